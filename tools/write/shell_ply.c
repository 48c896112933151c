/* shell_ply.c - a shell as a binary PLY file, with doubles, which hold the planes of the grid, and a colour for each face. */
#include <inttypes.h>
#include <string.h>

#include "console/message.h"
#include "read/little.h"
#include "shell_file.h"

static int begin(shell_file *f)
{
    fprintf(f->to,
            "ply\nformat binary_little_endian 1.0\ncomment the surface of cells, by tribox\n"
            "element vertex %" PRIu64 "\nproperty double x\nproperty double y\nproperty double z\n"
            "element face %" PRIu64 "\nproperty list uchar int vertex_indices\n%send_header\n",
            f->vertices, f->shell->triangles,
            f->cells->colours ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
    return EXIT_CODE_OK;
}

static void put_vertex(shell_file *f, const uint32_t halves[3], rgb colour)
{
    unsigned char bytes[3 * sizeof(uint64_t)];
    (void)colour;
    for (int a = 0; a < 3; a++) {
        const double x = shell_file_coordinate(f->cells, a, halves[a]);
        uint64_t bits;
        memcpy(&bits, &x, sizeof bits);
        little_put64(bytes + 8 * a, bits);
    }
    fwrite(bytes, 1, sizeof bytes, f->to);
}

static void put_triangle(shell_file *f, const uint32_t triangle[3], rgb colour)
{
    enum { PLAIN = 1 + 3 * sizeof(uint32_t) };
    unsigned char bytes[PLAIN + sizeof colour] = {3};
    for (int n = 0; n < 3; n++)
        little_put32(bytes + 1 + 4 * n, triangle[n]);
    memcpy(bytes + PLAIN, colour.at, sizeof colour);
    fwrite(bytes, 1, f->cells->colours ? sizeof bytes : PLAIN, f->to);
}

const shell_format shell_ply = {.begin = begin, .vertex = put_vertex, .triangle = put_triangle};
