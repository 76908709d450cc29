#include "app/paper/method_figures.h"

#include "app/assets/centerlines.h"
#include "app/paper/exact_trees.h"
#include "app/picture/compose.h"
#include "app/session/numbers.h"
#include "core/io/standard_input.h"
#include "core/mesh/tree_field.h"
#include "core/tree/smooth.h"

#include <algorithm>
#include <array>
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

// Two rows of pictures of one vessel: its surfaces, and its centerlines with rings of the radius.
class Rows {
public:
    explicit Rows(glm::ivec2 size) : size_(size) {}

    [[nodiscard]] Result<void> add(const std::string& caption, const tree::VesselTree& tree,
                                   const mesh::SurfaceOptions& options, Job& job) {
        RAMUS_TRY(surface, made_surface(tree, options, job));
        columns_.push_back({caption, surface.paged, centerlines_of(tree, options).lines});
        return {};
    }
    // `close_to`: what insets magnify, `height_mm` high.
    [[nodiscard]] Plate plate(const Looking& looking, const glm::dvec3& close_to, double height_mm) const {
        Plate plate{.columns = columns_.size()};
        const std::array all{columns_.front().surface};
        const render::Camera camera = camera_on(all, size_, looking);
        for (const bool lines : {false, true})
            for (const Column& column : columns_) {
                render::Frame frame = frame_of(column.surface, camera, size_, lines ? "" : column.caption);
                if (lines) show_skeleton(frame, column.lines);
                Panel panel{frame, {}};
                frame.camera = magnified(camera, close_to, height_mm);
                frame.size = glm::ivec2(size_.y / 2);
                frame.overlays.caption.clear();
                panel.inset = std::move(frame);
                plate.panels.push_back(std::move(panel));
            }
        return plate;
    }

private:
    struct Column {
        std::string caption;
        Paged surface;
        std::shared_ptr<const render::Centerlines> lines;
    };
    // Over a pale surface.
    static void show_skeleton(render::Frame& frame, const std::shared_ptr<const render::Centerlines>& lines) {
        frame.skeleton = lines;
        frame.appearance.vessel = glm::vec3(0.86F, 0.80F, 0.78F);
        frame.appearance.centerline = glm::vec3(0.05F, 0.30F, 0.60F);
    }

    glm::ivec2 size_;
    std::vector<Column> columns_;
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
    constexpr glm::ivec2 kSize(720, 470), kInset(260, 260);
    RAMUS_TRY(tree, bench.first(job));
    Figure figure{.options = {"ramus mesh TREE --method iso, cones and cs; cs with --blend paper --centerline lines"}};
    Plate plate{.columns = 3};
    const std::vector<NamedSurface> surfaces = surfaces_of(*tree);
    const std::array all{surfaces.front().paged, surfaces.back().paged};
    const render::Camera camera = camera_on(all, kSize, {.azimuth = 0.0, .elevation = 0.0, .share = 0.63});
    const CloseUp place = branching_of(*tree->input.tree);
    for (const NamedSurface& surface : surfaces) {
        Panel panel{frame_of(surface.paged, camera, kSize, surface.title), {}};
        panel.inset = frame_of(surface.paged, magnified(camera, place.position, 9.0 * place.radius), kInset, "");
        for (render::Frame* frame : {&panel.frame, &*panel.inset}) show_claims(*frame, tree->input.tree->claims);
        plate.panels.push_back(std::move(panel));
    }
    RAMUS_TRY(picture, bench.picture("figure_05.png", "The tree " + tree->input.name + ". " + isosurface_text(*tree),
                                     plate, job));
    figure.pictures.push_back(std::move(picture));
    return figure;
}

Result<Figure> smoothing(Workbench& bench, Job& job) {
    Figure figure{.options = {"--smooth 0, 1 (the default) and 4; all with --blend paper --centerline lines"}};
    const tree::VesselTree jagged = winding_vessel_of_voxels(), exact = winding_vessel();
    mesh::SurfaceOptions options = paper_options();
    options.detail = 32;
    Rows rows({640, 330});
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
    if (auto added = add("The exact centerline", exact); !added) return tl::unexpected(added.error());
    const Plate plate = rows.plate({.azimuth = 0.0, .elevation = 8.0, .share = 0.74}, {26.0, 0.0, -3.0}, 14.0);
    RAMUS_TRY(picture,
              bench.picture("figure_06.png",
                            "A winding vessel whose centerline runs from voxel to voxel of 1 mm, with radii in "
                            "halves of a voxel. Below: centerlines and radii.",
                            plate, job));
    figure.pictures.push_back(std::move(picture));
    return figure;
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
    Rows rows({800, 380});
    if (auto added = rows.add("Not pruned", vessel.tree, options, job); !added) return tl::unexpected(added.error());
    // Each spur makes a branch more, and cuts the one that it stands on in two.
    figure.measured.push_back({"branches, not pruned", branches(), "", vessel.real_branches + 2.0 * vessel.spurs});
    options.prune_ratio = kRatio;
    if (auto added = rows.add("Pruned: leaf branches below half of their parent's length", vessel.tree, options, job);
        !added)
        return tl::unexpected(added.error());
    figure.measured.push_back({"branches, pruned", branches(), "", static_cast<double>(vessel.real_branches)});
    RAMUS_TRY(picture, bench.picture(
                           "figure_07.png",
                           "A vessel of voxels with one side branch and four spurs of three voxels, as thinning "
                           "leaves them. Below: centerlines and radii.",
                           rows.plate({.azimuth = 0.0, .elevation = 8.0, .share = 0.74}, {20.0, 0.0, 4.0}, 12.0), job));
    figure.pictures.push_back(std::move(picture));
    return figure;
}

} // namespace ramus::app::paper
