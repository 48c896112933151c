/*
 * fill_picture.c - draws cuts through bodies: their surface, what tribox_fill_outside and what tribox_fill_parity fill, beside each
 * other in a picture for each body.
 *
 *     build/bench/fill-picture examples/insides
 *
 * Dark: the surface. Blue: filled. White: free.
 */
#include <stdio.h>
#include <stdbool.h>
#include <string.h>

#include "console/message.h"
#include "fill_bodies.h"
#include "picture/picture_png.h"

enum {
    CELL = 4,
    GAP = 12,
    PANELS = 3,
    NX = 64,
    NY = 48,
    NZ = 48,
    WIDTH = PANELS * NX * CELL + (PANELS - 1) * GAP,
    HEIGHT = NY * CELL
};

static const tribox_grid grid = {{0, 0, 0}, {1, 1, 1}, {NX, NY, NZ}};

static fill_body body;
static uint64_t occupied[NY * NZ], solid[PANELS][NY * NZ];
static unsigned char pixels[HEIGHT][WIDTH][3];

/* Row (j, k) in a picture whose y is up. */
static void paint_cell(int panel, int i, int j, const unsigned char colour[3])
{
    for (int y = 0; y < CELL; y++)
        for (int x = 0; x < CELL; x++) {
            const bool is_line = !x || !y; /* between cells */
            unsigned char *const pixel = pixels[(NY - 1 - j) * CELL + y][panel * (NX * CELL + GAP) + i * CELL + x];
            for (int c = 0; c < 3; c++)
                pixel[c] = is_line ? (unsigned char)(colour[c] - colour[c] / 8) : colour[c];
        }
}

static void paint(void)
{
    static const unsigned char free_cell[3] = {250, 250, 250}, surface[3] = {50, 50, 60}, filled[3] = {110, 165, 230};
    memset(pixels, 255, sizeof pixels);
    for (int panel = 0; panel < PANELS; panel++)
        for (int j = 0; j < NY; j++)
            for (int i = 0; i < NX; i++) {
                const size_t row = NZ / 2 * NY + (size_t)j;
                paint_cell(panel, i, j, occupied[row] >> i & 1 ? surface : solid[panel][row] >> i & 1 ? filled : free_cell);
            }
}

static int write_picture(const char *folder, const char *name)
{
    char path[4096];
    if (snprintf(path, sizeof path, "%s/%s.png", folder, name) >= (int)sizeof path)
        return message_usage("the folder's name is too long");
    FILE *const to = fopen(path, "wb");
    const bool is_written = to && picture_png_write(to, &pixels[0][0][0], WIDTH, HEIGHT) && !ferror(to);
    if ((to && fclose(to)) || !is_written)
        return message_failure("%s: cannot be written%s", path, picture_png_is_there ? "" : ": built without libpng");
    return EXIT_CODE_OK;
}

static int show(const char *folder, const fill_kind *kind)
{
    uint64_t scratch[2 * (NY * NZ) / 64 + 3];
    size_t outside, inside, odd_rows;
    body.count = 0;
    kind->make(&body);
    const tribox_soup soup = fill_body_soup(&body);
    memset(occupied, 0, sizeof occupied);
    if (tribox_fill_bytes(grid.size) > sizeof scratch || tribox_voxelize(&soup, &grid, NULL, NULL, occupied, NULL) ||
        tribox_fill_outside(grid.size, occupied, scratch, solid[1], &outside) ||
        tribox_fill_parity(&soup, &grid, occupied, scratch, solid[2], &inside, &odd_rows))
        return message_failure("%s: cannot be filled", kind->name);
    memcpy(solid[0], occupied, sizeof occupied);
    printf("%-9s %5zu triangles: outside fills %6zu cells, parity %6zu; odd rows %4zu\n", kind->name, soup.count, outside, inside,
           odd_rows);
    paint();
    return write_picture(folder, kind->name);
}

int main(int argc, char **argv)
{
    message_set_program("fill-picture");
    if (argc != 2)
        return message_usage("name the folder to write pictures to");
    int code = EXIT_CODE_OK;
    for (size_t n = 0; !code && n < fill_kind_count(); n++)
        code = show(argv[1], fill_kind_at(n));
    return code;
}
