/* mesh_numbers.h - where the numbers of a mesh lie in memory, by the definition in tribox.h; they are read, and changed. */
#ifndef TRIBOX_TESTS_MESH_NUMBERS_H
#define TRIBOX_TESTS_MESH_NUMBERS_H

#include <stdint.h>
#include <string.h>

#include "tribox.h"

/* Bytes of a number, from an axis to the next, from a vertex to the next, and of all vertices. */
static inline size_t mesh_number_bytes(const tribox_mesh *mesh) { return mesh->position_bytes == 8 ? 8 : 4; }

static inline size_t mesh_axis_stride(const tribox_mesh *mesh)
{
    return mesh->axis_stride ? mesh->axis_stride : mesh_number_bytes(mesh);
}

static inline size_t mesh_stride(const tribox_mesh *mesh)
{
    const size_t bytes = mesh_number_bytes(mesh);
    return mesh->stride ? mesh->stride : mesh->axis_stride > bytes ? bytes : 3 * bytes;
}

static inline size_t mesh_bytes(const tribox_mesh *mesh)
{
    const size_t last = 2 * mesh_axis_stride(mesh) + mesh_number_bytes(mesh);
    return mesh->vertices ? (mesh->vertices - 1) * mesh_stride(mesh) + last : 0;
}

/* Where axis a of a vertex lies, and a number to be put there. */
static inline unsigned char *mesh_address(const tribox_mesh *mesh, size_t vertex, int a)
{
    unsigned char *const positions = (unsigned char *)(uintptr_t)mesh->positions;
    const unsigned axes = mesh->axes ? mesh->axes : 123, digit[3] = {axes / 100, axes / 10 % 10, axes % 10};
    return positions + vertex * mesh_stride(mesh) + (digit[a] - 1) * mesh_axis_stride(mesh);
}

static inline void mesh_put(const tribox_mesh *mesh, size_t vertex, int a, double x)
{
    const float narrow = (float)x;
    memcpy(mesh_address(mesh, vertex, a), mesh_number_bytes(mesh) == 8 ? (const void *)&x : &narrow, mesh_number_bytes(mesh));
}

/* The number of the vertex at a corner, and a change of it. */
static inline size_t mesh_index(const tribox_mesh *mesh, size_t corner)
{
    uint16_t narrow = 0;
    uint32_t wide = 0;
    if (!mesh->indices)
        return corner;
    const unsigned char *const at = (const unsigned char *)mesh->indices + mesh->index_bytes * corner;
    memcpy(mesh->index_bytes == 2 ? (void *)&narrow : &wide, at, mesh->index_bytes);
    return mesh->index_bytes == 2 ? narrow : wide;
}

static inline void mesh_set_index(const tribox_mesh *mesh, size_t corner, size_t number)
{
    const uint16_t narrow = (uint16_t)number;
    const uint32_t wide = (uint32_t)number;
    memcpy((unsigned char *)(uintptr_t)mesh->indices + mesh->index_bytes * corner,
           mesh->index_bytes == sizeof narrow ? (const void *)&narrow : &wide, mesh->index_bytes);
}

/* Axis a of the vertex at a corner, of floats as it is, or widened. */
static inline float mesh_float(const tribox_mesh *mesh, size_t corner, int a)
{
    float number;
    memcpy(&number, mesh_address(mesh, mesh_index(mesh, corner), a), sizeof number);
    return number;
}

static inline double mesh_number(const tribox_mesh *mesh, size_t corner, int a)
{
    double number;
    if (mesh_number_bytes(mesh) != 8)
        return (double)mesh_float(mesh, corner, a);
    memcpy(&number, mesh_address(mesh, mesh_index(mesh, corner), a), sizeof number);
    return number;
}

#endif
