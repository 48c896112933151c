/*
 * volume_frames.c - what stands around dense cells.
 *
 * VTK's images, for ParaView: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
 * Nearly raw raster data, for 3D Slicer: https://teem.sourceforge.net/nrrd/format.html
 */
#include "console/written_number.h"
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
    const char *const name = v->ids ? "id" : voxels_have_labels(v) ? "label" : "occupied";
    const char *const range = voxels_have_labels(v) ? " RangeMin=\"0\" RangeMax=\"2\"" : " RangeMin=\"0\" RangeMax=\"1\"";
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
            "        <DataArray type=\"%s\" Name=\"%s\" format=\"appended\"%s offset=\"0\"/>\n"
            "      </CellData>\n"
            "    </Piece>\n"
            "  </ImageData>\n",
            name, v->ids ? "Int32" : "UInt8", name, v->ids ? "" : range);
}

/* The length of the array stands before it. */
static void write_length(FILE *to, const voxels *v)
{
    unsigned char length[8];
    const uint32_t *const size = v->grid.size;
    little_put64(length, (uint64_t)size[0] * size[1] * size[2] * (v->ids ? sizeof *v->ids : 1));
    fwrite(length, 1, sizeof length, to);
}

static void write_vti_header(FILE *to, const voxels *v)
{
    fputs("<?xml version=\"1.0\"?>\n"
          "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
          to);
    write_image(to, v);
    fputs("  <AppendedData encoding=\"raw\">\n   _", to);
    write_length(to, v);
}

static void write_after(FILE *to) { fputs("\n  </AppendedData>\n</VTKFile>\n", to); }

const volume_writer volume_vti = {.frame = &(const volume_frame){.before = write_vti_header, .after = write_after}};

/* The place of a sample is the middle of its cell. */
static double middle(const voxels *v, int a) { return v->grid.origin[a] + v->grid.cell[a] / 2 + v->shift[a]; }

static void write_vector(FILE *to, double x, double y, double z)
{
    char text[3][DECIMAL_MAX];
    fprintf(to, " (%s,%s,%s)", decimal_of_double(x, text[0]), decimal_of_double(y, text[1]), decimal_of_double(z, text[2]));
}

static void write_nrrd_header(FILE *to, const voxels *v)
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

const volume_writer volume_nrrd = {.frame = &(const volume_frame){.before = write_nrrd_header}};
