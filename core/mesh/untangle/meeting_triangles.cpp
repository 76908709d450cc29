#include "core/mesh/untangle/meeting_triangles.h"

#include "core/base/bounds.h"
#include "core/base/lists_by_thread.h"
#include "core/mesh/untangle/exact_triangles.h"

#include <algorithm>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_sort.h>

namespace ramus::mesh {

namespace {

// A triangle's box: first along the axis in which the set is longest, then along the two others.
struct SweptBox {
    float from = 0.0F, to = 0.0F;
    float low = 0.0F, high = 0.0F, left = 0.0F, right = 0.0F;
    std::uint32_t triangle = 0;

    [[nodiscard]] bool operator<(const SweptBox& other) const {
        return from != other.from ? from < other.from : triangle < other.triangle;
    }
    // Of two that meet along the first axis.
    [[nodiscard]] bool meets(const SweptBox& other) const {
        return low <= other.high && other.low <= high && left <= other.right && other.left <= right;
    }
};

std::vector<SweptBox> swept_boxes(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles) {
    std::vector<Bounds<glm::vec3>> bounds(triangles.size());
    Bounds<glm::vec3> all;
    for (std::size_t n = 0; n < triangles.size(); ++n) {
        for (int corner = 0; corner < 3; ++corner) bounds[n].hold(positions[triangles[n][corner]]);
        all.hold(bounds[n]);
    }
    const glm::vec3 size = all.size();
    const int x = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, y = (x + 1) % 3, z = (x + 2) % 3;
    std::vector<SweptBox> boxes(triangles.size());
    for (std::size_t n = 0; n < triangles.size(); ++n) {
        const auto& [least, most] = bounds[n];
        boxes[n] = {least[x], most[x], least[y], most[y], least[z], most[z], static_cast<std::uint32_t>(n)};
    }
    tbb::parallel_sort(boxes);
    return boxes;
}

} // namespace

std::vector<TrianglePair> meeting_triangles(std::span<const glm::vec3> positions, std::span<const glm::uvec3> triangles,
                                            std::span<const std::uint8_t> asked) {
    const std::vector<SweptBox> boxes = swept_boxes(positions, triangles);
    ListsByThread<TrianglePair> found;
    tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t n) {
        const SweptBox& box = boxes[n];
        for (std::size_t other = n + 1; other < boxes.size() && boxes[other].from <= box.to; ++other) {
            const auto [first, second] = std::minmax(box.triangle, boxes[other].triangle);
            if ((asked[first] | asked[second]) == 0 || !box.meets(boxes[other])) continue;
            if (triangles_meet(positions, triangles[first], triangles[second]))
                found.local().push_back({first, second});
        }
    });
    return found.sorted();
}

} // namespace ramus::mesh
