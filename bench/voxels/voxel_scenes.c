/* voxel_scenes.c - makes and reads soups to voxelize. */
#include "voxel_scenes.h"

#include <math.h>

#include "common/mesh_list.h"
#include "paper/random.h"
#include "read/mesh.h"

const char *const voxel_scene_names[VOXEL_SCENES] = {"torus", "small", "huge"};

static bool make_room(timing_work *made, size_t count)
{
    return timing_work_make(made, 1, timing_work_room(count)) ||
           message_failure("out of memory for %zu triangles", count) == EXIT_CODE_OK;
}

static bool complete(timing_work *made, size_t count)
{
    const timing_job job = timing_work_soup(made, count);
    timing_work_add(made, &job, &(tribox_box){{0, 0, 0}, {1, 1, 1}});
    return true;
}

static void torus_vertex(float u[3], int along, int around, int longs, int arounds)
{
    const double turn = 6.283185307179586, s = turn * along / longs, t = turn * around / arounds, r = 1 + 0.4 * cos(t);
    u[0] = (float)(r * cos(s));
    u[1] = (float)(r * sin(s));
    u[2] = (float)(0.4 * sin(t));
}

static bool make_torus(timing_work *made)
{
    const int longs = 500, arounds = 200;
    if (!make_room(made, (size_t)(2 * longs * arounds)))
        return false;
    size_t at = 0;
    for (int s = 0; s < longs; s++)
        for (int t = 0; t < arounds; t++)
            for (int half = 0; half < 2; half++, at++) {
                torus_vertex(made->triangles[at][0], s, t + half, longs, arounds);
                torus_vertex(made->triangles[at][1], s + 1, t, longs, arounds);
                torus_vertex(made->triangles[at][2], s + half, t + 1, longs, arounds);
            }
    return complete(made, at);
}

static bool make_random(timing_work *made, size_t count, float reach, uint64_t seed)
{
    generator g = {seed};
    if (!make_room(made, count))
        return false;
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < 3; a++) {
            const float lo = random_between(&g, 0, 1 - reach);
            for (int v = 0; v < 3; v++)
                made->triangles[i][v][a] = random_between(&g, lo, lo + reach);
        }
    return complete(made, count);
}

bool voxel_scene_make(size_t which, uint64_t seed, timing_work *made)
{
    return which == 0 ? make_torus(made) : which == 1 ? make_random(made, 200000, 0.01f, seed) : make_random(made, 12, 1, seed);
}

bool voxel_scene_read(const char *path, timing_work *made)
{
    mesh m;
    size_t count = 0;
    *made = (timing_work){.count = 0};
    if (!mesh_list_read(path, &m))
        return false;
    const bool is_made = make_room(made, m.soup.count);
    for (size_t i = 0; is_made && i < m.soup.count; i++) {
        float(*const u)[3] = made->triangles[count], sum = 0;
        for (int v = 0; v < 3; v++) {
            u[v][0] = m.soup.x[v][i];
            u[v][1] = m.soup.y[v][i];
            u[v][2] = m.soup.z[v][i];
            for (int a = 0; a < 3; a++)
                sum += u[v][a] - u[v][a];
        }
        count += sum == 0; /* finite: the rivals know nothing else */
    }
    mesh_free(&m);
    return is_made && complete(made, count);
}

tribox_grid voxel_scene_grid(const timing_job *at, uint32_t resolution)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY}, longest = 0;
    tribox_grid grid;
    for (size_t i = 0; i < at->soup.count; i++)
        for (int v = 0; v < 3; v++)
            for (int a = 0; a < 3; a++) {
                lo[a] = fminf(lo[a], at->triangles[i][v][a]);
                hi[a] = fmaxf(hi[a], at->triangles[i][v][a]);
            }
    for (int a = 0; a < 3; a++)
        longest = fmaxf(longest, hi[a] - lo[a]);
    for (int a = 0; a < 3; a++) {
        grid.origin[a] = (double)lo[a];
        grid.cell[a] = (double)(longest / (float)resolution * 1.0001f); /* what lies on the far side lies inside */
        grid.size[a] = (uint32_t)fmax(1, ceil((double)(hi[a] - lo[a]) / grid.cell[a]));
    }
    return grid;
}
