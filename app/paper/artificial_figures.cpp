#include "app/paper/artificial_figures.h"

#include "app/paper/closed_forms.h"
#include "app/paper/exact_trees.h"
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
render::Frame side_view(const Paged& surface, double height_radii) {
    constexpr glm::ivec2 kSize(170, 250);
    render::Camera camera = render::camera_for(surface->positions(), render::View::kLeft, kSize, true);
    camera = magnified(camera, glm::dvec3(0.0), 4.4 * kJointRadius);
    render::Frame frame = frame_of(surface, camera, kSize, digits(height_radii, 4) + " r");
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
    for (double width = 0.8; width <= kMost; width += 0.05)
        curve.push_back({area.at_x(width), area.at_y(merging_radius(kDistance, width))});
    svg.polyline(curve, kSurfaceStroke);
    for (const auto& [width, radius] : found) svg.diamond({area.at_x(width), area.at_y(radius)}, 4.5, kInk);
    draw_legend(svg, {14.0, kHeight - 8.0}, kWidth - 14.0,
                {{"1.5 mm / sqrt(1 + 1 / width); diamonds: found on surfaces", kSurfaceStroke}});
    return svg;
}

struct Pair {
    double width, radius;
};

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
    constexpr glm::ivec2 kSize(520, 400);
    Figure figure{.options = {kFineOptions}};
    Plate plate{.columns = joints().size()};
    std::vector<MadeSurface> surfaces;
    std::vector<Paged> all;
    for (const double width : kWidths)
        for (const Joint& joint : joints()) {
            RAMUS_TRY(surface, made_surface(star(joint.degrees, kJointRadius, kJointLength), fine(width), job));
            all.push_back(surface.paged);
            surfaces.push_back(std::move(surface));
        }
    const render::Camera camera = camera_on(all, kSize, {.azimuth = 0.0, .elevation = 28.0, .share = 0.7});
    auto next = surfaces.begin();
    for (const double width : kWidths)
        for (const Joint& joint : joints()) {
            const MadeSurface& surface = *next++;
            const double height = height_over_joint(surface.mesh) / kJointRadius;
            const std::string caption = std::string(joint.name) + ", " + width_text(width);
            plate.panels.push_back({frame_of(surface.paged, camera, kSize, caption), side_view(surface.paged, height)});
            figure.measured.push_back({"height over the joint, " + caption, height, "radii",
                                       joint_height(static_cast<int>(joint.degrees.size()), width)});
        }
    RAMUS_TRY(picture, bench.picture("figure_01.png",
                                     "Above width 1, below width 5. Insets: the same joint seen along its plane; the "
                                     "blue lines are one radius from the axis, the number is the height of the surface "
                                     "over the joint in radii.",
                                     plate, job));
    figure.pictures.push_back(std::move(picture));
    return figure;
}

Result<Figure> unwanted_blending(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(520, 560);
    constexpr double kRadius = 1.07;
    Figure figure{.options = {kFineOptions, "on the right --blend tree --width 1"}};
    Plate plate{.columns = 3};
    const tree::VesselTree pair = s_shaped_pair(kDistance, kRadius);
    struct Way {
        double width;
        mesh::Blend blend;
        const char* name;
        int pieces; // of the surface
    };
    for (const Way& way :
         {Way{1.0, mesh::Blend::kPaper, "the plain sum", 1}, Way{5.0, mesh::Blend::kPaper, "the plain sum", 2},
          Way{1.0, mesh::Blend::kTree, "ramus keeps them apart", 2}}) {
        mesh::SurfaceOptions options = fine(way.width);
        options.blend = way.blend;
        RAMUS_TRY(surface, made_surface(pair, options, job));
        const std::array all{surface.paged};
        const render::Camera camera = camera_on(all, kSize, {.azimuth = 0.0, .elevation = 0.0, .share = 0.6});
        const int pieces = mesh::component_count(surface.mesh);
        const std::string caption = "Radius 1.07 mm, " + width_text(way.width) + ": " + way.name;
        Panel panel{frame_of(surface.paged, camera, kSize, caption), {}};
        constexpr glm::ivec2 kInset(210, 210);
        panel.inset = frame_of(surface.paged, magnified(camera, {-8.0, 0.0, -8.0}, 7.0), kInset, "");
        plate.panels.push_back(std::move(panel));
        figure.measured.push_back({"pieces of the surface, " + width_text(way.width) + ", " + way.name,
                                   static_cast<double>(pieces), "", static_cast<double>(way.pieces)});
    }
    RAMUS_TRY(picture, bench.picture("figure_02.png",
                                     "Two S-shaped vessels of radius 1.07 mm, 3 mm apart, which are not connected. At "
                                     "width 1 the plain sum makes one surface of them, at width 5 it does not.",
                                     plate, job));
    figure.pictures.push_back(std::move(picture));
    return figure;
}

Result<Figure> merging(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(460, 420), kInset(200, 200);
    Figure figure{.options = {kFineOptions}};
    Plate plate{.columns = 3};
    for (const Pair& pair :
         {Pair{1.0, 1.04}, Pair{1.0, 1.07}, Pair{1.0, 1.37}, Pair{5.0, 1.07}, Pair{5.0, 1.36}, Pair{5.0, 1.37}}) {
        mesh::SurfaceOptions options = fine(pair.width);
        options.detail = 192; // the bridge at 1.37 mm is a tenth of a millimetre thick
        RAMUS_TRY(surface, made_surface(parallel_pair(kDistance, pair.radius, kPairLength), options, job));
        const std::array all{surface.paged};
        const render::Camera camera = camera_on(all, kSize, {.azimuth = 25.0, .elevation = 20.0, .share = 0.6});
        const bool one = mesh::component_count(surface.mesh) == 1;
        const std::string caption =
            "Radius " + rounded(pair.radius) + " mm, " + width_text(pair.width) + ": " + (one ? "merged" : "apart");
        const render::Camera front = render::looking(camera, render::View::kAnterior);
        Panel panel{frame_of(surface.paged, camera, kSize, caption), {}};
        panel.inset = frame_of(surface.paged, magnified(front, glm::dvec3(0.0), 4.6), kInset, "from the front");
        plate.panels.push_back(std::move(panel));
        figure.measured.push_back(
            {"pieces of the surface, radius " + rounded(pair.radius) + " mm, " + width_text(pair.width),
             one ? 1.0 : 2.0, "", pair.radius > merging_radius(kDistance, pair.width) ? 1.0 : 2.0});
    }
    RAMUS_TRY(picture, bench.picture("figure_03.png",
                                     "Two parallel vessels 3 mm apart, above at width 1, below at width 5. Insets: the "
                                     "gap from the front, magnified.",
                                     plate, job));
    figure.pictures.push_back(std::move(picture));
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
    return figure;
}

} // namespace ramus::app::paper
