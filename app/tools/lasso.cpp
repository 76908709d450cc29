#include "app/tools/lasso.h"

#include "app/session/branch_facts.h"

#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

class Judge {
public:
    Judge(const tree::VesselTree& tree, const render::Camera& camera, glm::ivec2 size, const PixelPolygon& polygon,
          const LassoRule& rule)
        : tree_(tree), projector_(camera, size), polygon_(polygon), rule_(rule) {}

    [[nodiscard]] bool is_in(int id) const {
        const auto& points = tree_.branches[static_cast<std::size_t>(id)].points;
        double inside = 0.0, all = 0.0, before = 0.0;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const glm::dvec3& position = tree_.points[points[i]].position;
            const double after =
                i + 1 < points.size() ? 0.5 * glm::distance(position, tree_.points[points[i + 1]].position) : 0.0;
            const double weight = before + after;
            before = after;
            const auto pixel = projector_(position);
            if (rule_.visible != nullptr && !(pixel && rule_.visible->at(pixel->x, pixel->y) == id)) continue;
            all += weight;
            if (!pixel || !polygon_.contains({pixel->x, pixel->y})) continue;
            if (rule_.any_part) return true;
            inside += weight;
        }
        return inside > 0.0 && 2.0 * inside >= all;
    }

private:
    const tree::VesselTree& tree_;
    render::Projector projector_;
    const PixelPolygon& polygon_;
    const LassoRule& rule_;
};

} // namespace

std::vector<int> branches_inside(const tree::VesselTree& tree, const render::Camera& camera, glm::ivec2 size,
                                 const PixelPolygon& polygon, const LassoRule& rule,
                                 std::span<const std::uint8_t> hidden) {
    const Judge judge(tree, camera, size, polygon, rule);
    return branches_where(tree.branches.size(), [&](std::size_t id) {
        return (id >= hidden.size() || hidden[id] == 0) && judge.is_in(static_cast<int>(id));
    });
}

} // namespace ramus::app
