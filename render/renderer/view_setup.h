// ViewSetup: parameters of one view for the passes: sizes, matrices, the uniform block of view.glsl. A value without
// GL.
#pragma once

#include "render/scene/bounds.h"
#include "render/scene/frame.h"
#include "render/scene/uniform_blocks.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace ramus::render {

// Full pictures are the mean of this many views, each shifted by less than a quarter of a pixel. Picks use the first.
inline constexpr int kFineViews = 4;

struct ViewSetup {
    glm::ivec2 picture{0}; // size of the picture, pixels
    glm::ivec2 size{0};    // size of what passes draw, smaller while the view moves
    int samples = 1;       // samples per pixel that passes draw
    int shift = 0;         // index of the view, less than kFineViews
    ViewBlock block{};
    glm::dmat4 projection{1.0};          // eye space to clip space
    glm::dmat4 to_clip{1.0};             // mm to clip space
    glm::mat3 to_eye{1.0F};              // rotation only
    std::optional<glm::vec4> cap_values; // kUniformCapValues, if the eye looks into a cut; see shaders/caps.glsl

    [[nodiscard]] bool enlarged() const { return size != picture; }
    // Drawn pixels per pixel of the picture, horizontally and vertically.
    [[nodiscard]] glm::vec2 to_inner() const { return glm::vec2(size) / glm::vec2(picture); }
    // Drawn pixels per point (1/96 inch).
    [[nodiscard]] float pixels_a_point(const Frame& frame) const {
        return frame.pixel_ratio * static_cast<float>(size.y) / static_cast<float>(picture.y);
    }
    [[nodiscard]] glm::dmat4 clip_from(const glm::dvec3& origin) const; // for positions relative to `origin`

    struct Ball {
        glm::dvec3 centre;
        double radius;
    };
    // Sets matrices and the uniform block for `frame.camera`; sizes, samples and shift stay. The near and far planes
    // enclose `box`, which the depth cue spans, and `others`. Depth is reversed, 1 at the near plane and 0 at the far
    // plane, so that float depth is equally precise far away.
    void look(const Frame& frame, const Box& box, const std::vector<Ball>& others);
};

// From mm to eye space with depth as +z, the convention of the full-screen passes.
[[nodiscard]] glm::dmat4 eye_matrix(const Camera& camera);

// The uniform block of look.glsl (colours and lights), for shaders and the caster. `outlined`: something is selected.
[[nodiscard]] LookBlock look_of(const Frame& frame, const ViewSetup& view, bool has_glass, bool outlined);

} // namespace ramus::render
