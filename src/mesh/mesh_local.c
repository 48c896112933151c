/* mesh_local.c - a mesh of doubles against a box, a block at a time. */
#include "mesh_local.h"

#include "base/bits.h"
#include "mesh_input.h"
#include "pairs/settle.h"

/* Triangles that are copied at a time where they cannot be read from where they lie. */
enum { COPIED = 128, BLOCK_WORDS = TRIBOX_MESH_BLOCK / 64 };

bool tribox_is_ordinary(const tribox_box *box)
{
    for (int a = 0; a < 3; a++) {
        const double length = box->hi[a] - box->lo[a];
        if (!(length >= 0x1p-36) || !(length <= 0x1p36))
            return false;
    }
    return true;
}

void tribox_local_box_make(const tribox_box *box, const tribox_plan *plan, tribox_local_box *local)
{
    const bool is_for_all = plan->axes == TRIBOX_AXES_ALL && tribox_is_ordinary(box);
    local->box = box;
    local->walk = is_for_all ? TRIBOX_LOCAL_ALL : TRIBOX_LOCAL_BOX;
    local->are_hits_certain = is_for_all || plan->axes == TRIBOX_AXES_BOX;
    for (int a = 0; a < 3; a++) {
        local->moved.lo[a] = local->moved.of.origin[a] = 0;
        local->moved.hi[a] = local->moved.of.H[a] = (float)(box->hi[a] - box->lo[a]);
    }
    for (int k = 0; k < TRIBOX_LOCAL; k++) {
        local->origin[k] = box->lo[k % 3];
        local->pattern.lo[k] = 0;
        local->pattern.hi[k] = local->moved.hi[k % 3];
    }
    local->pattern.origin = local->origin;
}

static void read_doubles(const tribox_mesh *mesh, size_t triangle, double u[3][3])
{
    for (size_t v = 0; v < 3; v++)
        tribox_position_read(mesh, tribox_vertex_number(mesh, tribox_vertex_bytes(mesh), 3 * triangle + v), u[v]);
}

/*
 * Bullet 1 of the paper, on the doubles. NaN is not apart: the next stage finds it. Without branches, which could not be
 * foreseen.
 */
static bool is_apart_in_double(double u[3][3], const tribox_box *box)
{
    bool apart = false;
    for (int a = 0; a < 3; a++) {
        const double lo = box->lo[a], hi = box->hi[a];
        apart |= (bool)((u[0][a] < lo) & (u[1][a] < lo) & (u[2][a] < lo));
        apart |= (bool)((u[0][a] > hi) & (u[1][a] > hi) & (u[2][a] > hi));
    }
    return apart;
}

/* Open pairs, until they fill a batch. */
typedef struct gathering {
    tribox_batch batch;
    size_t lane[TRIBOX_BATCH];
    unsigned count;
} gathering;

static void gather_pair(gathering *g, double u[3][3], const tribox_box *box, size_t lane)
{
    for (int a = 0; a < 3; a++) {
        for (int v = 0; v < 3; v++)
            g->batch.number[3 * a + v][g->count] = u[v][a];
        g->batch.number[9 + a][g->count] = box->lo[a];
        g->batch.number[12 + a][g->count] = box->hi[a];
    }
    g->lane[g->count++] = lane;
}

/* Adds those that overlap to the hits. Returns how many have finite numbers. */
static size_t settle(gathering *g, const tribox_plan *plan, uint64_t *hit)
{
    const tribox_verdict verdict = tribox_settle_batch(&g->batch, g->count, plan);
    for (uint64_t left = verdict.overlapping; left; left &= left - 1) {
        const size_t lane = g->lane[tribox_lowest_bit(left)];
        hit[lane / 64] |= UINT64_C(1) << lane % 64;
    }
    g->count = 0;
    return tribox_count_bits(verdict.finite);
}

/* Word w has the triangles from first[w] on. What is gathered lies on the stack only while it is used, as below. */
TRIBOX_NOINLINE size_t settle_words(const tribox_mesh *mesh, const size_t *first, const tribox_local_box *local,
                                    const tribox_plan *plan, size_t words, const uint64_t *undecided, uint64_t *hit)
{
    gathering g;
    size_t settled = 0;
    g.count = 0;
    for (size_t w = 0; w < words; w++)
        for (uint64_t left = undecided[w]; left; left &= left - 1) {
            const size_t bit = tribox_lowest_bit(left), lane = 64 * w + bit;
            double u[3][3];
            read_doubles(mesh, first[w] + bit, u);
            if (plan->axes & TRIBOX_AXES_BOX && is_apart_in_double(u, local->box))
                continue;
            gather_pair(&g, u, local->box, lane);
            if (g.count == TRIBOX_BATCH)
                settled += settle(&g, plan, hit);
        }
    return settled + (g.count ? settle(&g, plan, hit) : 0);
}

/*
 * Triangles of any positions as nine doubles each. Fewer than a kernel has lanes are followed by the first, as packets are whole.
 */
static void copy_nines(const tribox_mesh *mesh, size_t first, size_t count, unsigned lanes, double (*nine)[3][3])
{
    tribox_mesh_read_corners(mesh, 3 * first, 3 * count, nine[0]);
    for (size_t i = count; i < lanes; i++)
        memcpy(nine[i], nine[0], sizeof nine[i]);
}

/* The walk's answers, bit by bit; of triangles that it is not asked about, nothing is known. */
static void walk(const tribox_corners *corners, size_t count, const tribox_local_box *local, const tribox_plan *plan, uint64_t *hit,
                 uint64_t *undecided)
{
    const tribox_query pairs = {.corners = corners, .box = &local->moved, .count = count};
    plan->kernel->walk_local[local->walk](&pairs, 0, count, hit, undecided);
    for (size_t w = 0; !local->are_hits_certain && w < tribox_words_of(count); w++) {
        undecided[w] |= hit[w];
        hit[w] = 0;
    }
}

/* Without the box normals nothing can be left out: every triangle is undecided. */
static void leave_undecided(size_t count, uint64_t *hit, uint64_t *undecided)
{
    for (size_t w = 0; w < tribox_words_of(count); w++) {
        hit[w] = 0;
        undecided[w] = count - 64 * w < 64 ? ~(~UINT64_C(0) << (count - 64 * w)) : ~UINT64_C(0);
    }
}

/* Walks the block in place, if all of it can be read so; *is_there: whether its vertices are there. */
TRIBOX_NOINLINE bool walk_in_place(const tribox_mesh *mesh, size_t first, size_t count, const tribox_local_box *local,
                                   const tribox_plan *plan, uint64_t *hit, uint64_t *undecided, bool *is_there)
{
    uint32_t offset[3 * TRIBOX_MESH_BLOCK];
    tribox_corners corners;
    *is_there = plan->kernel->find_corners(mesh, first, count, offset, &corners) < mesh->vertices;
    if (!*is_there)
        return false;
    if (!(plan->axes & TRIBOX_AXES_BOX)) {
        leave_undecided(count, hit, undecided);
        return true;
    }
    if (!tribox_mesh_has_doubles(mesh) || !corners.base || !corners.has_all || count < plan->kernel->lanes)
        return false;
    corners.origin = local->origin;
    walk(&corners, count, local, plan, hit, undecided);
    return true;
}

TRIBOX_NOINLINE void walk_copied(const tribox_mesh *mesh, size_t first, size_t count, const tribox_local_box *local,
                                 const tribox_plan *plan, uint64_t *hit, uint64_t *undecided)
{
    _Alignas(64) double nine[COPIED][3][3];
    copy_nines(mesh, first, count, plan->kernel->lanes, nine);
    const tribox_corners corners = {.base = (const char *)nine, .origin = local->origin, .has_all = true};
    walk(&corners, count, local, plan, hit, undecided);
}

/* Walks as much of the block as it can (tribox_answer_block): in place or a copied prefix. */
static size_t walk_block(const tribox_mesh *mesh, size_t first, size_t count, const tribox_local_box *local,
                         const tribox_plan *plan, uint64_t *hit, uint64_t *undecided)
{
    bool is_there;
    if (walk_in_place(mesh, first, count, local, plan, hit, undecided, &is_there) || !is_there)
        return is_there ? count : 0;
    const size_t copied = count < COPIED ? count : COPIED;
    walk_copied(mesh, first, copied, local, plan, hit, undecided);
    return copied;
}

size_t tribox_mesh_answer_local(const tribox_mesh_query *query, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                tribox_report *counts)
{
    uint64_t unasked[BLOCK_WORDS], undecided[BLOCK_WORDS], *const hit = mask ? mask : unasked;
    const size_t done = walk_block(mesh, first, count, query->about, query->plan, hit, undecided), words = tribox_words_of(done);
    size_t first_of[BLOCK_WORDS];
    for (size_t w = 0; w < BLOCK_WORDS; w++)
        first_of[w] = first + 64 * w;
    counts->undecided += settle_words(mesh, first_of, query->about, query->plan, words, undecided, hit);
    for (size_t w = 0; w < words; w++)
        counts->overlapping += tribox_count_bits(hit[w]);
    return done;
}

static size_t answer_local_corners(const tribox_mesh_query *query, const tribox_mesh *mesh, const tribox_corners *corners,
                                   const size_t *first, size_t count, uint64_t *hit)
{
    const tribox_local_box *const local = query->about;
    uint64_t undecided[BLOCK_WORDS];
    tribox_corners doubles = *corners;
    doubles.origin = local->origin;
    walk(&doubles, count, local, query->plan, hit, undecided);
    return settle_words(mesh, first, local, query->plan, tribox_words_of(count), undecided, hit);
}

tribox_answer_corners *tribox_mesh_local_corners(const tribox_mesh *mesh)
{
    return tribox_mesh_has_doubles(mesh) ? answer_local_corners : NULL;
}

uint64_t tribox_mesh_inside(const tribox_mesh *mesh, const tribox_box *box, size_t first, uint64_t candidates)
{
    uint64_t found = 0;
    for (uint64_t left = candidates; left; left &= left - 1) {
        const unsigned lane = tribox_lowest_bit(left);
        double u[3][3];
        bool is_inside = true;
        read_doubles(mesh, first + lane, u);
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                is_inside &= u[v][a] >= box->lo[a] && u[v][a] <= box->hi[a];
        found |= (uint64_t)is_inside << lane;
    }
    return found;
}
