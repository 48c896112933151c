/* terminal_windows.c - the command line in UTF-16 as UTF-8, streams without line ends of their own, a console that shows UTF-8. */
#include "system.h"

#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <windows.h>

#include "wide_text.h"

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
