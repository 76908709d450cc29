#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <string>

namespace ramus::render {

namespace {

constexpr int kInteractiveDivisor = 2; // of width and height

} // namespace

// Most that passes draw into is made when the first of them draws: a window's first picture is the caster's, and comes
// that much sooner.
Result<void> Renderer::Impl::resize(glm::ivec2 size, Quality quality, Targets wanted) {
    const int divisor = quality == Quality::kFull ? 1 : kInteractiveDivisor;
    const glm::ivec2 inner = (size + divisor - 1) / divisor;
    GLint integer_samples = 0;
    glGetIntegerv(GL_MAX_INTEGER_SAMPLES, &integer_samples);
    const int s = quality == Quality::kFull ? std::clamp(integer_samples, 1, kMostSamples) : 1;
    const bool passes = wanted == Targets::kAll && (inner != passes_ || float(s) != view_.picture.z);
    inner_ = inner;
    if (size == size_ && !passes) return {};
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    if (size.x > largest || size.y > largest)
        return fail("this graphics driver draws at most " + std::to_string(largest) + " pixels a side", {},
                    "give a smaller size");
    if (passes) make_passes(s);
    if (size != size_) {
        picture_ = make_texture(GL_RGBA8, size.x, size.y);
        picture_target_ = make_framebuffer({picture_});
    }
    size_ = size;
    const GLuint target = wanted == Targets::kAll ? geometry_target_ : picture_target_;
    if (glCheckNamedFramebufferStatus(target, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        let_go();
        return fail("this graphics driver cannot draw a picture of " + std::to_string(size.x) + "x" +
                        std::to_string(size.y) + " pixels",
                    gl_description(), "give a smaller size, or use another driver: ramus render --backend osmesa");
    }
    return {};
}

// Of the size of `inner_`.
void Renderer::Impl::make_passes(int samples) {
    const int w = inner_.x, h = inner_.y;
    surface_ = make_texture(GL_RG32UI, w, h, samples);
    depth_ = make_texture(GL_DEPTH_COMPONENT32F, w, h, samples);
    covered_ = make_texture(GL_DEPTH_COMPONENT32F, w, h);
    id_normal_ = make_texture(GL_RG32UI, w, h);
    opaque_depth_ = make_texture(GL_R32F, w, h);
    picked_depth_ = make_texture(GL_R32F, w, h);
    occlusion_ = make_texture(GL_R8, w, h);
    half_blurred_ = make_texture(GL_R8, w, h);
    blurred_ = make_texture(GL_R8, w, h);
    lit_ = make_texture(GL_RGBA8, w, h);
    glTextureParameteri(lit_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    geometry_target_ = make_framebuffer({surface_}, depth_);
    resolve_target_ = make_framebuffer({id_normal_, opaque_depth_, picked_depth_}, covered_);
    occlusion_target_ = make_framebuffer({occlusion_}, covered_);
    half_blur_target_ = make_framebuffer({half_blurred_}, covered_);
    blur_target_ = make_framebuffer({blurred_}, covered_);
    lit_target_ = make_framebuffer({lit_}, covered_);
    if (gl_has_lists()) glass_target_ = make_framebuffer({}, depth_);
    view_.picture.z = static_cast<float>(samples);
    layer_panes_ = {}; // makes the others anew when they are needed
    find_sample_places();
    passes_ = inner_;
}

} // namespace ramus::render
