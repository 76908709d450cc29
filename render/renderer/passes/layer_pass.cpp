#include "render/renderer/passes/gl_state.h"
#include "render/renderer/passes/glass_pass.h"
#include "render/renderer/passes/surface_pass.h"

#include <array>

namespace ramus::render {

namespace {

constexpr int kMostLayers = 128;

void make_layers(GlassLayers& layers, const ViewSetup& view, GLuint covered) {
    if (layers.fragments != 0) return;
    Texture fragments = make_texture(GL_RG32UI, view.size.x, view.size.y, view.samples);
    for (std::size_t i = 0; i < layers.depths.size(); ++i) {
        layers.depths[i] = make_texture(GL_DEPTH_COMPONENT32F, view.size.x, view.size.y, view.samples);
        layers.framebuffers[i] = make_framebuffer({fragments}, layers.depths[i]);
    }
    layers.fronts = make_deep_texture(GL_TEXTURE_2D_ARRAY, GL_RGBA32F, view.size.x, view.size.y, kMostSamples);
    layers.fronts_framebuffer = make_framebuffer({}, covered);
    std::array<GLenum, kMostSamples> attachments{};
    for (int s = 0; s < kMostSamples; ++s) {
        attachments[std::size_t(s)] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(s);
        glNamedFramebufferTextureLayer(layers.fronts_framebuffer, attachments[std::size_t(s)], layers.fronts, 0, s);
    }
    glNamedFramebufferDrawBuffers(layers.fronts_framebuffer, kMostSamples, attachments.data());
    layers.fragments = std::move(fragments); // the last: all is there
}

// For a program that keeps what lies behind the layer before.
void bind_layer_before(const ViewTargets& targets, int layer) {
    glUniform1i(kUniformSamples, targets.view.samples);
    glUniform1i(kUniformLayer, layer);
    glUniform2fv(kUniformSamplePositions, kMostSamples, &targets.samples.positions[0].x);
    glBindTextureUnit(kUnitOpaqueSamples, targets.samples.depth);
    glBindTextureUnit(kUnitLastLayer, layer == 0 ? 0 : GLuint(targets.layers.depths.at(std::size_t(1 - layer % 2))));
}

} // namespace

Result<void> LayerPass::make() {
    GLuint id = 0;
    glGenQueries(1, &id);
    any_left_ = Query(id);
    constexpr const char *kGlass = "#define TRANSPARENT\n", *kBorders = "#define TRANSPARENT\n#define BORDER\n";
    return make_programs({{&vessels_, "geometry.vert", "fragment_layer.frag", kGlass},
                          {&borders_, "geometry.vert", "fragment_layer.frag", kBorders, "border.geom"}});
}

// Into the layers' fragments and depths[layer % 2]; false: no fragment is left.
bool LayerPass::draw_layer(const Subject& subject, const ViewTargets& targets, int layer, Of what,
                           std::uint64_t& triangles) const {
    const ViewSetup& view = targets.view;
    const GpuMesh& mesh = subject.mesh;
    BranchLayers& layers = subject.scene.branch_layers();
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    glBindFramebuffer(GL_FRAMEBUFFER, targets.layers.framebuffers.at(std::size_t(layer % 2)));
    draw_front_faces(true);
    clear_samples();
    glBeginQuery(GL_ANY_SAMPLES_PASSED, any_left_);
    use_for_vessels(vessels_, subject, view);
    bind_layer_before(targets, layer);
    triangles += mesh.draw(mesh.choose(layers.all, Layer::kGlass, to_clip));
    use_for_vessels(borders_, subject, view);
    bind_layer_before(targets, layer);
    glBindTextureUnit(kUnitLayers, layers.table);
    triangles += mesh.draw(mesh.choose_borders(layers.all, Layer::kGlass, to_clip));
    end_borders();
    if (what == Of::kEverything) triangles += draw_clear(subject, targets, ContextPass::Clear::kAll, layer);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    GLuint any = GL_FALSE;
    glGetQueryObjectuiv(any_left_, GL_QUERY_RESULT, &any);
    return any != GL_FALSE;
}

// What draw_layer() draws of what is clear.
std::uint64_t LayerPass::draw_clear(const Subject& subject, const ViewTargets& targets, ContextPass::Clear what,
                                    int layer) const {
    return context_.draw_clear(subject, targets.view, what, [&](const Program&) { bind_layer_before(targets, layer); });
}

// Their nearest layer alone: into the layers' fragments and the depths of `target`.
std::uint64_t LayerPass::draw_first_clear(const Subject& subject, const ViewTargets& targets, ContextPass::Clear what,
                                          std::size_t target) const {
    glBindFramebuffer(GL_FRAMEBUFFER, targets.layers.framebuffers.at(target));
    draw_front_faces(true);
    clear_samples();
    const std::uint64_t triangles = draw_clear(subject, targets, what, 0);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    return triangles;
}

std::uint64_t LayerPass::draw_first(const Subject& subject, ViewTargets& targets) const {
    make_layers(targets.layers, targets.view, targets.resolved.covered);
    const Band all{0, targets.view.size.y};
    std::uint64_t triangles = draw_first_clear(subject, targets, ContextPass::Clear::kAll, 1);
    (void)draw_layer(subject, targets, 0, Of::kVessels, triangles);
    resolve_.draw(ResolvePass::What::kGlass, targets, all);
    if (subject.has_lesions()) {
        triangles += draw_first_clear(subject, targets, ContextPass::Clear::kLesions, 0);
        resolve_.draw(ResolvePass::What::kLesions, targets, all);
    }
    return triangles;
}

void LayerPass::draw_all(const Subject& subject, ViewTargets& targets, const Fullscreen& light) const {
    const GlassLayers& layers = targets.layers;
    glBindFramebuffer(GL_FRAMEBUFFER, layers.fronts_framebuffer);
    const std::array<GLfloat, 4> clear{};
    for (GLint s = 0; s < kMostSamples; ++s) glClearBufferfv(GL_COLOR, s, clear.data());
    std::uint64_t triangles = 0;
    for (int layer = 0; layer < kMostLayers && draw_layer(subject, targets, layer, Of::kEverything, triangles);
         ++layer) {
        glBindFramebuffer(GL_FRAMEBUFFER, layers.fronts_framebuffer);
        glBindTextureUnit(kUnitSurface, layers.fragments);
        glBindTextureUnit(kUnitDepth, layers.depths.at(std::size_t(layer % 2)));
        glBindTextureUnit(kUnitOpaqueSamples, targets.samples.depth);
        begin_blending(Blending::kUnder);
        light.draw(Fullscreen::Pixels::kCovered);
        glDisable(GL_BLEND);
    }
    glBindTextureUnit(kUnitFronts, layers.fronts);
}

} // namespace ramus::render
