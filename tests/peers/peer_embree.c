/*
 * peer_embree.c - Embree's rtcCollide of a scene of triangles and a scene of boxes, which knows bounding boxes alone; its
 * candidates are then tested by tribox_mesh_overlap, box by box.
 */
#include <math.h>
#include <stdio.h>

#include "peer.h"

#if HAVE_EMBREE == 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

typedef struct embree_tree {
    RTCDevice device;
    RTCScene triangles, boxes;
    tribox_mesh mesh;
    const tribox_box *box;
    size_t box_count;
    uint32_t (*pairs)[2]; /* box, triangle: candidates as they come */
    size_t pair_count, pair_room;
    size_t *end;       /* of each box, among the candidates in order */
    uint32_t *ordered; /* candidates, box after box */
    uint32_t *corners; /* of the candidates of a box */
    uint64_t *mask;
} embree_tree;

static void *allocate(void *old, size_t bytes)
{
    void *const memory = realloc(old, bytes);
    if (!memory)
        abort();
    return memory;
}

static void bound_triangle(const struct RTCBoundsFunctionArguments *args)
{
    const float(*const u)[3] = ((const float(*)[3][3])args->geometryUserPtr)[args->primID];
    args->bounds_o->lower_x = fminf(fminf(u[0][0], u[1][0]), u[2][0]);
    args->bounds_o->lower_y = fminf(fminf(u[0][1], u[1][1]), u[2][1]);
    args->bounds_o->lower_z = fminf(fminf(u[0][2], u[1][2]), u[2][2]);
    args->bounds_o->upper_x = fmaxf(fmaxf(u[0][0], u[1][0]), u[2][0]);
    args->bounds_o->upper_y = fmaxf(fmaxf(u[0][1], u[1][1]), u[2][1]);
    args->bounds_o->upper_z = fmaxf(fmaxf(u[0][2], u[1][2]), u[2][2]);
}

static void bound_box(const struct RTCBoundsFunctionArguments *args)
{
    const tribox_box *const box = (const tribox_box *)args->geometryUserPtr + args->primID;
    args->bounds_o->lower_x = (float)box->lo[0];
    args->bounds_o->lower_y = (float)box->lo[1];
    args->bounds_o->lower_z = (float)box->lo[2];
    args->bounds_o->upper_x = (float)box->hi[0];
    args->bounds_o->upper_y = (float)box->hi[1];
    args->bounds_o->upper_z = (float)box->hi[2];
}

static RTCScene make_scene(RTCDevice device, const void *things, size_t count, RTCBoundsFunction bounds)
{
    const RTCScene scene = rtcNewScene(device);
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, (unsigned)count);
    rtcSetGeometryUserData(geometry, (void *)(uintptr_t)things);
    rtcSetGeometryBoundsFunction(geometry, bounds, NULL);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

/* One thread, as everyone else. */
static void *make(const float (*triangles)[3][3], size_t count)
{
    embree_tree *const tree = allocate(NULL, sizeof *tree);
    *tree = (embree_tree){.device = rtcNewDevice("threads=1"),
                          .mesh = {.positions = triangles, .vertices = 3 * count, .index_bytes = 4}};
    tree->triangles = make_scene(tree->device, triangles, count, bound_triangle);
    tree->corners = allocate(NULL, 3 * count * sizeof *tree->corners + 1);
    tree->mask = allocate(NULL, (tribox_mask_words(count) + 1) * sizeof *tree->mask);
    if (rtcGetDeviceError(tree->device) != RTC_ERROR_NONE) {
        fprintf(stderr, "Embree: the scene cannot be built\n");
        exit(1);
    }
    return tree;
}

static void release(void *asked)
{
    embree_tree *const tree = asked;
    if (tree->boxes)
        rtcReleaseScene(tree->boxes);
    rtcReleaseScene(tree->triangles);
    rtcReleaseDevice(tree->device);
    free(tree->pairs);
    free(tree->end);
    free(tree->ordered);
    free(tree->corners);
    free(tree->mask);
    free(tree);
}

static void take_boxes(void *asked, const tribox_box *boxes, size_t count)
{
    embree_tree *const tree = asked;
    if (tree->boxes)
        rtcReleaseScene(tree->boxes);
    tree->boxes = make_scene(tree->device, boxes, count, bound_box);
    tree->box = boxes;
    tree->box_count = count;
}

static void take_down(void *to, struct RTCCollision *found, unsigned count)
{
    embree_tree *const tree = to;
    if (tree->pair_count + count > tree->pair_room) {
        tree->pair_room = 2 * (tree->pair_count + count);
        tree->pairs = allocate(tree->pairs, tree->pair_room * sizeof *tree->pairs);
        tree->ordered = allocate(tree->ordered, tree->pair_room * sizeof *tree->ordered);
    }
    for (unsigned i = 0; i < count; i++) {
        tree->pairs[tree->pair_count][0] = found[i].primID1;
        tree->pairs[tree->pair_count++][1] = found[i].primID0;
    }
}

static void order_by_box(embree_tree *tree)
{
    tree->end = allocate(tree->end, (tree->box_count + 1) * sizeof *tree->end);
    for (size_t b = 0; b <= tree->box_count; b++)
        tree->end[b] = 0;
    for (size_t i = 0; i < tree->pair_count; i++)
        tree->end[tree->pairs[i][0] + 1]++;
    for (size_t b = 0; b < tree->box_count; b++)
        tree->end[b + 1] += tree->end[b];
    for (size_t i = 0; i < tree->pair_count; i++)
        tree->ordered[tree->end[tree->pairs[i][0]]++] = tree->pairs[i][1];
}

static void filter(embree_tree *tree, size_t box, const uint32_t *candidates, size_t count, peer_lists *to)
{
    tree->mesh.indices = tree->corners;
    tree->mesh.count = count;
    for (size_t i = 0; i < count; i++)
        for (uint32_t v = 0; v < 3; v++)
            tree->corners[3 * i + v] = 3 * candidates[i] + v;
    if (tribox_mesh_overlap(&tree->mesh, &tree->box[box], NULL, tree->mask, NULL))
        abort();
    for (size_t i = 0; i < count; i++)
        if (tree->mask[i / 64] >> i % 64 & 1)
            peer_lists_add(to, candidates[i]);
}

static void list(void *asked, const tribox_box *boxes, size_t count, peer_lists *to)
{
    embree_tree *const tree = asked;
    (void)boxes;
    tree->pair_count = 0;
    rtcCollide(tree->triangles, tree->boxes, take_down, tree);
    order_by_box(tree);
    for (size_t b = 0, first = 0; b < count; first = tree->end[b++]) {
        peer_lists_begin(to, b);
        filter(tree, b, tree->ordered + first, tree->end[b] - first, to);
    }
    peer_lists_begin(to, count);
    to->candidates += tree->pair_count;
}

static void list_boxes_too(void *asked, const tribox_box *boxes, size_t count, peer_lists *to)
{
    take_boxes(asked, boxes, count);
    list(asked, boxes, count, to);
}

const peer peer_embree = {"Embree", true, make, release, take_boxes, list, NULL};

/* The same with the time for the scene of boxes, which others do not need. */
const peer peer_embree_boxes = {"Embree+", true, make, release, NULL, list_boxes_too, NULL};
