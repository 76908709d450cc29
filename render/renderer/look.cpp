#include "render/renderer/look.h"

#include "render/scene/colour.h"

#include <algorithm>

namespace ramus::render {

namespace {

constexpr float kLesionOpacity = 0.6F; // where they face the eye (tuned by eye: solid, and vessels inside show)

} // namespace

LookBlock look_of(const Frame& frame, const ViewSetup& view, bool has_glass, bool outlined) {
    const Appearance& a = frame.appearance;
    const Background& b = frame.background;
    const float point = view.pixels_a_point(frame);
    return {glm::vec4(b.top, b.transparent ? 1.0F : 0.0F),
            glm::vec4(b.bottom, a.depth_cue),
            linear(a.glass, has_glass ? 1.0F : 0.0F),
            linear(a.selection, outlined ? std::max(1.0F, 1.6F * point) : 0.0F),
            {a.key, a.fill, a.rim, a.specular},
            {a.occlusion, std::clamp(a.glass_opacity, 0.0F, 2.0F), std::max(1.0F, point), a.shadows},
            linear(a.centerline, 1.0F),
            linear(a.lesion, kLesionOpacity),
            linear(a.lost, 1.0F),
            linear(0.5F * (b.top + b.bottom), 1.0F),
            {a.halos, a.contours, a.chromadepth, std::max(1.0F, 2.6F * point)}};
}

} // namespace ramus::render
