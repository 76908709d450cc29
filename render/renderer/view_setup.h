// ViewSetup: one look at the scene as passes need it: how many pixels, which matrices, the uniform block of view.glsl.
// A value without GL.
#pragma once

#include "render/scene/bounds.h"
#include "render/scene/frame.h"
#include "render/scene/uniform_blocks.h"

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <vector>

namespace ramus::render {

// Full pictures are the mean of so many views, each off by less than a quarter of a pixel. The first one is what is
// pointed at.
inline constexpr int kFineViews = 4;

struct ViewSetup {
    glm::ivec2 picture{0}; // pixels of the picture
    glm::ivec2 size{0};    // of what passes draw, fewer while the view moves
    int samples = 1;       // a pixel, of what passes draw
    int shift = 0;         // which of kFineViews
    ViewBlock block{};
    glm::dmat4 projection{1.0}; // eye space to clip space
    glm::dmat4 to_clip{1.0};    // mm to clip space
    glm::mat3 to_eye{1.0F};     // rotation only

    [[nodiscard]] bool enlarged() const { return size != picture; }
    // Pixels that are drawn for one of the picture, across and up.
    [[nodiscard]] glm::vec2 to_inner() const { return glm::vec2(size) / glm::vec2(picture); }
    // The same for lengths that are given in points.
    [[nodiscard]] float pixels_a_point(const Frame& frame) const {
        return frame.pixel_ratio * static_cast<float>(size.y) / static_cast<float>(picture.y);
    }
    [[nodiscard]] glm::dmat4 clip_from(const glm::dvec3& origin) const; // positions relative to `origin`

    struct Ball {
        glm::dvec3 centre;
        double radius;
    };
    // Looks as `frame.camera` does; sizes, samples and shift stay. The near and far planes enclose all of `box`, which
    // the depth cue spans, and of `others`. Reversed depth, 1 at the near plane and 0 at the far one: float depth is
    // then as fine far away as near by.
    void look(const Frame& frame, const Box& box, const std::vector<Ball>& others);
};

// From mm to eye space with depth as +z, as the full-screen passes reckon.
[[nodiscard]] glm::dmat4 eye_matrix(const Camera& camera);

// The uniform block of look.glsl: colours and lights, for shaders and for the caster. `outlined`: something is
// selected.
[[nodiscard]] LookBlock look_of(const Frame& frame, const ViewSetup& view, bool has_glass, bool outlined);

} // namespace ramus::render
