// EightBoxes: boxes side by side in memory, so that a box is compared with all of them by vectors. Trees of boxes are
// made of these.
#pragma once

#include "core/base/bounds.h"

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>

namespace ramus {

class EightBoxes {
public:
    static constexpr std::size_t kCount = 8;
    using Box = Bounds<glm::vec3>;

    EightBoxes() { // around nothing
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
    [[nodiscard]] Box around() const {
        Box all;
        for (std::size_t n = 0; n < kCount; ++n) all.hold(box(n));
        return all;
    }
    // Which of them meet a box: a bit each.
    [[nodiscard]] unsigned meeting(const Box& box) const {
        unsigned bits = 0;
        for (std::size_t n = 0; n < kCount; ++n) {
            bool meets = true; // no test depends on another: nothing to guess for a processor
            for (std::size_t axis = 0; axis < 3; ++axis) {
                meets &= least_[axis][n] <= box.most[static_cast<int>(axis)];
                meets &= most_[axis][n] >= box.least[static_cast<int>(axis)];
            }
            bits |= static_cast<unsigned>(meets) << n;
        }
        return bits;
    }

private:
    std::array<std::array<float, kCount>, 3> least_, most_;
};

} // namespace ramus
