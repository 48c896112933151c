/* volume_vti.c - VTK's images, for ParaView: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html */
#include "console/decimal.h"
#include "read/little.h"
#include "volume.h"

/* Three doubles, with a blank before each but the first. */
static void write_point(FILE *to, double x, double y, double z)
{
    char text[3][DECIMAL_MAX];
    fprintf(to, "%s %s %s", decimal_of_double(x, text[0]), decimal_of_double(y, text[1]), decimal_of_double(z, text[2]));
}

static void write_extent(FILE *to, const char *attribute, const uint32_t size[3])
{
    fprintf(to, " %s=\"0 %u 0 %u 0 %u\"", attribute, size[0], size[1], size[2]);
}

static void write_image(FILE *to, const voxels *v)
{
    const bool has_labels = voxels_have_labels(v);
    const tribox_grid *const grid = &v->grid;
    fputs("  <ImageData", to);
    write_extent(to, "WholeExtent", grid->size);
    fputs(" Origin=\"", to);
    write_point(to, grid->origin[0] + v->shift[0], grid->origin[1] + v->shift[1], grid->origin[2] + v->shift[2]);
    fputs("\" Spacing=\"", to);
    write_point(to, grid->cell[0], grid->cell[1], grid->cell[2]);
    fputs("\">\n    <Piece", to);
    write_extent(to, "Extent", grid->size);
    fprintf(to,
            ">\n"
            "      <CellData Scalars=\"%s\">\n"
            "        <DataArray type=\"UInt8\" Name=\"%s\" format=\"appended\" RangeMin=\"0\" RangeMax=\"%d\" offset=\"0\"/>\n"
            "      </CellData>\n"
            "    </Piece>\n"
            "  </ImageData>\n",
            has_labels ? "label" : "occupied", has_labels ? "label" : "occupied", has_labels ? VOXELS_INSIDE : 1);
}

/* The length of the array stands before it. */
static void write_length(FILE *to, const uint32_t size[3])
{
    unsigned char length[8];
    little_put64(length, (uint64_t)size[0] * size[1] * size[2]);
    fwrite(length, 1, sizeof length, to);
}

static void write_before(FILE *to, const voxels *v)
{
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
          to);
    write_image(to, v);
    fputs("  <AppendedData encoding=\"raw\">\n   _", to);
    write_length(to, v->grid.size);
}

static void write_after(FILE *to) { fputs("\n  </AppendedData>\n</VTKFile>\n", to); }

const volume_frame volume_vti = {.before = write_before, .after = write_after};
