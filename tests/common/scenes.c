#include "scenes.h"

#include <stdio.h>
#include <string.h>

#include "doubles/scenes_f64.h"

static const scene table[] = {
    {"paper", "ordinary", draw_paper, false},
    {"eighths", "ordinary", draw_eighths, true},
    {"points", "ordinary", draw_points, true},
    {"segments", "ordinary", draw_segments, false},
    {"offset", "ordinary", draw_offset, false},
    {"big-triangles", "ordinary", draw_big_triangles, false},
    {"small-triangles", "ordinary", draw_small_triangles, false},
    {"cad", "ordinary", draw_cad, true},
    {"sphere", "ordinary", draw_sphere, false},
    {"flat-boxes", "ordinary", draw_flat_boxes, false},

    {"touching", "contact", draw_touching, true},
    {"touching-ulp", "contact", draw_touching_ulp, false},
    {"near-contact", "contact", draw_near_contact, false},
    {"needles", "contact", draw_needles, false},
    {"caps", "contact", draw_caps, false},
    {"edge-on", "contact", draw_edge_on, false},
    {"flat-triangles", "contact", draw_flat_triangles, false},

    {"offset-huge", "range", draw_offset_huge, false},
    {"near-contact-scaled", "range", draw_near_contact_scaled, false},
    {"scaled", "range", draw_scaled, false},
    {"subnormal", "range", draw_subnormal, false},
    {"near-max", "range", draw_near_max, false},

    {"random-bits", "scales", draw_random_bits, false},
    {"own-scale", "scales", draw_own_scale, false},
    {"own-scale-touching", "scales", draw_own_scale_touching, false},
    {"tiny-at-corner", "scales", draw_tiny_at_corner, false},
    {"lost-normal", "scales", draw_lost_normal, false},
    {"tiny-and-huge", "scales", draw_tiny_and_huge, false},
};

size_t scene_count(void) { return sizeof table / sizeof table[0]; }

const scene *scene_at(size_t i) { return &table[i]; }

void scene_draw_batch(const scene *s, random_source *r, scene_batch *batch)
{
    s->draw(r, batch);
    for (int a = 0; a < 3; a++) {
        batch->box.lo[a] = random_sign_of_zero(r, (float)batch->box.lo[a]);
        batch->box.hi[a] = random_sign_of_zero(r, (float)batch->box.hi[a]);
        for (int k = 0; k < SCENE_TRIANGLES; k++)
            for (int j = 0; j < 3; j++)
                batch->u[k][j][a] = random_sign_of_zero(r, batch->u[k][j][a]);
    }
}

pair_f64 scene_pair(const scene_batch *batch, int k) { return pair_of_floats(batch->u[k][0], &batch->box); }

bool scene_is_called(const scene *s, const char *name) { return !name || !strcmp(name, s->name) || !strcmp(name, s->family); }

bool scene_name_is_known(const char *name)
{
    for (size_t i = 0; i < scene_count(); i++)
        if (scene_is_called(&table[i], name))
            return true;
    for (size_t i = 0; i < scene_f64_count(); i++)
        if (scene_f64_is_called(scene_f64_at(i), name))
            return true;
    fprintf(stderr, "no scene and no family of scenes is called '%s'; there are (family: scene)\n", name);
    for (size_t i = 0; i < scene_count(); i++)
        fprintf(stderr, "  %s: %s\n", table[i].family, table[i].name);
    for (size_t i = 0; i < scene_f64_count(); i++)
        fprintf(stderr, "  doubles: %s\n", scene_f64_at(i)->name);
    return false;
}
