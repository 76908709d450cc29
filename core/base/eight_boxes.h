// EightBoxes: eight boxes as a structure of arrays, so that SIMD vectors compare a box with all of them. A node of
// BoxTree (box_tree.h).
#pragma once

#include "core/base/bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <limits>

namespace ramus {

class EightBoxes {
public:
    static constexpr std::size_t kCount = 8;
    using Box = Bounds<glm::vec3>;

    EightBoxes() { // all empty
        for (auto& row : least_) row.fill(std::numeric_limits<float>::max());
        for (auto& row : most_) row.fill(std::numeric_limits<float>::lowest());
    }
    void set(std::size_t n, const Box& box) {
        for (int axis = 0; axis < 3; ++axis) {
            least_[static_cast<std::size_t>(axis)][n] = box.least[axis];
            most_[static_cast<std::size_t>(axis)][n] = box.most[axis];
        }
    }
    [[nodiscard]] Box box(std::size_t n) const {
        return {{least_[0][n], least_[1][n], least_[2][n]}, {most_[0][n], most_[1][n], most_[2][n]}};
    }
    // The bounding box of all eight.
    [[nodiscard]] Box around() const {
        Box all;
        for (std::size_t n = 0; n < kCount; ++n) all.hold(box(n));
        return all;
    }
    // Coordinates of all eight boxes along one axis.
    [[nodiscard]] const float* least(std::size_t axis) const { return least_[axis].data(); }
    [[nodiscard]] const float* most(std::size_t axis) const { return most_[axis].data(); }
    // Bit n is set if box n meets `box`. Boxes that only touch meet.
    [[nodiscard]] unsigned meeting(const Box& box) const {
        const Bits low = meeting(0, Bits{1, 2, 4, 8}, box), high = meeting(kLanes, Bits{16, 32, 64, 128}, box);
        const Bits bits = low | high;
        return static_cast<unsigned>(bits[0] | bits[1] | bits[2] | bits[3]);
    }

private:
    // Explicit vectors, because compilers do not vectorize a loop over all boxes. Any processor has this size.
    static constexpr std::size_t kLanes = 4;
    using Numbers [[gnu::vector_size(kLanes * sizeof(float))]] = float;
    using Bits [[gnu::vector_size(kLanes * sizeof(std::int32_t))]] = std::int32_t;

    // For the four boxes from `first` on: the given bit if the box meets, else 0.
    [[nodiscard]] Bits meeting(std::size_t first, Bits bits, const Box& box) const {
        const auto numbers = [&](const std::array<float, kCount>& row) {
            Numbers some;
            std::memcpy(&some, row.data() + first, sizeof(some));
            return some;
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float least = box.least[static_cast<int>(axis)], most = box.most[static_cast<int>(axis)];
            bits &= numbers(least_[axis]) <= Numbers{most, most, most, most};
            bits &= numbers(most_[axis]) >= Numbers{least, least, least, least};
        }
        return bits;
    }

    std::array<std::array<float, kCount>, 3> least_, most_;
};

} // namespace ramus
