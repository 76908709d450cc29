#include "render/overlay.h"
#include "render/renderer_impl.h"
#include "render/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>

namespace ramus::render {

namespace {

constexpr int kSamples = 4;
constexpr int kTaps = 20, kInteractiveTaps = 10;
constexpr int kInteractiveDivisor = 2; // of width and height
constexpr double kOcclusionShare =
    0.055; // of the picture's height: the reach of the occlusion (tuned by eye on brain and airway trees)

float linear(float srgb) { return srgb <= 0.04045F ? srgb / 12.92F : std::pow((srgb + 0.055F) / 1.055F, 2.4F); }
glm::vec4 linear(const glm::vec3& srgb, float w) { return {linear(srgb.x), linear(srgb.y), linear(srgb.z), w}; }

// The uniform block of shade.frag.
struct LookBlock {
    glm::vec4 background_top, background_bottom, glass_colour, selection_colour, lights, more;
};

Layer layer_of(BranchState state) {
    if (state == BranchState::kHidden) return Layer::kNone;
    return state == BranchState::kDefocused ? Layer::kGlass : Layer::kOpaque;
}

} // namespace

Result<void> Renderer::Impl::initialise() {
    const auto make = [](Program& program, std::string_view vertex, std::string_view fragment,
                         std::string_view defines = {}) -> Result<void> {
        auto made = make_program(vertex, fragment, defines);
        if (!made) return tl::unexpected(made.error());
        program = std::move(*made);
        return {};
    };
    for (auto [program, vertex, fragment] : {std::tuple{&geometry_, "geometry.vert", "geometry.frag"},
                                             {&resolve_, "fullscreen.vert", "resolve.frag"},
                                             {&occlude_, "fullscreen.vert", "occlusion.frag"},
                                             {&blur_, "fullscreen.vert", "occlusion_blur.frag"},
                                             {&background_, "fullscreen.vert", "background.frag"},
                                             {&enlarge_, "fullscreen.vert", "enlarge.frag"},
                                             {&overlay_, "fullscreen.vert", "overlay.frag"}})
        if (auto made = make(*program, vertex, fragment); !made) return made;
    no_vertices_ = make_vertex_array();
    view_block_ = make_buffer();
    look_block_ = make_buffer();
    glNamedBufferStorage(view_block_, sizeof(ViewBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    glNamedBufferStorage(look_block_, sizeof(LookBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return {};
}

Result<void> Renderer::Impl::resize(glm::ivec2 size, Quality quality) {
    const int divisor = quality == Quality::kFull ? 1 : kInteractiveDivisor;
    const glm::ivec2 inner = (size + divisor - 1) / divisor;
    if (size == size_ && inner == inner_) return {};
    GLint largest = 0, integer_samples = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    glGetIntegerv(GL_MAX_INTEGER_SAMPLES, &integer_samples);
    if (size.x > largest || size.y > largest)
        return fail("this graphics driver draws at most " + std::to_string(largest) + " pixels a side", {},
                    "give a smaller size");
    while (glGetError() != GL_NO_ERROR) {
    }
    if (inner != inner_) {
        const int w = inner.x, h = inner.y, s = std::clamp(integer_samples, 1, kSamples);
        surface_ = make_texture(GL_RG32UI, w, h, s);
        depth_ = make_texture(GL_DEPTH_COMPONENT32F, w, h, s);
        covered_ = make_texture(GL_DEPTH_COMPONENT32F, w, h);
        id_normal_ = make_texture(GL_RG32UI, w, h);
        opaque_depth_ = make_texture(GL_R32F, w, h);
        picked_depth_ = make_texture(GL_R32F, w, h);
        occlusion_ = make_texture(GL_R8, w, h);
        half_blurred_ = make_texture(GL_R8, w, h);
        blurred_ = make_texture(GL_R8, w, h);
        lit_ = make_texture(GL_RGBA8, w, h);
        geometry_target_ = make_framebuffer({surface_}, depth_);
        resolve_target_ = make_framebuffer({id_normal_, opaque_depth_, picked_depth_}, covered_);
        occlusion_target_ = make_framebuffer({occlusion_}, covered_);
        half_blur_target_ = make_framebuffer({half_blurred_}, covered_);
        blur_target_ = make_framebuffer({blurred_}, covered_);
        lit_target_ = make_framebuffer({lit_}, covered_);
        glass_surface_ = Texture();
        glass_depth_ = Texture();
        glass_target_ = Framebuffer();
        view_.picture.z = static_cast<float>(s);
    }
    if (size != size_) {
        picture_ = make_texture(GL_RGBA8, size.x, size.y);
        picture_target_ = make_framebuffer({picture_});
    }
    size_ = size;
    inner_ = inner;
    if (glGetError() != GL_NO_ERROR ||
        glCheckNamedFramebufferStatus(geometry_target_, GL_DRAW_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
        size_ = inner_ = glm::ivec2(0);
        return fail("a picture of " + std::to_string(size.x) + "x" + std::to_string(size.y) +
                        " pixels does not fit into graphics memory",
                    {}, "give a smaller size");
    }
    return {};
}

void Renderer::Impl::make_glass_layer() {
    if (glass_target_ != 0) return;
    const int s = static_cast<int>(view_.picture.z);
    glass_surface_ = make_texture(GL_RG32UI, inner_.x, inner_.y, s);
    glass_depth_ = make_texture(GL_DEPTH_COMPONENT32F, inner_.x, inner_.y, s);
    glass_target_ = make_framebuffer({glass_surface_}, glass_depth_);
}

// The frame as it can be drawn now: its mesh is the one that the graphics card has and that its quality asks for. The
// preview is sent first, and stands in until the mesh has come: drawing the mesh before it in full would be in vain.
Frame Renderer::Impl::take_up(const Frame& wanted, std::size_t upload_budget, DrawStatistics& done) {
    std::size_t left = upload_budget;
    preview_.follow(wanted.preview, left);
    mesh_.follow(wanted.mesh, left);
    done.uploaded = upload_budget - left;
    const bool mesh_there = mesh_.shown() == wanted.mesh;
    const bool preview_there = wanted.preview && preview_.shown() == wanted.preview;
    done.pending = !mesh_there || preview_.shown() != wanted.preview;
    Frame frame = wanted;
    if (preview_there && !mesh_there) frame.quality = Quality::kInteractive;
    const bool quick = preview_there && frame.quality == Quality::kInteractive;
    const GpuMesh& mesh = quick ? preview_ : mesh_;
    drawn_ = mesh.shown() && mesh.shown()->triangle_count() > 0 ? &mesh : nullptr;
    frame.mesh = mesh.shown();
    frame.preview = nullptr;
    done.quality = frame.quality;
    return frame;
}

// Draws over every pixel, or only where a surface is: the early depth test is the one branch that a software rasteriser
// really skips. The triangle lies at depth 0, the far plane.
void Renderer::Impl::fullscreen(const Program& program, Pixels pixels) const {
    if (pixels == Pixels::kCovered) {
        glEnable(GL_DEPTH_TEST);
        glDepthMask(GL_FALSE);
        glDepthFunc(GL_LESS);
    }
    glUseProgram(program);
    glBindVertexArray(no_vertices_);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
}

std::uint64_t Renderer::Impl::draw_geometry(const Frame& frame, const GpuMesh* mesh, const std::vector<Layer>& layers) {
    const Camera& camera = frame.camera;
    const Box box = mesh != nullptr ? mesh->shown()->bounds() : Box{};
    const CameraAxes axes = axes_of(camera);
    const double middle = glm::dot(box.centre() - camera.position, axes.forward), radius = 1.001 * box.radius();
    double far = middle + radius, near = middle - radius;
    if (!camera.orthographic) {
        far = std::max(far, 1e-3 * radius);
        near = std::max(near, 1e-4 * far);
    }

    // Reversed depth, 1 at the near plane and 0 at the far one: float depth is then as fine far away as near by.
    glm::dmat4 projection = projection_matrix(camera, frame.size, near, far);
    projection[2][2] = camera.orthographic ? 1.0 / (far - near) : near / (far - near);
    projection[3][2] = camera.orthographic ? far / (far - near) : near * far / (far - near);
    const glm::dmat4 view = view_matrix(camera);
    const glm::dvec3 origin = mesh != nullptr ? mesh->shown()->origin() : glm::dvec3(0.0);
    glm::dmat4 to_eye = view;
    to_eye[3] = view * glm::dvec4(origin, 1.0);
    const glm::dmat4 to_clip = projection * to_eye;

    const glm::vec2 size(inner_);
    const bool flat = camera.orthographic;
    const double mm_at_unit_depth =
        flat ? mm_per_pixel(camera, inner_) : 2.0 * std::tan(glm::radians(0.5 * camera.view_angle)) / size.y;
    const double reach = std::max(4.0, kOcclusionShare * size.y);
    // The depth cue spans the box's own depth.
    const glm::dvec3 half = 0.5 * (box.empty() ? glm::dvec3(1.0) : box.upper - box.lower);
    const double depth = std::max(glm::dot(half, glm::abs(axes.forward)), 1e-3 * radius);
    view_.clip_to_eye = flat ? glm::vec4(0.0F, -(far - near), far / (far - near), 0.0F)
                             : glm::vec4(0.0F, projection[2][2], projection[3][2], 0.0F);
    view_.pixel_to_eye = {0.5F * size.x, 0.5F * size.y, mm_at_unit_depth, 0.0F};
    view_.depth_range = {middle - depth, middle + depth, reach, reach * mm_at_unit_depth};
    view_.picture = {size.x, size.y, view_.picture.z, flat ? 1.0F : 0.0F};
    glNamedBufferSubData(view_block_, 0, sizeof view_, &view_);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_block_);

    has_glass_ = mesh != nullptr && std::ranges::find(layers, Layer::kGlass) != layers.end();
    if (has_glass_) make_glass_layer();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GREATER);
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
    glEnable(GL_MULTISAMPLE);
    std::uint64_t triangles = 0;
    for (const Layer layer : {Layer::kOpaque, Layer::kGlass}) {
        if (layer == Layer::kGlass && !has_glass_) break;
        const Framebuffer& target = layer == Layer::kOpaque ? geometry_target_ : glass_target_;
        glBindFramebuffer(GL_FRAMEBUFFER, target);
        const std::array<GLuint, 4> nothing{};
        const GLfloat farthest = 0.0F;
        glClearBufferuiv(GL_COLOR, 0, nothing.data());
        glClearBufferfv(GL_DEPTH, 0, &farthest);
        if (mesh == nullptr) continue;
        glUseProgram(geometry_);
        glUniformMatrix4fv(0, 1, GL_FALSE, glm::value_ptr(glm::mat4(to_clip)));
        glUniformMatrix3fv(1, 1, GL_FALSE, glm::value_ptr(glm::mat3(view)));
        triangles += mesh->draw(layers, layer, to_clip);
    }
    glDisable(GL_CULL_FACE);

    glBindFramebuffer(GL_FRAMEBUFFER, resolve_target_);
    glDepthFunc(GL_ALWAYS); // writes the covered pixels' depth
    glEnable(GL_DEPTH_TEST);
    glBindTextureUnit(0, surface_);
    glBindTextureUnit(1, depth_);
    glBindTextureUnit(2, has_glass_ ? glass_surface_ : surface_);
    glBindTextureUnit(3, has_glass_ ? glass_depth_ : depth_);
    glProgramUniform1i(resolve_, 0, has_glass_ ? 1 : 0);
    fullscreen(resolve_);
    return triangles;
}

void Renderer::Impl::draw_occlusion(const Frame& frame) {
    glBindTextureUnit(0, id_normal_);
    glBindTextureUnit(1, opaque_depth_);
    glBindFramebuffer(GL_FRAMEBUFFER, occlusion_target_);
    glProgramUniform1i(occlude_, 0, frame.quality == Quality::kFull ? kTaps : kInteractiveTaps);
    fullscreen(occlude_, Pixels::kCovered);
    for (const bool across : {true, false}) {
        glBindTextureUnit(0, across ? occlusion_ : half_blurred_);
        glBindFramebuffer(GL_FRAMEBUFFER, across ? half_blur_target_ : blur_target_);
        glProgramUniform2i(blur_, 0, across ? 1 : 0, across ? 0 : 1);
        fullscreen(blur_, Pixels::kCovered);
    }
}

Result<void> Renderer::Impl::shade(const Frame& frame, const GpuMesh* mesh) {
    // One small record a branch; nothing else changes when the user points at things.
    const auto count = static_cast<std::size_t>(std::max(1, mesh != nullptr ? mesh->shown()->branch_count() : 0));
    std::vector<std::array<std::uint8_t, 4>> records(count);
    const bool any_highlight = std::ranges::find(frame.states, BranchState::kHighlighted) != frame.states.end();
    const auto byte = [](float v) {
        return static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(v, 0.0F, 1.0F)));
    };
    for (std::size_t i = 0; i < count; ++i) {
        const BranchState state = i < frame.states.size() ? frame.states[i] : BranchState::kNormal;
        const bool highlighted = state == BranchState::kHighlighted;
        const glm::vec3 own = i < frame.colours.size() ? frame.colours[i] : frame.appearance.vessel;
        const glm::vec3 colour = highlighted ? frame.appearance.highlight : own;
        const int flags =
            (any_highlight && !highlighted ? 1 : 0) | (highlighted ? 2 : 0) | (int(i) == frame.hovered ? 4 : 0);
        records[i] = {byte(colour.x), byte(colour.y), byte(colour.z), static_cast<std::uint8_t>(flags)};
    }
    for (const int id : frame.hovered_dependents)
        if (id >= 0 && static_cast<std::size_t>(id) < count) records[static_cast<std::size_t>(id)][3] |= 16;
    bool any_selected = false;
    for (const int id : frame.selected) {
        if (id < 0 || static_cast<std::size_t>(id) >= count) continue;
        // An outline is dear; what is hidden has none.
        if (static_cast<std::size_t>(id) < frame.states.size() &&
            frame.states[static_cast<std::size_t>(id)] == BranchState::kHidden)
            continue;
        auto& flags = records[static_cast<std::size_t>(id)][3];
        flags = static_cast<std::uint8_t>((flags & ~1) | 8); // what is selected is never calm
        any_selected = true;
    }
    if (count > branch_capacity_) {
        branch_buffer_ = make_buffer();
        branch_capacity_ = count;
        glNamedBufferStorage(branch_buffer_, static_cast<GLsizeiptr>(4 * count), nullptr, GL_DYNAMIC_STORAGE_BIT);
        GLuint texture = 0;
        glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
        branch_texture_ = Texture(texture);
        glTextureBuffer(texture, GL_RGBA8UI, branch_buffer_);
    }
    glNamedBufferSubData(branch_buffer_, 0, static_cast<GLsizeiptr>(4 * count), records.data());

    const Appearance& a = frame.appearance;
    const Background& b = frame.background;
    const float outline =
        any_selected
            ? std::max(1.0F, 1.6F * frame.pixel_ratio * static_cast<float>(inner_.y) / static_cast<float>(size_.y))
            : 0.0F;
    const LookBlock look{glm::vec4(b.top, b.transparent ? 1.0F : 0.0F),
                         glm::vec4(b.bottom, a.depth_cue),
                         linear(a.glass, has_glass_ ? 1.0F : 0.0F),
                         linear(a.selection, outline),
                         {a.key, a.fill, a.rim, a.specular},
                         {a.occlusion, 0.0F, 0.0F, 0.0F}};
    glNamedBufferSubData(look_block_, 0, sizeof look, &look);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, view_block_);
    glBindBufferBase(GL_UNIFORM_BUFFER, 1, look_block_);
    glBindTextureUnit(0, surface_);
    glBindTextureUnit(1, depth_);
    glBindTextureUnit(2, has_glass_ ? glass_surface_ : surface_);
    glBindTextureUnit(3, has_glass_ ? glass_depth_ : depth_);
    glBindTextureUnit(4, id_normal_);
    glBindTextureUnit(5, blurred_);
    glBindTextureUnit(6, branch_texture_);
    glBindFramebuffer(GL_FRAMEBUFFER, lit_target_);
    fullscreen(background_);
    const std::size_t variant = (has_glass_ ? 1U : 0U) + (any_selected ? 2U : 0U);
    if (shade_[variant] == 0) {
        constexpr std::array kDefines{"", "#define GLASS\n", "#define OUTLINE\n", "#define GLASS\n#define OUTLINE\n"};
        auto made = make_program("fullscreen.vert", "shade.frag", kDefines[variant]);
        if (!made) return tl::unexpected(made.error());
        shade_[variant] = std::move(*made);
    }
    // An outline reaches beyond the surface it surrounds.
    fullscreen(shade_[variant], any_selected ? Pixels::kAll : Pixels::kCovered);
    return {};
}

void Renderer::Impl::draw_overlays(const Frame& frame) {
    glBindFramebuffer(GL_FRAMEBUFFER, picture_target_);
    glViewport(0, 0, size_.x, size_.y);
    if (inner_ == size_) {
        glBlitNamedFramebuffer(lit_target_, picture_target_, 0, 0, size_.x, size_.y, 0, 0, size_.x, size_.y,
                               GL_COLOR_BUFFER_BIT, GL_NEAREST);
    } else {
        glBindTextureUnit(0, lit_);
        fullscreen(enlarge_);
    }
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    for (const Sprite& sprite : overlays_of(frame, default_font())) {
        const Image& image = sprite.image;
        const Texture texture = make_texture(GL_RGBA8, image.width, image.height);
        glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
        glTextureSubImage2D(texture, 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
        const int x = sprite.corner.x, y = frame.size.y - sprite.corner.y - image.height;
        glScissor(x, y, image.width, image.height);
        glBindTextureUnit(0, texture);
        glProgramUniform2i(overlay_, 0, x, y);
        fullscreen(overlay_);
    }
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

// OpenGL's own defaults, for whoever draws next into the window.
void Renderer::Impl::restore_state() const {
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    glBindVertexArray(0);
    glUseProgram(0);
    for (GLuint unit = 0; unit < 7; ++unit) glBindTextureUnit(unit, 0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Result<DrawStatistics> Renderer::Impl::draw(const Frame& wanted, std::size_t upload_budget) {
    DrawStatistics done;
    if (auto fits = check_size(wanted.size.x, wanted.size.y); !fits) return tl::unexpected(fits.error());
    const Frame frame = take_up(wanted, upload_budget, done);
    if (last_ && *last_ == frame) return done;
    const glm::ivec2 old_size = size_, old_inner = inner_;
    if (auto resized = resize(frame.size, frame.quality); !resized) {
        last_.reset();
        return tl::unexpected(resized.error());
    }
    std::vector<Layer> layers(frame.states.size());
    std::ranges::transform(frame.states, layers.begin(), layer_of);
    while (!layers.empty() && layers.back() == Layer::kOpaque) layers.pop_back();

    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_STENCIL_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glViewport(0, 0, inner_.x, inner_.y);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    const bool same_geometry = last_ && last_->mesh == frame.mesh && last_->camera == frame.camera &&
                               size_ == old_size && inner_ == old_inner && last_->quality == frame.quality &&
                               last_layers_ == layers &&
                               (last_->appearance.occlusion > 0.0F || !(frame.appearance.occlusion > 0.0F));
    if (!same_geometry) {
        done.triangles = draw_geometry(frame, drawn_, layers);
        if (frame.appearance.occlusion > 0.0F) draw_occlusion(frame);
        done.geometry = true;
    }
    if (auto shaded = shade(frame, drawn_); !shaded) {
        last_.reset();
        return tl::unexpected(shaded.error());
    }
    draw_overlays(frame);
    done.shaded = true;
    restore_state();
    last_ = frame;
    last_layers_ = std::move(layers);
    if (const int errors = gl_error_count(); errors != 0 && glGetError() == GL_OUT_OF_MEMORY) {
        last_.reset();
        return fail("out of graphics memory", {}, "give a smaller size or a coarser --detail");
    }
    return done;
}

Image Renderer::Impl::read_image() const {
    Image image(size_.x, size_.y);
    if (size_.x == 0) return image;
    Image upside_down(size_.x, size_.y);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glGetTextureImage(picture_, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(upside_down.rgba.size()),
                      upside_down.rgba.data());
    const std::size_t row = 4 * static_cast<std::size_t>(size_.x);
    for (int y = 0; y < size_.y; ++y) std::copy_n(upside_down.pixel(0, size_.y - 1 - y), row, image.pixel(0, y));
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const int alpha = image.rgba[i + 3];
        if (alpha == 0 || alpha == 255) continue;
        for (std::size_t k = i; k < i + 3; ++k)
            image.rgba[k] = static_cast<std::uint8_t>(std::min(255, (image.rgba[k] * 255 + alpha / 2) / alpha));
    }
    return image;
}

void Renderer::Impl::present(unsigned framebuffer, int x, int y) const {
    if (size_.x == 0) return;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(picture_target_, framebuffer, 0, 0, size_.x, size_.y, x, y, x + size_.x, y + size_.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
}

} // namespace ramus::render
