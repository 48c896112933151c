// peers.cc - peers in C++, for peers.py: NAME_cells returns the processor time to its answer, or a negative number if it fails.
#include <ctime>

static double seconds()
{
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

#ifdef PEER_itk
#include <itkImage.h>
#include <itkMesh.h>
#include <itkTriangleCell.h>
#include <itkTriangleMeshToBinaryImageFilter.h>

using mesh = itk::Mesh<double, 3>;
using image = itk::Image<unsigned char, 3>;

// ITK's solid of a mesh, from its own mesh to cells[z][y][x]: those whose middle is inside; middle is that of the first cell.
extern "C" double itk_cells(const float *vertices, int count, const int *faces, int triangles, const double *middle, double cell,
                            const int *size, unsigned char *cells)
{
    auto from = mesh::New();
    auto filter = itk::TriangleMeshToBinaryImageFilter<mesh, image>::New();
    image::SizeType sizes;
    for (int v = 0; v < count; v++)
        from->SetPoint(v, mesh::PointType(vertices + 3 * v));
    for (int t = 0; t < triangles; t++) {
        mesh::CellAutoPointer one;
        one.TakeOwnership(new itk::TriangleCell<mesh::CellType>);
        for (int v = 0; v < 3; v++)
            one->SetPointId(v, faces[3 * t + v]);
        from->SetCell(t, one);
    }
    for (int a = 0; a < 3; a++)
        sizes[a] = size[a];
    const double begin = seconds();
    filter->SetInput(from);
    filter->SetOrigin(image::PointType(middle));
    filter->SetSpacing(image::SpacingType(cell));
    filter->SetSize(sizes);
    filter->SetInsideValue(1);
    try {
        filter->Update();
    } catch (const std::exception &) {
        return -1;
    }
    const double taken = seconds() - begin;
    std::copy_n(filter->GetOutput()->GetBufferPointer(), long(size[0]) * size[1] * size[2], cells);
    return taken;
}
#endif

#ifdef PEER_recast
#include <recastnavigation/Recast.h>

// Recast's heightfield of spans, columns along y, over rows along x and layers along z; cells[z][y][x] gets those that they hold.
extern "C" double recast_cells(const float *vertices, int count, const int *faces, int triangles, const unsigned char *areas,
                               const float *lo, const float *hi, float cell, const int *size, unsigned char *cells)
{
    rcContext context(false);
    const double begin = seconds();
    rcHeightfield *const field = rcAllocHeightfield();
    const bool is_done = field && rcCreateHeightfield(&context, *field, size[0], size[2], lo, hi, cell, cell) &&
                         rcRasterizeTriangles(&context, vertices, count, faces, areas, triangles, *field);
    const double taken = seconds() - begin;
    for (long column = 0; is_done && column < long(size[0]) * size[2]; column++)
        for (const rcSpan *s = field->spans[column]; s; s = s->next)
            for (unsigned y = s->smin; y < s->smax && y < unsigned(size[1]); y++)
                cells[(column / size[0] * size[1] + y) * size[0] + column % size[0]] = 1;
    rcFreeHeightField(field);
    return is_done ? taken : -1;
}
#endif
