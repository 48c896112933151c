/* fuzz_indexed.c - the calls about a mesh: every layout, in memory of exactly the size that the layout promises. */
#include <string.h>

#include "answers.h"
#include "ensure.h"
#include "tight_memory.h"
#include "target.h"

enum { VERTICES_MAX = 24, NUMBERS_DRAWN = 450 };

/* A mesh, and its vertex numbers as they are meant. */
typedef struct fuzz_case {
    tribox_mesh mesh;
    tribox_box box;
    tribox_options options;
    uint32_t number[3 * COUNT_MAX];
    float vertex[VERTICES_MAX][3];
    unsigned wrong;
} fuzz_case;

static size_t stride_of(const tribox_mesh *mesh) { return mesh->stride ? mesh->stride : 12; }

/* 0, 12 and any others up to 75; too small ones are rare. */
static size_t draw_stride(input *in)
{
    const unsigned choice = input_byte(in);
    return choice < 64 ? 0 : choice < 128 ? 12 : choice == 255 ? 1 + input_below(in, 11) : 12 + choice % 64;
}

/* Behind the last z there is nothing. */
static void lay_positions(input *in, fuzz_case *q, size_t shift)
{
    tribox_mesh *const mesh = &q->mesh;
    mesh->vertices = input_below(in, VERTICES_MAX + 1);
    const size_t stride = stride_of(mesh), size = mesh->vertices ? (mesh->vertices - 1) * stride + sizeof q->vertex[0] : 0;
    unsigned char *const positions = tight_memory(size, shift);
    for (size_t n = 0; n < mesh->vertices; n += 3) {
        float u[3][3];
        input_triangle(in, u);
        for (size_t k = 0; k < 3 && n + k < mesh->vertices; k++) {
            memcpy(q->vertex[n + k], u[k], sizeof u[k]);
            if (stride >= sizeof u[k])
                memcpy(positions + (n + k) * stride, u[k], sizeof u[k]);
        }
    }
    mesh->positions = positions;
}

/* A byte as a vertex number: most exist, some are just past the last, few are as large as they can be. */
static uint32_t draw_number(input *in, const tribox_mesh *mesh)
{
    const unsigned byte = input_byte(in);
    if (byte == 255)
        return mesh->index_bytes == 2 ? UINT16_MAX : UINT32_MAX;
    if (byte >= 250)
        return (uint32_t)mesh->vertices + byte - 250;
    return mesh->vertices ? byte % (uint32_t)mesh->vertices : 0;
}

static void lay_indices(input *in, fuzz_case *q, size_t shift)
{
    tribox_mesh *const mesh = &q->mesh;
    const size_t corners = 3 * mesh->count;
    unsigned char *const indices = tight_memory(corners * mesh->index_bytes, shift);
    for (size_t k = 0; k < corners; k++) {
        q->number[k] = k < NUMBERS_DRAWN ? draw_number(in, mesh) : q->number[k - NUMBERS_DRAWN];
        const uint16_t narrow = (uint16_t)q->number[k];
        if (mesh->index_bytes == 2)
            memcpy(indices + 2 * k, &narrow, 2);
        if (mesh->index_bytes == 4)
            memcpy(indices + 4 * k, &q->number[k], 4);
    }
    mesh->indices = indices;
}

static fuzz_case draw_case(input *in)
{
    static const unsigned widths[] = {4, 2, 0, 4, 2, 0, 4, 2, 3};
    fuzz_case q = {.wrong = 0};
    const drawn_options how = input_options(in);
    q.options = how.options;
    q.box = input_box(in);
    q.mesh.stride = draw_stride(in);
    const unsigned shifts = input_byte(in), width = widths[input_below(in, sizeof widths / sizeof widths[0])];
    lay_positions(in, &q, shifts % 8);
    q.mesh.index_bytes = width;
    q.mesh.count = width ? input_count(in) : q.mesh.vertices / 3 + (shifts >= 192);
    if (width)
        lay_indices(in, &q, shifts / 8 % 8);
    for (uint32_t k = 0; !width && k < 3 * q.mesh.count; k++)
        q.number[k] = k;
    const bool is_unknown_layout = (q.mesh.stride && q.mesh.stride < 12) || width == 3;
    q.wrong = how.wrong | (is_unknown_layout ? 1u << TRIBOX_BAD_ARGUMENT : 0) | (box_is_finite(&q.box) ? 0 : 1u << TRIBOX_BAD_BOX);
    return q;
}

/* The indices of some triangles that refer to no vertex, and the place of the first among all. */
static size_t bad_indices(const fuzz_case *q, size_t first, size_t count, size_t *place)
{
    size_t found = 0;
    *place = 3 * (first + count);
    for (size_t k = 3 * first; k < 3 * (first + count); k++)
        if (q->number[k] >= q->mesh.vertices && !found++)
            *place = k;
    return found;
}

static void check_bad_indices(const fuzz_case *q)
{
    const bool is_empty = q->wrong >> TRIBOX_BAD_ARGUMENT & 1;
    size_t place = 0, first;
    const size_t count = is_empty ? 0 : bad_indices(q, 0, q->mesh.count, &place);
    const size_t found = tribox_mesh_bad_vertices(&q->mesh, &first);
    ensure(found == count && found == tribox_mesh_bad_vertices(&q->mesh, NULL), "%zu bad indices found, there are %zu", found,
           count);
    ensure(first == place, "the first bad index is found at %zu", first);
}

/* Nine streams of exact size. */
static void make_streams(size_t count, size_t shift, float *to[9])
{
    for (int k = 0; k < 9; k++)
        to[k] = tight_memory(count * sizeof(float), shift * sizeof(float));
}

static void expect_streams(const fuzz_case *q, size_t first, size_t count, float *const to[9])
{
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 9; k++)
            to[k][i] = q->vertex[q->number[3 * (first + i) + (size_t)k % 3]][k / 3];
}

static void check_streams(const fuzz_case *q, size_t first, size_t count, size_t shift)
{
    size_t place;
    const unsigned arguments = q->wrong & 1u << TRIBOX_BAD_ARGUMENT;
    const bool is_refused = arguments || bad_indices(q, first, count, &place);
    float *expected[9], *streams[9];
    make_streams(count, 0, expected);
    if (!is_refused)
        expect_streams(q, first, count, expected);
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++) {
        make_streams(count, shift, streams);
        const tribox_status status = tribox_mesh_to_soup(&q->mesh, NULL, first, count, &(tribox_options){.kernel = *kernel},
                                                         streams, streams + 3, streams + 6);
        status_fits("tribox_mesh_to_soup", arguments ? arguments : is_refused ? 1u << TRIBOX_BAD_VERTEX : 0, status);
        for (int k = 0; k < 9; k++)
            ensure(!memcmp(streams[k], expected[k], count * sizeof(float)),
                   "kernel %s: stream %d of %zu triangles from %zu on is wrong", *kernel, k, count, first);
    }
}

static tribox_soup soup_of(float *const s[9], size_t count)
{
    return (tribox_soup){{s[0], s[1], s[2]}, {s[3], s[4], s[5]}, {s[6], s[7], s[8]}, count};
}

static void check_refusal(const fuzz_case *q, unsigned wrong)
{
    const size_t bytes = tribox_mask_words(q->mesh.count) * sizeof(uint64_t);
    uint64_t *const mask = tight_mask(q->mesh.count);
    tribox_report report;
    memset(&report, POISON, sizeof report);
    status_fits("tribox_mesh_overlap", wrong, tribox_mesh_overlap(&q->mesh, &q->box, &q->options, mask, &report));
    ensure(is_poisoned(mask, bytes) && is_poisoned(&report, sizeof report), "tribox_mesh_overlap writes although it refuses");
}

/* The same as of the streams, at every accuracy. */
static void check_overlap(const fuzz_case *q)
{
    const size_t count = q->mesh.count, bytes = tribox_mask_words(count) * sizeof(uint64_t);
    float *streams[9];
    make_streams(count, 0, streams);
    expect_streams(q, 0, count, streams);
    const tribox_soup soup = soup_of(streams, count);
    tribox_options o = q->options;
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            tribox_report reports[2];
            uint64_t *const masks[2] = {tight_mask(count), tight_mask(count)};
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            status_fits("tribox_overlap", 0, tribox_overlap(&soup, &q->box, &o, masks[0], &reports[0]));
            status_fits("tribox_mesh_overlap", 0, tribox_mesh_overlap(&q->mesh, &q->box, &o, masks[1], &reports[1]));
            ensure(!memcmp(masks[0], masks[1], bytes) && reports[0].overlapping == reports[1].overlapping,
                   "accuracy %d, axes %u, kernel %s: the answers about a mesh and its streams differ", accuracy, o.axes, o.kernel);
        }
    status_fits("tribox_mesh_overlap", 0, tribox_mesh_overlap(&q->mesh, &q->box, &o, NULL, NULL));
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    input in = input_of(data, size);
    const fuzz_case q = draw_case(&in);
    const size_t first = q.mesh.count ? input_byte(&in) % q.mesh.count : 0;
    const size_t count = q.mesh.count ? 1 + input_byte(&in) % (q.mesh.count - first) : 0;
    size_t place;
    check_bad_indices(&q);
    check_streams(&q, 0, q.mesh.count, 0);
    check_streams(&q, first, count, 1);
    if (q.wrong)
        check_refusal(&q, q.wrong | 1u << TRIBOX_BAD_VERTEX);
    else if (bad_indices(&q, 0, q.mesh.count, &place))
        check_refusal(&q, 1u << TRIBOX_BAD_VERTEX);
    else
        check_overlap(&q);
    tight_memory_free_all();
    return 0;
}
