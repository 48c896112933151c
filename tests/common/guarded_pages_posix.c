/* guarded_pages_posix.c - pages by mmap and mprotect, faults by signals. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS, MAP_NORESERVE */
#include "guarded_pages.h"

#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

static void (*tell_fault)(const char *fault);

size_t page_size(void) { return (size_t)sysconf(_SC_PAGESIZE); }

void *pages_reserve(size_t bytes)
{
    void *const pages = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    return pages != MAP_FAILED ? pages : NULL;
}

void pages_release(void *pages, size_t bytes) { munmap(pages, bytes); }

bool pages_allow(void *from, size_t bytes, page_access access)
{
    static const int flags[] = {[PAGES_HIDDEN] = PROT_NONE, [PAGES_READ_ONLY] = PROT_READ, [PAGES_OPEN] = PROT_READ | PROT_WRITE};
    return !mprotect(from, bytes, flags[access]);
}

/* Only calls that a signal handler may make. */
void pages_tell(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0)
        _exit(1);
}

static void end_with_message(int signal_number)
{
    tell_fault(signal_number == SIGILL   ? "illegal instruction"
               : signal_number == SIGFPE ? "floating-point trap"
                                         : "memory touched that is not the caller's");
    _exit(1);
}

void pages_catch_faults(void (*tell)(const char *fault))
{
    static const int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE};
    tell_fault = tell;
    for (size_t k = 0; k < sizeof signals / sizeof signals[0]; k++)
        signal(signals[k], end_with_message);
}
