/* read_by_assimp.c - reads what libassimp can read, without any of its clean-up. */
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "console/message.h"
#include "readers.h"

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

typedef struct counts {
    size_t triangles;
    size_t points_and_lines;
    size_t to_cut; /* triangles that the polygons are worth */
} counts;

static void count_faces(const struct aiMesh *part, const transform *place, void *context)
{
    counts *c = context;
    (void)place;
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const unsigned corners = part->mFaces[i].mNumIndices;
        c->triangles += corners == 3;
        c->points_and_lines += corners == 1 || corners == 2;
        c->to_cut += corners > 3 ? corners - 2 : 0;
    }
}

static counts count_scene(const struct aiScene *scene)
{
    counts c = {0, 0, 0};
    walk(scene, count_faces, &c);
    return c;
}

static void append_triangles(const struct aiMesh *part, const transform *place, void *context)
{
    mesh *m = context;
    const bool is_moved = !is_identity(place);
    for (unsigned i = 0; i < part->mNumFaces; i++) {
        const struct aiFace *face = &part->mFaces[i];
        if (face->mNumIndices != 3)
            continue;
        /* Nine streams, one after another: x of the three vertices, then y, then z. */
        float *to = m->coordinates + m->soup.count++;
        for (int a = 0; a < 3; a++)
            for (int v = 0; v < 3; v++, to += m->capacity)
                *to = transform_coordinate(place, is_moved, a, &part->mVertices[face->mIndices[v]]);
    }
}

static int check_indices(const char *path, const struct aiScene *scene)
{
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const struct aiMesh *part = scene->mMeshes[i];
        for (unsigned f = 0; f < part->mNumFaces; f++)
            for (unsigned k = 0; k < part->mFaces[f].mNumIndices; k++)
                if (part->mFaces[f].mIndices[k] >= part->mNumVertices)
                    return message_failure("%s: damaged: face %u refers to vertex %ld, the mesh has %u, counted from 0", path, f,
                                           (long)(int32_t)part->mFaces[f].mIndices[k], part->mNumVertices);
    }
    return EXIT_CODE_OK;
}

/* Keeps libassimp's own report, which may have several lines, on one. */
static int refuse(const char *path)
{
    char reason[200];
    snprintf(reason, sizeof reason, "%s", aiGetErrorString());
    for (char *c = reason; *c; c++)
        if (*c == '\n' || *c == '\r')
            *c = ' ';
    return message_failure("%s: not a mesh that libassimp can read, or a damaged one (%s)", path, reason);
}

static int read_scene(const char *path, const struct aiScene *scene, mesh *m)
{
    int code = check_indices(path, scene);
    if (code)
        return code;
    const counts before = count_scene(scene);
    if (before.to_cut && !aiApplyPostProcessing(scene, aiProcess_Triangulate))
        return refuse(path);
    const counts after = before.to_cut ? count_scene(scene) : before;
    m->left_out = before.points_and_lines;
    m->uncut = before.triangles + before.to_cut - after.triangles;
    code = mesh_make_room(path, after.triangles, m);
    if (!code)
        walk(scene, append_triangles, m);
    return code;
}

/* By its path, as a file may refer to others beside it. */
int read_by_assimp(const char *path, mesh *m)
{
    const struct aiScene *const scene = aiImportFile(path, 0);
    if (!scene)
        return refuse(path);
    const int code = read_scene(path, scene, m);
    aiReleaseImport(scene);
    return code;
}
