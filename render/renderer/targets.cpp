#include "render/renderer/targets.h"

#include "render/gl/gl_context.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ramus::render {

namespace {

std::array<glm::vec2, kMostSamples> sample_positions(GLuint framebuffer, int samples) {
    std::array<glm::vec2, kMostSamples> positions{};
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    for (int s = 0; s < samples; ++s) {
        glm::vec2 at(0.5F);
        if (samples > 1) glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(s), &at.x);
        positions.at(static_cast<std::size_t>(s)) = at - 0.5F;
    }
    return positions;
}

} // namespace

bool ViewTargets::fit(glm::ivec2 size, int samples_a_pixel) const {
    return size == made_for_ && samples_a_pixel == view.samples;
}

void ViewTargets::make(int samples_a_pixel) {
    const int w = view.size.x, h = view.size.y;
    samples.id_normal = make_texture(GL_RG32UI, w, h, samples_a_pixel);
    samples.depth = make_texture(GL_DEPTH_COMPONENT32F, w, h, samples_a_pixel);
    resolved.covered = make_texture(GL_DEPTH_COMPONENT32F, w, h);
    resolved.id_normal = make_texture(GL_RG32UI, w, h);
    resolved.opaque_depth = make_texture(GL_R32F, w, h);
    resolved.picked_depth = make_texture(GL_R32F, w, h);
    occlusion.raw = make_texture(GL_RG8, w, h);
    occlusion.half_blurred = make_texture(GL_RG8, w, h);
    occlusion.blurred = make_texture(GL_RG8, w, h);
    lit.colour = make_texture(GL_RGBA8, w, h);
    glTextureParameteri(lit.colour, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    samples.framebuffer = make_framebuffer({samples.id_normal}, samples.depth);
    resolved.framebuffer =
        make_framebuffer({resolved.id_normal, resolved.opaque_depth, resolved.picked_depth}, resolved.covered);
    occlusion.raw_target = make_framebuffer({occlusion.raw}, resolved.covered);
    occlusion.half_target = make_framebuffer({occlusion.half_blurred}, resolved.covered);
    occlusion.blurred_target = make_framebuffer({occlusion.blurred}, resolved.covered);
    lit.framebuffer = make_framebuffer({lit.colour}, resolved.covered);
    if (gl_has_lists()) lists.framebuffer = make_framebuffer({}, samples.depth);
    layers.fragments = {}; // the others are recreated when needed
    samples.values = {};   // likewise
    samples.caps = {};
    sliced.depth = {};
    has_planes = false;
    samples.positions = sample_positions(samples.framebuffer, samples_a_pixel);
    view.samples = samples_a_pixel;
    made_for_ = view.size;
}

void ViewTargets::make_values() {
    if (samples.values != 0) return;
    Texture values = make_texture(GL_R32F, view.size.x, view.size.y, view.samples);
    samples.valued_framebuffer = make_framebuffer({samples.id_normal, values}, samples.depth);
    samples.values = std::move(values); // the last: all is there
}

void ViewTargets::make_caps() {
    if (samples.caps == 0) {
        Texture caps = make_texture(GL_DEPTH32F_STENCIL8, view.size.x, view.size.y, view.samples);
        samples.caps_framebuffer = make_framebuffer({samples.id_normal}, caps);
        glNamedFramebufferTexture(samples.caps_framebuffer, GL_STENCIL_ATTACHMENT, caps, 0);
        samples.caps = std::move(caps); // the last: all is there
    }
    if (samples.values == 0) return;
    samples.valued_caps_framebuffer = make_framebuffer({samples.id_normal, samples.values}, samples.caps);
    glNamedFramebufferTexture(samples.valued_caps_framebuffer, GL_STENCIL_ATTACHMENT, samples.caps, 0);
}

void ViewTargets::make_sliced() {
    if (sliced.depth != 0) return;
    sliced.lit.colour = make_texture(GL_RGBA8, view.size.x, view.size.y);
    glTextureParameteri(sliced.lit.colour, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    sliced.lit.framebuffer = make_framebuffer({sliced.lit.colour});
    sliced.guide = make_texture(GL_RG32F, view.size.x, view.size.y);
    sliced.guide_framebuffer = make_framebuffer({sliced.guide});
    sliced.mixed = make_texture(GL_DEPTH_COMPONENT32F, view.size.x, view.size.y);
    Texture depth = make_texture(GL_R32F, view.size.x, view.size.y);
    sliced.framebuffer = make_framebuffer({sliced.lit.colour, depth}, sliced.mixed);
    sliced.colour_framebuffer = make_framebuffer({sliced.lit.colour}, sliced.mixed);
    sliced.guided = false;
    sliced.depth = std::move(depth); // the last: all is there
}

void ViewTargets::keep_resolved(KeptTarget& kept) {
    std::swap(resolved.id_normal, kept.resolved.id_normal);
    std::swap(resolved.opaque_depth, kept.resolved.opaque_depth);
    std::swap(resolved.picked_depth, kept.resolved.picked_depth);
    std::swap(resolved.framebuffer, kept.resolved.framebuffer);
    if (std::exchange(kept.size, made_for_) != made_for_) {
        resolved.id_normal = make_texture(GL_RG32UI, made_for_.x, made_for_.y);
        resolved.opaque_depth = make_texture(GL_R32F, made_for_.x, made_for_.y);
        resolved.picked_depth = make_texture(GL_R32F, made_for_.x, made_for_.y);
    }
    resolved.framebuffer =
        make_framebuffer({resolved.id_normal, resolved.opaque_depth, resolved.picked_depth}, resolved.covered);
}

void PictureTarget::make(glm::ivec2 pixels) {
    size = glm::ivec2(0);
    colour = make_texture(GL_RGBA8, pixels.x, pixels.y);
    framebuffer = make_framebuffer({colour});
    size = pixels;
}

void PictureTarget::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, size.x, size.y);
}

void PictureTarget::put(const Image& opaque) {
    Image upside_down(size.x, size.y);
    const std::size_t row = 4 * static_cast<std::size_t>(size.x);
    for (int y = 0; y < size.y; ++y) std::copy_n(opaque.pixel(0, size.y - 1 - y), row, upside_down.pixel(0, y));
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTextureSubImage2D(colour, 0, 0, 0, size.x, size.y, GL_RGBA, GL_UNSIGNED_BYTE, upside_down.rgba.data());
}

Image PictureTarget::read_premultiplied() const {
    Image image(size.x, size.y);
    if (size.x == 0) return image;
    Image upside_down(size.x, size.y);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(colour, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(upside_down.rgba.size()),
                      upside_down.rgba.data());
    const std::size_t row = 4 * static_cast<std::size_t>(size.x);
    for (int y = 0; y < size.y; ++y) std::copy_n(upside_down.pixel(0, size.y - 1 - y), row, image.pixel(0, y));
    return image;
}

Image PictureTarget::read() const {
    Image image = read_premultiplied();
    straighten(image);
    return image;
}

glm::dvec2 PictureTarget::pixel_presented(glm::ivec2 size, glm::ivec2 filled, glm::dvec2 at) {
    if (size == filled || size.y == 0 || filled.y == 0) return at;
    const double scale = static_cast<double>(size.y) / filled.y;
    return 0.5 * glm::dvec2(size) + scale * (at - 0.5 * glm::dvec2(filled));
}

void PictureTarget::present(GLuint to, int x, int y, glm::ivec2 filled) const {
    if (size.x == 0) return;
    const bool fits = size == filled;
    const int width = fits ? size.x : static_cast<int>(std::lround(double(size.x) * filled.y / size.y));
    const int left = x + (filled.x - width) / 2;
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
    glDisable(GL_SCISSOR_TEST);
    if (!fits) {
        glEnable(GL_SCISSOR_TEST);
        glScissor(x, y, filled.x, filled.y);
    }
    glBlitNamedFramebuffer(framebuffer, to, 0, 0, size.x, size.y, left, y, left + width, y + filled.y,
                           GL_COLOR_BUFFER_BIT, fits ? GL_NEAREST : GL_LINEAR);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace ramus::render
