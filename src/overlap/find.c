/* find.c - the first triangle that overlaps a box, or that does not: the calls. */
#include "base/bits.h"
#include "base/environment.h"
#include "overlap_call.h"

/*
 * The first triangle whose bit differs from that of `usual`, or the count of triangles. The first blocks are small, as they often
 * have it. False if a triangle before it names no vertex.
 */
static bool find_unlike(tribox_overlap_call *c, uint64_t usual, size_t *found)
{
    tribox_report counts = {0, 0};
    size_t block = 64;
    for (size_t first = 0, done; first < c->count; first += done, block = block < TRIBOX_CALL_BLOCK ? 2 * block : block) {
        uint64_t hit[TRIBOX_BLOCK_WORDS];
        const size_t left = c->count - first;
        done = tribox_call_answer_block(c, first, left < block ? left : block, hit, &counts);
        if (!done)
            return false;
        for (size_t w = 0; w < tribox_words_of(done); w++)
            if (hit[w] != usual) { /* past the last triangle bits are zero: at the latest, the first unlike is one past it */
                *found = first + 64 * w + tribox_lowest_bit(hit[w] ^ usual);
                return true;
            }
    }
    *found = c->count;
    return true;
}

static tribox_status find_with(tribox_overlap_call *c, tribox_codes *codes, tribox_find_what what, size_t *triangle)
{
    const uint64_t usual = what == TRIBOX_FIRST_HIT ? 0 : ~UINT64_C(0);
    size_t found = 0;
    bool is_found = true;
    const tribox_environment callers = tribox_environment_enter();
    tribox_call_start(c, codes, false);
    if (c->is_empty)
        found = usual ? 0 : c->count;
    else
        is_found = find_unlike(c, usual, &found);
    tribox_environment_leave(callers);
    if (!is_found)
        return TRIBOX_BAD_VERTEX;
    *triangle = found;
    return TRIBOX_OK;
}

TRIBOX_NOINLINE tribox_status find_coded(tribox_overlap_call *c, tribox_find_what what, size_t *triangle)
{
    tribox_codes codes;
    return find_with(c, &codes, what, triangle);
}

/* One that was checked. */
static tribox_status find(tribox_overlap_call *c, tribox_status checked, tribox_find_what what, size_t *triangle)
{
    return checked ? checked : tribox_call_may_code(c) ? find_coded(c, what, triangle) : find_with(c, NULL, what, triangle);
}

static bool is_known(tribox_find_what what, const size_t *triangle) { return triangle && (unsigned)what <= TRIBOX_FIRST_MISS; }

tribox_status tribox_find(const tribox_soup *soup, const tribox_box *box, const tribox_options *options, tribox_find_what what,
                          size_t *triangle)
{
    tribox_overlap_call c;
    const bool is_taken = is_known(what, triangle) && tribox_call_take_soup(&c, soup);
    return find(&c, tribox_call_check(&c, is_taken, box, options), what, triangle);
}

tribox_status tribox_mesh_find(const tribox_mesh *mesh, const tribox_box *box, const tribox_options *options, tribox_find_what what,
                               size_t *triangle)
{
    tribox_overlap_call c;
    const bool is_taken = is_known(what, triangle) && tribox_call_take_mesh(&c, mesh);
    return find(&c, tribox_call_check(&c, is_taken, box, options), what, triangle);
}
