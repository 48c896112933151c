/* scene.c - generates the scenes of tribox demo. */
#include "scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "console/message.h"
#include "paper/random.h"

enum { RANDOM_TRIANGLES = 100000, KNOT_RINGS = 1000, KNOT_CORNERS = 100 };

static const double pi = 3.14159265358979323846;

static int allocate(scene *s, size_t count)
{
    s->soup.count = count;
    s->triangles = malloc(count * sizeof *s->triangles);
    s->coordinates = malloc(9 * count * sizeof *s->coordinates);
    if (s->triangles && s->coordinates)
        return EXIT_CODE_OK;
    scene_free(s);
    return message_failure("out of memory for a scene of %zu triangles", count);
}

/* From the triangles and the box to the streams and the centre. */
static void complete(scene *s)
{
    float *next = s->coordinates;
    for (int a = 0; a < 3; a++)
        for (int v = 0; v < 3; v++) {
            (a == 0 ? s->soup.x : a == 1 ? s->soup.y : s->soup.z)[v] = next;
            for (size_t i = 0; i < s->soup.count; i++)
                *next++ = s->triangles[i][v][a];
        }
    for (int a = 0; a < 3; a++) {
        s->center[a] = 0.5f * (s->box.lo[a] + s->box.hi[a]);
        s->half[a] = 0.5f * (s->box.hi[a] - s->box.lo[a]);
    }
}

int scene_make_random(scene *s)
{
    *s = (scene){.title = "Random triangles, vertices uniform in [-2,2]^3 (the workload of the paper)",
                 .box = {{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}};
    const int code = allocate(s, RANDOM_TRIANGLES);
    if (code)
        return code;
    generator g = {SCENE_SEED};
    for (size_t i = 0; i < s->soup.count; i++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++)
                s->triangles[i][v][a] = random_between(&g, -2, 2);
    complete(s);
    return EXIT_CODE_OK;
}

/*
 * A point of the tube. The knot winds twice around the axis of a torus and three times through its hole; `outward` is normal to the
 * torus and so to the knot, and with `sideward` spans the plane of the ring.
 */
static void knot_point(int ring, int corner, float point[3])
{
    const double radius = 2, swing = 0.85, tube = 0.42;
    const double t = 2 * pi * (ring % KNOT_RINGS) / KNOT_RINGS, turn = 2 * pi * (corner % KNOT_CORNERS) / KNOT_CORNERS;
    const double cp = cos(2 * t), sp = sin(2 * t), cq = cos(3 * t), sq = sin(3 * t), rho = radius + swing * cq;
    const double center[3] = {rho * cp, rho * sp, swing * sq};
    const double outward[3] = {cq * cp, cq * sp, sq};
    const double along[3] = {-3 * swing * sq * cp - 2 * rho * sp, -3 * swing * sq * sp + 2 * rho * cp, 3 * swing * cq};
    const double length = sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double sideward = (along[b] * outward[c] - along[c] * outward[b]) / length;
        point[a] = (float)(center[a] + tube * (cos(turn) * outward[a] + sin(turn) * sideward));
    }
}

int scene_make_knot(scene *s)
{
    *s = (scene){.title = "A mesh: a tube along a trefoil knot", .box = {{0.2f, -0.6f, -1.0f}, {2.2f, 1.4f, 1.0f}}};
    const int code = allocate(s, 2 * KNOT_RINGS * KNOT_CORNERS);
    if (code)
        return code;
    float(*triangle)[3][3] = s->triangles;
    for (int ring = 0; ring < KNOT_RINGS; ring++)
        for (int corner = 0; corner < KNOT_CORNERS; corner++, triangle += 2) {
            float quad[4][3];
            for (int k = 0; k < 4; k++)
                knot_point(ring + (k == 1 || k == 2), corner + k / 2, quad[k]);
            memcpy(triangle[0], quad, sizeof *triangle);
            memcpy(triangle[1][0], quad[0], sizeof quad[0]);
            memcpy(triangle[1][1], quad[2], 2 * sizeof quad[0]);
        }
    complete(s);
    return EXIT_CODE_OK;
}

void scene_free(scene *s)
{
    free(s->triangles);
    free(s->coordinates);
    s->triangles = NULL;
    s->coordinates = NULL;
}
