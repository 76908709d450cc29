#include "app/commands/validate_data_set.h"

#include "app/commands/inputs.h"
#include "app/commands/progress.h"
#include "app/session/error_context.h"
#include "app/session/numbers.h"
#include "app/workspace/compared_surfaces.h"
#include "core/field/kernel.h"
#include "core/io/checksum.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/volume_file.h"
#include "core/measure/deviation/deviation.h"
#include "core/mesh/close_mesh.h"
#include "core/mesh/tree_field.h"
#include "core/validate/free_ends.h"
#include "core/validate/overlap.h"
#include "core/validate/worst_radii.h"

#include <iostream>
#include <optional>
#include <span>
#include <utility>

namespace ramus::app {

namespace {

constexpr std::size_t kFarthest = 8; // places in a report

Result<mesh::TriangleMesh> surface_to_validate(const ValidateFlags& flags, std::size_t n,
                                               const tree::VesselTree& tree) {
    const std::string file = flags.mesh(n);
    if (!file.empty() && !io::is_mesh(file) && io::is_volume(file))
        return fail("this is a mask, not a surface", file, "give it to --mask, which takes its isosurface");
    RAMUS_TRY(loaded, file.empty() ? with_file(surface_of_tree(tree, flags.surface), flags.trees[n])
                                   : with_file(load_mesh(file, flags.mesh_axes), file));
    if (loaded.mesh.triangles.empty()) return fail("there is no surface in it", file.empty() ? flags.trees[n] : file);
    warn_of_stated_axes(file, loaded, flags.mesh_axes);
    if (loaded.is_mesh)
        warn_of_half_turn(file, loaded, {render::bounds_of(tree), tree.claims.orientation},
                          other_axes_option(flags.mesh_axes));
    return std::move(loaded.mesh);
}

validate::ValidationOptions validation_options(const ValidateFlags& flags) {
    const mesh::SurfaceOptions& options = flags.surface.surface;
    return {mesh::kernel_of(options).limits, options.threads};
}

// The statistics without free ends of vessels; nothing if the surface does not know its branches.
std::optional<measure::DeviationStatistics>
but_for_ends(const mesh::TriangleMesh& surface, std::span<const double> distances, const validate::FreeEnds& ends) {
    if (surface.branches.size() != distances.size()) return {};
    std::vector<double> others;
    for (std::size_t v = 0; v < distances.size(); ++v)
        if (!ends.beyond(surface.branches[v], glm::dvec3(surface.positions[v]))) others.push_back(distances[v]);
    if (others.empty()) return {};
    return measure::statistics_of(others, std::nullopt);
}

// Compares one surface with others.
class Comparing {
public:
    Comparing(const ValidateFlags& flags, const mesh::TriangleMesh& surface, ValidatedDataSet& set, bool for_report)
        : flags_(flags), surface_(surface), set_(set), for_report_(for_report) {}

    // `by_vertex`: receives the distances (mm) for pictures, if there is a report.
    [[nodiscard]] Result<SurfaceDistances> distances_to(const mesh::TriangleMesh& other, std::vector<float>& by_vertex,
                                                        const validate::FreeEnds* ends = nullptr) const {
        return with_progress("distances", [&](Job&) -> Result<SurfaceDistances> {
            SurfaceDistances found;
            LargeArray<double> distances = measure::deviations(surface_, other, flags_.surface.surface.threads);
            if (for_report_) by_vertex.assign(distances.begin(), distances.end());
            note_farthest(surface_, distances, found);
            if (ends != nullptr) found.but_for_ends = but_for_ends(surface_, distances, *ends);
            found.statistics = measure::statistics_of(distances, set_.half_voxel_mm);
            return found;
        });
    }
    [[nodiscard]] Result<SurfaceDistances> distances_from(const mesh::TriangleMesh& other) const {
        return with_progress("distances", [&](Job&) -> Result<SurfaceDistances> {
            SurfaceDistances found;
            LargeArray<double> distances = measure::deviations(other, surface_, flags_.surface.surface.threads);
            note_farthest(other, distances, found);
            found.statistics = measure::statistics_of(distances, set_.half_voxel_mm);
            return found;
        });
    }
    [[nodiscard]] Result<Volumes> volumes_with(const MaskVoxels& voxels) const {
        return with_progress("volumes", [&](Job& job) -> Result<Volumes> {
            RAMUS_TRY(overlap, validate::overlap_of(surface_, voxels.inside, voxels.to_patient, job));
            return Volumes{measure::size_of(surface_).volume_mm3, static_cast<double>(overlap.mask) * overlap.voxel_mm3,
                           overlap.dice()};
        });
    }
    [[nodiscard]] Result<std::vector<double>> radii_in(const mesh::TriangleMesh& other) const {
        if (!for_report_) return std::vector<double>();
        return with_progress("radii", [&](Job& job) {
            return validate::radii_in(other, set_.validation.radii, validation_options(flags_), job);
        });
    }

private:
    // Lists the vertices of `from` with the largest distances, if there is a report.
    void note_farthest(const mesh::TriangleMesh& from, std::span<const double> distances,
                       SurfaceDistances& found) const {
        if (!for_report_) return;
        for (const std::size_t vertex : measure::farthest_vertices(from, distances, kFarthest)) {
            const glm::dvec3 at(from.positions[vertex]);
            const validate::RadiusPlace* place = validate::nearest_place(set_.validation, at);
            found.farthest.push_back({at, distances[vertex], place != nullptr ? place->branch : 0});
        }
    }

    const ValidateFlags& flags_;
    const mesh::TriangleMesh& surface_;
    ValidatedDataSet& set_;
    bool for_report_;
};

Result<std::vector<InputFile>> checksums_of(const ValidatedDataSet& set) {
    return with_progress("checksums", [&](Job& job) -> Result<std::vector<InputFile>> {
        std::vector<InputFile> files;
        for (const auto& [role, path] :
             {std::pair{"tree", set.tree}, std::pair{"surface", set.surface}, std::pair{"mask", set.mask}}) {
            std::error_code error;
            if (path.empty() || job.cancelled()) continue;
            std::vector<std::filesystem::path> read = io::files_read_with(path);
            if (std::filesystem::is_directory(path, error)) read = {path};
            for (const std::filesystem::path& file : read) {
                RAMUS_TRY(sum, io::sha256_of(file));
                files.push_back({role, io::input_name(file), std::move(sum)});
            }
        }
        return files;
    });
}

// Warns if the mask is elsewhere: distances from a mask of other vessels, in another unit or in other axes are
// meaningless.
void warn_if_elsewhere(const ValidatedDataSet& set, bool apart) {
    std::vector<double> radii;
    for (const validate::RadiusPlace& place : set.validation.radii) radii.push_back(place.input_mm);
    const double distance = set.to_mask->statistics.box.median;
    if (!apart && (radii.empty() || distance <= measure::quantile(radii, 0.5))) return;
    std::cerr << "ramus: " << io::input_name(set.mask)
              << ": the mask does not lie where the vessels do: half of the surface is "
              << Lengths(set.claims).text(distance)
              << " or more from it; check that it is the tree's, and its unit (--mask-units)\n";
}

} // namespace

std::vector<std::string> ValidateFlags::files(std::size_t n) const {
    std::vector<std::string> all{trees[n]};
    for (const std::string& file : {mask(n), mesh(n)})
        if (!file.empty()) all.push_back(file);
    return all;
}

void check_one_for_each(const std::string& option, std::size_t count, std::size_t trees) {
    if (count == 0 || count == trees) return;
    throw CLI::ValidationError(option, "is given " + counted(count, "time", "times") + " for " +
                                           counted(trees, "tree", "trees") +
                                           "; give one for each tree, in the same order, or none");
}

Result<std::vector<tree::VesselTree>> read_all(const ValidateFlags& flags) {
    std::vector<tree::VesselTree> trees;
    for (const std::string& file : flags.trees) {
        RAMUS_TRY(tree, load_tree(file, flags.surface));
        trees.push_back(std::move(tree));
    }
    if (flags.count() == 1) return trees; // a bad mask costs no other results
    SurfaceFlags silent = flags.surface;  // assumptions are printed when the files are used
    silent.verbose = false;
    for (const std::string& file : flags.masks)
        if (auto mask = load_volume(file, with_units(silent, flags.labels)); !mask) return tl::unexpected(mask.error());
    for (const std::string& file : flags.meshes)
        if (auto mesh = with_file(io::read_mesh(file, io::Holes::kAllowed), file); !mesh)
            return tl::unexpected(mesh.error());
    return trees;
}

Result<ValidatedDataSet> validated(const ValidateFlags& flags, std::size_t n, const tree::VesselTree& tree,
                                   ValidationPainter* painter) {
    ValidatedDataSet set;
    set.claims = tree.claims;
    set.tree = flags.trees[n];
    set.mask = flags.mask(n);
    set.surface = flags.mesh(n);
    RAMUS_TRY(surface, surface_to_validate(flags, n, tree));
    RAMUS_TRY(validation, with_progress("validation", [&](Job& job) {
                  return validate::validate(tree, surface, validation_options(flags), job);
              }));
    set.validation = std::move(validation);
    const bool closed = set.surface.empty() ? flags.surface.surface.method == mesh::Method::kConvolutionSurface
                                            : mesh::check_closed(surface, set.surface).has_value();
    if (closed) set.validation.shape = validate::shape_of(tree, surface);
    std::vector<float> to_cones_mm, to_mask_mm;
    const Comparing comparing(flags, surface, set, painter != nullptr);
    if (!set.mask.empty()) { // first: half its voxel diagonal is the threshold of both comparisons
        MaskVoxels voxels;
        RAMUS_TRY(mask, surface_of_mask(set.mask, flags.surface, flags.labels, &voxels));
        set.half_voxel_mm = mask.half_voxel_mm;
        RAMUS_TRY(distances, comparing.distances_to(mask.mesh, to_mask_mm));
        RAMUS_TRY(radii, comparing.radii_in(mask.mesh));
        set.to_mask = std::move(distances);
        RAMUS_TRY(back, comparing.distances_from(mask.mesh));
        set.from_mask = std::move(back);
        RAMUS_TRY(volumes, comparing.volumes_with(voxels));
        set.volumes = volumes;
        warn_if_elsewhere(set, lies_elsewhere(mask.mesh, tree));
        set.mask_radii_mm = std::move(radii);
    }
    {
        SurfaceFlags of_cones = flags.surface;
        of_cones.surface.method = mesh::Method::kTruncatedCones;
        of_cones.surface.smooth_passes = 0; // of the tree without smoothing
        RAMUS_TRY(cones, surface_of_tree(tree, of_cones));
        const validate::FreeEnds ends(tree);
        const validate::FreeEnds* const known =
            set.surface.empty() ? &ends : nullptr; // branches of a given surface are not known
        RAMUS_TRY(distances, comparing.distances_to(cones.mesh, to_cones_mm, known));
        RAMUS_TRY(radii, comparing.radii_in(cones.mesh));
        set.to_cones = std::move(distances);
        set.cones_radii_mm = std::move(radii);
    }
    if (painter == nullptr) return set;
    RAMUS_TRY(files, checksums_of(set));
    set.files = std::move(files);
    const PaintedSurface painted{std::move(surface), tree, flags.surface.surface, std::move(to_cones_mm),
                                 std::move(to_mask_mm)};
    if (auto done = with_progress("pictures", [&](Job&) { return painter->paint(painted, set); }); !done)
        return tl::unexpected(done.error());
    return set;
}

} // namespace ramus::app
