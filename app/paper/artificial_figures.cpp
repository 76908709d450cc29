#include "app/paper/closed_forms.h"
#include "app/paper/exact_trees.h"
#include "app/paper/figures.h"
#include "app/reports/plots/axis.h"
#include "app/session/numbers.h"
#include "core/measure/deviation/packed_triangles.h"
#include "core/mesh/connectivity.h"

#include <array>
#include <utility>

namespace ramus::app::paper {

namespace {

constexpr std::array kWidths{1.0, 5.0};
constexpr int kFine = 96;            // triangles around a vessel: exact to a thousandth of its radius
constexpr double kDistance = 3.0;    // mm, of the paper's vessels side by side
constexpr double kPairLength = 14.0; // mm
constexpr glm::vec3 kRadiusLine{0.05F, 0.35F, 0.65F};

std::string width_text(double width) { return "width " + rounded(width); }

mesh::SurfaceOptions fine(double width) {
    mesh::SurfaceOptions options = paper_options(width);
    options.detail = kFine;
    return options;
}

constexpr const char* kFineOptions =
    "ramus mesh TREE -o MESH --blend paper --centerline lines --smooth 0 --detail 96 --width 1, and --width 5";

struct Joint {
    const char* name;
    std::vector<double> degrees; // of the branches, the stem first
};
const std::array<Joint, 3>& joints() {
    static const std::array<Joint, 3> all{Joint{"Y: three branches", {270.0, 30.0, 150.0}},
                                          Joint{"T: three branches", {270.0, 0.0, 180.0}},
                                          Joint{"Trifurcation: four branches", {270.0, 0.0, 90.0, 180.0}}};
    return all;
}

constexpr double kJointRadius = 2.0, kJointLength = 11.0; // mm

// The joint seen along its plane, with the outline that straight vessels would have.
render::Frame side_view(const Paged& surface) {
    constexpr glm::ivec2 kSize(170, 250);
    render::Camera camera = render::camera_for(surface->positions(), render::View::kLeft, kSize, true);
    camera = magnified(camera, glm::dvec3(0.0), 4.8 * kJointRadius);
    render::Frame frame = frame_of(surface, camera, kSize, "");
    frame.overlays.scale_bar = false;
    const glm::dvec3 before = -1.5 * kJointLength * render::axes_of(camera).forward;
    for (const double side : {-kJointRadius, kJointRadius})
        frame.lines.push_back(
            {{before + glm::dvec3(0.0, side, -kJointLength), before + glm::dvec3(0.0, side, kJointLength)},
             kRadiusLine,
             1.2F});
    return frame;
}

// Whether the surface of a pair is one piece.
Result<bool> merged(double distance_mm, double radius_mm, double width, Job& job) {
    mesh::SurfaceOptions options = fine(width);
    options.detail = 128; // a bridge that begins is thin
    RAMUS_TRY(surface, made_surface(parallel_pair(distance_mm, radius_mm, kPairLength), options, job));
    return mesh::component_count(surface.mesh) == 1;
}

// Merging radii by the closed form as a curve, and as they were found.
Svg merging_plot(const std::vector<std::pair<double, double>>& found) {
    constexpr double kWidth = 440.0, kHeight = 250.0, kMost = 10.0;
    Svg svg(kWidth, kHeight, "Radius at which two parallel vessels 3 mm apart merge");
    svg.text({14.0, 16.0}, "Radius at which two parallel vessels 3 mm apart merge", Anchor::kStart, 12.0);
    const PlotArea area{70.0, 28.0, kWidth - 14.0, kHeight - 58.0, linear_axis(0.0, kMost), linear_axis(0.9, 1.5)};
    draw_y_axis(svg, area, "Radius, mm");
    draw_x_axis(svg, area, "Width coefficient");
    std::vector<PlotPoint> curve;
    for (double width = 1.0; width < kMost + 0.01; width += 0.05)
        curve.push_back({area.at_x(width), area.at_y(merging_radius(kDistance, width))});
    svg.polyline(curve, kSurfaceStroke);
    for (const auto& [width, radius] : found) svg.diamond({area.at_x(width), area.at_y(radius)}, 4.5, kInk);
    draw_legend(svg, {14.0, kHeight - 8.0}, kWidth - 14.0,
                {{"1.5 mm / sqrt(1 + 1 / width); diamonds: found on surfaces", kSurfaceStroke}});
    return svg;
}

} // namespace

double height_over_joint(const mesh::TriangleMesh& mesh) {
    return measure::PackedTriangles(mesh).first_exit(glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0), 0.0).at;
}

Result<double> found_merging_radius(double distance_mm, double width, Job& job) {
    constexpr int kHalvings = 6;
    const double guess = merging_radius(distance_mm, width);
    double apart = 0.97 * guess, one = 1.03 * guess;
    for (int step = 0; step < kHalvings; ++step) {
        const double radius = 0.5 * (apart + one);
        RAMUS_TRY(touch, merged(distance_mm, radius, width, job));
        (touch ? one : apart) = radius;
    }
    return 0.5 * (apart + one);
}

Result<Figure> bulging(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(520, 360);
    Figure figure{.options = {kFineOptions}};
    Plate plate{.columns = joints().size()};
    std::vector<Paged> all;
    for (const double width : kWidths)
        for (const Joint& joint : joints()) {
            RAMUS_TRY(surface, made_surface(star(joint.degrees, kJointRadius, kJointLength), fine(width), job));
            const double height = height_over_joint(surface.mesh) / kJointRadius;
            const std::string name = std::string(joint.name) + ", " + width_text(width);
            figure.measured.push_back({"height over the joint, " + name, height, "radii",
                                       joint_height(static_cast<int>(joint.degrees.size()), width)});
            plate.panels.push_back(
                {frame_of(surface.paged, {}, kSize, name + ": " + digits(height, 4) + " r"), side_view(surface.paged)});
            all.push_back(surface.paged);
        }
    const render::Camera camera = camera_on(all, kSize, {.elevation = 28.0, .right = 0.35});
    for (Panel& panel : plate.panels) panel.frame.camera = camera;
    return bench.with_picture(
        std::move(figure), "figure_01.png",
        "Above width 1, below width 5, with the height of the surface over the joint in radii r. "
        "Insets: the same joint seen along its plane; the blue lines are one radius from the axis.",
        plate, job);
}

Result<Figure> unwanted_blending(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(520, 520), kInset(220, 220);
    constexpr double kRadius = 1.07;
    Figure figure{.options = {std::string(kFineOptions) + "; on the right --blend tree --width 1"}};
    Plate plate{.columns = 3};
    const tree::VesselTree pair = s_shaped_pair(kDistance, kRadius);
    struct Way {
        double width;
        mesh::Blend blend;
        const char* name;
        int pieces; // of the surface
    };
    std::vector<Paged> all;
    for (const Way& way :
         {Way{1.0, mesh::Blend::kPaper, "the plain sum", 1}, Way{5.0, mesh::Blend::kPaper, "the plain sum", 2},
          Way{1.0, mesh::Blend::kTree, "ramus keeps them apart", 2}}) {
        mesh::SurfaceOptions options = fine(way.width);
        options.blend = way.blend;
        RAMUS_TRY(surface, made_surface(pair, options, job));
        figure.measured.push_back({"pieces of the surface, " + width_text(way.width) + ", " + way.name,
                                   static_cast<double>(mesh::component_count(surface.mesh)), "",
                                   static_cast<double>(way.pieces)});
        plate.panels.push_back({frame_of(surface.paged, {}, kSize, "Width " + rounded(way.width) + ", " + way.name),
                                frame_of(surface.paged, {}, kInset, "")});
        all.push_back(surface.paged);
    }
    const render::Camera camera = camera_on(all, kSize, {.right = 0.46});
    for (Panel& panel : plate.panels) {
        panel.frame.camera = camera;
        panel.inset->camera = magnified(camera, {-8.0, 0.0, -8.0}, 7.0);
    }
    return bench.with_picture(std::move(figure), "figure_02.png",
                              "Two S-shaped vessels of radius 1.07 mm, 3 mm apart, which are not connected. At width 1 "
                              "the plain sum makes one surface of them, at width 5 it does not.",
                              plate, job);
}

Result<Figure> merging(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(460, 440), kInset(220, 220);
    Figure figure{.options = {kFineOptions}};
    Plate plate{.columns = 3};
    std::vector<Paged> all;
    using Pair = std::pair<double, double>; // width and radius
    for (const auto& [width, radius] :
         {Pair{1.0, 1.04}, Pair{1.0, 1.07}, Pair{1.0, 1.37}, Pair{5.0, 1.07}, Pair{5.0, 1.36}, Pair{5.0, 1.37}}) {
        mesh::SurfaceOptions options = fine(width);
        options.detail = 192; // the bridge at 1.37 mm is a tenth of a millimetre thick
        RAMUS_TRY(surface, made_surface(parallel_pair(kDistance, radius, kPairLength), options, job));
        const int pieces = mesh::component_count(surface.mesh);
        const std::string name = rounded(radius) + " mm, " + width_text(width);
        figure.measured.push_back({"pieces of the surface, radius " + name, static_cast<double>(pieces), "",
                                   radius > merging_radius(kDistance, width) ? 1.0 : 2.0});
        plate.panels.push_back(
            {frame_of(surface.paged, {}, kSize, "Radius " + name + (pieces == 1 ? ": merged" : ": apart")),
             frame_of(surface.paged, {}, kInset, "")});
        all.push_back(surface.paged);
    }
    const render::Camera camera = camera_on(all, kSize, {.azimuth = 25.0, .elevation = 20.0, .right = 0.5});
    const render::Camera front = render::looking(camera, render::View::kAnterior);
    for (Panel& panel : plate.panels) {
        panel.frame.camera = camera;
        panel.inset->camera = magnified(front, glm::dvec3(0.0), 7.6);
    }
    std::vector<std::pair<double, double>> found;
    for (const double width : kWidths) {
        RAMUS_TRY(radius, found_merging_radius(kDistance, width, job));
        found.emplace_back(width, radius);
        const bool wide = width == kWidths.front();
        figure.measured.push_back({"radius at which they merge, " + width_text(width), radius, "mm",
                                   merging_radius(kDistance, width), wide ? "1.07 mm" : "1.37 mm"});
        figure.measured.push_back({"gap at this moment, share of the distance, " + width_text(width),
                                   100.0 * (kDistance - 2.0 * radius) / kDistance, "%", 100.0 * merging_gap(width),
                                   wide ? "29 %" : "9 %"});
    }
    figure.plots.push_back({"figure_03_merging.svg", merging_plot(found)});
    return bench.with_picture(std::move(figure), "figure_03.png",
                              "Two parallel vessels 3 mm apart, above at width 1, below at width 5. Insets: the gap "
                              "from the front, magnified.",
                              plate, job);
}

} // namespace ramus::app::paper
