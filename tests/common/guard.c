#include "guard.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

#include "guarded_pages.h"

char doing[DOING_TEXT];

guarded guarded_make(size_t bytes)
{
    const size_t page = page_size(), size = (bytes + page - 1) / page * page;
    unsigned char *const all = pages_reserve(size + 2 * page);
    assert_non_null(all);
    const guarded g = {all + page, size};
    guarded_read_only(g, false);
    return g;
}

void guarded_free(guarded g) { pages_release(g.first - page_size(), g.size + 2 * page_size()); }

void *guarded_tail(guarded g, size_t bytes) { return g.first + g.size - bytes; }

void guarded_read_only(guarded g, bool is_read_only)
{
    assert_true(!g.size || pages_allow(g.first, g.size, is_read_only ? PAGES_READ_ONLY : PAGES_OPEN));
}

void *guarded_room(guarded *g, size_t bytes)
{
    if (g->first && g->size < bytes)
        guarded_free(*g);
    if (!g->first || g->size < bytes)
        *g = guarded_make(bytes);
    guarded_read_only(*g, false);
    return guarded_tail(*g, bytes);
}

static void tell(const char *fault)
{
    pages_tell(fault);
    pages_tell(" in ");
    pages_tell(doing);
    pages_tell("\n");
}

/* To be called in each test: cmocka puts its own handlers in place before it. */
void catch_faults(void) { pages_catch_faults(tell); }
