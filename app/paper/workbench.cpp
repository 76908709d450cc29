#include "app/paper/workbench.h"

#include "app/workspace/compared_surfaces.h"
#include "core/base/stopwatch.h"
#include "core/measure/deviation/deviation.h"
#include "core/mesh/surface.h"

#include <array>
#include <tuple>
#include <utility>

namespace ramus::app::paper {

namespace {

struct GrownTree {
    const char* letter;
    int branches;
    std::uint64_t seed;
    [[nodiscard]] std::string name() const {
        return std::string(letter) + " (" + std::to_string(branches) + " branches)";
    }
};
constexpr std::array<GrownTree, 3> kGrown{{{"A", 61, 1}, {"B", 121, 2}, {"C", 121, 3}}};

Result<InputTree> grown_input(const GrownTree& row, Job& job) {
    tree::GrowOptions options;
    options.branches = row.branches;
    options.seed = row.seed;
    RAMUS_TRY(grown, tree::grow(options, job));
    InputTree input;
    input.name = row.name();
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

// The three surfaces of a tree; `results` gets distances and times.
Result<ComparedTree> compare(const InputTree& input, TreeResults& results, Job& job) {
    ComparedTree tree;
    tree.input = input;
    ValidatedDataSet& set = results.distances;
    set.tree = input.name;
    set.mask = input.mask;
    set.claims = input.tree->claims;
    results.points = input.tree->points.size();
    results.branches = input.tree->branches.size();
    float done = 0.0F;
    for (const auto& [kind, to, name] :
         {std::tuple{Compared::kConvolutionSurface, &tree.surface, "convolution surface"},
          std::tuple{Compared::kTruncatedCones, &tree.cones, "truncated cones"},
          std::tuple{Compared::kIsosurface, &tree.isosurface, "isosurface"}}) {
        Job part(job, done, done + 0.2F);
        done += 0.2F;
        const Stopwatch watch;
        RAMUS_TRY(found, compared_mesh(*input.tree, request_of(input, kind), part));
        results.steps.push_back({name, found.mesh.triangles.size(), watch.seconds()});
        to->paged = paged(found.mesh, *input.tree);
        to->mesh = std::move(found.mesh);
        if (found.voxel_diagonal_mm) set.half_voxel_mm = 0.5 * *found.voxel_diagonal_mm;
        tree.voxel_mm = found.voxel_mm; // of the last, the isosurface
    }
    if (job.cancelled()) return fail("cancelled");
    const Stopwatch watch;
    set.to_cones = distances_of(tree, tree.cones.mesh, set.half_voxel_mm, tree.to_cones_mm);
    if (job.cancelled()) return fail("cancelled");
    set.to_mask = distances_of(tree, tree.isosurface.mesh, set.half_voxel_mm, tree.to_isosurface_mm);
    results.steps.push_back({"distances to both", tree.surface.mesh.triangles.size(), watch.seconds()});
    return tree;
}

} // namespace

Facts grown_trees() {
    Facts facts{{"Trees", "ramus grow"}};
    for (const GrownTree& row : kGrown)
        facts.emplace_back("Tree " + std::string(row.letter),
                           std::to_string(row.branches) + " branches, seed " + std::to_string(row.seed));
    return facts;
}

mesh::SurfaceOptions paper_options(double width) {
    mesh::SurfaceOptions options;
    options.width = width;
    options.blend = mesh::Blend::kPaper;
    options.centerline = tree::Centerline::kLines;
    return options;
}

Result<MadeSurface> made_surface(const tree::VesselTree& tree, const mesh::SurfaceOptions& options, Job& job) {
    RAMUS_TRY(surface, mesh::make_surface(tree, options, job));
    Paged shown = app::paged(surface.mesh, tree);
    return MadeSurface{std::move(surface.mesh), std::move(shown)};
}

Result<Artist*> Workbench::artist() {
    if (artist_) return artist_.get();
    RAMUS_TRY(made, Artist::create());
    artist_ = std::move(made);
    return artist_.get();
}

Result<Figure> Workbench::with_picture(Figure figure, const std::string& file, const std::string& caption,
                                       const Plate& plate, Job& job) {
    RAMUS_TRY(drawer, artist());
    RAMUS_TRY(image, drawer->draw(plate, job));
    RAMUS_TRY(png, render::encode_png(image));
    figure.pictures.push_back({file, caption, std::move(png)});
    return figure;
}

Result<void> Workbench::grow_inputs(Job& job) {
    if (!inputs_.empty()) return {};
    std::vector<InputTree> inputs;
    for (const GrownTree& row : kGrown) {
        RAMUS_TRY(input, grown_input(row, job));
        inputs.push_back(std::move(input));
    }
    inputs_ = std::move(inputs);
    return {};
}

Result<const ComparedTree*> Workbench::first(Job& job) {
    if (first_) return first_.get();
    if (auto grown = grow_inputs(job); !grown) return tl::unexpected(grown.error());
    TreeResults results;
    RAMUS_TRY(made, compare(inputs_.front(), results, job));
    first_ = std::make_unique<const ComparedTree>(std::move(made));
    all_.push_back(std::move(results));
    return first_.get();
}

Result<const TreeResults*> Workbench::results_of_first(Job& job) {
    if (auto made = first(job); !made) return tl::unexpected(made.error());
    return &all_.front();
}

Result<const std::vector<TreeResults>*> Workbench::all(Job& job) {
    if (auto made = first(job); !made) return tl::unexpected(made.error());
    while (all_.size() < inputs_.size()) {
        TreeResults results;
        if (auto made = compare(inputs_[all_.size()], results, job); !made) return tl::unexpected(made.error());
        all_.push_back(std::move(results));
    }
    return &all_;
}

} // namespace ramus::app::paper
