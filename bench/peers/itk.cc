// itk.cc - ITK's solid of a mesh, for peer_itk.py: the cells whose middle is inside.
#include <ctime>
#include <itkImage.h>
#include <itkMesh.h>
#include <itkTriangleCell.h>
#include <itkTriangleMeshToBinaryImageFilter.h>

using mesh = itk::Mesh<double, 3>;
using image = itk::Image<unsigned char, 3>;

static double seconds()
{
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return now.tv_sec + 1e-9 * now.tv_nsec;
}

// Processor time from its own mesh to cells[z][y][x]; middle is that of the first cell. Negative if it throws.
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
