/*
 * system_windows.c - what the program asks Windows about streams, processors and memory: the command line in UTF-16 as UTF-8,
 * streams without line ends of their own, a console that shows UTF-8.
 */
#define _WIN32_WINNT 0x0601
#include "system.h"

#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <windows.h>

/* ------------------------------------------------------------------------------------------------------------------------- text */

wchar_t *wide_of_utf8(const char *text)
{
    const int count = MultiByteToWideChar(CP_UTF8, 0, text, -1, NULL, 0);
    wchar_t *const wide = malloc((size_t)count * sizeof *wide);
    if (wide)
        MultiByteToWideChar(CP_UTF8, 0, text, -1, wide, count);
    return wide;
}

char *utf8_of_wide(const wchar_t *text)
{
    const int count = WideCharToMultiByte(CP_UTF8, 0, text, -1, NULL, 0, NULL, NULL);
    char *const narrow = malloc((size_t)count);
    if (narrow)
        WideCharToMultiByte(CP_UTF8, 0, text, -1, narrow, count, NULL, NULL);
    return narrow;
}

/* --------------------------------------------------------------------------------------------------------------------- terminal */

enum { LINE_BYTES = 1024 };

static UINT code_page_before;

void terminal_end(void)
{
    if (code_page_before)
        SetConsoleOutputCP(code_page_before);
}

/* The system ends the program after this one, without atexit. */
static BOOL WINAPI end_interrupted(DWORD event)
{
    (void)event;
    terminal_end();
    return FALSE;
}

bool terminal_is(FILE *stream)
{
    DWORD mode;
    return GetConsoleMode((HANDLE)_get_osfhandle(_fileno(stream)), &mode);
}

static void prepare_streams(void)
{
    static char lines[LINE_BYTES];
    FILE *const streams[] = {stdin, stdout, stderr};
    for (int i = 0; i < 3; i++)
        _setmode(_fileno(streams[i]), _O_BINARY);
    _setmaxstdio(2048); /* many partitions are many open files */
    setvbuf(stderr, lines, _IOFBF, sizeof lines); /* or each byte is written by itself, half a letter at times */
    if (!terminal_is(stdout) && !terminal_is(stderr))
        return;
    code_page_before = GetConsoleOutputCP();
    atexit(terminal_end);
    SetConsoleCtrlHandler(end_interrupted, TRUE);
    SetConsoleOutputCP(CP_UTF8);
}

char **terminal_begin(int *count, char **words)
{
    prepare_streams();
    wchar_t **const wide = CommandLineToArgvW(GetCommandLineW(), count);
    char **const narrow = wide ? malloc(((size_t)*count + 1) * sizeof *narrow) : NULL;
    if (!narrow)
        return words;
    for (int i = 0; i < *count; i++) {
        narrow[i] = utf8_of_wide(wide[i]);
        if (!narrow[i])
            return words;
    }
    narrow[*count] = NULL;
    LocalFree(wide);
    return narrow;
}

/* ------------------------------------------------------------------------------------------------------------------- processors */

unsigned processors_here(void)
{
    const DWORD count = GetActiveProcessorCount(ALL_PROCESSOR_GROUPS);
    return count < 1 ? 1 : count < THREADS_MAX ? (unsigned)count : THREADS_MAX;
}

void processors_name(char *name, size_t size)
{
    DWORD bytes = (DWORD)size;
    if (RegGetValueA(HKEY_LOCAL_MACHINE, "HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0", "ProcessorNameString", RRF_RT_REG_SZ,
                     NULL, name, &bytes))
        snprintf(name, size, "unknown");
}

/* ----------------------------------------------------------------------------------------------------------------------- memory */

static uint64_t least(uint64_t a, uint64_t b) { return a < b ? a : b; }

uint64_t memory_available(void)
{
    MEMORYSTATUSEX about = {.dwLength = sizeof about};
    if (!GlobalMemoryStatusEx(&about))
        return UINT64_MAX;
    return least(about.ullAvailPhys, least(about.ullAvailPageFile, about.ullAvailVirtual));
}

/* ------------------------------------------------------------------------------------------------------------------------ pages */

/* Large pages take a right that few have: these are the usual ones. */
void *pages_take(size_t bytes) { return VirtualAlloc(NULL, bytes ? bytes : 1, MEM_RESERVE | MEM_COMMIT, PAGE_READWRITE); }

void pages_free(void *room, size_t bytes)
{
    (void)bytes;
    if (room)
        VirtualFree(room, 0, MEM_RELEASE);
}
