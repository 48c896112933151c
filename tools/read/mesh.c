/* mesh.c - copies triangles into streams: from a file of them, or from what libassimp reads, with none of its clean-up. */
#define _POSIX_C_SOURCE 200809L
#include "mesh.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "mesh_file.h"
#include "console/message.h"

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
        /* Nine streams, one behind the other: x of the three vertices, then y, then z. */
        float *to = m->coordinates + m->soup.count++;
        for (int a = 0; a < 3; a++)
            for (int v = 0; v < 3; v++, to += m->capacity)
                *to = transform_coordinate(place, is_moved, a, &part->mVertices[face->mIndices[v]]);
    }
}

static int make_room(const char *path, uint64_t count, mesh *m)
{
    if (!count)
        return message_failure("%s: no triangles in it, points or lines at most; give a mesh with faces", path);
    m->coordinates = count <= SIZE_MAX / (9 * sizeof(float)) ? malloc(9 * (size_t)count * sizeof(float)) : NULL;
    if (!m->coordinates)
        return message_failure("%s: out of memory for %" PRIu64 " triangles", path, count);
    m->capacity = (size_t)count;
    for (size_t v = 0; v < 3; v++) {
        m->soup.x[v] = m->coordinates + v * m->capacity;
        m->soup.y[v] = m->coordinates + (3 + v) * m->capacity;
        m->soup.z[v] = m->coordinates + (6 + v) * m->capacity;
    }
    return EXIT_CODE_OK;
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
    code = make_room(path, after.triangles, m);
    if (!code)
        walk(scene, append_triangles, m);
    return code;
}

static bool has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), size = strlen(ending);
    return length >= size && !strcasecmp(path + length - size, ending);
}

static int check_file(const char *path, mesh_file *file)
{
    if (mesh_file_is_ply(file))
        return mesh_file_check_ply(path, file);
    if (has_ending(path, ".stl"))
        return mesh_file_check_stl(path, file);
    return has_ending(path, ".off") ? mesh_file_check_off(path, file) : EXIT_CODE_OK;
}

/* A PLY file from memory, for the sake of its header; others by their path, as they may refer to files beside them. */
static const struct aiScene *import(const char *path, mesh_file *file)
{
    if (mesh_file_is_ply(file))
        return aiImportFileFromMemory(file->bytes, (unsigned)file->size, 0, "ply");
    mesh_file_free(file);
    return aiImportFile(path, 0);
}

static int read_by_assimp(const char *path, mesh *m)
{
    mesh_file file;
    int code = mesh_file_read(path, &file);
    if (!code)
        code = check_file(path, &file);
    const struct aiScene *scene = code ? NULL : import(path, &file);
    mesh_file_free(&file);
    if (code)
        return code;
    if (!scene)
        return refuse(path);
    code = read_scene(path, scene, m);
    aiReleaseImport(scene);
    return code;
}

static int read_triangles(const char *path, triangle_file *file, mesh *m)
{
    if (!file->is_sized)
        return message_failure("%s: is no regular file, and the whole mesh is needed; save it as a file", path);
    int code = make_room(path, file->promised, m);
    size_t count = 0;
    while (!code) {
        float *to[9];
        for (size_t k = 0; k < 9; k++)
            to[k] = m->coordinates + k * m->capacity + m->soup.count;
        code = triangle_file_next(file, to, &count);
        if (!count)
            break;
        m->soup.count += count;
    }
    return code;
}

int mesh_read_as(const char *path, triangle_format format, mesh *m)
{
    triangle_file file;
    *m = (mesh){.coordinates = NULL};
    int code = triangle_file_open(path, format, &file);
    if (!code)
        code = file.stream ? read_triangles(path, &file, m) : read_by_assimp(path, m);
    triangle_file_close(&file);
    if (code)
        mesh_free(m);
    else
        m->not_finite = tribox_soup_not_finite(&m->soup, &m->first_not_finite);
    return code;
}

int mesh_read(const char *path, mesh *m) { return mesh_read_as(path, TRIANGLES_OTHER, m); }

void mesh_warn_not_finite(const char *path, uint64_t not_finite, uint64_t count, uint64_t first)
{
    if (not_finite)
        message_say("warning: %s: %" PRIu64 " of %" PRIu64
                    " triangles have NaN or infinite coordinates and overlap nothing; the first is number %" PRIu64,
                    path, not_finite, count, first);
}

void mesh_warn(const char *path, const mesh *m)
{
    mesh_warn_not_finite(path, m->not_finite, m->soup.count, m->first_not_finite);
    if (m->uncut)
        message_say("warning: %s: %zu of %zu triangles are missing: libassimp cannot cut polygons that cross themselves", path,
                    m->uncut, m->soup.count + m->uncut);
}

void mesh_free(mesh *m)
{
    free(m->coordinates);
    *m = (mesh){.coordinates = NULL};
}
