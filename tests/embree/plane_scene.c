#include "plane_scene.h"

#include <math.h>
#include <stdlib.h>

#include "zeroed.h"

/* lo .. lo + extent holds mesh and grid. */
typedef struct bounds {
    float lo[3], extent[3];
} bounds;

static bounds bounds_of(const grid_planes *p, const model *s)
{
    bounds b;
    for (int a = 0; a < 3; a++) {
        float lo = (float)p->plane[a][0], hi = (float)p->plane[a][(int)p->grid.size[a]];
        for (size_t t = 0; t < s->count; t++)
            for (int j = 0; j < 3; j++) {
                lo = fminf(lo, s->triangles[t].u[j][a]);
                hi = fmaxf(hi, s->triangles[t].u[j][a]);
            }
        b.lo[a] = lo;
        b.extent[a] = hi - lo;
    }
    return b;
}

/* Corners (A, A), (B, A), (A, B) in the plane, A = lo - extent and B = lo + 4 extent. */
static triangle plane_triangle(const bounds *b, int axis, float plane)
{
    triangle t;
    for (int j = 0; j < 3; j++) {
        t.u[j][axis] = plane;
        for (int k = 1; k < 3; k++) {
            const int a = (axis + k) % 3;
            t.u[j][a] = b->lo[a] + (j == k ? 4 : -1) * b->extent[a];
        }
    }
    return t;
}

plane_scene plane_scene_make(const grid_planes *p, const model *s)
{
    const bounds b = bounds_of(p, s);
    plane_scene d = {0};
    triangle *const triangles = memory_of(3 * (GRID_PLANES_CELLS + 1), sizeof *triangles);
    int count = 0;
    for (int a = 0; a < 3; a++) {
        d.first[a] = count;
        for (int i = 0; i <= (int)p->grid.size[a]; i++)
            triangles[count++] = plane_triangle(&b, a, (float)p->plane[a][i]);
    }
    d.scene = embree_scene_make(triangles, (size_t)count);
    free(triangles);
    return d;
}

void plane_scene_free(plane_scene *d) { embree_scene_free(d->scene); }

int plane_scene_axis(const plane_scene *d, unsigned number) { return ((int)number >= d->first[1]) + ((int)number >= d->first[2]); }

int plane_scene_plane(const plane_scene *d, unsigned number) { return (int)number - d->first[plane_scene_axis(d, number)]; }
