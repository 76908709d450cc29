#include "app/assets/centerlines.h"
#include "app/paper/exact_trees.h"
#include "app/paper/figures.h"
#include "app/picture/compose.h"
#include "app/session/numbers.h"
#include "core/io/standard_input.h"
#include "core/mesh/tree_field.h"
#include "core/tree/smooth.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <utility>

namespace ramus::app::paper {

namespace {

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// How much the centerline of one vessel turns, degrees per mm.
double turning_of(const tree::VesselTree& tree) {
    const auto& points = tree.branches.front().points;
    const auto step = [&](std::size_t i) {
        return glm::normalize(tree.points[points[i]].position - tree.points[points[i - 1]].position);
    };
    double turning = 0.0;
    for (std::size_t i = 2; i < points.size(); ++i)
        turning += std::acos(std::clamp(glm::dot(step(i - 1), step(i)), -1.0, 1.0));
    return glm::degrees(turning) / tree::length_mm(tree, tree.branches.front());
}

// Pictures of one vessel, a row for each way to make it: its surface, and its centerline with rings of the radius.
class Rows {
public:
    Rows(glm::ivec2 size, const glm::dvec3& close_to, double height_mm) // what insets magnify
        : size_(size), close_to_(close_to), height_mm_(height_mm) {}

    [[nodiscard]] Result<void> add(const std::string& caption, const tree::VesselTree& tree,
                                   const mesh::SurfaceOptions& options, Job& job) {
        RAMUS_TRY(surface, made_surface(tree, options, job));
        const int inset = size_.y - size_.y / 4;
        const Looking looking{.elevation = 8.0, .right = static_cast<double>(inset + 20) / size_.x};
        const render::Camera camera = plate_.panels.empty() ? camera_on({surface.paged}, size_, looking)
                                                            : plate_.panels.front().frame.camera; // all rows alike
        for (const bool lines : {false, true}) {
            render::Frame frame = frame_of(surface.paged, camera, size_, lines ? "" : caption);
            if (lines) frame.skeleton = centerlines_of(tree, options).lines;
            Panel panel{frame};
            frame.camera = magnified(camera, close_to_, height_mm_);
            frame.size = glm::ivec2(inset);
            frame.overlays.caption.clear();
            panel.inset = std::move(frame);
            plate_.panels.push_back(std::move(panel));
        }
        return {};
    }
    [[nodiscard]] const Plate& plate() const { return plate_; }

private:
    glm::ivec2 size_;
    glm::dvec3 close_to_;
    double height_mm_;
    Plate plate_{.columns = 2};
};

} // namespace

CloseUp branching_of(const tree::VesselTree& tree) {
    const std::vector<CloseUp> places = close_ups_of(tree);
    return places[std::min<std::size_t>(1, places.size() - 1)];
}

std::vector<NamedSurface> surfaces_of(const ComparedTree& tree) {
    return {{"Isosurface", tree.isosurface.paged},
            {"Truncated cones", tree.cones.paged},
            {"Convolution surface", tree.surface.paged}};
}

std::string isosurface_text(const ComparedTree& tree) {
    if (!tree.input.mask.empty())
        return "The isosurface is that of the mask " +
               std::filesystem::path(io::input_name(tree.input.mask)).filename().string() + ".";
    return "The isosurface is that of a mask of the tree itself, of voxels of " +
           Lengths(tree.input.tree->claims).text(tree.voxel_mm) + ": a scan without noise.";
}

Result<Figure> methods(Workbench& bench, Job& job) {
    constexpr glm::ivec2 kSize(560, 400);
    RAMUS_TRY(tree, bench.first(job));
    Figure figure{
        .options = {"ramus mesh MASK --method iso, and ramus mesh TREE --method cones and cs; cs with --blend paper "
                    "--centerline lines"}};
    const std::vector<NamedSurface> surfaces = surfaces_of(*tree);
    Plate plate{.columns = surfaces.size()};
    const render::Camera camera = camera_on({surfaces.front().paged, surfaces.back().paged}, kSize);
    const CloseUp place = branching_of(*tree->input.tree);
    for (const bool close : {false, true})
        for (const NamedSurface& surface : surfaces) {
            plate.panels.push_back({frame_of(surface.paged, camera, kSize, surface.title)});
            Panel& panel = plate.panels.back();
            show_claims(panel.frame, tree->input.tree->claims);
            if (close)
                panel.frame.camera = magnified(camera, place.position, 9.0 * place.radius);
            else
                panel.close_up = plate.panels.size() - 1 + surfaces.size();
        }
    return bench.with_picture(std::move(figure), "figure_05.png",
                              "The tree " + tree->input.name + ", below at a branching. " + isosurface_text(*tree),
                              plate, job);
}

Result<Figure> smoothing(Workbench& bench, Job& job) {
    Figure figure{.options = {"--smooth 0, 1 (the default) and 4; all with --blend paper --centerline lines"}};
    const tree::VesselTree jagged = winding_vessel_of_voxels();
    mesh::SurfaceOptions options = paper_options();
    options.detail = 32;
    Rows rows({780, 290}, {26.0, 0.0, -3.0}, 14.0);
    const auto add = [&](const std::string& name, const tree::VesselTree& tree) {
        const tree::VesselTree smooth = tree::smooth(tree, options.smooth_passes);
        figure.measured.push_back({"turning of the centerline, " + name, turning_of(smooth), "degrees per mm"});
        figure.measured.push_back({"mean distance of points from the exact centerline, " + name,
                                   mean_of(distances_to_winding_vessel(smooth)), "mm"});
        return rows.add(name, tree, options, job);
    };
    for (const int passes : {0, 1, 4}) {
        options.smooth_passes = passes;
        const std::string name =
            passes == 0 ? std::string("No smoothing")
                        : "Binomial filter, " + counted(static_cast<std::uint64_t>(passes), "pass", "passes");
        if (auto added = add(name, jagged); !added) return tl::unexpected(added.error());
    }
    figure.measured.push_back({"largest displacement of a point, four passes",
                               tree::displacement_of(jagged, tree::smooth(jagged, options.smooth_passes)).largest_mm,
                               "mm"});
    if (auto added = add("The exact centerline", winding_vessel()); !added) return tl::unexpected(added.error());
    return bench.with_picture(std::move(figure), "figure_06.png",
                              "A winding vessel whose centerline runs from voxel to voxel of 1 mm, with radii in "
                              "halves of a voxel. Left: surfaces; right: their centerlines and radii.",
                              rows.plate(), job);
}

Result<Figure> pruning(Workbench& bench, Job& job) {
    constexpr double kRatio = 0.5;
    Figure figure{.options = {"--prune 0 (off, the default) and --prune 0.5; both with --smooth 1 --blend paper "
                              "--centerline lines"}};
    const SpurredVessel vessel = spurred_vessel();
    mesh::SurfaceOptions options = paper_options();
    options.detail = 32;
    const auto branches = [&] {
        return static_cast<double>(mesh::prepare_tree(vessel.tree, options).tree.branches.size());
    };
    Rows rows({780, 350}, {20.0, 0.0, 4.0}, 12.0);
    if (auto added = rows.add("Not pruned", vessel.tree, options, job); !added) return tl::unexpected(added.error());
    // Each spur makes a branch more, and cuts the one that it stands on in two.
    figure.measured.push_back({"branches, not pruned", branches(), "", vessel.real_branches + 2.0 * vessel.spurs});
    options.prune_ratio = kRatio;
    if (auto added = rows.add("Pruned: leaf branches below half of their parent's length", vessel.tree, options, job);
        !added)
        return tl::unexpected(added.error());
    figure.measured.push_back({"branches, pruned", branches(), "", static_cast<double>(vessel.real_branches)});
    return bench.with_picture(std::move(figure), "figure_07.png",
                              "A vessel of voxels with one side branch and four spurs of three voxels, as thinning "
                              "leaves them. Left: surfaces; right: their centerlines and radii.",
                              rows.plate(), job);
}

} // namespace ramus::app::paper
