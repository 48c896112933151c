#include "scenes_f64.h"

#include <stdio.h>
#include <string.h>

static const scene_f64 scenes[] = {
    {"paper", draw_f64_paper, 1},
    {"offset", draw_f64_offset, 1},
    {"nanometres", draw_f64_nanometres, 1},
    {"sparse", draw_f64_sparse, 1},
    {"lattice", draw_f64_lattice, 1},
    {"far-lattice", draw_f64_far_lattice, 1},
    {"tenths", draw_f64_tenths, 1},
    {"widened", draw_f64_widened, 1},
    {"northings", draw_f64_northings, 1},
    {"degenerate", draw_f64_degenerate, 1},
    {"touching", draw_f64_touching, 1},
    {"touching-ulp", draw_f64_touching_ulp, 1},
    {"float-ulp", draw_f64_float_ulp, 1},
    {"needles", draw_f64_needles, 1},
    {"scaled", draw_f64_scaled, 1},
    {"rotated", draw_f64_rotated, 1},
    {"corners", draw_f64_corners, 1},
    {"big-triangles", draw_f64_big_triangles, 2},
    {"big-boxes", draw_f64_big_boxes, 1},
    {"flat", draw_f64_flat, 1},
    {"thin", draw_f64_thin, 1},
    {"thin-faces", draw_f64_thin_faces, 1},
    {"sides", draw_f64_sides, 1},
    {"faces", draw_f64_faces, 1},
    {"zero-faces", draw_f64_zero_faces, 10},
    {"beside-faces", draw_f64_beside_faces, 1},
    {"standing", draw_f64_standing, 1},
    {"wild", draw_f64_wild, 2},
    {"range", draw_f64_range, 10},
    {"subnormal", draw_f64_subnormal, 1},
    {"near-max", draw_f64_near_max, 1},
    {"overflow", draw_f64_overflow, 10},
    {"units", draw_f64_units, 10},
    {"stage-ends", draw_f64_stage_ends, 5},
    {"nasty", draw_f64_nasty, 10},
    {"bits", draw_f64_bits, 10},
    {"float-planes", draw_f64_float_planes, 1},
    {"float-edges", draw_f64_float_edges, 1},
    {"float-faces", draw_f64_float_faces, 1},
};

enum { SCENES = sizeof scenes / sizeof scenes[0] };

size_t scene_f64_count(void) { return SCENES; }

const scene_f64 *scene_f64_at(size_t i) { return &scenes[i]; }

bool scene_f64_is_called(const scene_f64 *s, const char *name) { return !name || !strcmp(s->name, name); }

bool scene_f64_name_is_known(const char *name)
{
    for (size_t i = 0; i < SCENES; i++)
        if (scene_f64_is_called(&scenes[i], name))
            return true;
    fprintf(stderr, "no scene '%s'; there are:", name);
    for (size_t i = 0; i < SCENES; i++)
        fprintf(stderr, " %s", scenes[i].name);
    fprintf(stderr, "\n");
    return false;
}

pair_f64 batch_f64_pair(const batch_f64 *batch, int k)
{
    pair_f64 pair = {.box = batch->box};
    memcpy(pair.u, batch->u[k], sizeof pair.u);
    return pair;
}
