/*
 * volume_frames.c - what stands around dense cells.
 *
 * VTK's images, for ParaView: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
 * Nearly raw raster data, for 3D Slicer: https://teem.sourceforge.net/nrrd/format.html
 */
#include "console/written_number.h"
#include "read/little.h"
#include "volume.h"

enum { TRIPLE_MAX = 3 * DECIMAL_MAX };

static void write_vti_header(FILE *to, const voxels *v)
{
    const char *const name = v->ids ? "id" : v->inside ? "label" : "occupied";
    const char *const range = v->inside ? " RangeMin=\"0\" RangeMax=\"2\"" : " RangeMin=\"0\" RangeMax=\"1\"";
    const uint32_t *const n = v->grid.size;
    const double *const at = v->grid.origin, *const by = v->shift;
    unsigned char length[8]; /* stands before the array */
    char origin[TRIPLE_MAX], cell[TRIPLE_MAX];
    fprintf(to,
            "<?xml version=\"1.0\"?>\n"
            "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
            "  <ImageData WholeExtent=\"0 %u 0 %u 0 %u\" Origin=\"%s\" Spacing=\"%s\">\n"
            "    <Piece Extent=\"0 %u 0 %u 0 %u\">\n"
            "      <CellData Scalars=\"%s\">\n"
            "        <DataArray type=\"%s\" Name=\"%s\" format=\"appended\"%s offset=\"0\"/>\n"
            "      </CellData>\n"
            "    </Piece>\n"
            "  </ImageData>\n"
            "  <AppendedData encoding=\"raw\">\n   _",
            n[0], n[1], n[2], decimals_of((const double[]){at[0] + by[0], at[1] + by[1], at[2] + by[2]}, ' ', origin),
            decimals_of(v->grid.cell, ' ', cell), n[0], n[1], n[2], name, v->ids ? "Int32" : "UInt8", name, v->ids ? "" : range);
    little_put64(length, (uint64_t)n[0] * n[1] * n[2] * (v->ids ? sizeof *v->ids : 1));
    fwrite(length, 1, sizeof length, to);
}

static void write_vti_end(FILE *to) { fputs("\n  </AppendedData>\n</VTKFile>\n", to); }

const volume_writer volume_vti = {.write_all = dense_write,
                                  .frame = &(const volume_frame){.before = write_vti_header, .after = write_vti_end}};

static void write_nrrd_header(FILE *to, const voxels *v)
{
    const uint32_t *const n = v->grid.size;
    const double *const c = v->grid.cell;
    const char *const more = v->ids ? ": the number of the lowest triangle, else -1" : ": 1, and that it encloses: 2";
    double middle[3]; /* of the first cell, the place of its sample */
    char x[TRIPLE_MAX], y[TRIPLE_MAX], z[TRIPLE_MAX], origin[TRIPLE_MAX];
    for (int a = 0; a < 3; a++)
        middle[a] = v->grid.origin[a] + c[a] / 2 + v->shift[a];
    fprintf(to,
            "NRRD0004\n"
            "# cells of a grid that a mesh overlaps%s, by tribox\n"
            "%s\n"
            "dimension: 3\n"
            "space dimension: 3\n"
            "sizes: %u %u %u\n"
            "space directions: (%s) (%s) (%s)\n"
            "centers: cell cell cell\n"
            "kinds: domain domain domain\n"
            "encoding: raw\n"
            "space origin: (%s)\n\n",
            v->ids || v->inside ? more : "", v->ids ? "type: int32\nendian: little" : "type: uint8", n[0], n[1], n[2],
            decimals_of((const double[]){c[0], 0, 0}, ',', x), decimals_of((const double[]){0, c[1], 0}, ',', y),
            decimals_of((const double[]){0, 0, c[2]}, ',', z), decimals_of(middle, ',', origin));
}

const volume_writer volume_nrrd = {.write_all = dense_write, .frame = &(const volume_frame){.before = write_nrrd_header}};
