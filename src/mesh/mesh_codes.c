/* mesh_codes.c - which vertices are coded, and what codes leave open answered like any other triangles. */
#include "mesh_codes.h"

#include <string.h>

#include "base/bits.h"
#include "base/floats.h"
#include "mesh_input.h"

#if defined(__SSE2__) || defined(_M_X64)
#include <emmintrin.h>
#endif

/*
 * Triangles that are told together; open ones that are answered together, and how many are left alone after a part with more; the
 * fewest of a mesh that are worth it.
 */
enum { PART = 256, OPEN = 128, UNTOLD = 4096, CODED_LEAST = 256 };

/* A bit in each byte: of eight triangles. */
#define EACH_BYTE UINT64_C(0x0101010101010101)

bool tribox_codes_help(const tribox_mesh *mesh)
{
    return mesh->indices && mesh->count >= CODED_LEAST && mesh->vertices <= 4 * mesh->count &&
           (tribox_mesh_has_floats(mesh) || tribox_mesh_has_doubles(mesh));
}

/* Of floats: the float below a bound is below the least one that is not below it. */
static void make_coded_box(const tribox_box *box, bool is_double, tribox_coded_box *coded)
{
    for (int k = 0; is_double && k < 3 * TRIBOX_DOUBLES_MAX; k++) {
        coded->below.wide[k] = -tribox_double_above(-box->lo[k % 3]);
        coded->above.wide[k] = tribox_double_above(box->hi[k % 3]);
    }
    for (int k = 0; !is_double && k < 3 * TRIBOX_LANES_MAX; k++) {
        coded->below.single[k] = tribox_float_below(tribox_float_from(box->lo[k % 3]));
        coded->above.single[k] = tribox_float_above(-tribox_float_from(-box->hi[k % 3]));
    }
}

void tribox_codes_start(tribox_codes *codes, const tribox_mesh *mesh, const tribox_box *box, bool is_all_asked)
{
    make_coded_box(box, tribox_mesh_has_doubles(mesh), &codes->box);
    codes->first = codes->end = codes->untold = codes->answered = 0;
    codes->credit = is_all_asked ? 2 * mesh->count + mesh->vertices : 0;
    codes->earned = is_all_asked ? 0 : 4;
}

/* Vertices first .. end - 1. Those that do not follow each other, and fewer than are compared at a time, are copied first. */
static void code(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t end)
{
    const size_t bytes = 3 * tribox_position_bytes(mesh);
    const bool is_packed = mesh->stride == bytes && (uintptr_t)mesh->positions % tribox_position_bytes(mesh) == 0;
    tribox_code *const code_some = bytes == 3 * sizeof(float) ? q->plan->kernel->code : q->plan->kernel->settle->code;
    for (size_t at = first, count; at < end; at += count) {
        const char *const from = (const char *)mesh->positions + at * mesh->stride;
        uint8_t *const to = q->codes->code + at % TRIBOX_CODES;
        count = TRIBOX_CODES - at % TRIBOX_CODES;
        count = end - at < count ? end - at : count;
        if (is_packed && count >= TRIBOX_CODED) {
            count = count / TRIBOX_CODED * TRIBOX_CODED;
            code_some(from, count, &q->codes->box, to);
            continue;
        }
        double copy[3 * TRIBOX_CODED] = {0};
        uint8_t some[TRIBOX_CODED];
        count = count < TRIBOX_CODED ? count : TRIBOX_CODED;
        for (size_t v = 0; v < count; v++)
            memcpy((char *)copy + v * bytes, from + v * mesh->stride, bytes);
        code_some(copy, TRIBOX_CODED, &q->codes->box, some);
        memcpy(to, some, count);
    }
}

/*
 * Whether all vertices from the least to the greatest have codes now. Most files list vertices in the order in which triangles need
 * them, so the window moves up; of what it leaves behind the latest stays.
 */
static bool have_codes(const tribox_mesh_query *q, const tribox_mesh *mesh, tribox_vertices named)
{
    enum { STEP = 64, GAP = 4096 }; /* windows begin and end at multiples, so that codes are made in whole packets */
    tribox_codes *const c = q->codes;
    if (named.least >= c->first && named.greatest < c->end)
        return true;
    const bool is_whole = mesh->vertices <= TRIBOX_CODES;
    const size_t least = is_whole ? 0 : named.least / STEP * STEP, last = named.greatest / STEP * STEP + STEP,
                 end = is_whole || last > mesh->vertices ? mesh->vertices : last;
    const bool is_next = least >= c->first && least <= c->end + GAP && c->end % STEP == 0;
    const size_t from = is_next ? c->end : least;
    if (end - least > TRIBOX_CODES || end - from > c->credit)
        return false;
    code(q, mesh, from, end);
    c->credit -= end - from;
    c->first = !is_next ? least : end > c->first + TRIBOX_CODES ? end - TRIBOX_CODES : c->first;
    c->end = end;
    return true;
}

/* Whether triangles first .. first + count - 1 have codes; *is_there: whether all their vertices are there. */
static bool are_coded(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, bool *is_there)
{
    const tribox_vertices named = q->plan->kernel->find_vertices(mesh, first, count);
    *is_there = named.greatest < mesh->vertices;
    return *is_there && have_codes(q, mesh, named);
}

/* Which of 64 bytes have their highest bit set, once no more than these bits are kept, and this is added. */
#if defined(__SSE2__) || defined(_M_X64)
static uint64_t highest_bits(const uint8_t *byte, uint8_t kept, uint8_t added)
{
    uint64_t bits = 0;
    for (int at = 0; at < 64; at += 16) {
        const __m128i some = _mm_and_si128(_mm_load_si128((const __m128i *)(const void *)(byte + at)), _mm_set1_epi8((char)kept));
        bits |= (uint64_t)_mm_movemask_epi8(_mm_add_epi8(some, _mm_set1_epi8((char)added))) << at;
    }
    return bits;
}
#else
static uint64_t highest_bits(const uint8_t *byte, uint8_t kept, uint8_t added)
{
    uint64_t bits = 0;
    for (int at = 0; at < 64; at += 8) {
        uint64_t eight = 0;
        for (int k = 0; k < 8; k++)
            eight |= (uint64_t)byte[at + k] << 8 * k;
        eight = (eight & kept * EACH_BYTE) + added * EACH_BYTE;
        bits |= ((eight >> 7 & EACH_BYTE) * UINT64_C(0x0102040810204080) >> 56) << at;
    }
    return bits;
}
#endif

/* The bits that the three vertices of a triangle share. */
TRIBOX_INLINE uint8_t shared_bits(const tribox_mesh *mesh, unsigned index_bytes, const uint8_t *code, size_t i)
{
    return code[tribox_vertex_number(mesh, index_bytes, 3 * i) % TRIBOX_CODES] &
           code[tribox_vertex_number(mesh, index_bytes, 3 * i + 1) % TRIBOX_CODES] &
           code[tribox_vertex_number(mesh, index_bytes, 3 * i + 2) % TRIBOX_CODES];
}

TRIBOX_INLINE void share_bits(const tribox_mesh *mesh, unsigned index_bytes, const uint8_t *code, size_t first, size_t count,
                              uint8_t *shared)
{
    size_t i = 0;
    for (; i + 4 <= count; i += 4)
        for (size_t k = 0; k < 4; k++)
            shared[i + k] = shared_bits(mesh, index_bytes, code, first + i + k);
    for (; i < count; i++)
        shared[i] = shared_bits(mesh, index_bytes, code, first + i);
}

/* Triangles that the codes leave open, answered as a mesh of their own, of the same vertices. */
typedef struct open_list {
    uint32_t vertex[OPEN][3];
    uint8_t lane[OPEN]; /* of the part */
    size_t count;
} open_list;

static void answer_open(const tribox_mesh_query *q, const tribox_mesh *mesh, const open_list *open, uint64_t *mask,
                        tribox_report *counts)
{
    uint64_t hit[OPEN / 64];
    tribox_mesh some = *mesh;
    some.indices = open->vertex;
    some.index_bytes = sizeof open->vertex[0][0];
    some.count = open->count;
    for (size_t done = 0; done < open->count;)
        done += q->answer(q, &some, done, open->count - done, hit + done / 64, counts);
    for (size_t w = 0; w < tribox_words_of(open->count); w++)
        for (uint64_t left = hit[w]; left; left &= left - 1) {
            const size_t lane = open->lane[64 * w + tribox_lowest_bit(left)];
            mask[lane / 64] |= UINT64_C(1) << lane % 64;
        }
}

/* Triangles first .. first + count - 1, a part at most. False if too many are open. */
TRIBOX_NOINLINE bool answer_told(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                 uint64_t *inside, tribox_report *counts)
{
    const tribox_mesh from = *mesh; /* known not to change while bits are shared */
    _Alignas(16) uint8_t shared[PART]; /* of all triangles, before any are read as words */
    uint64_t open[PART / 64];
    open_list list;
    size_t opened = 0;
    if (from.index_bytes == 2)
        share_bits(&from, 2, q->codes->code, first, count, shared);
    else
        share_bits(&from, 4, q->codes->code, first, count, shared);
    memset(shared + count, 0, PART - count);
    for (size_t w = 0; w < tribox_words_of(count); w++) {
        const uint64_t present = count - 64 * w < 64 ? ~(~UINT64_C(0) << (count - 64 * w)) : ~UINT64_C(0);
        mask[w] = inside[w] = highest_bits(shared + 64 * w, TRIBOX_CODE_INSIDE, 0);
        open[w] = present & ~(highest_bits(shared + 64 * w, 63, 127) | mask[w]);
        opened += tribox_count_bits(open[w]);
    }
    if (opened > OPEN)
        return false;
    list.count = 0;
    for (size_t w = 0; w < tribox_words_of(count); w++) {
        counts->overlapping += tribox_count_bits(mask[w]);
        for (uint64_t left = open[w]; left; left &= left - 1) {
            const size_t lane = 64 * w + tribox_lowest_bit(left);
            for (size_t v = 0; v < 3; v++)
                list.vertex[list.count][v] = (uint32_t)tribox_vertex_number(&from, from.index_bytes, 3 * (first + lane) + v);
            list.lane[list.count++] = (uint8_t)lane;
        }
    }
    if (list.count)
        answer_open(q, mesh, &list, mask, counts);
    return true;
}

/* A part: by codes if it can be, else without. Returns how many of its triangles were answered, 0 if one names no vertex. */
static size_t answer_part(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                          uint64_t *inside, uint64_t *unknown, tribox_report *counts)
{
    tribox_codes *const codes = q->codes;
    bool is_there = true;
    for (size_t w = 0; w < tribox_words_of(count); w++)
        unknown[w] = inside[w] = 0;
    if (codes->untold) {
        codes->untold -= codes->untold < count ? codes->untold : count;
    } else if (are_coded(q, mesh, first, count, &is_there)) {
        if (answer_told(q, mesh, first, count, mask, inside, counts))
            return count;
        codes->untold = UNTOLD;
    } else if (!is_there) {
        return 0;
    }
    count = q->answer(q, mesh, first, count, mask, counts);
    for (size_t w = 0; w < tribox_words_of(count); w++) {
        unknown[w] = ~UINT64_C(0);
        inside[w] = 0;
    }
    return count;
}

size_t tribox_mesh_answer_coded(const tribox_mesh_query *q, const tribox_mesh *mesh, size_t first, size_t count, uint64_t *mask,
                                tribox_report *counts)
{
    uint64_t unasked[TRIBOX_MESH_BLOCK / 64], *const hit = mask ? mask : unasked;
    q->codes->answered = first;
    for (size_t done = 0, part; done < count; done += part) {
        const size_t left = count - done, most = q->codes->untold ? left : PART, w = done / 64;
        part = answer_part(q, mesh, first + done, left < most ? left : most, hit + w, q->codes->inside + w, q->codes->unknown + w,
                           counts);
        if (!part)
            return 0;
    }
    q->codes->credit += q->codes->earned * count;
    return count;
}
