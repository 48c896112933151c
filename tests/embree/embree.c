/* embree.c - Embree 3 or 4, whichever HAVE_EMBREE names; without it every test is skipped. */
#include "embree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if HAVE_EMBREE == 4
#include <embree4/rtcore.h>
#elif HAVE_EMBREE == 3
#include <embree3/rtcore.h>
#endif

#if HAVE_EMBREE

struct embree_scene {
    RTCDevice device;
    RTCScene scene;
    embree_hit *hits;
    size_t count, capacity;
};

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

bool embree_is_usable(void)
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

static void record(embree_scene *s, embree_hit hit)
{
    if (s->count == s->capacity) {
        s->capacity = s->capacity ? 2 * s->capacity : 256;
        s->hits = realloc(s->hits, s->capacity * sizeof *s->hits);
        if (!s->hits)
            die(s->device, "no memory for the hits");
    }
    s->hits[s->count++] = hit;
}

/* Takes down every hit and refuses it, so that the ray goes on. The names of a packet's members are for C++ alone. */
static void take_down(const struct RTCFilterFunctionNArguments *args)
{
    carried *const with = (carried *)args->context;
    const float *const ray = (const float *)args->ray;
    const unsigned *const hit = (const unsigned *)args->hit;
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; i++)
        if (args->valid[i]) {
            record(with->scene, (embree_hit){.triangle = hit[5 * n + i], .t = ray[8 * n + i]});
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

/* Robust: closed at both ends of a ray, and no hit on an edge falls between two triangles. */
embree_scene *embree_scene_make(const triangle *triangles, size_t count)
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

void embree_scene_free(embree_scene *s)
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

size_t embree_cast(embree_scene *s, const float from[3], const float along[3], float far, const embree_hit **hits)
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

#else

bool embree_is_usable(void)
{
    printf("skipped: built without Embree; install it (Debian: libembree-dev) and set up the build with -Dembree=enabled\n");
    return false;
}

embree_scene *embree_scene_make(const triangle *triangles, size_t count)
{
    (void)triangles;
    (void)count;
    abort();
}

void embree_scene_free(embree_scene *scene)
{
    (void)scene;
    abort();
}

size_t embree_cast(embree_scene *scene, const float from[3], const float along[3], float far, const embree_hit **hits)
{
    (void)scene;
    (void)from;
    (void)along;
    (void)far;
    (void)hits;
    abort();
}

#endif
