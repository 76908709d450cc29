// BranchInk: the colours in which slices draw the vessels of a frame, the same as on its surface: by branch, state,
// scale, distance from lesions and cuts.
#pragma once

#include "render/scene/frame.h"

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace ramus::render {

struct Ink {
    glm::vec3 colour{1.0F}; // sRGB
    float width = 1.5F;     // points
    float opacity = 1.0F;
    bool operator==(const Ink&) const = default;
};

class BranchInk {
public:
    // The frame must outlive the object.
    explicit BranchInk(const Frame& frame);

    // At a place (mm) on or in the branch; none: the branch is hidden. `value`: of the surface there, if it has values.
    [[nodiscard]] std::optional<Ink> at(int branch, const glm::dvec3& place, std::optional<float> value) const;

private:
    [[nodiscard]] std::optional<glm::vec3> scale_colour(int branch, const glm::dvec3& place,
                                                        std::optional<float> value) const;
    [[nodiscard]] std::optional<glm::vec3> margin_colour(const glm::dvec3& place) const;
    [[nodiscard]] bool is_lost(int branch, const glm::dvec3& place) const;

    const Frame& frame_;
    std::vector<char> selected_; // by branch
};

} // namespace ramus::render
