/* scene.c - generates the scenes of tribox demo. */
#include "scene.h"

#include <math.h>
#include <string.h>

#include "console/message.h"
#include "paper/random.h"

enum { RANDOM_TRIANGLES = 100000, KNOT_RINGS = 1000, KNOT_CORNERS = 100 };

static const double pi = 3.14159265358979323846;

static int make(timing_work *work, size_t count, const tribox_box *box, void (*draw)(float (*triangle)[3][3]))
{
    if (timing_work_make(work, 1, timing_work_room(count))) {
        draw(work->triangles);
        const timing_job job = timing_work_soup(work, count);
        timing_work_add(work, &job, box);
        if (timing_work_mesh(work))
            return EXIT_CODE_OK;
    }
    return message_failure("out of memory for a scene of %zu triangles", count);
}

static void draw_random(float (*triangle)[3][3])
{
    generator g = {SCENE_SEED};
    for (size_t n = 0; n < 9 * RANDOM_TRIANGLES; n++)
        triangle[n / 9][n / 3 % 3][n % 3] = random_between(&g, -2, 2);
}

int scene_make_random(timing_work *work)
{
    return make(work, RANDOM_TRIANGLES, &(tribox_box){{-0.5f, -0.5f, -0.5f}, {0.5f, 0.5f, 0.5f}}, draw_random);
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

static void draw_knot(float (*triangle)[3][3])
{
    for (int ring = 0; ring < KNOT_RINGS; ring++)
        for (int corner = 0; corner < KNOT_CORNERS; corner++, triangle += 2) {
            float quad[4][3];
            for (int k = 0; k < 4; k++)
                knot_point(ring + (k == 1 || k == 2), corner + k / 2, quad[k]);
            memcpy(triangle[0], quad, sizeof *triangle);
            memcpy(triangle[1][0], quad[0], sizeof quad[0]);
            memcpy(triangle[1][1], quad[2], 2 * sizeof quad[0]);
        }
}

int scene_make_knot(timing_work *work)
{
    return make(work, 2 * KNOT_RINGS * KNOT_CORNERS, &(tribox_box){{0.2f, -0.6f, -1.0f}, {2.2f, 1.4f, 1.0f}}, draw_knot);
}
