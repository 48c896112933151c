#include "stored.h"

#include <float.h>
#include <math.h>

#include "common/fences.h"
#include "common/guarded_pages.h"
#include "common/harness.h"

enum { POISONED = 0xa5, GAP = 8 /* bytes between numbers of a mesh at most */ };

stored_soup stored;

void stored_make(size_t room)
{
    stream_fences_make(room, stored.stream_fence);
    stored.ids_fence = guarded_make((room + STORED_SHIFTS) * sizeof(uint32_t));
    stored.nodes_fence = guarded_make(tribox_index_bytes(room) + STORED_SHIFTS);
}

void stored_mesh_make(size_t room)
{
    stored.mesh_fences = laid_fences_for(args.seed, room, (3 * room + 2) * 3 * (sizeof(double) + GAP) + 64);
}

static void *laid(guarded fence, size_t bytes, int shift, size_t unit)
{
    return shift == STORED_AT_END ? guarded_tail(fence, bytes) : fence.first + (size_t)shift * unit;
}

void stored_soup_lay(size_t count, int shift)
{
    stored_soup *const s = &stored;
    s->soup = streams_lay(s->stream_fence, count, shift, s->stream);
    s->ids = laid(s->ids_fence, count * sizeof(uint32_t), shift, sizeof(uint32_t));
    for (size_t i = 0; i < count; i++)
        s->ids[i] = (uint32_t)i * 2654435761u ^ 0x9e3779b9u;
    s->nodes = laid(s->nodes_fence, tribox_index_bytes(count), shift, 1);
    s->layout = (mesh_layout){.place = {.scale = 1}};
    s->index = s->with_ids = (tribox_index){.nodes = s->nodes, .soup = &s->soup};
    s->with_ids.ids = s->ids;
}

void stored_build(const char *kernel)
{
    memset(stored.nodes, POISONED, stored_index_bytes());
    assert_int_equal(tribox_index_build(&stored.index, &(tribox_options){.kernel = kernel}, stored.nodes), TRIBOX_OK);
}

/* Near, as maps have it, at the end of what float and double can tell, and so small and large that float ends before. */
static const mesh_place places[] = {
    {1, {0, 0, 0}},
    {1, {500000.125, 5123456.7, 123.4}},
    {0x1p-10, {0x1p40, -0x1p40, 0x1p45}},
    {1, {0x1p70, 0x1p60, 0}},
    {0x1p-160, {0, 0, 0}},
    {0x1p-900, {0, 0x1p-901, 0}},
    {0x1p120, {0, 0, 0}},
    {0x1p880, {0, 0, 0}},
    {1 / 3.0, {0.1, 0, 1e9}},
};

mesh_layout draw_layout(random_source *r, size_t triangles)
{
    mesh_layout layout = {.form = mesh_form_draw(r, true), .place = places[0]};
    if (random_int(r, 2)) { /* as most have them: others are read number by number */
        layout.form.order = ROWS;
        layout.form.axes = 0;
        layout.form.shift = 0;
    }
    layout.form.gap %= GAP + 1;
    layout.form.is_shared = false;
    if (layout.form.index_bytes == 2 && 3 * triangles > 65536)
        layout.form.index_bytes = 4;
    if (layout.form.position_bytes == 8)
        layout.place = places[random_int(r, sizeof places / sizeof places[0])];
    return layout;
}

static double placed(size_t corner, int a)
{
    const mesh_place *const place = &stored.layout.place;
    return (double)stored.stream[3 * (size_t)a + corner % 3][corner / 3] * place->scale + place->offset[a];
}

void stored_mesh_write(size_t first, size_t count)
{
    for (size_t n = 9 * first; n < 9 * (first + count); n++)
        mesh_put(&stored.mesh, mesh_index(&stored.mesh, n / 3), (int)(n % 3), placed(n / 3, (int)(n % 3)));
}

void stored_mesh_lay(random_source *r, const mesh_layout *layout)
{
    const size_t count = stored.soup.count;
    double(*const u)[3][3] = malloc(count * sizeof *u + 1);
    assert_non_null(u);
    stored.layout = *layout;
    for (size_t n = 0; n < 9 * count; n++)
        u[n / 9][n / 3 % 3][n % 3] = placed(n / 3, (int)(n % 3));
    stored.mesh = laid_mesh_of(r, &layout->form, (const double(*)[3][3])u, count, (const int[]){0, 1, 2}, stored.mesh_fences);
    stored.index.soup = stored.with_ids.soup = NULL;
    stored.index.mesh = stored.with_ids.mesh = &stored.mesh;
    free(u);
}

tribox_box box_in_place(random_source *r, const tribox_box *box)
{
    const mesh_place *const place = &stored.layout.place;
    tribox_box moved = *box;
    for (int k = 0; k < 6; k++) {
        double *const bound = k < 3 ? &moved.lo[k] : &moved.hi[k - 3];
        const int way = random_int(r, 6);
        *bound = *bound * place->scale + place->offset[k % 3];
        *bound = way == 0 ? nextafter(*bound, DBL_MAX) : way == 1 ? nextafter(*bound, -DBL_MAX) : *bound;
    }
    return moved;
}

/* From now on reading the triangles, as the index has them, faults, or no longer does. */
static void hide(bool is_hidden)
{
    const guarded of_mesh[] = {stored.mesh_fences.positions, stored.mesh_fences.indices};
    const guarded *const fences = stored.index.mesh ? of_mesh : stored.stream_fence;
    for (int k = 0; k < (stored.index.mesh ? 2 : STORED_STREAMS); k++)
        assert_true(!fences[k].size || pages_allow(fences[k].first, fences[k].size, is_hidden ? PAGES_HIDDEN : PAGES_OPEN));
}

size_t count_unseen(const tribox_region *region, const tribox_options *options, const char *how)
{
    tribox_report report = {SIZE_MAX, SIZE_MAX};
    snprintf(doing, sizeof doing, "a question that needs no triangle: %s, kernel %s, accuracy %d", how, options->kernel,
             (int)options->accuracy);
    hide(true);
    const tribox_status status = tribox_index_overlap(&stored.index, region, options, NULL, &report);
    hide(false);
    assert_int_equal(status, TRIBOX_OK);
    assert_int_equal(report.undecided, 0);
    return report.overlapping;
}
