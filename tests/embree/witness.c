/*
 * witness.c - casts rays by Embree 3 or 4, whichever HAVE_EMBREE names, with a filter that takes down every hit; and marks what
 * they witness.
 */
#include "witness.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if HAVE_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

typedef struct embree_scene {
    RTCDevice device;
    RTCScene scene;
    unsigned *hits; /* triangles */
    size_t count, capacity;
} embree_scene;

#if HAVE_EMBREE == 4
typedef struct RTCRayQueryContext ray_context;
#else
typedef struct RTCIntersectContext ray_context;
#endif

/* What a ray carries to the filter: Embree's own context must come first. */
typedef struct carried {
    ray_context context;
    embree_scene *scene;
} carried;

/* One thread: the answers are few and the sanitizers have nothing to say of it. */
static RTCDevice new_device(void) { return rtcNewDevice("threads=1"); }

static void die(RTCDevice device, const char *what)
{
    fprintf(stderr, "Embree: %s (error %d)\n", what, (int)rtcGetDeviceError(device));
    exit(1);
}

bool witness_is_usable(void)
{
    const RTCDevice device = new_device();
    if (!device) {
        printf("skipped: Embree makes no device here (error %d)\n", (int)rtcGetDeviceError(NULL));
        return false;
    }
    const bool has_filters = rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_FILTER_FUNCTION_SUPPORTED) != 0;
    if (!has_filters)
        printf("skipped: this Embree was built without filter functions\n");
    rtcReleaseDevice(device);
    return has_filters;
}

static void record(embree_scene *s, unsigned number)
{
    if (s->count == s->capacity) {
        s->capacity = s->capacity ? 2 * s->capacity : 256;
        s->hits = realloc(s->hits, s->capacity * sizeof *s->hits);
        if (!s->hits)
            die(s->device, "no memory for the hits");
    }
    s->hits[s->count++] = number;
}

/* Takes down every hit and refuses it, so that the ray goes on. The names of a packet's members are for C++ alone. */
static void take_down(const struct RTCFilterFunctionNArguments *args)
{
    carried *const with = (carried *)args->context;
    const unsigned *const hit = (const unsigned *)args->hit;
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; i++)
        if (args->valid[i]) {
            record(with->scene, hit[5 * n + i]);
            args->valid[i] = 0;
        }
}

static void fill(RTCGeometry geometry, RTCDevice device, const triangle *triangles, size_t count)
{
    float *const vertex =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), 3 * count);
    unsigned *const index =
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count);
    if (!vertex || !index)
        die(device, "no memory for the triangles");
    memcpy(vertex, triangles, count * sizeof *triangles);
    for (size_t k = 0; k < 3 * count; k++)
        index[k] = (unsigned)k;
}

/* The triangles are copied. Robust: closed at both ends of a ray, and no hit on an edge falls between two triangles. */
static embree_scene *embree_scene_make(const triangle *triangles, size_t count)
{
    embree_scene *const s = calloc(1, sizeof *s);
    if (!s)
        die(NULL, "no memory for a scene");
    s->device = new_device();
    s->scene = rtcNewScene(s->device);
    rtcSetSceneFlags(s->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(s->scene, RTC_BUILD_QUALITY_MEDIUM);
    const RTCGeometry geometry = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    fill(geometry, s->device, triangles, count);
    rtcSetGeometryMask(geometry, 0xffffffff);
    rtcSetGeometryIntersectFilterFunction(geometry, take_down);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(s->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(s->scene);
    if (rtcGetDeviceError(s->device) != RTC_ERROR_NONE)
        die(s->device, "the scene cannot be built");
    return s;
}

static void embree_scene_free(embree_scene *s)
{
    rtcReleaseScene(s->scene);
    rtcReleaseDevice(s->device);
    free(s->hits);
    free(s);
}

/* All that differs between the two versions. */
static void intersect(embree_scene *s, struct RTCRayHit *ray)
{
    carried with = {.scene = s};
#if HAVE_EMBREE == 4
    struct RTCIntersectArguments arguments;
    rtcInitRayQueryContext(&with.context);
    rtcInitIntersectArguments(&arguments);
    arguments.context = &with.context;
    rtcIntersect1(s->scene, ray, &arguments);
#else
    rtcInitIntersectContext(&with.context);
    rtcIntersect1(s->scene, &with.context, ray);
#endif
}

/* All triangles that the closed ray from + t * along, 0 <= t <= far, meets, in no order. They last until the next cast. */
static size_t embree_cast(embree_scene *s, const float from[3], const float along[3], float far, const unsigned **hits)
{
    struct RTCRayHit ray = {
        .ray = {.org_x = from[0], .org_y = from[1], .org_z = from[2], .dir_x = along[0], .dir_y = along[1], .dir_z = along[2]}};
    ray.ray.tfar = far;
    ray.ray.mask = 0xffffffff;
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    s->count = 0;
    intersect(s, &ray);
    *hits = s->hits;
    return s->count;
}

/* The planes of a grid as a scene: a triangle each, so large that no ray within mesh and grid nears its border. */
typedef struct plane_scene {
    embree_scene *scene;
    int first[3]; /* the triangle that is plane 0 of an axis */
} plane_scene;

/* Corners (A, A), (B, A), (A, B) in the plane, A = lo - extent and B = lo + 4 extent of the grid, in which the mesh lies. */
static triangle plane_triangle(const planes *p, int axis, float plane)
{
    triangle t;
    for (int j = 0; j < 3; j++) {
        t.u[j][axis] = plane;
        for (int k = 1; k < 3; k++) {
            const int a = (axis + k) % 3;
            const float lo = (float)p->at[a][0], extent = (float)p->at[a][p->grid.size[a]] - lo;
            t.u[j][a] = lo + (j == k ? 4 : -1) * extent;
        }
    }
    return t;
}

static plane_scene plane_scene_make(const planes *p)
{
    plane_scene d = {0};
    triangle *const triangles = memory_of(3 * (CELLS_MAX + 1), sizeof *triangles);
    int count = 0;
    for (int a = 0; a < 3; a++) {
        d.first[a] = count;
        for (int i = 0; i <= (int)p->grid.size[a]; i++)
            triangles[count++] = plane_triangle(p, a, (float)p->at[a][i]);
    }
    d.scene = embree_scene_make(triangles, (size_t)count);
    free(triangles);
    return d;
}

/* A point that is on a plane of the grid by construction lies in the cells on both sides. */
static span cells_at_plane(const planes *p, int axis, int plane)
{
    return (span){plane > 0 ? plane - 1 : 0, plane < (int)p->grid.size[axis] ? plane : (int)p->grid.size[axis] - 1};
}

static span cells_at(const planes *p, int axis, double x) { return planes_met(p, axis, x, x); }

static void mark(witness *w, size_t t, const span at[3])
{
    const block *const candidates = &w->candidates[t];
    int c[3];
    for (c[2] = at[2].first; c[2] <= at[2].last; c[2]++)
        for (c[1] = at[1].first; c[1] <= at[1].last; c[1]++)
            for (c[0] = at[0].first; c[0] <= at[0].last; c[0]++) {
                const size_t number = block_number(candidates, c);
                if (number == block_cells(candidates))
                    w->strays++;
                else
                    w->met[w->first_word[t] + number / 64] |= UINT64_C(1) << number % 64;
            }
}

static void mark_vertices(witness *w, size_t t)
{
    for (int j = 0; j < 3; j++) {
        span at[3];
        for (int a = 0; a < 3; a++)
            at[a] = cells_at(w->planes, a, (double)w->model->triangles[t].u[j][a]);
        mark(w, t, at);
    }
}

/* Where edge p q crosses a plane of the grid. False beyond the ends of the edge. */
static bool edge_crosses(const witness *w, const float p[3], const float q[3], int axis, int plane, span at[3])
{
    const double rise = (double)q[axis] - (double)p[axis], part = (double)w->planes->at[axis][plane] - (double)p[axis];
    if (rise == 0 || part / rise < 0 || part / rise > 1)
        return false;
    at[axis] = cells_at_plane(w->planes, axis, plane);
    for (int k = 1; k < 3; k++) {
        const int a = (axis + k) % 3;
        const double along = (double)q[a] - (double)p[a];
        at[a] = cells_at(w->planes, a, along == 0 ? (double)p[a] : (double)p[a] + part * along / rise);
    }
    return true;
}

static void cast_edge(witness *w, plane_scene *d, size_t t, int j)
{
    const float *const p = w->model->triangles[t].u[j], *const q = w->model->triangles[t].u[(j + 1) % 3];
    const float along[3] = {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
    if (along[0] == 0 && along[1] == 0 && along[2] == 0)
        return;
    const unsigned *hits;
    const size_t count = embree_cast(d->scene, p, along, 1 + 0x1p-20f, &hits);
    for (size_t k = 0; k < count; k++) {
        span at[3];
        const int number = (int)hits[k], axis = (number >= d->first[1]) + (number >= d->first[2]);
        const bool is_met = edge_crosses(w, p, q, axis, number - d->first[axis], at);
        if (is_met)
            mark(w, t, at);
        w->edges += is_met;
        w->strays += !is_met;
    }
}

static void cast_edges(witness *w)
{
    plane_scene d = plane_scene_make(w->planes);
    for (size_t t = 0; t < w->model->count; t++)
        for (int j = 0; j < 3; j++)
            cast_edge(w, &d, t, j);
    embree_scene_free(d.scene);
}

/* A lattice line along the axis, at[a] and at[b] being its planes on the two others. */
static void cast_lattice_line(witness *w, embree_scene *scene, int axis, span at[3], const float from[3])
{
    const planes *const p = w->planes;
    const float highest = (float)p->at[axis][(int)p->grid.size[axis]];
    const float cell = (float)p->grid.cell[axis];
    float along[3] = {0};
    along[axis] = 1;
    const unsigned *hits;
    const size_t count = embree_cast(scene, from, along, highest - from[axis] + cell, &hits);
    for (size_t k = 0; k < count; k++) {
        double along_line;
        if (!crossing_of(&w->model->triangles[hits[k]], axis, from, &along_line)) {
            w->strays++;
            continue;
        }
        at[axis] = cells_at(p, axis, (double)from[axis] + along_line);
        mark(w, hits[k], at);
        w->hits++;
    }
}

static void cast_lattice(witness *w)
{
    const planes *const p = w->planes;
    embree_scene *const scene = embree_scene_make(w->model->triangles, w->model->count);
    for (int axis = 0; axis < 3; axis++) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int i = 0; i <= (int)p->grid.size[a]; i++)
            for (int j = 0; j <= (int)p->grid.size[b]; j++) {
                span at[3];
                at[a] = cells_at_plane(p, a, i);
                at[b] = cells_at_plane(p, b, j);
                float from[3];
                from[axis] = (float)(p->at[axis][0] - p->grid.cell[axis]);
                from[a] = (float)p->at[a][i];
                from[b] = (float)p->at[b][j];
                cast_lattice_line(w, scene, axis, at, from);
            }
    }
    embree_scene_free(scene);
}

static void find_candidates(witness *w)
{
    const size_t count = w->model->count;
    w->candidates = memory_of(count, sizeof *w->candidates);
    w->first_word = memory_of(count + 1, sizeof *w->first_word);
    for (size_t t = 0; t < count; t++) {
        w->candidates[t] = planes_candidates(w->planes, &w->model->triangles[t]);
        w->first_word[t + 1] = w->first_word[t] + tribox_mask_words(block_cells(&w->candidates[t]));
    }
    w->met = memory_of(w->first_word[count], sizeof *w->met);
}

witness witness_make(const planes *p, const model *s)
{
    witness w = {.planes = p, .model = s};
    find_candidates(&w);
    for (size_t t = 0; t < s->count; t++)
        mark_vertices(&w, t);
    cast_edges(&w);
    cast_lattice(&w);
    return w;
}

void witness_free(witness *w)
{
    free(w->candidates);
    free(w->first_word);
    free(w->met);
}
