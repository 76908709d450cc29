#include "render/renderer/passes/glass_pass.h"

#include "render/gl/gl_context.h"
#include "render/renderer/passes/gl_state.h"

#include <algorithm>
#include <array>

namespace ramus::render {

namespace {

constexpr std::size_t kFragmentBytes = 16;
constexpr std::size_t kFirstFragments = std::size_t{1} << 20;

Buffer make_storage(std::size_t bytes) { return make_buffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT); }

// Clears the lists of the band's pixels.
void clear_lists(FragmentLists& lists, std::size_t pixels) {
    if (lists.head_capacity < pixels) {
        lists.heads = make_storage(4 * pixels);
        lists.head_capacity = pixels;
    }
    if (lists.count == 0) lists.count = make_storage(4);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // the previous band's lists have been read
    const GLuint zero = 0;
    glClearNamedBufferSubData(lists.heads, GL_R32UI, 0, static_cast<GLsizeiptr>(4 * pixels), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    glNamedBufferSubData(lists.count, 0, 4, &zero);
}

void begin_band(const ViewTargets& targets, Band band) {
    glBindFramebuffer(GL_FRAMEBUFFER, targets.lists.framebuffer);
    draw_front_faces(false);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, band.first, targets.view.size.x, band.count);
}

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
    layers.fragments = std::move(fragments); // last: everything is allocated
}

// Binds the previous layer, for a program that keeps fragments behind it.
void bind_layer_before(const ViewTargets& targets, int layer) {
    glUniform1i(kUniformSamples, targets.view.samples);
    glUniform1i(kUniformLayer, layer);
    glUniform2fv(kUniformSamplePositions, kMostSamples, &targets.samples.positions[0].x);
    glBindTextureUnit(kUnitOpaqueSamples, targets.samples.depth);
    glBindTextureUnit(kUnitLastLayer, layer == 0 ? 0 : GLuint(targets.layers.depths.at(std::size_t(1 - layer % 2))));
}

} // namespace

Result<void> GlassPass::make() {
    constexpr const char *kGlass = "#define TRANSPARENT\n", *kBorders = "#define TRANSPARENT\n#define BORDER\n";
    return make_programs({{&vessels_, "geometry.vert", "fragment.frag", kGlass},
                          {&borders_, "geometry.vert", "fragment.frag", kBorders, "border.geom"}});
}

// Grows the lists; false: the limit is reached. Fragments are numbered from 1.
bool FragmentListPass::grow(FragmentLists& lists, std::size_t wanted) const {
    GLint64 largest = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    const std::size_t most = std::min(most_bytes_, static_cast<std::size_t>(largest)) / kFragmentBytes - 1;
    if (lists.capacity >= most) return false;
    const std::size_t capacity = std::min(most, std::max(kFirstFragments, wanted + wanted / 4));
    try {
        lists.fragments = make_storage((capacity + 1) * kFragmentBytes);
    } catch (const OutOfGraphicsMemory&) {
        if (lists.capacity == 0) throw;
        return false; // use bands instead
    }
    lists.capacity = capacity;
    return true;
}

// Collects fragments, unsorted.
InParts<FragmentListPass::Listed> FragmentListPass::list(const Subject& subject, ViewTargets& targets,
                                                         Band band) const {
    FragmentLists& lists = targets.lists;
    const ViewSetup& view = targets.view;
    clear_lists(lists, std::size_t(view.size.x) * std::size_t(band.count));
    const auto prepare = [&](const Program& program) {
        bind_lists(program, targets, band);
        glUniform1ui(kUniformCapacity, static_cast<GLuint>(lists.capacity));
    };
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    Listed listed;
    for (const bool borders : {false, true}) {
        const Program& program = borders ? borders_ : vessels_;
        const GpuMesh::Ranges ranges = borders ? subject.mesh.choose_borders(subject.layers, Layer::kGlass, to_clip)
                                               : subject.mesh.choose(subject.layers, Layer::kGlass, to_clip);
        for (std::size_t part = 0; part < ranges.parts(); ++part) {
            begin_band(targets, band);
            use_for_vessels(program, subject, view);
            prepare(program);
            if (subject.frame.cut_away) glDisable(GL_CULL_FACE); // the cut shows the inside
            if (borders) glUniform1i(kUniformSamples, view.samples);
            subject.mesh.draw_part(ranges, part);
            end_borders();
            co_await kPartEnds;
        }
        listed.triangles += ranges.triangles();
    }
    InParts<std::uint64_t> clear = context_.draw_clear(
        subject, view, ContextPass::Clear::kAll, [&targets, band] { begin_band(targets, band); }, prepare);
    while (clear.resume()) co_await kPartEnds;
    listed.triangles += clear.result();
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint count = 0;
    glGetNamedBufferSubData(lists.count, 0, 4, &count);
    listed.fragments = count;
    co_return listed;
}

InParts<Result<std::uint64_t>> FragmentListPass::draw(const Subject& subject, ViewTargets& targets) const {
    FragmentLists& lists = targets.lists;
    std::uint64_t triangles = 0;
    if (lists.capacity == 0) grow(lists, 0);
    lists.bands.clear();
    std::vector<Band> todo{{0, targets.view.size.y}};
    while (!todo.empty()) {
        const Band band = todo.back();
        InParts<Listed> listing = list(subject, targets, band);
        while (listing.resume()) co_await kPartEnds;
        const Listed listed = listing.result();
        if (listed.fragments > lists.capacity && grow(lists, listed.fragments)) continue;
        todo.pop_back();
        triangles += listed.triangles;
        if (listed.fragments <= lists.capacity) {
            resolve_.draw(ResolvePass::What::kGlass, targets, band);
            lists.bands.push_back(band);
        } else if (band.count > 1) {
            const int half = band.count / 2;
            todo.push_back({band.first + half, band.count - half});
            todo.push_back({band.first, half});
        } else {
            co_return fail("too many layers of glass lie behind each other", {},
                           "give a smaller size, or hide some of it");
        }
    }
    co_return triangles;
}

void FragmentListPass::draw_again(const Subject& subject, ViewTargets& targets, Band band) const {
    list(subject, targets, band).finish();
    resolve_.draw(ResolvePass::What::kGlass, targets, band);
}

Result<void> LayerPass::make() {
    any_left_ = created<Query>(glGenQueries);
    return GlassPass::make();
}

// Draws into `fragments` and depths[layer % 2]; false: no fragment is left.
bool LayerPass::draw_layer(const Subject& subject, const ViewTargets& targets, int layer, Of what,
                           std::uint64_t& triangles) const {
    const ViewSetup& view = targets.view;
    const GpuMesh& mesh = subject.mesh;
    const glm::dmat4 to_clip = subject.mesh_to_clip(view);
    glBindFramebuffer(GL_FRAMEBUFFER, targets.layers.framebuffers.at(std::size_t(layer % 2)));
    draw_front_faces(true);
    clear_samples();
    glBeginQuery(GL_ANY_SAMPLES_PASSED, any_left_);
    if (subject.frame.cut_away) glDisable(GL_CULL_FACE); // the cut shows the inside
    use_for_vessels(vessels_, subject, view);
    bind_layer_before(targets, layer);
    triangles += mesh.draw(mesh.choose(subject.layers, Layer::kGlass, to_clip));
    use_for_vessels(borders_, subject, view);
    bind_layer_before(targets, layer);
    triangles += mesh.draw(mesh.choose_borders(subject.layers, Layer::kGlass, to_clip));
    end_borders();
    if (what == Of::kEverything) triangles += draw_clear(subject, targets, ContextPass::Clear::kAll, layer);
    glEndQuery(GL_ANY_SAMPLES_PASSED);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    GLuint any = GL_FALSE;
    glGetQueryObjectuiv(any_left_, GL_QUERY_RESULT, &any);
    return any != GL_FALSE;
}

// Draws the transparent shapes of draw_layer().
std::uint64_t LayerPass::draw_clear(const Subject& subject, const ViewTargets& targets, ContextPass::Clear what,
                                    int layer) const {
    const auto bind = [&](const Program&) { bind_layer_before(targets, layer); };
    return context_
        .draw_clear(
            subject, targets.view, what, [] {}, bind)
        .finish();
}

// Draws only the nearest layer of shapes, into `fragments` and the depths of `target`.
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
        glBindTextureUnit(kUnitFirstFragments, targets.samples.id_normal);
        begin_blending(Blending::kUnder);
        light.draw_in(glm::ivec2(0), targets.view.size, Fullscreen::Pixels::kCovered);
        glDisable(GL_BLEND);
    }
    glBindTextureUnit(kUnitFronts, layers.fronts);
}

} // namespace ramus::render
