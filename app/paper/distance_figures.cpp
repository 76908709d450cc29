#include "app/paper/distance_figures.h"

#include "app/paper/method_figures.h"
#include "app/picture/compose.h"
#include "app/picture/deviation_colours.h"
#include "app/reports/plots/distance_plots.h"
#include "app/reports/validation/validation_page.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <array>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr const char* kOptions = "ramus validate TREE --mask MASK --blend paper --centerline lines --radii plain";
constexpr const char* kHalfVoxel = "half the diagonal of a voxel";

// The surface of the first tree in colours of its distance from another one.
struct Deviation {
    DeviationChoice::From from;
    Held held;
    std::string number; // "08"
    const Stroke& stroke;
};

std::vector<ValidatedDataSet> data_sets(const std::vector<TreeResults>& results) {
    std::vector<ValidatedDataSet> sets;
    for (const TreeResults& one : results) sets.push_back(one.distances);
    return sets;
}

void colour(render::Frame& frame, const ComparedTree& tree, const SurfaceDistances& distances, const Deviation& what) {
    const std::vector<float>& mm = what.held == Held::kToCones ? tree.to_cones_mm : tree.to_isosurface_mm;
    std::vector<double> values(mm.begin(), mm.end());
    Marks marks;
    marks.deviation.from = what.from;
    marks.comparison.mask = tree.input.mask;
    SurfaceDeviation deviation;
    deviation.most_mm = distances.statistics.max;
    deviation.percentile_99_mm = measure::quantile(values, 0.99);
    show_deviation(frame, marks, &deviation);
    show_claims(frame, tree.input.tree->claims);
    frame.overlays.legend.title = tree.input.tree->claims.worded(frame.overlays.legend.title);
    frame.mesh = std::make_shared<const render::PagedMesh>(tree.surface.paged->with_values(mm));
}

Result<Figure> deviation_figure(Workbench& bench, const Deviation& what, Job& job) {
    constexpr glm::ivec2 kSize(820, 700);
    RAMUS_TRY(tree, bench.first(job));
    RAMUS_TRY(results, bench.results_of_first(job));
    const ValidatedDataSet& set = results->distances;
    const SurfaceDistances& distances = *distances_of(set, what.held);
    const Lengths lengths(set.claims);
    Figure figure{.options = {kOptions}};
    const std::array all{tree->surface.paged};
    const render::Camera camera = camera_on(all, kSize);
    render::Frame whole = frame_of(tree->surface.paged, camera, kSize, "");
    colour(whole, *tree, distances, what);
    const CloseUp place = branching_of(*tree->input.tree);
    render::Frame close = whole;
    close.camera = magnified(camera, place.position, 12.0 * place.radius);
    close.overlays.legend = {};
    Plate plate{.columns = 2, .panels = {{std::move(whole), {}}, {std::move(close), {}}}};
    std::string caption = "The convolution surface of the tree " + tree->input.name + ", whole and at a branching.";
    if (what.held == Held::kToMask) caption += " " + isosurface_text(*tree);
    RAMUS_TRY(picture, bench.picture("figure_" + what.number + ".png", caption, plate, job));
    figure.pictures.push_back(std::move(picture));
    const bool to_mask = what.held == Held::kToMask;
    figure.plots.push_back({"figure_" + what.number + "_histogram.svg",
                            histogram_plot(title_of(what.held), distances.statistics, what.stroke,
                                           to_mask ? set.half_voxel_mm : std::nullopt, kHalfVoxel, lengths.unit())});
    const measure::DeviationStatistics& found = distances.statistics;
    figure.measured = {{"mean distance", found.mean, lengths.unit()}, {"largest distance", found.max, lengths.unit()}};
    if (to_mask && found.above)
        figure.measured.push_back({"vertices below half the diagonal of a voxel", 100.0 - 100.0 * *found.above, "%"});
    return figure;
}

} // namespace

Result<Figure> deviation_from_cones(Workbench& bench, Job& job) {
    return deviation_figure(bench, {DeviationChoice::From::kCones, Held::kToCones, "08", kConesStroke}, job);
}

Result<Figure> deviation_from_isosurface(Workbench& bench, Job& job) {
    return deviation_figure(bench, {DeviationChoice::From::kIsosurface, Held::kToMask, "09", kMaskStroke}, job);
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
    for (const auto& [held, file, paper] :
         {std::tuple{Held::kToCones, "table_1_to_cones.csv", "0.09 mm in the mean, 1.07 mm at most"},
          std::tuple{Held::kToMask, "table_1_to_isosurface.csv", "0.37 mm in the mean, 91.26 % below half a voxel"}}) {
        Table table = distance_table(sets, held);
        const auto sums = static_cast<std::size_t>(
            std::ranges::count_if(table.rows, [](const auto& row) { return !row.front().number; }));
        figure.tables.push_back({file, std::move(table), std::string("The paper, of ten trees: ") + paper + ".", sums});
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
    figure.tables.push_back({"table_3.csv", std::move(table),
                             "Seconds of a clock, on this machine and beside whatever else it did: the only numbers "
                             "here that differ from run to run. Triangles of distances are those whose vertices are "
                             "measured."});
    return figure;
}

} // namespace ramus::app::paper
