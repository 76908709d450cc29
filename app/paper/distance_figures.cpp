#include "app/paper/figures.h"
#include "app/picture/compose.h"
#include "app/picture/deviation_colours.h"
#include "app/reports/plots/distance_plots.h"
#include "app/reports/validation/validation_page.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr const char* kOptions = "ramus validate TREE --mask MASK --blend paper --centerline lines --radii plain";
constexpr const char* kHalfVoxel = "half the diagonal of a voxel";

std::vector<ValidatedDataSet> data_sets(const std::vector<TreeResults>& results) {
    std::vector<ValidatedDataSet> sets;
    for (const TreeResults& one : results) sets.push_back(one.distances);
    return sets;
}

// The surface in colours of its distance from the other one.
void colour(render::Frame& frame, const ComparedTree& tree, const SurfaceDistances& distances, Held held) {
    const bool to_cones = held == Held::kToCones;
    const std::vector<float>& mm = to_cones ? tree.to_cones_mm : tree.to_isosurface_mm;
    std::vector<double> values(mm.begin(), mm.end());
    Marks marks;
    marks.deviation.from = to_cones ? DeviationChoice::From::kCones : DeviationChoice::From::kIsosurface;
    marks.comparison.mask = tree.input.mask;
    SurfaceDeviation deviation;
    deviation.most_mm = distances.statistics.max;
    deviation.percentile_99_mm = measure::quantile(values, 0.99);
    show_deviation(frame, marks, &deviation);
    show_claims(frame, tree.input.tree->claims);
    frame.overlays.legend.subtitle.clear(); // the panel's caption says it
    frame.overlays.legend.title = tree.input.tree->claims.worded(frame.overlays.legend.title);
    frame.appearance.depth_cue = 0.0F; // would change colours that mean distances
    frame.mesh = std::make_shared<const render::PagedMesh>(tree.surface.paged->with_values(mm));
}

Result<Figure> deviation_figure(Workbench& bench, Held held, const std::string& file, Job& job) {
    constexpr glm::ivec2 kSize(860, 560);
    const bool to_cones = held == Held::kToCones;
    RAMUS_TRY(tree, bench.first(job));
    RAMUS_TRY(results, bench.results_of_first(job));
    const ValidatedDataSet& set = results->distances;
    const SurfaceDistances& distances = *distances_of(set, held);
    const Lengths lengths(set.claims);
    const measure::DeviationStatistics& found = distances.statistics;
    Figure figure{
        .options = {kOptions},
        .measured = {{"mean distance", found.mean, lengths.unit()}, {"largest distance", found.max, lengths.unit()}}};
    if (!to_cones && found.above)
        figure.measured.push_back({"vertices below half the diagonal of a voxel", 100.0 - 100.0 * *found.above, "%"});
    figure.plots.push_back({file + "_histogram.svg",
                            histogram_plot(title_of(held), found, to_cones ? kConesStroke : kMaskStroke,
                                           to_cones ? std::nullopt : set.half_voxel_mm, kHalfVoxel, lengths.unit())});
    const render::Camera camera = camera_on({tree->surface.paged}, kSize, {.left = 0.2});
    render::Frame whole = frame_of(tree->surface.paged, camera, kSize,
                                   std::string("Deviation from ") + (to_cones ? "truncated cones" : "the isosurface"));
    colour(whole, *tree, distances, held);
    const CloseUp place = branching_of(*tree->input.tree);
    render::Frame close = whole;
    close.camera = magnified(camera, place.position, 9.0 * place.radius);
    close.overlays.caption = "At a branching";
    close.overlays.legend = {};
    return bench.with_picture(std::move(figure), file + ".png",
                              "The convolution surface of the tree " + tree->input.name +
                                  ", whole and at a branching." + (to_cones ? "" : " " + isosurface_text(*tree)),
                              {.columns = 2, .panels = {{std::move(whole), {}, 1}, {std::move(close)}}}, job);
}

} // namespace

Result<Figure> deviation_from_cones(Workbench& bench, Job& job) {
    return deviation_figure(bench, Held::kToCones, "figure_08", job);
}

Result<Figure> deviation_from_isosurface(Workbench& bench, Job& job) {
    return deviation_figure(bench, Held::kToMask, "figure_09", job);
}

Result<Figure> box_plots_of_trees(Workbench& bench, Job& job) {
    RAMUS_TRY(results, bench.all(job));
    const std::vector<ValidatedDataSet> sets = data_sets(*results);
    Figure figure{.options = {kOptions}};
    figure.plots.push_back({"figure_10_to_cones.svg", boxes_of(sets, Held::kToCones)});
    figure.plots.push_back({"figure_10_to_isosurface.svg", boxes_of(sets, Held::kToMask)});
    return figure;
}

Result<Figure> table_of_distances(Workbench& bench, Job& job) {
    RAMUS_TRY(results, bench.all(job));
    const std::vector<ValidatedDataSet> sets = data_sets(*results);
    Figure figure{.options = {kOptions}};
    for (const auto& [held, file] :
         {std::pair{Held::kToCones, "table_1_to_cones.csv"}, std::pair{Held::kToMask, "table_1_to_isosurface.csv"}}) {
        Table table = distance_table(sets, held);
        const auto sums = static_cast<std::size_t>(
            std::ranges::count_if(table.rows, [](const auto& row) { return !row.front().number; }));
        figure.tables.push_back({file, std::move(table), {}, sums});
    }
    return figure;
}

Result<Figure> table_of_times(Workbench& bench, Job& job) {
    RAMUS_TRY(results, bench.all(job));
    Figure figure{.options = {"--blend paper --centerline lines --detail 16"}};
    Table table{"Times",
                {{"tree", "Tree"},
                 {"points", "Points"},
                 {"branches", "Branches"},
                 {"step", "Step"},
                 {"triangles", "Triangles"},
                 {"seconds", "Seconds"}},
                {}};
    for (const TreeResults& one : *results)
        for (const TreeResults::Step& step : one.steps)
            table.rows.push_back({name_of(one.distances), static_cast<double>(one.points),
                                  static_cast<double>(one.branches), step.name, static_cast<double>(step.triangles),
                                  step.seconds});
    figure.tables.push_back(
        {"table_3.csv", std::move(table),
         "Seconds of a clock on this machine, which may have done other work at the same time: the only "
         "numbers here that differ from run to run. The isosurface includes making the mask or "
         "reading it. Triangles of distances are those whose vertices are measured."});
    return figure;
}

} // namespace ramus::app::paper
