/* order_scenes.c - draws the scenes. */
#include "order_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/place.h"
#include "sweep/octree.h"
#include "sweep/order_why.h"

#include "read/mesh.h"

/* Small triangles within the shadow of the unit box, above it: one box normal separates them, whatever the other axes do. */
static void draw_above(generator *g, triangle t, int axis)
{
    draw_inside(g, t);
    for (int j = 0; j < 3; j++)
        t[j][axis] += 2;
}

static void draw_above_x(generator *g, triangle t) { draw_above(g, t, 0); }

static void draw_above_z(generator *g, triangle t) { draw_above(g, t, 2); }

/* Which triangles a scene keeps, by the axes that separate them. */
static bool keep_hits(unsigned apart) { return !apart; }

static bool keep_plane_misses(unsigned apart) { return apart == 1u << WHY_PLANE; }

static bool keep_edge_misses(unsigned apart) { return apart >= 1u << WHY_EDGES && !(apart & (apart - 1)); }

static const struct recipe {
    const char *name, *what;
    float size; /* of the box, a cube about the origin */
    draw_triangle *draw;
    bool (*keep)(unsigned apart); /* NULL for all */
    bool is_sorted;               /* in spatial order */
} recipes[] = {
    {"box-0.01", "vertices uniform in [-2, 2]^3, box 0.01", 0.01f, draw_paper, NULL, false},
    {"box-0.03", "the same, box 0.03", 0.03f, draw_paper, NULL, false},
    {"box-0.1", "the same, box 0.1", 0.1f, draw_paper, NULL, false},
    {"box-0.3", "the same, box 0.3", 0.3f, draw_paper, NULL, false},
    {"box-0.6", "the same, box 0.6", 0.6f, draw_paper, NULL, false},
    {"paper", "the same, box 1: the paper, section 3", 1, draw_paper, NULL, false},
    {"box-1.5", "the same, box 1.5", 1.5f, draw_paper, NULL, false},
    {"box-2", "the same, box 2", 2, draw_paper, NULL, false},
    {"box-3", "the same, box 3", 3, draw_paper, NULL, false},
    {"box-4", "the same, box 4: all overlap", 4, draw_paper, NULL, false},
    {"sparse", "small triangles all over [-8, 8]^3, box 1, in random order", 1, draw_sparse, NULL, false},
    {"sorted", "the same in spatial order", 1, draw_sparse, NULL, true},
    {"hit", "those of paper that overlap the box", 1, draw_paper, keep_hits, false},
    {"grazing", "those of paper that one edge axis alone separates", 1, draw_paper, keep_edge_misses, false},
    {"plane", "those of paper that the plane alone separates", 1, draw_paper, keep_plane_misses, false},
    {"miss-x", "triangles beside the box on the x axis", 1, draw_above_x, NULL, false},
    {"miss-z", "triangles beside the box on the z axis", 1, draw_above_z, NULL, false},
};

enum { RECIPES = sizeof recipes / sizeof recipes[0], TORUS = RECIPES, CHANGE, SCENES };

size_t order_scene_count(void) { return SCENES; }

const char *order_scene_name(size_t index) { return index == TORUS ? "octree" : index == CHANGE ? "change" : recipes[index].name; }

const char *order_scene_what(size_t index)
{
    return index == TORUS    ? "a torus of 100,000 triangles against the leaves of its octree"
           : index == CHANGE ? "sparse, and from half way on plane"
                             : recipes[index].what;
}

static bool fail(const char *scene, const char *what)
{
    fprintf(stderr, "order: cannot make scene %s: %s\n", scene, what);
    return false;
}

/* NULL, or what fails. */
static const char *draw_all(const struct recipe *recipe, const tribox_box *box, size_t count, generator *g, triangle *triangles)
{
    for (size_t kept = 0, tries = 0; kept < count; tries++) {
        if (tries > 10000 + 1000 * kept)
            return "hardly any triangle is kept";
        recipe->draw(g, triangles[kept]);
        kept += !recipe->keep || recipe->keep(why_axes_of((const float(*)[3])triangles[kept], box).apart);
    }
    return !recipe->is_sorted || place_sort(triangles, count, 8.5f) ? NULL : "out of memory";
}

/* The first `part` triangles by a recipe, the rest by `then`; the box is that of the first. */
static bool make_parts(const struct recipe *recipe, size_t part, const struct recipe *then, size_t count, uint64_t seed,
                       timing_work *work)
{
    const float half = recipe->size / 2;
    const tribox_box box = {{-half, -half, -half}, {half, half, half}};
    generator g = {seed};
    if (!timing_work_make(work, 1, timing_work_room(count)))
        return fail(recipe->name, "out of memory");
    const char *failure = draw_all(recipe, &box, part, &g, work->triangles);
    failure = failure ? failure : draw_all(then, &box, count - part, &g, work->triangles + part);
    if (failure) {
        timing_work_free(work);
        return fail(recipe->name, failure);
    }
    const timing_job job = timing_work_soup(work, count);
    timing_work_add(work, &job, &box);
    return true;
}

static bool make_drawn(const struct recipe *recipe, size_t count, uint64_t seed, timing_work *work)
{
    return make_parts(recipe, count, recipe, count, seed, work);
}

static const struct recipe *recipe_named(const char *name)
{
    const struct recipe *recipe = recipes;
    while (strcmp(recipe->name, name) != 0)
        recipe++;
    return recipe;
}

static bool make_change(size_t count, uint64_t seed, timing_work *work)
{
    return make_parts(recipe_named("sparse"), count / 2, recipe_named("plane"), count, seed, work);
}

enum { AROUND = 500, ACROSS = 100 };

/* A point of a torus that is turned, so that no triangle of it lies along an axis. */
static void torus_point(size_t around, size_t across, float point[3])
{
    const double turn = 2 * acos(-1.0);
    const double p = turn * (double)around / AROUND, q = turn * (double)across / ACROSS;
    const double flat[3] = {(2 + cos(q)) * cos(p), (2 + cos(q)) * sin(p), sin(q)};
    for (int a = 0; a < 3; a++)
        point[a] = (float)((2 * flat[a] + 2 * flat[(a + 1) % 3] - flat[(a + 2) % 3]) / 3);
}

static void write_torus(float (*triangles)[3][3])
{
    for (size_t p = 0; p < AROUND; p++)
        for (size_t q = 0; q < ACROSS; q++, triangles += 2)
            for (size_t j = 0; j < 3; j++) {
                torus_point(p + (j == 1), q + (j == 2), triangles[0][j]);
                torus_point(p + (j != 1), q + (j != 2), triangles[1][j]);
            }
}

static bool make_octree(const char *name, const tribox_soup *soup, size_t count, timing_work *work)
{
    const char *const failure = octree_work(soup, octree_depth_for(soup->count), count, work);
    return !failure || fail(name, failure);
}

static bool make_torus(size_t count, timing_work *work)
{
    enum { TRIANGLES = 2 * AROUND * ACROSS };
    timing_work torus;
    if (!timing_work_make(&torus, 1, timing_work_room(TRIANGLES)))
        return fail("octree", "out of memory");
    write_torus(torus.triangles);
    const timing_job job = timing_work_soup(&torus, TRIANGLES);
    const bool is_made = make_octree("octree", &job.soup, count, work);
    timing_work_free(&torus);
    return is_made;
}

bool order_scene_make(size_t index, size_t count, uint64_t seed, timing_work *work)
{
    return index == TORUS    ? make_torus(count, work)
           : index == CHANGE ? make_change(count, seed, work)
                             : make_drawn(&recipes[index], count, seed, work);
}

bool order_scene_of_mesh(const char *path, size_t count, timing_work *work)
{
    mesh m;
    if (mesh_read(path, &m))
        return false;
    const bool is_made = make_octree(path, &m.soup, count, work);
    mesh_free(&m);
    return is_made;
}
