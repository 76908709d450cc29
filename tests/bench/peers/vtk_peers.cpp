#include "brick_fill.h"
#include "core/field/convolution_field.h"
#include "core/mesh/surface_options.h"
#include "peers.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <glm/geometric.hpp>
#include <new>
#include <numbers>
#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkTubeFilter.h>

namespace ramus::peers {
namespace {

Made made_of(vtkSmartPointer<vtkPolyData> mesh) {
    Made made;
    made.triangles = static_cast<std::uint64_t>(mesh->GetNumberOfPolys());
    made.plain = [mesh] {
        PlainMesh plain;
        const vtkIdType points = mesh->GetNumberOfPoints();
        plain.positions.resize(static_cast<std::size_t>(points));
        for (vtkIdType n = 0; n < points; ++n) {
            double p[3];
            mesh->GetPoint(n, p);
            plain.positions[static_cast<std::size_t>(n)] = glm::vec3(glm::dvec3(p[0], p[1], p[2]));
        }
        vtkCellArray* polys = mesh->GetPolys();
        vtkNew<vtkIdList> corners;
        plain.triangles.reserve(static_cast<std::size_t>(polys->GetNumberOfCells()));
        for (vtkIdType n = 0; n < polys->GetNumberOfCells(); ++n) {
            polys->GetCellAtId(n, corners);
            plain.triangles.emplace_back(corners->GetId(0), corners->GetId(1), corners->GetId(2));
        }
        return plain;
    };
    return made;
}

} // namespace

int tube_sides(const Scene& scene) {
    const tree::VesselTree& tree = scene.prepared.tree;
    double length = 0.0, weighted = 0.0;
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 1; i < branch.points.size(); ++i) {
            const tree::Point& from = tree.points[branch.points[i - 1]];
            const tree::Point& to = tree.points[branch.points[i]];
            const double step = glm::distance(from.position, to.position);
            length += step, weighted += 0.5 * step * (from.radius + to.radius);
        }
    const double around = 2.0 * std::numbers::pi * weighted / length;
    return std::max(8, static_cast<int>(std::lround(around / scene.cell_mm)));
}

Made vtk_tubes(const Scene& scene) {
    const tree::VesselTree& tree = scene.prepared.tree;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkDoubleArray> radii;
    radii->SetName("radius");
    for (const tree::Point& point : tree.points) {
        points->InsertNextPoint(point.position.x, point.position.y, point.position.z);
        radii->InsertNextValue(point.radius);
    }
    vtkNew<vtkCellArray> lines;
    std::vector<vtkIdType> line;
    for (const tree::Branch& branch : tree.branches) {
        line.clear();
        // The filter gives up on a whole line that has two points in one place.
        for (const std::uint32_t n : branch.points)
            if (line.empty() || tree.points[n].position != tree.points[static_cast<std::size_t>(line.back())].position)
                line.push_back(n);
        if (line.size() > 1) lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
    }
    vtkNew<vtkPolyData> centerlines;
    centerlines->SetPoints(points);
    centerlines->SetLines(lines);
    centerlines->GetPointData()->SetScalars(radii);

    vtkNew<vtkTubeFilter> tubes;
    tubes->SetInputData(centerlines);
    tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
    tubes->SetNumberOfSides(tube_sides(scene));
    tubes->CappingOn();
    vtkNew<vtkTriangleFilter> triangles; // tubes are strips
    triangles->SetInputConnection(tubes->GetOutputPort());
    triangles->PassVertsOff();
    triangles->PassLinesOff();
    triangles->Update();
    return made_of(triangles->GetOutput());
}

Made vtk_flying_edges(const Scene& scene) {
    const field::ConvolutionField field(scene.prepared, mesh::SurfaceOptions().width);
    const BrickGrid grid = brick_grid(field, scene.cell_mm);
    const glm::ivec3 size = grid.points();
    const auto row = static_cast<std::size_t>(size.x);
    const std::size_t sheet = row * static_cast<std::size_t>(size.y);
    const std::size_t count = sheet * static_cast<std::size_t>(size.z);

    // A value and the filter's note on one edge for each point.
    const double needed = static_cast<double>(count) * (sizeof(float) + 1.0);
    const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
    if (needed > 0.4 * memory) {
        char text[64];
        std::snprintf(text, sizeof text, "needs %.1f GiB", needed / static_cast<double>(std::size_t{1} << 30));
        Made none;
        none.refusal = text;
        return none;
    }

    const auto start = std::chrono::steady_clock::now();
    // Memory that is zero without being written: most of the box is far from every vessel.
    auto* values = static_cast<float*>(std::calloc(count, sizeof(float)));
    if (values == nullptr) throw std::bad_alloc();
    fill_bricks(field, grid, [&](glm::ivec3 brick, const field::GridGroups& samples) {
        const glm::ivec3 first = kBrickPoints * brick;
        float* to = values + static_cast<std::size_t>(first.z) * sheet + static_cast<std::size_t>(first.y) * row +
                    static_cast<std::size_t>(first.x);
        for (std::size_t z = 0; z < kBrickPoints; ++z)
            for (std::size_t y = 0; y < kBrickPoints; ++y)
                std::memcpy(to + z * sheet + y * row, &samples.value[z][kBrickPoints * y],
                            kBrickPoints * sizeof(float));
    });
    const double fill_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    // Debian builds VTK with TBB, so the process-wide limit on threads holds for the filter too.
    vtkNew<vtkFloatArray> scalars;
    scalars->SetArray(values, static_cast<vtkIdType>(count), 0, vtkFloatArray::VTK_DATA_ARRAY_FREE);
    vtkNew<vtkImageData> image;
    image->SetDimensions(size.x, size.y, size.z);
    image->SetOrigin(grid.origin.x, grid.origin.y, grid.origin.z);
    image->SetSpacing(grid.cell_mm, grid.cell_mm, grid.cell_mm);
    image->GetPointData()->SetScalars(scalars);
    vtkNew<vtkFlyingEdges3D> edges;
    edges->SetInputData(image);
    edges->SetValue(0, field.kernel().isovalue);
    edges->ComputeNormalsOff();
    edges->ComputeGradientsOff();
    edges->ComputeScalarsOff();
    edges->Update();
    Made made = made_of(edges->GetOutput());
    made.fill_s = fill_s;
    return made;
}

} // namespace ramus::peers
