/* soup_or_mesh.h - triangles in either form, and the calls about both by one name. */
#ifndef TRIBOX_TESTS_SOUP_OR_MESH_H
#define TRIBOX_TESTS_SOUP_OR_MESH_H

#include <stdbool.h>

#include "tribox_threads.h"

typedef struct soup_or_mesh {
    tribox_soup soup;
    tribox_mesh mesh;
    bool is_mesh; /* which of them is asked */
} soup_or_mesh;

/* What stands behind the triangles is alike in both calls. */
#define CALL(name, of, ...) ((of)->is_mesh ? tribox_mesh_##name(&(of)->mesh, __VA_ARGS__) : tribox_##name(&(of)->soup, __VA_ARGS__))

/* Nine streams in a row, of so many floats each: by axis, then by vertex. */
static inline tribox_soup soup_of_rows(const float *rows, size_t length, size_t count)
{
    tribox_soup soup = {.count = count};
    for (size_t v = 0; v < 3; v++) {
        soup.x[v] = rows + v * length;
        soup.y[v] = rows + (3 + v) * length;
        soup.z[v] = rows + (6 + v) * length;
    }
    return soup;
}

/* Three corners each, one after the other, of floats or of doubles. */
static inline tribox_mesh mesh_of_corners(const void *corners, size_t count, unsigned position_bytes)
{
    return (tribox_mesh){.positions = corners, .vertices = 3 * count, .count = count, .position_bytes = position_bytes};
}

#endif
