#include "app/assets/centerlines.h"

#include "app/session/branch_facts.h"
#include "core/field/kernels/gaussian.h"
#include "core/mesh/tree_field.h"
#include "render/scene/bounds.h"
#include "render/scene/uniform_blocks.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace ramus::app {

namespace {

// The start and length of each branch of the file, mm along the vessels.
struct Extent {
    double begin = 0.0, length = 0.0;
};

std::vector<Extent> extents_of(const tree::VesselTree& tree) {
    std::vector<Extent> extents(tree.branches.size());
    for (const int id : parents_first(tree)) {
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
        Extent& own = extents[static_cast<std::size_t>(id)];
        own.length = tree::length_mm(tree, branch);
        if (branch.parent == tree::kNoBranch) continue;
        const Extent& parent = extents[static_cast<std::size_t>(branch.parent)];
        own.begin = parent.begin + parent.length;
    }
    return extents;
}

constexpr double kMostOfList = 1e14; // shaders would take larger values for unknown ones

render::Centerlines make_centerlines(const tree::VesselTree& tree, const mesh::SurfaceOptions& options) {
    const mesh::PreparedTree prepared = mesh::prepare_tree(tree, options);
    const auto& points = prepared.tree.points;
    const render::Box box = render::bounds_of(prepared.tree);

    // Runs of the file's branches; pruning joins some of them end to end into one branch.
    std::vector<std::vector<std::uint32_t>> runs(tree.branches.size());
    std::size_t segment = 0;
    for (const tree::Branch& branch : prepared.tree.branches)
        for (std::size_t i = 0; i + 1 < branch.points.size(); ++i, ++segment) {
            auto& run = runs[static_cast<std::size_t>(prepared.segment_source[segment])];
            if (run.empty() || run.back() != branch.points[i]) run.push_back(branch.points[i]);
            run.push_back(branch.points[i + 1]);
        }

    render::Centerlines lines;
    lines.lists.resize(prepared.tree.point_data.size());
    lines.smooth_radii = prepared.centerline == tree::Centerline::kSmooth;
    lines.origin = box.empty() ? glm::dvec3(0.0) : box.centre();
    lines.runs.resize(tree.branches.size());
    const std::vector<Extent> extents = extents_of(tree);
    for (std::size_t id = 0; id < runs.size(); ++id) {
        const auto& run = runs[id];
        lines.runs[id] = {static_cast<std::uint32_t>(lines.points.size()), static_cast<std::uint32_t>(run.size())};
        double length = 0.0;
        for (std::size_t i = 1; i < run.size(); ++i)
            length += glm::distance(points[run[i - 1]].position, points[run[i]].position);
        double so_far = 0.0;
        for (std::size_t i = 0; i < run.size(); ++i) {
            const tree::Point& point = points[run[i]];
            if (i > 0) so_far += glm::distance(points[run[i - 1]].position, point.position);
            const double share = length > 0.0 ? so_far / length : 0.0;
            lines.points.emplace_back(glm::vec3(point.position - lines.origin),
                                      static_cast<float>(extents[id].begin + share * extents[id].length));
            lines.details.push_back({static_cast<float>(2.0 * point.radius), static_cast<std::int32_t>(id)});
            for (std::size_t list = 0; list < lines.lists.size(); ++list) {
                const double value = prepared.tree.point_data[list].values[run[i]];
                lines.lists[list].push_back(tree::is_known(value)
                                                ? static_cast<float>(std::clamp(value, -kMostOfList, kMostOfList))
                                                : render::kNotKnown);
            }
        }
    }
    return lines;
}

} // namespace

SurfaceCenterlines centerlines_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options) {
    return {options.smooth_passes, options.prune_ratio, smoothing_of(tree, options.smooth_passes),
            std::make_shared<const render::Centerlines>(make_centerlines(tree, options)), nullptr};
}

DrawnWidth drawn_width(const mesh::SurfaceOptions& options, mesh::Method method) {
    if (method == mesh::Method::kTruncatedCones || options.kernel != field::KernelKind::kGaussian) return {};
    return {static_cast<float>(options.width), static_cast<float>(field::reach_beyond_end(options.width))};
}

bool drawn_along_lines(const mesh::SurfaceOptions& options, mesh::Method method) {
    if (method == mesh::Method::kTruncatedCones) return true;
    return options.kernel == field::KernelKind::kGaussian && mesh::row_of(options.blend).along_centerlines;
}

} // namespace ramus::app
