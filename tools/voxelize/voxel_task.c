/* voxel_task.c - cuts triangles and layers out of what is given, and calls the library. */
#include "voxel_task.h"

#include <string.h>

#include "tribox_threads.h"

voxel_task voxel_task_of_soup(const tribox_soup *soup, const tribox_grid *grid, const tribox_options *options)
{
    return (voxel_task){.soup = soup, .count = soup->count, .grid = *grid, .options = options};
}

voxel_task voxel_task_of_mesh(const tribox_mesh *mesh, const tribox_grid *grid, const tribox_options *options)
{
    return (voxel_task){.mesh = mesh, .count = mesh->count, .grid = *grid, .options = options};
}

static tribox_soup part_of_soup(const tribox_soup *soup, size_t start, size_t count)
{
    tribox_soup part = {.count = count};
    for (int v = 0; v < 3; v++) {
        part.x[v] = soup->x[v] + start;
        part.y[v] = soup->y[v] + start;
        part.z[v] = soup->z[v] + start;
    }
    return part;
}

static size_t number_bytes(const tribox_mesh *mesh) { return mesh->position_bytes ? mesh->position_bytes : sizeof(float); }

static size_t stride_of(const tribox_mesh *mesh) { return mesh->stride ? mesh->stride : 3 * number_bytes(mesh); }

static tribox_mesh part_of_mesh(const tribox_mesh *mesh, size_t start, size_t count)
{
    tribox_mesh part = *mesh;
    part.count = count;
    if (mesh->indices) {
        part.indices = (const uint32_t *)mesh->indices + 3 * start;
    } else {
        part.positions = (const unsigned char *)mesh->positions + 3 * start * stride_of(mesh);
        part.vertices = 3 * count;
    }
    return part;
}

tribox_status voxel_task_run(const voxel_task *task, size_t start, size_t count, uint32_t first, uint32_t layers,
                             uint64_t *occupied, tribox_report *report)
{
    const tribox_window window = {{0, 0, first}, {task->grid.size[0], task->grid.size[1], layers}};
    if (task->soup) {
        const tribox_soup part = part_of_soup(task->soup, start, count);
        return task->is_thin ? tribox_voxelize_thin(&part, &task->grid, &window, task->options, occupied, report)
                             : tribox_voxelize(&part, &task->grid, &window, task->options, occupied, report);
    }
    const tribox_mesh part = part_of_mesh(task->mesh, start, count);
    return task->is_thin ? tribox_mesh_voxelize_thin(&part, &task->grid, &window, task->options, occupied, report)
                         : tribox_mesh_voxelize(&part, &task->grid, &window, task->options, occupied, report);
}

tribox_status voxel_task_lists(const voxel_task *task, size_t first, size_t count, const tribox_tiles *tiles,
                               const tribox_options *options, size_t *places, uint32_t *list)
{
    return task->soup ? tribox_tile_lists_part(task->soup, first, count, &task->grid, tiles, options, places, list)
                      : tribox_mesh_tile_lists_part(task->mesh, first, count, &task->grid, tiles, options, places, list);
}

static double number_at(const unsigned char *at, size_t bytes)
{
    float narrow;
    double wide;
    memcpy(&narrow, at, sizeof narrow);
    if (bytes == sizeof narrow)
        return (double)narrow;
    memcpy(&wide, at, sizeof wide);
    return wide;
}

static void mesh_triangle_of(const tribox_mesh *mesh, size_t t, double u[3][3])
{
    const size_t bytes = number_bytes(mesh), axis = mesh->axis_stride ? mesh->axis_stride : bytes;
    const uint32_t *const indices = mesh->indices;
    for (size_t v = 0; v < 3; v++) {
        const size_t vertex = indices ? indices[3 * t + v] : 3 * t + v;
        for (size_t a = 0; a < 3; a++)
            u[a][v] = number_at((const unsigned char *)mesh->positions + vertex * stride_of(mesh) + a * axis, bytes);
    }
}

void voxel_task_triangle(const voxel_task *task, size_t t, double u[3][3])
{
    if (!task->soup) {
        mesh_triangle_of(task->mesh, t, u);
        return;
    }
    for (size_t v = 0; v < 3; v++) {
        u[0][v] = (double)task->soup->x[v][t];
        u[1][v] = (double)task->soup->y[v][t];
        u[2][v] = (double)task->soup->z[v][t];
    }
}
