/* assimp_part.c - the part of the program that reads what libassimp can read, without any of its clean-up. */
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "assimp_part.h"

/* Rows of an affine transform: a coordinate is row . (x, y, z, 1). */
typedef struct transform {
    double row[3][4];
} transform;

static const transform identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

static transform transform_of(const struct aiMatrix4x4 *m)
{
    return (transform){{{m->a1, m->a2, m->a3, m->a4}, {m->b1, m->b2, m->b3, m->b4}, {m->c1, m->c2, m->c3, m->c4}}};
}

static transform transform_product(const transform *a, const transform *b)
{
    transform product;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++)
            product.row[i][j] = a->row[i][0] * b->row[0][j] + a->row[i][1] * b->row[1][j] + a->row[i][2] * b->row[2][j] +
                                (j == 3 ? a->row[i][3] : 0);
    return product;
}

static bool is_identity(const transform *t)
{
    for (int i = 0; i < 12; i++)
        if (t->row[i / 4][i % 4] != identity.row[i / 4][i % 4])
            return false;
    return true;
}

/* Evaluated in double and rounded once; the identity gives the float itself, NaN and -0 included. */
static float transform_coordinate(const transform *t, bool is_moved, int a, const struct aiVector3D *p)
{
    if (!is_moved)
        return a == 0 ? p->x : a == 1 ? p->y : p->z;
    const double *row = t->row[a];
    return (float)(row[0] * (double)p->x + row[1] * (double)p->y + row[2] * (double)p->z + row[3]);
}

/* Calls visit for every mesh of every node, in the order of the file. */
typedef void visit_mesh(const struct aiMesh *part, const transform *place, void *context);

static void walk_node(const struct aiScene *scene, const struct aiNode *node, const transform *parent, visit_mesh *visit,
                      void *context)
{
    const transform own = transform_of(&node->mTransformation), place = transform_product(parent, &own);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        visit(scene->mMeshes[node->mMeshes[i]], &place, context);
    for (unsigned i = 0; i < node->mNumChildren; i++)
        walk_node(scene, node->mChildren[i], &place, visit, context);
}

static void walk(const struct aiScene *scene, visit_mesh *visit, void *context)
{
    if (scene->mRootNode)
        walk_node(scene, scene->mRootNode, &identity, visit, context);
}

typedef struct faces {
    size_t triangles;
    size_t points_and_lines;
    size_t to_cut; /* triangles that the polygons are worth */
} faces;

static void count_faces(const struct aiMesh *part, const transform *place, void *context)
{
    faces *f = context;
    (void)place;
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const unsigned corners = part->mFaces[i].mNumIndices;
        f->triangles += corners == 3;
        f->points_and_lines += corners == 1 || corners == 2;
        f->to_cut += corners > 3 ? corners - 2 : 0;
    }
}

static faces faces_of(const struct aiScene *scene)
{
    faces f = {0, 0, 0};
    walk(scene, count_faces, &f);
    return f;
}

/* Where the triangles go, and how many there are so far. */
typedef struct streams {
    float *first;
    size_t length, done;
} streams;

static void put_triangles(const struct aiMesh *part, const transform *place, void *context)
{
    streams *s = context;
    const bool is_moved = !is_identity(place);
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const struct aiFace *face = &part->mFaces[i];
        if (face->mNumIndices != 3)
            continue;
        float *to = s->first + s->done++;
        for (int a = 0; a < 3; a++)
            for (int v = 0; v < 3; v++, to += s->length)
                *to = transform_coordinate(place, is_moved, a, &part->mVertices[face->mIndices[v]]);
    }
}

static bool check_indices(const struct aiScene *scene, char *reason)
{
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const struct aiMesh *part = scene->mMeshes[i];
        for (unsigned f = 0; f < part->mNumFaces; f++)
            for (unsigned k = 0; k < part->mFaces[f].mNumIndices; k++)
                if (part->mFaces[f].mIndices[k] >= part->mNumVertices) {
                    snprintf(reason, ASSIMP_REASON, "damaged: face %u refers to vertex %ld, the mesh has %u, counted from 0", f,
                             (long)(int32_t)part->mFaces[f].mIndices[k], part->mNumVertices);
                    return false;
                }
    }
    return true;
}

/* Keeps libassimp's own report, which may have several lines, on one. */
static bool refuse(char *reason)
{
    snprintf(reason, ASSIMP_REASON, "not a mesh that libassimp can read, or a damaged one (%.200s)", aiGetErrorString());
    for (char *c = reason; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
    return false;
}

/* Cuts polygons, and counts. What fails has released the scene, as libassimp does. */
static bool cut(const struct aiScene *scene, assimp_counts *counts, char *reason)
{
    const faces before = faces_of(scene);
    if (before.to_cut && !aiApplyPostProcessing(scene, aiProcess_Triangulate))
        return refuse(reason);
    counts->triangles = before.to_cut ? faces_of(scene).triangles : before.triangles;
    counts->points_and_lines = before.points_and_lines;
    counts->uncut = before.triangles + before.to_cut - counts->triangles;
    return true;
}

/* By its path, as a file may refer to others beside it. */
static const void *open_scene(const char *path, assimp_counts *counts, char *reason)
{
    const struct aiScene *const scene = aiImportFile(path, 0);
    if (!scene) {
        refuse(reason);
        return NULL;
    }
    if (!check_indices(scene, reason)) {
        aiReleaseImport(scene);
        return NULL;
    }
    return cut(scene, counts, reason) ? scene : NULL;
}

static void put_scene(const void *scene, size_t triangles, float *to)
{
    walk(scene, put_triangles, &(streams){to, triangles, 0});
}

static void close_scene(const void *scene) { aiReleaseImport(scene); }

__attribute__((visibility("default"))) const assimp_part tribox_assimp_part = {open_scene, put_scene, close_scene};
