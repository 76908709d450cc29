#include "core/measure/largest_diameter.h"

#include "core/base/halved_boxes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <vector>

namespace ramus::measure {

namespace {

class PointsInBoxes {
public:
    explicit PointsInBoxes(std::span<const glm::vec3> points)
        : points_(points),
          boxes_(halved_boxes(
              static_cast<std::uint32_t>(points.size()),
              [&](Bounds<glm::dvec3>& box, std::uint32_t point) { box.hold(glm::dvec3(points[point])); },
              [&](std::uint32_t point, int axis) { return static_cast<double>(points[point][axis]); })) {}

    [[nodiscard]] glm::dvec3 outermost(const glm::dvec3& direction) const {
        return best([&](const Bounds<glm::dvec3>& box) {
            const glm::dvec3 most = glm::max(direction * box.least, direction * box.most);
            return most.x + most.y + most.z;
        });
    }
    [[nodiscard]] glm::dvec3 farthest(const glm::dvec3& from) const {
        return best([&](const Bounds<glm::dvec3>& box) {
            return glm::length(glm::max(glm::abs(box.least - from), glm::abs(box.most - from)));
        });
    }

private:
    // The point of the greatest value; value(box): the greatest that a point of the box can have.
    template <class Value> [[nodiscard]] glm::dvec3 best(const Value& value) const {
        double greatest = std::numeric_limits<double>::lowest();
        glm::dvec3 found(0.0);
        std::vector<std::uint32_t> open{0};
        while (!open.empty()) {
            const std::uint32_t at = open.back();
            const BoxNode& node = boxes_.nodes[at];
            open.pop_back();
            if (value(node.box) <= greatest) continue;
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const glm::dvec3 point(points_[boxes_.order[i]]);
                if (const double here = value({point, point}); here > greatest) greatest = here, found = point;
            }
            if (node.count > 0) continue;
            const bool second = value(boxes_.nodes[node.first].box) > value(boxes_.nodes[at + 1].box);
            open.push_back(second ? at + 1 : node.first);
            open.push_back(second ? node.first : at + 1); // the more promising one next
        }
        return found;
    }

    std::span<const glm::vec3> points_;
    HalvedBoxes boxes_;
};

} // namespace

double largest_diameter(std::span<const glm::vec3> points) {
    if (points.empty()) return 0.0;
    const PointsInBoxes boxes(points);
    glm::dvec3 a(points.front()), b = a;
    double longest = 0.0;
    const auto take = [&](const glm::dvec3& from, const glm::dvec3& to) {
        const double length = glm::distance(from, to);
        if (length <= longest) return false;
        a = from, b = to, longest = length;
        return true;
    };
    // A spiral of even density over half a sphere.
    constexpr int kDirections = 4'000;
    for (int i = 0; i < kDirections; ++i) {
        const double z = (i + 0.5) / kDirections, r = std::sqrt(1.0 - z * z);
        const double angle = glm::two_pi<double>() * i / glm::golden_ratio<double>();
        const glm::dvec3 direction(r * std::cos(angle), r * std::sin(angle), z);
        take(boxes.outermost(-direction), boxes.outermost(direction));
    }
    while (take(a, boxes.farthest(a)) || take(b, boxes.farthest(b))) {
    }
    return longest;
}

} // namespace ramus::measure
