#include "app/assets/shapes.h"

#include "app/session/error_context.h"
#include "core/io/length_unit.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/measure/largest_diameter.h"
#include "core/mesh/coarse_mesh.h"
#include "core/organ/mask_lesions.h"
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

LesionMesh lesion_mesh_of(mesh::TriangleMesh mesh, const tree::Claims& claims) {
    LesionMesh lesion;
    lesion.claims = claims;
    lesion.distance = std::make_shared<const measure::MeshDistance>(mesh);
    lesion.coarse = preview_of(mesh);
    lesion.diameter_mm = measure::largest_diameter(mesh.positions);
    lesion.mesh = std::move(mesh);
    return lesion;
}

Result<LesionFile> read_lesion_mesh(const LesionSource& source) {
    RAMUS_TRY(read, io::read_mesh_file(source.file, {io::Holes::kRefused, io::slicer_space(source.axes)}));
    return LesionFile{
        {std::make_shared<const LesionMesh>(lesion_mesh_of(std::move(read.mesh), {tree::SaidBy::kNobody, read.axes}))}};
}

Result<LesionFile> read_lesion_mask(const LesionSource& source, Job& job) {
    const auto unit = io::length_unit(source.units);
    RAMUS_TRY(volume, io::read_volume(source.file, {0.0, unit}, job));
    RAMUS_TRY(found, with_file(organ::mask_lesions(volume, source.labels, kMostLesionParts, JobRange(job, 0.5F, 1.0F)),
                               source.file));
    LesionFile file{{}, found.more, volume.suspicions.empty() ? std::string() : volume.suspicions.front()};
    for (organ::MaskLesion& one : found.lesions) {
        LesionMesh lesion = lesion_mesh_of(std::move(one.mesh), io::claims_of(volume, unit));
        lesion.volume_mm3 = one.volume_mm3;
        lesion.voxels = std::move(one.solid);
        lesion.name = std::move(one.name);
        file.parts.push_back(std::make_shared<const LesionMesh>(std::move(lesion)));
    }
    return file;
}

} // namespace

Loaded<LesionFile> read_lesion_file(const LesionSource& source, const Loaded<LesionFile>* before, Job& job) {
    auto loaded =
        read_if_written(source.file, before, "the lesion", [&]() -> Result<std::shared_ptr<const LesionFile>> {
            try {
                RAMUS_TRY(file, source.mask ? read_lesion_mask(source, job) : read_lesion_mesh(source));
                return std::make_shared<const LesionFile>(std::move(file));
            } catch (const std::bad_alloc&) {
                return fail("there is not enough memory for it", source.file, "give a coarser mask or mesh");
            }
        });
    if (job.cancelled()) loaded.value = fail("cancelled");
    return loaded;
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
