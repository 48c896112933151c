/* in_console.c - runs a command in its console, in code page 437. Says on standard error when the command shows UTF-8 there,
 * presses Ctrl-C at a line from standard input, and says in which code page the command leaves the console: in_console COMMAND */
#include <stdio.h>
#include <windows.h>

enum { BEFORE = 437, MOMENT = 10, WAIT = 60 * 1000 };

/* Ctrl-C is for the command. */
static BOOL WINAPI go_on(DWORD event)
{
    (void)event;
    return TRUE;
}

static int fail(const char *what)
{
    fprintf(stderr, "%s: error %lu\n", what, (unsigned long)GetLastError());
    return 1;
}

int main(int count, char **words)
{
    PROCESS_INFORMATION process;
    HANDLE input, silence; /* the command reads what never comes */
    if (count != 2)
        return fail("usage: in_console COMMAND");
    if (!SetConsoleOutputCP(BEFORE) || !SetConsoleCtrlHandler(go_on, TRUE))
        return fail("no console");
    if (!CreatePipe(&input, &silence, NULL, 0) || !SetHandleInformation(input, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT))
        return fail("no pipe");
    STARTUPINFOA start = {.cb = sizeof start, .dwFlags = STARTF_USESTDHANDLES, .hStdInput = input};
    start.hStdOutput = GetStdHandle(STD_OUTPUT_HANDLE);
    start.hStdError = GetStdHandle(STD_ERROR_HANDLE);
    if (!CreateProcessA(NULL, words[1], NULL, NULL, TRUE, 0, NULL, NULL, &start, &process))
        return fail("cannot run the command");
    for (int waited = 0; GetConsoleOutputCP() == BEFORE; waited += MOMENT)
        if (waited >= WAIT || !WaitForSingleObject(process.hProcess, MOMENT))
            return fail("the command does not show UTF-8");
    fprintf(stderr, "shows UTF-8\n");
    if (getchar() == EOF || !GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0) || WaitForSingleObject(process.hProcess, WAIT))
        return fail("the command does not end");
    fprintf(stderr, "leaves %u\n", GetConsoleOutputCP());
    return 0;
}
