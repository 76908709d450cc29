#include "app/workspace/compared_surfaces.h"

#include "app/session/error_context.h"
#include "core/io/volumes/volume_file.h"
#include "core/mesh/coarse_mesh.h"
#include "core/mesh/surface.h"
#include "core/volume/isosurface.h"
#include "core/volume/voxelise.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app {

namespace {

constexpr int kWireDetail = 10; // triangles around a vessel; more lines would merge (tuned by eye)

// Numbers of triangles that a software rasteriser draws fluently, and too slowly.
constexpr std::size_t kFluent = 60'000, kManyTriangles = 150'000;

void take_lines(mesh::TriangleMesh mesh, ComparedSurface& made) {
    if (mesh.triangles.size() > kManyTriangles)
        made.lines_preview = std::make_shared<const mesh::TriangleMesh>(mesh::coarse_mesh(mesh, kFluent));
    made.lines = std::make_shared<const mesh::TriangleMesh>(std::move(mesh));
}

// For voxelizing: branch ids differ from those of the input.
template <class Flags> tree::VesselTree without(tree::VesselTree tree, const Flags& hidden) {
    if (hidden.empty()) return tree;
    std::size_t kept = 0;
    for (std::size_t b = 0; b < tree.branches.size(); ++b)
        if (hidden[b] == 0) tree.branches[kept++] = tree.branches[b];
    tree.branches.resize(kept);
    return tree;
}

Result<mesh::TriangleMesh> isosurface_of(const tree::VesselTree& tree, const ComparedRequest& request,
                                         ComparedMesh& made, Job& job) {
    const volume::IsosurfaceOptions options{static_cast<double>(request.surface.options.memory_bytes),
                                            request.surface.options.threads};
    if (request.mask.empty()) {
        made.voxel_mm = request.voxel_mm > 0.0 ? request.voxel_mm : volume::sensible_voxel_mm(tree);
        const auto hidden = hidden_flags(request.surface.hidden, tree.branches.size());
        RAMUS_TRY(voxels, volume::voxelised(without(tree, hidden), made.voxel_mm, options.memory_bytes, job));
        made.voxel_diagonal_mm = glm::length(volume::spacing_mm(voxels.to_patient));
        return volume::mask_surface(voxels.mask, voxels.to_patient, options, job);
    }
    RAMUS_TRY(read, io::read_volume(request.mask, {options.memory_bytes, io::length_unit(request.units)}, job));
    made.voxel_diagonal_mm = glm::length(volume::spacing_mm(read.to_patient));
    made.notes = read.notes;
    made.notes.insert(made.notes.end(), read.suspicions.begin(), read.suspicions.end());
    return with_file(volume::isosurface(std::move(read), {request.labels, std::nullopt}, options, job), request.mask);
}

} // namespace

bool lies_elsewhere(const mesh::TriangleMesh& surface, const tree::VesselTree& tree) {
    const render::Box a = render::bounds_of(surface), b = render::bounds_of(tree);
    if (a.empty()) return false;
    return glm::any(glm::lessThan(a.upper, b.lower)) || glm::any(glm::lessThan(b.upper, a.lower));
}

std::vector<ComparedRequest> compared_requests(const Marks& marks) {
    std::vector<ComparedRequest> requests;
    const std::vector<Compared> kinds = compared_surfaces(marks.comparison);
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const bool wire = i > 0 && marks.comparison.mode == Comparison::Mode::kSuperimposed;
        if (!wire && is_own(kinds[i], marks.options)) continue;
        requests.push_back(compared_request(marks, kinds[i]));
        requests.back().wire = wire;
        if (wire) requests.back().surface.options.detail = std::min(marks.options.detail, kWireDetail);
    }
    return requests;
}

ComparedRequest compared_request(const Marks& marks, Compared kind) {
    ComparedRequest request;
    request.kind = kind;
    if (kind == Compared::kIsosurface) {
        request.surface.options.threads = marks.options.threads;
        request.surface.options.memory_bytes = marks.options.memory_bytes;
        request.mask = marks.comparison.mask;
        if (request.mask.empty())
            request.surface.hidden = surface_request(marks).hidden; // a mask's surface has no branches
        else
            request.labels = marks.comparison.labels, request.units = marks.comparison.mask_units;
    } else {
        request.surface = surface_request(marks);
        request.surface.options.method = row_of(kind).method;
        request.surface.options.blend = row_of(kind).blend.value_or(marks.options.blend);
    }
    return request;
}

Result<ComparedMesh> compared_mesh(const tree::VesselTree& tree, const ComparedRequest& request, Job& job) {
    ComparedMesh made;
    const auto hidden = hidden_flags(request.surface.hidden, tree.branches.size());
    if (!hidden.empty() && std::ranges::find(hidden, 0) == hidden.end()) return made;
    if (request.kind == Compared::kIsosurface) {
        RAMUS_TRY(surface, isosurface_of(tree, request, made, job));
        if (lies_elsewhere(surface, tree))
            return fail("this mask lies elsewhere than the tree", request.mask,
                        "give the mask that the tree was made from, or its unit if it is not mm");
        made.mesh = std::move(surface);
        return made;
    }
    RAMUS_TRY(surface, mesh::make_surface(tree, as_drawn(request.surface.options), job, hidden));
    made.mesh = std::move(surface.mesh);
    return made;
}

Result<ComparedSurface> make_compared(const tree::VesselTree& tree, const ComparedRequest& request, Job& job) {
    ComparedSurface made;
    made.request = request;
    if (request.kind != Compared::kIsosurface && !request.wire) {
        RAMUS_TRY(ready, make_ready(tree, request.surface, job));
        made.mesh = std::move(ready.mesh);
        return made;
    }
    RAMUS_TRY(surface, compared_mesh(tree, request, job));
    made.voxel_mm = surface.voxel_mm;
    made.notes = std::move(surface.notes);
    if (request.wire) {
        take_lines(std::move(surface.mesh), made);
        return made;
    }
    if (surface.mesh.triangles.size() > kManyTriangles)
        made.preview = paged(mesh::coarse_mesh(surface.mesh, kFluent), tree);
    made.mesh = paged(surface.mesh, tree);
    return made;
}

void show(ShownSurfaces& shown, const ComparedSurface& surface) {
    if (surface.request.wire)
        shown.lines = surface.lines, shown.lines_preview = surface.lines_preview;
    else
        shown.set(surface.request.kind, surface.mesh, surface.preview);
}

} // namespace ramus::app
