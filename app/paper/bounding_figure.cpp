#include "app/paper/bounding_volumes.h"
#include "app/paper/exact_trees.h"
#include "app/paper/figures.h"
#include "app/reports/plots/axis.h"
#include "app/session/numbers.h"
#include "core/field/kernels/gaussian.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr double kBoundRadius = 2.0, kGridCell = 1.0; // mm
constexpr glm::ivec2 kBoundPanel(540, 420);

constexpr std::array kColours{glm::vec3(0.34F, 0.71F, 0.92F), glm::vec3(0.0F, 0.62F, 0.45F),
                              glm::vec3(0.90F, 0.62F, 0.0F)}; // of segments; M. Okabe and K. Ito, 2008

// The smooth step by which ramus multiplies the kernel; `rho`: the squared distance in (r / sqrt(w))^2.
double fade_at(double rho) {
    const double c = std::clamp((field::kFadeEnd - rho) / (field::kFadeEnd - field::kFadeBegin), 0.0, 1.0);
    return c * c * (3.0 - 2.0 * c);
}

// What a vessel adds to the field across it, in percent of the isovalue, where a bounding volume may cut it.
Svg fade_plot() {
    constexpr double kWidth = 440.0, kHeight = 260.0, kFrom = 1.35, kTo = 1.75, kStep = 0.0025;
    constexpr const char* kTitle = "What a long vessel adds at a distance from its axis";
    const field::Kernel kernel = field::gaussian(5.0);
    Svg svg(kWidth, kHeight, kTitle);
    svg.text({14.0, 16.0}, kTitle, Anchor::kStart, 12.0);
    const PlotArea area{70.0, 28.0, kWidth - 14.0, kHeight - 72.0, linear_axis(kFrom, kTo), linear_axis(0.0, 6.0)};
    draw_y_axis(svg, area, "% of the isovalue");
    draw_x_axis(svg, area, "Distance, radii");
    const double w = kernel.width * std::log(2.0);
    std::vector<PlotPoint> plain, cut, fading;
    for (double x = kFrom; x <= kTo; x += kStep) {
        const double whole = 100.0 * std::exp(-w * x * x) / kernel.isovalue;
        plain.push_back({area.at_x(x), area.at_y(whole)});
        cut.push_back({area.at_x(x), area.at_y(x <= kPaperReach ? whole : 0.0)});
        fading.push_back({area.at_x(x), area.at_y(whole * fade_at(w * x * x))});
    }
    constexpr Stroke kPlain{"#5b6570", 1.2, "2 2"};
    svg.polyline(fading, kSurfaceStroke);
    svg.polyline(cut, kConesStroke);
    svg.polyline(plain, kPlain);
    draw_legend(
        svg, {14.0, kHeight - 22.0}, kWidth - 14.0,
        {{"without bounds", kPlain}, {"cut at 1.5 radii (paper)", kConesStroke}, {"fading (ramus)", kSurfaceStroke}});
    return svg;
}

render::Frame framed(const MadeSurface& vessel, const render::Camera& camera, const std::string& caption) {
    render::Frame frame = frame_of(vessel.paged, camera, kBoundPanel, caption);
    frame.appearance.depth_cue = 0.0F;
    return frame;
}

} // namespace

Result<Figure> bounding_volumes(Workbench& bench, Job& job) {
    Figure figure{.options = {"segments of radius 2 mm, cells of 1 mm, width 5"}};
    const tree::VesselTree tree = aslant_branching(kBoundRadius);
    const std::vector<RoundSegment> segments = segments_of(tree);
    RAMUS_TRY(vessel, made_surface(tree, paper_options(), job));
    render::Camera camera = camera_on({vessel.paged}, kBoundPanel, {.azimuth = -28.0, .elevation = 22.0});
    camera.scale *= 1.2; // the volumes reach farther
    Plate plate{.columns = bounds_of_segments().size()};
    std::vector<Panel> cut;
    double unbounded = 0.0;
    Table table{
        "Cells that each volume covers",
        {{"volume", "Volume"}, {"cells", "Cells"}, {"evaluations", "Evaluations"}, {"unbounded", "Without bounds"}},
        {}};
    for (const BoundRow& row : bounds_of_segments()) {
        const CoveredCells covered = covered_cells(row, segments, kGridCell);
        render::Frame shapes =
            framed(vessel, camera, std::string(row.name) + ", " + rounded(row.reach_radii) + " radii");
        double volume = 0.0;
        for (std::size_t i = 0; i < segments.size(); ++i) {
            auto shape = std::make_shared<const mesh::TriangleMesh>(shape_of(row, segments[i]));
            shapes.context.push_back({std::move(shape), nullptr, kColours[i % kColours.size()], 0.28F});
            volume += volume_mm3(row, segments[i]);
        }
        plate.panels.push_back({std::move(shapes), {}});
        std::vector<glm::ivec3> behind;
        std::ranges::copy_if(covered.cells, std::back_inserter(behind),
                             [](const glm::ivec3& cell) { return cell.y < 0; });
        render::Frame cubes = framed(
            vessel, camera, grouped(covered.cells.size()) + " cells, " + grouped(covered.evaluations) + " evaluations");
        cubes.context.push_back({std::make_shared<const mesh::TriangleMesh>(cubes_of(behind, kGridCell)), nullptr,
                                 glm::vec3(0.66F, 0.74F, 0.83F), 1.0F});
        cut.push_back({std::move(cubes), {}});
        const double by_volume = volume / (kGridCell * kGridCell * kGridCell);
        const auto evaluations = static_cast<double>(covered.evaluations);
        if (row.bound == Bound::kBox) unbounded = static_cast<double>(covered.cells.size() * segments.size());
        table.rows.push_back(
            {std::string(row.name), static_cast<double>(covered.cells.size()), evaluations, unbounded});
        figure.measured.push_back({"evaluations, " + std::string(row.name), evaluations, "", by_volume});
    }
    plate.panels.insert(plate.panels.end(), std::make_move_iterator(cut.begin()), std::make_move_iterator(cut.end()));
    figure.plots.push_back({"figure_04_fade.svg", fade_plot()});
    figure.tables.push_back({"figure_04_cells.csv", std::move(table),
                             "A cell is evaluated once for each segment whose volume covers its centre; the closed "
                             "form above is the volumes over that of a cell. Without bounds: every segment in every "
                             "cell of the boxes."});
    return bench.with_picture(std::move(figure), "figure_04.png",
                              "Above the volumes, one for each segment; below the cells whose centre some volume "
                              "covers, cut open in the plane of the vessels.",
                              plate, job);
}

} // namespace ramus::app::paper
