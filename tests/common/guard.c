#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "guard.h"

#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmocka.h>

char doing[DOING_TEXT];

static size_t page_size(void) { return (size_t)sysconf(_SC_PAGESIZE); }

guarded guarded_make(size_t bytes)
{
    const size_t page = page_size(), size = (bytes + page - 1) / page * page;
    unsigned char *const all = mmap(NULL, size + 2 * page, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(all != MAP_FAILED);
    const guarded g = {all + page, size};
    guarded_read_only(g, false);
    return g;
}

void guarded_free(guarded g) { munmap(g.first - page_size(), g.size + 2 * page_size()); }

void *guarded_tail(guarded g, size_t bytes) { return g.first + g.size - bytes; }

void guarded_read_only(guarded g, bool is_read_only)
{
    assert_int_equal(mprotect(g.first, g.size, is_read_only ? PROT_READ : PROT_READ | PROT_WRITE), 0);
}

/* Only calls that a signal handler may make. */
static void tell(const char *text)
{
    if (write(STDERR_FILENO, text, strlen(text)) < 0)
        _exit(1);
}

static void end_with_message(int signal_number)
{
    tell(signal_number == SIGILL   ? "illegal instruction"
         : signal_number == SIGFPE ? "floating-point trap"
                                   : "memory touched that is not the caller's");
    tell(" in ");
    tell(doing);
    tell("\n");
    _exit(1);
}

/* To be called in each test: cmocka puts its own handlers in place before it. */
void catch_faults(void)
{
    static const int signals[] = {SIGSEGV, SIGBUS, SIGILL, SIGFPE};
    for (size_t k = 0; k < sizeof signals / sizeof signals[0]; k++)
        signal(signals[k], end_with_message);
}
