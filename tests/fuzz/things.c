#include "things.h"

#include <string.h>

#include "common/kernels_here.h"

/* A vertex whose places along the axes of a rotation are eighths of the half lengths: but for rounding, often in contact. */
static void draw_vertex_in_frame(input *in, const tribox_oriented_box *box, double u[3])
{
    double place[3];
    for (int k = 0; k < 3; k++)
        place[k] = ((double)(input_byte(in) & 31) - 16) / 8 * box->half[k];
    for (int a = 0; a < 3; a++) {
        u[a] = box->center[a] + place[0] * box->axis[0][a] + place[1] * box->axis[1][a] + place[2] * box->axis[2][a];
        u[a] = in->is_wide ? u[a] : (double)(float)u[a];
    }
}

static void draw_triangle(input *in, const tribox_oriented_box *frame, double u[3][3])
{
    if (!frame || input_byte(in) & 1)
        input_triangle(in, u);
    else
        for (int v = 0; v < 3; v++)
            draw_vertex_in_frame(in, frame, u[v]);
}

float *tight_stream(size_t count, size_t shift) { return tight_memory(count * sizeof(float), shift * sizeof(float)); }

void things_lay_soup(things *t, size_t shift)
{
    const float **const streams[3] = {t->soup.x, t->soup.y, t->soup.z};
    t->soup.count = t->count;
    for (int k = 0; k < 9; k++) {
        float *const stream = tight_stream(t->count, shift);
        for (size_t i = 0; i < t->count; i++)
            stream[i] = (float)things_triangle(t, i)[k % 3][k / 3];
        streams[k / 3][k % 3] = stream;
    }
}

/* Corners of drawn triangles as other vertices than their own, and some as none. Triangles become what they are then. */
static void draw_numbers(input *in, things *t, uint32_t number[3 * DRAWN_MAX])
{
    double vertex[3 * DRAWN_MAX][3];
    const uint32_t vertices = 3 * t->drawn;
    memcpy(vertex, t->u, vertices * sizeof vertex[0]);
    for (uint32_t c = 0; c < vertices; c++) {
        const unsigned byte = input_byte(in);
        number[c] = byte == 255   ? (t->mesh.index_bytes == 2 ? UINT16_MAX : UINT32_MAX)
                    : byte >= 250 ? vertices + byte - 250
                                  : (c + byte) % vertices;
        if (number[c] < vertices)
            memcpy(t->u[c / 3][c % 3], vertex[number[c]], sizeof vertex[0]);
        else
            t->is_bad[c / 3] = true;
    }
}

/* Corner c of the mesh in vertex number[c], and which vertices the memory has. */
static void lay_indices(const uint32_t number[3 * DRAWN_MAX], size_t shift, things *t)
{
    const unsigned bytes = t->mesh.index_bytes;
    t->mesh.indices = tight_memory(3 * t->count * bytes, shift);
    t->first_bad = 3 * t->count;
    for (size_t c = 3 * t->count; c-- > 0;) {
        const uint32_t wide = number[3 * (c / 3 / t->run % t->drawn) + c % 3];
        if (bytes == 2 || bytes == 4)
            mesh_set_index(&t->mesh, c, wide);
        if (wide >= 3 * t->drawn) {
            t->bad++;
            t->first_bad = c;
        }
    }
}

/* Behind the last number there is nothing. `vertex`: all that there are, or drawn ones from which triangles are repeated. */
static void lay_positions(const double (*vertex)[3], size_t shift, things *t)
{
    tribox_mesh *const m = &t->mesh;
    m->positions = tight_memory(mesh_bytes(m), shift);
    for (size_t v = 0; v < m->vertices && mesh_stride(m) >= mesh_number_bytes(m); v++)
        for (int a = 0; a < 3; a++)
            mesh_put(m, v, a, vertex ? vertex[v][a] : things_triangle(t, v / 3)[v % 3][a]);
}

/* 0, without gaps, with gaps, and rarely too small; or columns. */
static void draw_strides(input *in, things *t)
{
    static const unsigned orders[] = {0, 0, 123, 132, 213, 231, 312, 321};
    tribox_mesh *const m = &t->mesh;
    const unsigned choice = input_byte(in), gap = input_byte(in) % 64, size = m->position_bytes == 8 ? 8 : 4;
    m->axes = orders[choice / 4 % 8];
    if (choice == 255)
        m->stride = 1 + gap % 11;
    else if (choice % 4 == 3)
        m->axis_stride = (m->vertices ? m->vertices : 1) * size + gap;
    else if (choice % 4)
        m->stride = 3 * size + (choice % 4 - 1) * gap;
    if (choice == 255)
        t->wrong |= 1u << TRIBOX_BAD_ARGUMENT;
}

static void lay_mesh(input *in, unsigned kind, size_t shift, things *t)
{
    static const unsigned widths[] = {0, 4, 2, 0, 4, 2, 0, 4, 3};
    double vertex[3 * DRAWN_MAX][3];
    tribox_mesh *const m = &t->mesh;
    const unsigned choice = input_byte(in), width = widths[input_below(in, 9)];
    uint32_t number[3 * DRAWN_MAX];
    memcpy(vertex, t->u, sizeof vertex);
    m->count = t->count;
    m->position_bytes = choice == 255 ? 6 : kind >= OF_NARROW ? 8 : choice % 2 ? 4 : 0;
    m->index_bytes = width;
    m->vertices = width ? 3 * t->drawn : 3 * t->count - (choice == 254 && t->count);
    t->first_bad = 3 * t->count - (m->vertices < 3 * t->count && !width);
    t->bad = 3 * t->count - t->first_bad;
    draw_strides(in, t);
    if (width) {
        draw_numbers(in, t, number);
        lay_indices(number, shift / 8, t);
    }
    lay_positions(width ? (const double(*)[3])vertex : NULL, shift % 8, t);
    t->wrong |= (m->position_bytes == 6 || width == 3 ? 1u << TRIBOX_BAD_ARGUMENT : 0) | (t->bad ? 1u << TRIBOX_BAD_VERTEX : 0);
}

void things_draw(input *in, unsigned kind, size_t count, const tribox_oriented_box *frame, things *t)
{
    *t = (things){.count = count, .run = 1, .is_mesh = kind != OF_SOUP};
    const unsigned shift = input_byte(in);
    t->drawn = 1 + input_below(in, DRAWN_MAX);
    if (count > COUNT_MAX) /* so that words and nodes have bounds of their own */
        t->run = 1 + input_byte(in);
    in->is_wide = kind == OF_DOUBLES;
    for (unsigned i = 0; i < t->drawn; i++)
        draw_triangle(in, frame, t->u[i]);
    if (t->is_mesh)
        lay_mesh(in, kind, shift % 64, t);
    else
        things_lay_soup(t, shift % 4);
}

things things_part(const things *t, size_t first, size_t count)
{
    things part = *t;
    tribox_mesh *const m = &part.mesh;
    for (int k = 0; !t->is_mesh && k < 9; k++)
        (k < 3 ? part.soup.x : k < 6 ? part.soup.y : part.soup.z)[k % 3] += first;
    part.soup.count = m->count = part.count = count;
    if (m->indices)
        m->indices = (const char *)m->indices + 3 * first * m->index_bytes;
    else if (m->positions) {
        m->positions = (const char *)m->positions + 3 * first * mesh_stride(m);
        m->vertices -= 3 * first;
    }
    return part;
}

bool oriented_is_finite(const tribox_oriented_box *box)
{
    return are_finite(box->center, 3) && are_finite(box->half, 3) && are_finite(box->axis[0], 9);
}

tribox_status things_overlap(const things *t, const tribox_region *region, const tribox_options *o, uint64_t *mask,
                             tribox_report *report)
{
    if (region->oriented)
        return CALL(overlap_oriented, t, region->oriented, o, mask, report);
    return CALL(overlap, t, region->box, o, mask, report);
}

const char *const *runnable_kernels(void)
{
    static const char *names[KERNELS_MAX + 1];
    if (!names[0])
        kernels_here(names);
    return names;
}

void ask_everywhere(tribox_options o, asking *ask, const void *about)
{
    for (const char *const *kernel = runnable_kernels(); *kernel; kernel++)
        for (int accuracy = TRIBOX_EXACT; accuracy <= TRIBOX_FAST; accuracy++) {
            o.kernel = *kernel;
            o.accuracy = (tribox_accuracy)accuracy;
            ensure_about(&o);
            ask(about, &o);
        }
    ensure_about(NULL);
}

size_t mask_population(const uint64_t *mask, size_t count)
{
    ensure(count % 64 == 0 || mask[count / 64] >> count % 64 == 0, "bits are set past the count of %zu", count);
    return bits_set(mask, tribox_mask_words(count));
}

bool is_same_mask(const uint64_t *one, const uint64_t *other, size_t count)
{
    return !count || !memcmp(one, other, tribox_mask_words(count) * sizeof *one);
}
