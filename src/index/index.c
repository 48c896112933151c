/* index.c - indices over soups: their size, building them and keeping them up to date. */
#include <string.h>

#include "dispatch.h"
#include "base/environment.h"
#include "index_levels.h"
#include "base/soup.h"

size_t tribox_index_bytes(size_t count)
{
    tribox_levels levels;
    tribox_levels_set(&levels, count);
    return (levels.start[levels.count - 1] + 1) * sizeof(tribox_node);
}

/* An index that is written. */
typedef struct site {
    const tribox_soup *soup;
    const tribox_nodes_kernel *kernel;
    char *memory;
    tribox_levels levels;
} site;

static char *built_node(const site *s, unsigned level, size_t j)
{
    return s->memory + (s->levels.start[level] + j) * sizeof(tribox_node);
}

/* Nodes first .. last of the lowest level. Every node is made where it is aligned. */
static void write_lowest(const site *s, size_t first, size_t last)
{
    for (size_t j = first; j <= last; j++) {
        tribox_node node;
        s->kernel->bound_soup(s->soup, 64 * j, &node);
        memcpy(built_node(s, 0, j), &node, sizeof node);
    }
}

/* The nodes above nodes first .. last of the lowest level, on all levels. */
static void write_upper(const site *s, size_t first, size_t last)
{
    for (unsigned level = 1; level < s->levels.count; level++) {
        first /= 64;
        last /= 64;
        for (size_t j = first; j <= last; j++) {
            const size_t left = s->levels.nodes[level - 1] - 64 * j;
            tribox_node node;
            s->kernel->bound_nodes(built_node(s, level - 1, 64 * j), left < 64 ? left : 64, &node);
            memcpy(built_node(s, level, j), &node, sizeof node);
        }
    }
}

static tribox_status check_index(const tribox_soup *soup, const tribox_options *options, void *memory, site *s)
{
    if (!memory || !tribox_soup_is_readable(soup))
        return TRIBOX_BAD_ARGUMENT;
    const tribox_kernel *const kernel = tribox_kernel_find(options ? options->kernel : NULL);
    if (!kernel)
        return TRIBOX_NO_KERNEL;
    s->soup = soup;
    s->kernel = kernel->nodes;
    s->memory = memory;
    tribox_levels_set(&s->levels, soup->count);
    return TRIBOX_OK;
}

tribox_status tribox_index_build(const tribox_soup *soup, const tribox_options *options, void *memory, tribox_index *index)
{
    site s;
    const tribox_status status = check_index(soup, options, memory, &s);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    write_lowest(&s, 0, s.levels.nodes[0] - 1);
    write_upper(&s, 0, s.levels.nodes[0] - 1);
    tribox_environment_leave(callers);
    if (index)
        *index = (tribox_index){memory, soup->count};
    return TRIBOX_OK;
}

tribox_status tribox_index_update(const tribox_soup *soup, size_t first, size_t count, const tribox_options *options, void *memory)
{
    site s;
    const tribox_status status = check_index(soup, options, memory, &s);
    if (status)
        return status;
    if (first > soup->count || count > soup->count - first)
        return TRIBOX_BAD_ARGUMENT;
    const size_t end = first + count;
    const bool is_shared = first % TRIBOX_INDEX_BLOCK == 0 && (end % TRIBOX_INDEX_BLOCK == 0 || end == soup->count);
    const size_t from = count ? first / TRIBOX_INDEX_BLOCK : 0;
    const size_t to = count ? (end - 1) / TRIBOX_INDEX_BLOCK : s.levels.nodes[0] - 1;
    const tribox_environment callers = tribox_environment_enter();
    if (count || !soup->count)
        write_lowest(&s, from, to);
    if (!count || !is_shared || count == soup->count)
        write_upper(&s, from, to);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
