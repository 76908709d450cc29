#include "app/paper/workbench.h"

#include "app/workspace/compared_surfaces.h"
#include "core/base/stopwatch.h"
#include "core/measure/deviation/deviation.h"
#include "core/mesh/surface.h"

#include <array>
#include <filesystem>
#include <utility>

namespace ramus::app::paper {

namespace {

struct GrownAs {
    int branches;
    std::uint64_t seed;
};
constexpr std::array<GrownAs, 3> kGrown{{{61, 1}, {121, 2}, {121, 3}}};

std::string name_of(const GrownAs& grown) {
    return "grown, " + std::to_string(grown.branches) + " branches, seed " + std::to_string(grown.seed);
}

Result<InputTree> grown_input(const GrownAs& as, Job& job) {
    tree::GrowOptions options;
    options.branches = as.branches;
    options.seed = as.seed;
    RAMUS_TRY(grown, tree::grow(options, job));
    InputTree input;
    input.name = name_of(as);
    input.tree = std::make_shared<const tree::VesselTree>(tree::vessel_tree_of(std::move(grown)));
    input.grown = options;
    return input;
}

ComparedRequest request_of(const InputTree& input, Compared kind) {
    Marks marks;
    marks.options = paper_options();
    // Comparisons are with the tree as it was read.
    if (kind == Compared::kTruncatedCones) marks.options.smooth_passes = 0;
    marks.comparison.mask = input.mask;
    marks.comparison.mask_units = input.mask_units;
    marks.comparison.labels = input.labels;
    return compared_request(marks, kind);
}

SurfaceDistances distances_of(const ComparedTree& tree, const mesh::TriangleMesh& other,
                              const std::optional<double>& threshold, std::vector<float>& by_vertex) {
    SurfaceDistances found;
    LargeArray<double> distances = measure::deviations(tree.surface.mesh, other);
    by_vertex.assign(distances.begin(), distances.end());
    found.statistics = measure::statistics_of(distances, threshold);
    return found;
}

struct Compared3 {
    ComparedTree tree;
    TreeResults results;
};

Result<Compared3> compare(const InputTree& input, Job& job) {
    Compared3 made;
    made.tree.input = input;
    std::optional<double> diagonal_mm;
    struct Part {
        Compared kind;
        MadeSurface& to;
        const char* name;
    };
    ComparedTree& tree = made.tree;
    const std::array<Part, 3> parts{Part{Compared::kConvolutionSurface, tree.surface, "convolution surface"},
                                    Part{Compared::kTruncatedCones, tree.cones, "truncated cones"},
                                    Part{Compared::kIsosurface, tree.isosurface, "isosurface"}};
    float done = 0.0F;
    for (const auto& [kind, to, name] : parts) {
        Job part(job, done, done + 0.2F);
        done += 0.2F;
        const Stopwatch watch;
        RAMUS_TRY(found, compared_mesh(*input.tree, request_of(input, kind), part));
        to.mesh = std::move(found.mesh);
        to.seconds = watch.seconds();
        to.paged = paged(to.mesh, *input.tree);
        made.results.steps.push_back({name, to.mesh.triangles.size(), to.seconds});
        if (kind != Compared::kIsosurface) continue;
        diagonal_mm = found.voxel_diagonal_mm;
        tree.voxel_mm = found.voxel_mm;
    }
    if (job.cancelled()) return fail("cancelled");
    ValidatedDataSet& set = made.results.distances;
    set.tree = input.name;
    set.mask = input.mask;
    set.claims = input.tree->claims;
    if (diagonal_mm) set.half_voxel_mm = 0.5 * *diagonal_mm;
    const Stopwatch watch;
    set.to_cones = distances_of(tree, tree.cones.mesh, set.half_voxel_mm, tree.to_cones_mm);
    if (job.cancelled()) return fail("cancelled");
    set.to_mask = distances_of(tree, tree.isosurface.mesh, set.half_voxel_mm, tree.to_isosurface_mm);
    made.results.steps.push_back({"distances to both", tree.surface.mesh.triangles.size(), watch.seconds()});
    made.results.points = input.tree->points.size();
    made.results.branches = input.tree->branches.size();
    return made;
}

} // namespace

mesh::SurfaceOptions paper_options(double width) {
    mesh::SurfaceOptions options;
    options.width = width;
    options.blend = mesh::Blend::kPaper;
    options.centerline = tree::Centerline::kLines;
    return options;
}

Result<MadeSurface> made_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options, Job& job) {
    const Stopwatch watch;
    RAMUS_TRY(surface, mesh::make_surface(tree, options, job));
    MadeSurface made{std::move(surface.mesh), nullptr, watch.seconds()};
    made.paged = app::paged(made.mesh, tree);
    return made;
}

Result<void> Workbench::make_artist() {
    if (artist_) return {};
    RAMUS_TRY(made, Artist::create());
    artist_ = std::move(made);
    return {};
}

Result<render::Renderer*> Workbench::renderer() {
    if (auto made = make_artist(); !made) return tl::unexpected(made.error());
    return &artist_->renderer();
}

Result<render::Image> Workbench::draw(const Plate& plate, Job& job) {
    if (auto made = make_artist(); !made) return tl::unexpected(made.error());
    return artist_->draw(plate, job);
}

Result<Picture> Workbench::picture(const std::string& file, const std::string& caption, const Plate& plate, Job& job) {
    RAMUS_TRY(image, draw(plate, job));
    RAMUS_TRY(png, render::encode_png(image));
    return Picture{file, caption, std::move(png)};
}

Result<void> Workbench::grow_inputs(Job& job) {
    if (!inputs_.empty()) return {};
    std::vector<InputTree> inputs;
    for (const GrownAs& as : kGrown) {
        RAMUS_TRY(input, grown_input(as, job));
        inputs.push_back(std::move(input));
    }
    inputs_ = std::move(inputs);
    return {};
}

Result<const ComparedTree*> Workbench::first(Job& job) {
    if (first_) return first_.get();
    if (auto grown = grow_inputs(job); !grown) return tl::unexpected(grown.error());
    RAMUS_TRY(made, compare(inputs_.front(), job));
    first_ = std::make_unique<const ComparedTree>(std::move(made.tree));
    all_.push_back(std::move(made.results));
    return first_.get();
}

Result<const TreeResults*> Workbench::results_of_first(Job& job) {
    if (auto made = first(job); !made) return tl::unexpected(made.error());
    return &all_.front();
}

Result<const std::vector<TreeResults>*> Workbench::all(Job& job) {
    if (auto made = first(job); !made) return tl::unexpected(made.error());
    while (all_.size() < inputs_.size()) {
        RAMUS_TRY(made, compare(inputs_[all_.size()], job));
        all_.push_back(std::move(made.results));
    }
    return &all_;
}

} // namespace ramus::app::paper
