/* guarded_pages_windows.c - pages by VirtualAlloc and VirtualProtect, faults by structured exceptions. */
#include "guarded_pages.h"

#include <string.h>
#include <windows.h>

static void (*tell_fault)(const char *fault);

size_t page_size(void)
{
    SYSTEM_INFO about;
    GetSystemInfo(&about);
    return about.dwPageSize;
}

void *pages_reserve(size_t bytes) { return VirtualAlloc(NULL, bytes, MEM_RESERVE, PAGE_NOACCESS); }

void pages_release(void *pages, size_t bytes)
{
    (void)bytes;
    VirtualFree(pages, 0, MEM_RELEASE);
}

bool pages_allow(void *from, size_t bytes, page_access access)
{
    static const DWORD flags[] = {[PAGES_HIDDEN] = PAGE_NOACCESS, [PAGES_READ_ONLY] = PAGE_READONLY, [PAGES_OPEN] = PAGE_READWRITE};
    DWORD before;
    return VirtualAlloc(from, bytes, MEM_COMMIT, PAGE_READWRITE) && VirtualProtect(from, bytes, flags[access], &before);
}

void pages_tell(const char *text)
{
    DWORD written;
    WriteFile(GetStdHandle(STD_ERROR_HANDLE), text, (DWORD)strlen(text), &written, NULL);
}

static LONG CALLBACK end_with_message(EXCEPTION_POINTERS *fault)
{
    const DWORD code = fault->ExceptionRecord->ExceptionCode;
    const bool is_float = code >= EXCEPTION_FLT_DENORMAL_OPERAND && code <= EXCEPTION_FLT_UNDERFLOW;
    tell_fault(code == EXCEPTION_ILLEGAL_INSTRUCTION ? "illegal instruction"
               : is_float                            ? "floating-point trap"
                                                     : "memory touched that is not the caller's");
    TerminateProcess(GetCurrentProcess(), 1);
    return EXCEPTION_EXECUTE_HANDLER;
}

void pages_catch_faults(void (*tell)(const char *fault))
{
    tell_fault = tell;
    SetUnhandledExceptionFilter(end_with_message);
}
