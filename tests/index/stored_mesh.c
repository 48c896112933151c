#include "stored_mesh.h"

#include <float.h>
#include <math.h>

#include "common/guarded_pages.h"
#include "common/harness.h"

enum { GAP = 8 /* bytes between numbers at most */ };

stored_mesh stored_mesh_make(size_t room)
{
    return (stored_mesh){.fences = laid_fences_for(args.seed, room, (3 * room + 2) * 3 * (sizeof(double) + GAP) + 64)};
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

static double placed(const mesh_place *place, const stored_soup *s, size_t corner, int a)
{
    return (double)s->stream[3 * (size_t)a + corner % 3][corner / 3] * place->scale + place->offset[a];
}

void stored_mesh_write(stored_mesh *m, const stored_soup *s, size_t first, size_t count)
{
    for (size_t n = 9 * first; n < 9 * (first + count); n++)
        laid_mesh_put(&m->mesh, n / 3, (int)(n % 3), placed(&m->layout.place, s, n / 3, (int)(n % 3)));
}

void stored_mesh_lay(random_source *r, stored_mesh *m, const mesh_layout *layout, stored_soup *s)
{
    const size_t count = s->soup.count;
    double(*const u)[3][3] = malloc(count * sizeof *u + 1);
    assert_non_null(u);
    for (size_t n = 0; n < 9 * count; n++)
        u[n / 9][n / 3 % 3][n % 3] = placed(&layout->place, s, n / 3, (int)(n % 3));
    m->layout = *layout;
    m->mesh = laid_mesh_of(r, &layout->form, (const double(*)[3][3])u, count, (const int[]){0, 1, 2}, m->fences);
    s->index.soup = s->with_ids.soup = NULL;
    s->index.mesh = s->with_ids.mesh = &m->mesh;
    free(u);
}

void stored_mesh_hide(const stored_mesh *m, bool is_hidden)
{
    const guarded fences[] = {m->fences.positions, m->fences.indices};
    for (int k = 0; k < 2; k++)
        assert_true(!fences[k].size || pages_allow(fences[k].first, fences[k].size, is_hidden ? PAGES_HIDDEN : PAGES_OPEN));
}

tribox_box box_in_place(random_source *r, const mesh_layout *layout, const tribox_box *box)
{
    tribox_box moved = *box;
    for (int k = 0; k < 6; k++) {
        double *const bound = k < 3 ? &moved.lo[k] : &moved.hi[k - 3];
        const int way = random_int(r, 6);
        *bound = *bound * layout->place.scale + layout->place.offset[k % 3];
        *bound = way == 0 ? nextafter(*bound, DBL_MAX) : way == 1 ? nextafter(*bound, -DBL_MAX) : *bound;
    }
    return moved;
}
