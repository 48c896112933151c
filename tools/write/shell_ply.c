/* shell_ply.c - a shell as a binary PLY file, with doubles, which hold the planes of the grid, and a colour for each face. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "read/little.h"
#include "shell_file.h"

static bool put_vertex_ply(void *file, const uint32_t halves[3], rgb colour)
{
    const shell_file *const f = file;
    unsigned char bytes[3 * sizeof(uint64_t)];
    (void)colour;
    for (int a = 0; a < 3; a++) {
        const double x = shell_file_coordinate(f->cells, a, halves[a]);
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        little_put64(bytes + 8 * a, bits);
    }
    return fwrite(bytes, 1, sizeof bytes, f->to) == sizeof bytes;
}

static void put_triangle_ply(void *file, const uint32_t triangle[3], rgb colour)
{
    enum { PLAIN = 1 + 3 * sizeof(uint32_t) };
    const shell_file *const f = file;
    unsigned char bytes[PLAIN + sizeof colour] = {3};
    for (int n = 0; n < 3; n++)
        little_put32(bytes + 1 + 4 * n, triangle[n]);
    memcpy(bytes + PLAIN, colour.at, sizeof colour);
    fwrite(bytes, 1, f->cells->colours ? sizeof bytes : PLAIN, f->to);
}

int shell_write_ply(shell_file *f)
{
    fprintf(f->to,
            "ply\nformat binary_little_endian 1.0\ncomment the surface of cells, by tribox\n"
            "element vertex %" PRIu64 "\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %" PRIu64 "\nproperty list uchar int vertex_indices\n%send_header\n",
            f->shell->points.vertices, f->shell->triangles,
            f->cells->colours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    if (shell_file_each_vertex(f, put_vertex_ply))
        shell_file_triangles(f, put_triangle_ply);
    return EXIT_CODE_OK;
}
