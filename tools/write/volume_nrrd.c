/* volume_nrrd.c - nearly raw raster data, for 3D Slicer: https://teem.sourceforge.net/nrrd/format.html */
#include "console/decimal.h"
#include "volume.h"

/* The place of a sample is the middle of its cell. */
static double middle(const voxels *v, int a) { return v->grid.origin[a] + v->grid.cell[a] / 2 + v->shift[a]; }

static void write_vector(FILE *to, double x, double y, double z)
{
    char text[3][DECIMAL_MAX];
    fprintf(to, " (%s,%s,%s)", decimal_of_double(x, text[0]), decimal_of_double(y, text[1]), decimal_of_double(z, text[2]));
}

static void write_header(FILE *to, const voxels *v)
{
    const tribox_grid *const grid = &v->grid;
    fprintf(to,
            "NRRD0004\n"
            "# cells of a grid that a mesh overlaps%s, by tribox\n"
            "%s\n"
            "dimension: 3\n"
            "space dimension: 3\n"
            "sizes: %u %u %u\n"
            "space directions:",
            v->ids                  ? ": the number of the lowest triangle, else -1"
            : voxels_have_labels(v) ? ": 1, and that it encloses: 2"
                                    : "",
            v->ids ? "type: int32\nendian: little" : "type: uint8", grid->size[0], grid->size[1], grid->size[2]);
    write_vector(to, grid->cell[0], 0, 0);
    write_vector(to, 0, grid->cell[1], 0);
    write_vector(to, 0, 0, grid->cell[2]);
    fputs("\ncenters: cell cell cell\n"
          "kinds: domain domain domain\n"
          "encoding: raw\n"
          "space origin:",
          to);
    write_vector(to, middle(v, 0), middle(v, 1), middle(v, 2));
    fputs("\n\n", to);
}

const volume_frame volume_nrrd = {.before = write_header};
