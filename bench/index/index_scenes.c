/* index_scenes.c - reads and makes soups, and draws boxes about them. */
#include "index_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/asked.h"
#include "paper/random.h"
#include "read/mesh.h"

enum { CACHE_LINE = 64, LINE_FLOATS = CACHE_LINE / sizeof(float) };

bool soup_room_make(size_t count, soup_room *made)
{
    const size_t stride = (count / LINE_FLOATS + 3) * LINE_FLOATS;
    float *to = aligned_alloc(CACHE_LINE, 9 * stride * sizeof *to);
    *made = (soup_room){.soup = {.count = count}, .storage = to};
    if (!to)
        return message_failure("out of memory for %zu triangles", count) == EXIT_CODE_OK;
    memset(to, 0, 9 * stride * sizeof *to); /* pages that are first touched here, and not while the clock runs */
    for (int v = 0; v < 3; v++) {
        made->soup.x[v] = made->x[v] = to + (size_t)v * stride;
        made->soup.y[v] = made->y[v] = to + (size_t)(3 + v) * stride;
        made->soup.z[v] = made->z[v] = to + (size_t)(6 + v) * stride;
    }
    return true;
}

void soup_room_free(soup_room *made)
{
    free(made->storage);
    *made = (soup_room){.storage = NULL};
}

void soup_room_put(soup_room *to, size_t i, const float u[3][3])
{
    for (int v = 0; v < 3; v++) {
        to->x[v][i] = u[v][0];
        to->y[v][i] = u[v][1];
        to->z[v][i] = u[v][2];
    }
}

void soup_triangle(const tribox_soup *soup, size_t i, float u[3][3])
{
    for (int v = 0; v < 3; v++) {
        u[v][0] = soup->x[v][i];
        u[v][1] = soup->y[v][i];
        u[v][2] = soup->z[v][i];
    }
}

static const char *const usual[] = {"dragon_vrip.ply", "buildings.ply", "SainteHelens.ply", "sponza.ply"};
enum { USUAL = sizeof usual / sizeof usual[0], WITH_GOALS = 3 };

size_t index_scene_usual(const char *const **names)
{
    const char *const folder = getenv("TRIBOX_MESHES");
    *names = usual;
    if (folder && *folder)
        return USUAL;
    message_say("no meshes: name some, or a folder with them in TRIBOX_MESHES; skipped");
    return 0;
}

bool index_scene_has_goals(const char *name)
{
    bool is_found = false;
    for (int k = 0; k < WITH_GOALS; k++)
        is_found = is_found || !strcmp(name, usual[k]);
    return is_found;
}

static void find_bounds(index_scene *made)
{
    const float *const *const streams[3] = {made->room.soup.x, made->room.soup.y, made->room.soup.z};
    for (int a = 0; a < 3; a++) {
        float lo = INFINITY, hi = -INFINITY;
        for (int v = 0; v < 3; v++)
            for (size_t i = 0; i < made->room.soup.count; i++) {
                lo = fminf(lo, streams[a][v][i]);
                hi = fmaxf(hi, streams[a][v][i]);
            }
        made->bounds.lo[a] = lo;
        made->bounds.hi[a] = hi;
    }
}

static bool is_finite(const float u[3][3])
{
    float sum = 0;
    for (int k = 0; k < 9; k++)
        sum += u[k / 3][k % 3] - u[k / 3][k % 3];
    return sum == 0;
}

bool index_scene_read(const char *name, index_scene *made)
{
    mesh m;
    if (!mesh_list_read(name, &m))
        return false;
    snprintf(made->name, sizeof made->name, "%s", mesh_list_name(name));
    const bool is_made = soup_room_make(m.soup.count - m.not_finite, &made->room);
    for (size_t i = 0, to = 0; is_made && i < m.soup.count; i++) {
        float u[3][3];
        soup_triangle(&m.soup, i, u);
        if (is_finite((const float(*)[3])u)) /* the peers know nothing else */
            soup_room_put(&made->room, to++, (const float(*)[3])u);
    }
    if (is_made)
        find_bounds(made);
    mesh_free(&m);
    return is_made;
}

/* Places are jittered, and what hills there are has no preferred size. */
static void terrain_vertex(generator *g, size_t i, size_t j, size_t side, float u[3])
{
    const double turn = 6.283185307179586 / (double)side;
    const double x = (double)i + (double)random_between(g, -0.3f, 0.3f), y = (double)j + (double)random_between(g, -0.3f, 0.3f);
    double z = (double)random_between(g, 0, 0.3f), height = 0.06 * (double)side;
    for (int waves = 1; waves < 200; waves *= 2, height /= 2.1)
        z += height * sin(turn * waves * x + waves) * cos(turn * 1.1 * waves * y + 2 * waves);
    u[0] = (float)x;
    u[1] = (float)y;
    u[2] = (float)z;
}

bool index_scene_terrain(size_t triangles, uint64_t seed, index_scene *made)
{
    size_t side = (size_t)sqrt((double)triangles / 2);
    side = side ? side : 1;
    generator g = {seed};
    float(*const row)[3] = malloc(2 * (side + 1) * sizeof *row);
    snprintf(made->name, sizeof made->name, "terrain");
    if (!row || !soup_room_make(2 * side * side, &made->room)) {
        free(row);
        return message_failure("out of memory for a terrain") == EXIT_CODE_OK;
    }
    for (size_t j = 0, to = 0; j <= side; j++) {
        float(*const here)[3] = row + j % 2 * (side + 1), (*const before)[3] = row + (j + 1) % 2 * (side + 1);
        for (size_t i = 0; i <= side; i++)
            terrain_vertex(&g, i, j, side, here[i]);
        for (size_t i = 0; j && i < side; i++)
            for (size_t half = 0; half < 2; half++) {
                float u[3][3];
                memcpy(u[0], before[i], sizeof u[0]);
                memcpy(u[1], half ? here[i + 1] : before[i + 1], sizeof u[1]);
                memcpy(u[2], half ? here[i] : here[i + 1], sizeof u[2]);
                soup_room_put(&made->room, to++, (const float(*)[3])u);
            }
    }
    free(row);
    find_bounds(made);
    return true;
}

void index_scene_free(index_scene *made) { soup_room_free(&made->room); }

double index_scene_extent(const index_scene *scene)
{
    double extent = 0;
    for (int a = 0; a < 3; a++)
        extent = fmax(extent, (double)scene->bounds.hi[a] - (double)scene->bounds.lo[a]);
    return extent;
}

size_t index_scene_boxes_within(const index_scene *scene, size_t pairs, size_t most)
{
    const size_t boxes = pairs / scene->room.soup.count;
    return boxes == 0 ? 1 : boxes < most ? boxes : most;
}

/* By way of memory: gcc 12 leaves out the rounding where it takes several such numbers at once. */
static double as_float(double number)
{
    const volatile float nearest = (float)number;
    return nearest;
}

void index_scene_boxes(const index_scene *scene, double part, size_t count, uint64_t seed, tribox_box *boxes)
{
    generator g = {seed};
    const double half = index_scene_extent(scene) * part / 2;
    for (size_t b = 0; b < count; b++) {
        float u[3][3];
        soup_triangle(&scene->room.soup, random_below(&g, scene->room.soup.count), u);
        double p = (double)random_between(&g, 0, 1), q = (double)random_between(&g, 0, 1);
        if (p + q > 1) {
            p = 1 - p;
            q = 1 - q;
        }
        for (int a = 0; a < 3; a++) {
            const double middle = (double)u[0][a] * (1 - p - q) + (double)u[1][a] * p + (double)u[2][a] * q;
            boxes[b].lo[a] = as_float(middle - half);
            boxes[b].hi[a] = as_float(middle + half);
        }
    }
}
