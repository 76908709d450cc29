// Glass where shaders cannot write lists (before OpenGL 4.3): layer by layer. Each pass draws the glass again and
// keeps, in every pixel, the nearest pane behind the one before (depth peeling: C. Everitt, Interactive
// Order-Independent Transparency, 2001); that one goes onto those before it, sample by sample, as a list's next pane
// would. The picture is that of the lists.
//
// Where it differs: of panes with the very same depth at a sample one is seen; and what lies behind kMostLayers panes
// of one pixel is not. A pane is a triangle: a layer of glass is one to four of them where edges cross the pixel.
// Branches beyond 8 million have no number here.
#include "render/renderer/renderer_impl.h"

#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace ramus::render {

namespace {

constexpr int kMostLayers = 128;

} // namespace

void Renderer::Impl::make_layers() {
    if (layer_panes_ != 0) return;
    const int samples = static_cast<int>(view_.picture.z);
    Texture panes = make_texture(GL_RG32UI, inner_.x, inner_.y, samples);
    for (std::size_t i = 0; i < layer_depths_.size(); ++i) {
        layer_depths_[i] = make_texture(GL_DEPTH_COMPONENT32F, inner_.x, inner_.y, samples);
        layer_targets_[i] = make_framebuffer({panes}, layer_depths_[i]);
    }
    fronts_ = make_deep_texture(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, inner_.x, inner_.y, kMostSamples);
    fronts_target_ = make_framebuffer({}, covered_);
    std::array<GLenum, kMostSamples> attachments{};
    for (int s = 0; s < kMostSamples; ++s) {
        attachments[std::size_t(s)] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(s);
        glNamedFramebufferTextureLayer(fronts_target_, attachments[std::size_t(s)], fronts_, 0, s);
    }
    glNamedFramebufferDrawBuffers(fronts_target_, kMostSamples, attachments.data());
    if (layer_query_ == 0) {
        GLuint id = 0;
        glGenQueries(1, &id);
        layer_query_ = Query(id);
    }
    layer_panes_ = std::move(panes); // the last: all is there
}

// Where the samples of a pixel lie, from its middle.
void Renderer::Impl::find_sample_places() {
    glBindFramebuffer(GL_FRAMEBUFFER, geometry_target_);
    for (int s = 0; s < static_cast<int>(view_.picture.z); ++s) {
        glm::vec2 place(0.5F);
        if (view_.picture.z > 1.0F) glGetMultisamplefv(GL_SAMPLE_POSITION, static_cast<GLuint>(s), &place.x);
        sample_places_.at(std::size_t(s)) = place - 0.5F;
    }
}

// Triangles that are cut in two inside a pixel. From 4.0 on a shader chooses samples; before, each is drawn by itself.
void Renderer::Impl::draw_by_sample(const Program& program, const std::function<void()>& draw) const {
    if (gl_has_lists()) return draw();
    glEnable(GL_SAMPLE_MASK);
    for (int s = 0; s < static_cast<int>(view_.picture.z); ++s) {
        glSampleMaski(0, GLbitfield{1} << s);
        glProgramUniform2f(program, kUniformSamplePosition, sample_places_.at(std::size_t(s)).x,
                           sample_places_.at(std::size_t(s)).y);
        draw();
    }
    glSampleMaski(0, ~GLbitfield{0});
    glDisable(GL_SAMPLE_MASK);
}

// Into layer_panes_ and layer_depths_[layer % 2]; false: no pane is left.
bool Renderer::Impl::draw_layer(const Frame& frame, const GpuMesh& mesh, int layer, LayerOf what,
                                std::uint64_t& triangles) {
    glBindFramebuffer(GL_FRAMEBUFFER, layer_targets_.at(std::size_t(layer % 2)));
    take_front_faces(true);
    clear_samples();
    const auto use = [&](const Program& program) {
        glUseProgram(program);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(mesh_to_clip_)));
        glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(glm::mat3(view_matrix(frame.camera))));
        glUniform1i(kUniformSamples, static_cast<GLint>(view_.picture.z));
        glUniform1i(kUniformLayer, layer);
        glUniform2fv(kUniformSamplePositions, kMostSamples, &sample_places_[0].x);
        glBindTextureUnit(kUnitOpaqueSamples, depth_);
        glBindTextureUnit(kUnitLastLayer, layer_depths_.at(std::size_t(1 - layer % 2)));
    };
    glBeginQuery(GL_ANY_SAMPLES_PASSED, layer_query_);
    use(fragment_);
    triangles += mesh.draw(mesh.choose(layers_, Layer::kGlass, mesh_to_clip_));
    use(border_fragment_);
    glBindTextureUnit(kUnitLayers, layer_texture_);
    triangles += mesh.draw(mesh.choose_borders(layers_, Layer::kGlass, mesh_to_clip_));
    end_borders();
    if (what == LayerOf::kEverything) triangles += draw_clear_layer(frame, Clear::kAll, layer);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    GLuint any = GL_FALSE;
    glGetQueryObjectuiv(layer_query_, GL_QUERY_RESULT, &any);
    return any != GL_FALSE;
}

// The vessels' nearest layer alone, for what is picked and outlined, where context and lesions are, and the lesions'
// nearest layer alone, which is picked through no glass; shading peels the others.
std::uint64_t Renderer::Impl::draw_first_layer(const Frame& frame, const GpuMesh& mesh) {
    make_layers();
    std::uint64_t triangles = draw_first_clear_layer(frame, Clear::kAll, 1);
    (void)draw_layer(frame, mesh, 0, LayerOf::kVessels, triangles);
    bands_ = {{0, inner_.y}};
    resolve(bands_.front());
    if (has_lesions(frame)) {
        triangles += draw_first_clear_layer(frame, Clear::kLesions, 0);
        resolve_by(resolve_lesions_, bands_.front());
    }
    return triangles;
}

// All layers into fronts_, front to back. The blocks and the branches' records are those of the shading that follows.
Result<void> Renderer::Impl::peel(const Frame& frame, const GpuMesh& mesh, unsigned variant) {
    const auto program = shading(kGlass | kLayer | (variant & (kCuts | kContext)));
    if (!program) return tl::unexpected(program.error());
    glBindFramebuffer(GL_FRAMEBUFFER, fronts_target_);
    const std::array<GLfloat, 4> clear{};
    for (GLint s = 0; s < kMostSamples; ++s) glClearBufferfv(GL_COLOR, s, clear.data());
    std::uint64_t triangles = 0;
    for (int layer = 0; layer < kMostLayers && draw_layer(frame, mesh, layer, LayerOf::kEverything, triangles);
         ++layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, fronts_target_);
        glBindTextureUnit(kUnitSurface, layer_panes_);
        glBindTextureUnit(kUnitDepth, layer_depths_.at(std::size_t(layer % 2)));
        glBindTextureUnit(kUnitContext, context_texture_);
        glBindTextureUnit(kUnitBranches, branch_texture_);
        glBindTextureUnit(kUnitOpaqueSamples, depth_);
        glEnable(GL_BLEND);
        glBlendEquation(GL_FUNC_ADD);
        glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
        fullscreen(**program, Pixels::kCovered);
        glDisable(GL_BLEND);
    }
    glBindTextureUnit(kUnitFronts, fronts_);
    return {};
}

} // namespace ramus::render
