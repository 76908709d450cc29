#include "app/assets/shapes.h"

#include "app/session/error_context.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/mesh/coarse_mesh.h"
#include "core/volume/isosurface.h"

#include <filesystem>
#include <glm/geometric.hpp>
#include <new>

namespace ramus::app {

namespace {

constexpr std::size_t kPreviewFrom = 80'000, kPreview = 40'000; // triangles; tuned on a software rasteriser
constexpr int kSmoothPasses = 6; // of normals; tuned on organs: fewer leave visible steps, more round off edges

void scale(mesh::TriangleMesh& mesh, const glm::dvec3& mm) {
    for (glm::vec3& position : mesh.positions) position = glm::vec3(mm * glm::dvec3(position));
    for (glm::vec3& normal : mesh.normals) normal = glm::normalize(glm::vec3(glm::dvec3(normal) / mm));
}

// Also sets the shape's claims, label and suspicion.
Result<mesh::TriangleMesh> read_surface(const ContextSource& source, ContextShape& shape, Job& job) {
    const auto unit = io::length_unit(source.units);
    if (!io::is_volume(source.file)) {
        if (!source.label.none() || source.isovalue)
            return fail("a mesh has neither labels nor values", source.file,
                        "masks and scans have them: " + io::readable_volume_extensions());
        RAMUS_TRY(read, io::read_mesh_file(source.file, {io::Holes::kAllowed, io::slicer_space(source.axes)}));
        shape.claims = {unit ? tree::SaidBy::kPerson : tree::SaidBy::kNobody, read.axes};
        if (unit) scale(read.mesh, unit->mm);
        return std::move(read.mesh);
    }
    if (!source.axes.empty()) return fail("a mask states its axes itself", source.file, "leave out --mesh-orientation");
    auto volume = io::read_volume(source.file, {0.0, unit}, job);
    if (!volume) return tl::unexpected(volume.error());
    if (!volume->suspicions.empty()) shape.suspicion = volume->suspicions.front();
    shape.claims = io::claims_of(*volume, unit);
    volume::Selection selection;
    selection.isovalue = source.isovalue;
    if (!source.label.none()) {
        selection.labels = {source.label};
        const auto numbers = with_file(volume::label_numbers(*volume, selection.labels), source.file);
        if (!numbers) return tl::unexpected(numbers.error());
        if (const volume::LabelName* name = volume::name_of_label(*volume, numbers->front())) shape.label = *name;
    }
    volume::IsosurfaceOptions options;
    if (!source.exact) options.steps = volume::VoxelSteps::kSmoothed;
    auto surface = with_file(volume::isosurface(std::move(*volume), selection, options, job), source.file);
    if (surface && !source.exact) mesh::smooth_normals(*surface, kSmoothPasses);
    return surface;
}

Result<std::shared_ptr<const ContextShape>> read_shape(const ContextSource& source, Job& job) {
    try {
        ContextShape shape;
        auto mesh = read_surface(source, shape, job);
        if (!mesh) return tl::unexpected(mesh.error());
        shape.preview = preview_of(*mesh);
        shape.box = render::bounds_of(*mesh);
        shape.mesh = std::make_shared<const mesh::TriangleMesh>(std::move(*mesh));
        return std::make_shared<const ContextShape>(std::move(shape));
    } catch (const std::bad_alloc&) {
        return fail("there is not enough memory for it", source.file, "give a coarser mask or mesh");
    }
}

} // namespace

Loaded<LesionMesh> read_lesion_mesh(const std::filesystem::path& file, const std::string& axes,
                                    const Loaded<LesionMesh>* before) {
    if (before != nullptr && before->value && (*before->value)->asked_axes != axes) before = nullptr;
    return read_if_written(file, before, "the lesion", [&]() -> Result<std::shared_ptr<const LesionMesh>> {
        RAMUS_TRY(read, io::read_mesh_file(file, {io::Holes::kRefused, io::slicer_space(axes)}));
        auto distance = std::make_shared<const measure::MeshDistance>(read.mesh);
        auto coarse = preview_of(read.mesh);
        return std::make_shared<const LesionMesh>(
            LesionMesh{std::move(read.mesh), std::move(coarse), axes, read.axes, std::move(distance)});
    });
}

namespace fs = std::filesystem;

Loaded<ContextShape> read_context_shape(const ContextSource& source, const Loaded<ContextShape>* before, Job& job) {
    auto loaded = read_if_written(source.file, before, "the file", [&] { return read_shape(source, job); });
    if (job.cancelled()) loaded.value = fail("cancelled");
    return loaded;
}

std::shared_ptr<const mesh::TriangleMesh> preview_of(const mesh::TriangleMesh& mesh) {
    if (mesh.triangles.size() <= kPreviewFrom) return {};
    return std::make_shared<const mesh::TriangleMesh>(mesh::coarse_mesh(mesh, kPreview));
}

bool can_be_context(const std::string& file) { return io::may_be_mesh(file) || io::is_volume(file); }

std::string context_extensions() {
    std::vector<std::string_view> words = io::readable_extensions(io::volume_formats());
    const auto meshes = io::readable_extensions(io::mesh_formats());
    words.insert(words.end(), meshes.begin(), meshes.end());
    return io::listed(words);
}

} // namespace ramus::app
