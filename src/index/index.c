/* index.c - indices: their size, building them and keeping them up to date. */
#include <string.h>

#include "dispatch.h"
#include "base/environment.h"
#include "indexed.h"
#include "mesh/mesh_input.h"

size_t tribox_index_bytes(size_t count)
{
    tribox_levels levels;
    tribox_levels_set(&levels, count);
    return (levels.start[levels.count - 1] + 1) * sizeof(tribox_node);
}

/* Nodes that are written, first to last of the lowest level and what is above them. */
typedef struct site {
    tribox_indexed over;
    const tribox_kernel *kernel;
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
        tribox_indexed_bound(&s->over, s->kernel, TRIBOX_INDEX_BLOCK * j, &node);
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
            tribox_indexed_bound_nodes(&s->over, s->kernel, built_node(s, level - 1, 64 * j), left < 64 ? left : 64, &node);
            memcpy(built_node(s, level, j), &node, sizeof node);
        }
    }
}

static tribox_status take_site(const tribox_index *index, const tribox_options *options, void *nodes, site *s)
{
    if (!nodes || !tribox_indexed_take(index, &s->over))
        return TRIBOX_BAD_ARGUMENT;
    s->kernel = tribox_kernel_find(options ? options->kernel : NULL);
    s->memory = nodes;
    tribox_levels_set(&s->levels, s->over.count);
    return s->kernel ? TRIBOX_OK : TRIBOX_NO_KERNEL;
}

/* The triangles under nodes first .. last of the lowest level, or TRIBOX_BAD_VERTEX. */
static tribox_status check_vertices(const site *s, size_t first, size_t last)
{
    const size_t from = TRIBOX_INDEX_BLOCK * first, left = s->over.count - from;
    const size_t count = last - first < left / TRIBOX_INDEX_BLOCK ? (last - first + 1) * TRIBOX_INDEX_BLOCK : left;
    const bool are_there = s->over.soup || tribox_mesh_is_in_range(&s->over.mesh, s->kernel, from, count);
    return are_there ? TRIBOX_OK : TRIBOX_BAD_VERTEX;
}

tribox_status tribox_index_build(const tribox_index *index, const tribox_options *options, void *nodes)
{
    site s;
    tribox_status status = take_site(index, options, nodes, &s);
    const size_t last = status ? 0 : s.levels.nodes[0] - 1;
    if (!status)
        status = check_vertices(&s, 0, last);
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    write_lowest(&s, 0, last);
    write_upper(&s, 0, last);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}

tribox_status tribox_index_update(const tribox_index *index, size_t first, size_t count, const tribox_options *options, void *nodes)
{
    site s;
    tribox_status status = take_site(index, options, nodes, &s);
    if (status)
        return status;
    const size_t all = s.over.count, end = first + count;
    if (first > all || count > all - first)
        return TRIBOX_BAD_ARGUMENT;
    const bool is_shared = first % TRIBOX_INDEX_BLOCK == 0 && (end % TRIBOX_INDEX_BLOCK == 0 || end == all);
    const size_t from = count ? first / TRIBOX_INDEX_BLOCK : 0;
    const size_t to = count ? (end - 1) / TRIBOX_INDEX_BLOCK : s.levels.nodes[0] - 1;
    status = count ? check_vertices(&s, from, to) : TRIBOX_OK;
    if (status)
        return status;
    const tribox_environment callers = tribox_environment_enter();
    if (count || !all)
        write_lowest(&s, from, to);
    if (!count || !is_shared || count == all)
        write_upper(&s, from, to);
    tribox_environment_leave(callers);
    return TRIBOX_OK;
}
