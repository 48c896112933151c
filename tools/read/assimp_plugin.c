/* assimp_plugin.c - the plugin of the program that reads what libassimp can read, without any of its clean-up. */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "assimp_plugin.h"

/* Rows of an affine transform: a coordinate is row . (x, y, z, 1). */
typedef struct transform {
    double row[3][4];
} transform;

static const transform identity = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

/* Of what is moved by `m`, and then by `by`. */
static transform transform_product(const transform *by, const struct aiMatrix4x4 *m)
{
    const double rows[3][4] = {{(double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4},
                               {(double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4},
                               {(double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4}};
    transform product;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 4; j++) {
            const double *const own = by->row[i];
            product.row[i][j] = own[0] * rows[0][j] + own[1] * rows[1][j] + own[2] * rows[2][j] + (j == 3 ? own[3] : 0);
        }
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
typedef void visit_mesh(const struct aiMesh *mesh, const transform *place, void *context);

static void walk_node(const struct aiScene *scene, const struct aiNode *node, const transform *parent, visit_mesh *visit,
                      void *context)
{
    const transform place = transform_product(parent, &node->mTransformation);
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

/* uncut: triangles that the polygons are worth. */
static void count_faces(const struct aiMesh *mesh, const transform *place, void *context)
{
    assimp_counts *const counts = context;
    (void)place;
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const unsigned corners = mesh->mFaces[i].mNumIndices;
        counts->triangles += corners == 3;
        counts->points_and_lines += corners == 1 || corners == 2;
        counts->uncut += corners > 3 ? corners - 2 : 0;
    }
}

/* Where the triangles go, and how many there are so far. */
typedef struct streams {
    float *first;
    size_t length, done;
} streams;

static void put_triangles(const struct aiMesh *mesh, const transform *place, void *context)
{
    streams *s = context;
    const bool is_moved = !is_identity(place);
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices != 3)
            continue;
        float *to = s->first + s->done++;
        for (int a = 0; a < 3; a++)
            for (int v = 0; v < 3; v++, to += s->length)
                *to = transform_coordinate(place, is_moved, a, &mesh->mVertices[face->mIndices[v]]);
    }
}

/* The colours of triangles: where they go, and how many have come. */
typedef struct colouring {
    const struct aiScene *scene;
    float (*of)[3];
    size_t done;
    assimp_colours found;
} colouring;

static bool has_texture(const struct aiMaterial *m)
{
    return aiGetMaterialTextureCount(m, aiTextureType_DIFFUSE) || aiGetMaterialTextureCount(m, aiTextureType_BASE_COLOR);
}

/* What libassimp makes up for a mesh that names no material is none: by its name, or in glTF white without one. */
static bool is_made_up(const struct aiMaterial *m, const struct aiColor4D *colour)
{
    struct aiString name = {0, ""};
    const bool has_name = aiGetMaterialString(m, AI_MATKEY_NAME, &name) == aiReturn_SUCCESS && name.length;
    return has_name ? !strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) : colour->r == 1 && colour->g == 1 && colour->b == 1;
}

/* Stays white where there is none. */
static bool find_material(const struct aiMaterial *m, struct aiColor4D *colour)
{
    const struct aiColor4D white = *colour;
    const bool is_there = (aiGetMaterialColor(m, AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
                           aiGetMaterialColor(m, AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS) &&
                          !is_made_up(m, colour);
    if (!is_there)
        *colour = white;
    return is_there;
}

static void colour_triangle(const struct aiColor4D *of_corners, const struct aiFace *face, const struct aiColor4D *base, float *to)
{
    const float factor[3] = {base->r, base->g, base->b};
    for (int c = 0; c < 3; c++)
        to[c] = factor[c];
    for (int c = 0; c < 3 && of_corners; c++) {
        double sum = 0;
        for (int v = 0; v < 3; v++) {
            const struct aiColor4D *const own = &of_corners[face->mIndices[v]];
            sum += (double)(c == 0 ? own->r : c == 1 ? own->g : own->b);
        }
        to[c] = (float)(sum / 3 * (double)factor[c]);
    }
}

static void put_colours(const struct aiMesh *mesh, const transform *place, void *context)
{
    colouring *const to = context;
    const bool is_there = mesh->mMaterialIndex < to->scene->mNumMaterials;
    const struct aiMaterial *const material = is_there ? to->scene->mMaterials[mesh->mMaterialIndex] : NULL;
    const struct aiColor4D *const of_corners = mesh->mColors[0];
    struct aiColor4D base = {1, 1, 1, 1};
    const bool has_material = is_there && find_material(material, &base), is_textured = is_there && has_texture(material);
    (void)place;
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        if (mesh->mFaces[i].mNumIndices != 3)
            continue;
        float *const own = to->of[to->done++];
        own[0] = own[1] = own[2] = NAN;
        if (!is_textured && (of_corners || has_material))
            colour_triangle(of_corners, &mesh->mFaces[i], &base, own);
        to->found.textured += is_textured;
        to->found.of_vertices += !is_textured && of_corners;
        to->found.of_materials += !is_textured && !of_corners && has_material;
    }
}

static assimp_colours colour_scene(const void *scene, float (*of)[3])
{
    colouring to = {.scene = scene, .of = of};
    walk(scene, put_colours, &to);
    return to.found;
}

static bool check_indices(const struct aiScene *scene, char *reason)
{
    for (unsigned i = 0; i < scene->mNumMeshes; i++) {
        const struct aiMesh *mesh = scene->mMeshes[i];
        for (unsigned f = 0; f < mesh->mNumFaces; f++)
            for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++)
                if (mesh->mFaces[f].mIndices[k] >= mesh->mNumVertices) {
                    snprintf(reason, ASSIMP_REASON, "damaged: face %u refers to vertex %ld, the mesh has %u, counted from 0", f,
                             (long)(int32_t)mesh->mFaces[f].mIndices[k], mesh->mNumVertices);
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
    assimp_counts after = {0, 0, 0};
    *counts = after;
    walk(scene, count_faces, counts);
    if (!counts->uncut)
        return true;
    if (!aiApplyPostProcessing(scene, aiProcess_Triangulate))
        return refuse(reason);
    walk(scene, count_faces, &after);
    counts->uncut += counts->triangles - after.triangles;
    counts->triangles = after.triangles;
    return true;
}

/* Files as libassimp opens them by itself, but their names are noted. */
static FILE *stream_of(struct aiFile *file) { return (FILE *)(void *)file->UserData; }

static size_t read_file(struct aiFile *file, char *to, size_t size, size_t count)
{
    return fread(to, size, count, stream_of(file));
}

static size_t tell_file(struct aiFile *file) { return (size_t)ftell(stream_of(file)); }

static enum aiReturn seek_file(struct aiFile *file, size_t offset, enum aiOrigin origin)
{
    static const int from[] = {[aiOrigin_SET] = SEEK_SET, [aiOrigin_CUR] = SEEK_CUR, [aiOrigin_END] = SEEK_END};
    return fseek(stream_of(file), (long)offset, from[origin]) ? aiReturn_FAILURE : aiReturn_SUCCESS;
}

static size_t size_file(struct aiFile *file)
{
    const size_t at = tell_file(file);
    const size_t size = seek_file(file, 0, aiOrigin_END) == aiReturn_SUCCESS ? tell_file(file) : 0;
    return seek_file(file, at, aiOrigin_SET) == aiReturn_SUCCESS ? size : 0;
}

/* names: as assimp_plugin.open returns them. */
static bool note(char **names, const char *path)
{
    size_t before = 0;
    while (*names && (*names)[before])
        before += strlen(*names + before) + 1;
    const size_t bytes = strlen(path) + 1;
    char *const all = realloc(*names, before + bytes + 1);
    if (!all)
        return false;
    memcpy(all + before, path, bytes);
    all[before + bytes] = '\0';
    *names = all;
    return true;
}

static struct aiFile *open_file(struct aiFileIO *system, const char *path, const char *mode)
{
    FILE *const stream = fopen(path, mode);
    struct aiFile *const file = stream ? malloc(sizeof *file) : NULL;
    if (file && note((void *)system->UserData, path)) {
        *file = (struct aiFile){.ReadProc = read_file,
                                .TellProc = tell_file,
                                .FileSizeProc = size_file,
                                .SeekProc = seek_file,
                                .UserData = (void *)stream};
        return file;
    }
    free(file);
    if (stream)
        fclose(stream);
    return NULL;
}

static void close_file(struct aiFileIO *system, struct aiFile *file)
{
    (void)system;
    fclose(stream_of(file));
    free(file);
}

/* By its path, as a file may refer to others beside it. */
static const void *open_scene(const char *path, assimp_counts *counts, char **opened, char *reason)
{
    struct aiFileIO system = {open_file, close_file, (void *)opened};
    *opened = NULL;
    const struct aiScene *const scene = aiImportFileEx(path, 0, &system);
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

static void put_scene(const void *scene, size_t triangles, float *to) { walk(scene, put_triangles, &(streams){to, triangles, 0}); }

static void close_scene(const void *scene) { aiReleaseImport(scene); }

__attribute__((visibility("default")))
const assimp_plugin tribox_assimp_plugin = {open_scene, put_scene, colour_scene, close_scene};
