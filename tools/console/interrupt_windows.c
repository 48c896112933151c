/* interrupt_windows.c - removes unfinished files when Ctrl-C, Ctrl-Break or a closed window ends the program. */
#include "interrupt.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

#include "message.h"
#include "system.h"

enum { WATCHED_MOST = 16 };

static const char *volatile watched[WATCHED_MOST];
static char line[512];
static CRITICAL_SECTION making; /* the handler runs beside the program, in a thread of its own */

static bool is_within(const char *folder, const char *path)
{
    const size_t length = strlen(folder);
    return !strncmp(path, folder, length) && path[length] == '/';
}

/* A file that is open vanishes when the program ends. Until then it would keep its folder, if that is to go as well: out of it. */
static void remove_file(const char *path, wchar_t *wide)
{
    for (int i = 0; i < WATCHED_MOST; i++)
        if (watched[i] && is_within(watched[i], path)) {
            wchar_t *const outside = wide_of_utf8(path);
            if (outside)
                outside[wcslen(wide) - strlen(path) + strlen(watched[i])] = L'-';
            if (outside && MoveFileExW(wide, outside, 0))
                DeleteFileW(outside);
        }
    DeleteFileW(wide);
}

static void clean_one(const char *path)
{
    wchar_t *const wide = wide_of_utf8(path);
    if (wide && !RemoveDirectoryW(wide))
        remove_file(path, wide);
    free(wide);
}

/* The section is never left: what would be made now would stay. */
static BOOL WINAPI clean(DWORD event)
{
    DWORD written;
    (void)event;
    EnterCriticalSection(&making);
    for (int i = WATCHED_MOST; i-- > 0;)
        if (watched[i])
            clean_one(watched[i]);
    WriteFile(GetStdHandle(STD_ERROR_HANDLE), line, (DWORD)strlen(line), &written, NULL);
    terminal_end();
    TerminateProcess(GetCurrentProcess(), STATUS_CONTROL_C_EXIT); /* as the system would, but before the others go on */
    return TRUE;
}

static void start(void)
{
    static bool is_started;
    if (is_started)
        return;
    is_started = true;
    if (!line[0])
        interrupt_advise("nothing was written; run it again");
    InitializeCriticalSection(&making);
    SetConsoleCtrlHandler(clean, TRUE);
}

void interrupt_hold(void)
{
    start();
    EnterCriticalSection(&making);
}

void interrupt_release(void) { LeaveCriticalSection(&making); }

static void replace(const char *path, const char *by)
{
    for (int i = 0; i < WATCHED_MOST; i++)
        if (watched[i] == path) {
            watched[i] = by;
            break;
        }
}

void interrupt_watch(const char *path) { replace(NULL, path); }

void interrupt_forget(const char *path) { replace(path, NULL); }

void interrupt_advise(const char *advice)
{
    message_line(line, sizeof line, "interrupted: ", advice);
    start();
}
