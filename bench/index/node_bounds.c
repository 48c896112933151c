/* node_bounds.c - bounds of 64, and the descent through them. */
#include "node_bounds.h"

#include <math.h>
#include <stdlib.h>

static size_t groups_of(size_t count) { return (count + 63) / 64; }

static const tribox_box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(tribox_box *by, const double lo[3], const double hi[3])
{
    for (int a = 0; a < 3; a++) {
        by->lo[a] = fmin(by->lo[a], lo[a]);
        by->hi[a] = fmax(by->hi[a], hi[a]);
    }
}

static void bound_words(const tribox_soup *soup, tribox_box *words)
{
    for (size_t i = 0; i < soup->count; i++) {
        if (i % 64 == 0)
            words[i / 64] = nothing;
        for (int v = 0; v < 3; v++) {
            const double p[3] = {soup->x[v][i], soup->y[v][i], soup->z[v][i]};
            widen(&words[i / 64], p, p);
        }
    }
}

bool node_bounds_make(const tribox_soup *soup, node_bounds *made)
{
    size_t all = 0;
    *made = (node_bounds){.levels = 0};
    for (size_t n = soup->count; made->levels == 0 || n > 1;) {
        n = groups_of(n);
        made->count[made->levels++] = n;
        all += n;
    }
    made->storage = malloc((all + 1) * sizeof *made->storage);
    if (!made->storage)
        return false;
    made->level[0] = made->storage;
    bound_words(soup, made->level[0]);
    for (int l = 1; l < made->levels; l++) {
        made->level[l] = made->level[l - 1] + made->count[l - 1];
        for (size_t i = 0; i < made->count[l - 1]; i++) {
            if (i % 64 == 0)
                made->level[l][i / 64] = nothing;
            widen(&made->level[l][i / 64], made->level[l - 1][i].lo, made->level[l - 1][i].hi);
        }
    }
    return true;
}

void node_bounds_free(node_bounds *made)
{
    free(made->storage);
    *made = (node_bounds){.levels = 0};
}

static bool touches(const tribox_box *p, const tribox_box *q)
{
    bool is_touched = true;
    for (int a = 0; a < 3; a++)
        is_touched = is_touched && p->lo[a] <= q->hi[a] && p->hi[a] >= q->lo[a];
    return is_touched;
}

static bool is_within(const tribox_box *p, const tribox_box *q)
{
    bool is_inside = true;
    for (int a = 0; a < 3; a++)
        is_inside = is_inside && p->lo[a] >= q->lo[a] && p->hi[a] <= q->hi[a];
    return is_inside;
}

/* The words below entry `at` of a level. */
static size_t words_below(const node_bounds *b, int level, size_t at)
{
    const size_t each = (size_t)1 << 6 * level, first = at * each, left = b->count[0] - first;
    return left < each ? left : each;
}

/* A node holds 64 entries of a level: node j those from 64 * j on. */
static void visit(const node_bounds *b, const tribox_box *box, int level, size_t j, uint32_t *asked, node_visits *v)
{
    const size_t end = 64 * j + 64 < b->count[level] ? 64 * j + 64 : b->count[level];
    v->nodes++;
    for (size_t at = 64 * j; at < end; at++) {
        const tribox_box *const entry = &b->level[level][at];
        if (!touches(entry, box))
            continue;
        if (is_within(entry, box))
            v->inside += words_below(b, level, at);
        else if (level > 0)
            visit(b, box, level - 1, at, asked, v);
        else {
            if (asked)
                asked[v->asked] = (uint32_t)at;
            v->asked++;
        }
    }
}

node_visits node_bounds_visit(const node_bounds *b, const tribox_box *box, uint32_t *asked)
{
    node_visits v = {0, 0, 0};
    const int top = b->levels > 1 ? b->levels - 2 : 0; /* the one box of all is not part of an index */
    visit(b, box, top, 0, asked, &v);
    return v;
}
