/* window.c - whether there is such a window, and its lattice in float. */
#include "window.h"

bool tribox_is_window(const uint32_t grid_size[3], const uint32_t first[3], const uint32_t size[3])
{
    bool is_inside = true;
    for (int a = 0; a < 3; a++)
        is_inside &= first[a] <= grid_size[a] && size[a] <= grid_size[a] - first[a];
    return is_inside;
}

bool tribox_window_make_float(tribox_window *w, const float origin[3], const double off[3])
{
    tribox_float_lattice *const f = &w->in_float;
    bool fits = true;
    for (int a = 0; a < 3; a++) {
        const bool is_off = off[a] < 0 || off[a] > 0;
        f->origin[a] = origin[a];
        f->off[a] = (float)off[a];
        f->per_cell[a] = (float)w->lattice.per_cell[a];
        f->size[a] = (float)w->size[a];
        f->error[a] = (float)w->lattice.error[a] * 1.001f + (is_off ? (f->size[a] + 4) * 0x1p-22f : 0);
        f->doubt[a] = f->error[a] + (f->size[a] + 1) * 0x1p-22f;
        fits &= w->size[a] <= 1 << 20 && f->per_cell[a] >= 0x1p-100f && f->per_cell[a] <= 0x1p100f && f->doubt[a] < 0.5f;
    }
    return fits;
}
