#include "render/renderer/passes/resolve_pass.h"

#include "render/gl/gl_context.h"

namespace ramus::render {

namespace {

constexpr int kTaps = 20, kInteractiveTaps = 7;

} // namespace

void bind_lists(GLuint program, const ViewTargets& targets, Band band) {
    glProgramUniform2i(program, kUniformBand, targets.view.size.x, band.first);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageHeads, targets.lists.heads);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageFragments, targets.lists.fragments);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageCount, targets.lists.count);
}

void set_caps(GLuint program, const ViewSetup& view) {
    if (!view.cap_values) return;
    const glm::vec4& values = *view.cap_values;
    glProgramUniform4f(program, kUniformCapValues, values.x, values.y, values.z, values.w);
}

Result<void> ResolvePass::Programs::make(const std::string& defines) {
    if (auto made = opaque.make("resolve.frag", defines); !made) return made;
    if (auto made = glass.make("resolve.frag", defines + "#define GLASS\n"); !made) return made;
    if (gl_has_lists()) return {};
    return lesions.make("resolve.frag", defines + "#define GLASS\n#define LESIONS\n");
}

Result<void> ResolvePass::make() { return plain_.make({}); }

Result<void> ResolvePass::make_capped() {
    return capped_.opaque.made() ? Result<void>() : capped_.make("#define CAPS\n");
}

void ResolvePass::draw(What what, ViewTargets& targets, Band band) const {
    const Programs& programs = targets.view.cap_values ? capped_ : plain_;
    const Fullscreen& program = what == What::kOpaque  ? programs.opaque
                                : what == What::kGlass ? programs.glass
                                                       : programs.lesions;
    set_caps(program, targets.view);
    const bool lists = what != What::kOpaque && gl_has_lists();
    glBindFramebuffer(GL_FRAMEBUFFER, targets.resolved.framebuffer);
    glBindTextureUnit(kUnitSurface, targets.samples.id_normal);
    glBindTextureUnit(kUnitDepth, targets.samples.depth);
    if (lists) bind_lists(program, targets, band);
    if (what != What::kOpaque && !lists) {
        glBindTextureUnit(kUnitFirstFragments, targets.layers.fragments);
        glBindTextureUnit(kUnitFirstDepths, targets.layers.depths[0]);
        glBindTextureUnit(kUnitContextDepths, targets.layers.depths[1]);
    }
    program.draw_in({0, band.first}, {targets.view.size.x, band.count}, Fullscreen::Pixels::kAllDepths);
    if (lists) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

Result<void> OcclusionPass::make() {
    if (auto made = taps_.make("occlusion.frag"); !made) return made;
    if (auto made = with_shadows_.make("occlusion.frag", "#define SHADOWS\n"); !made) return made;
    return blur_.make("occlusion_blur.frag");
}

void OcclusionPass::draw(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from,
                         const OcclusionTarget& to) const {
    const Fullscreen& taps = frame.appearance.shadows > 0.0F ? with_shadows_ : taps_;
    glBindTextureUnit(kUnitIdNormal, from.id_normal);
    glBindTextureUnit(kUnitOpaqueDepth, from.opaque_depth);
    glBindFramebuffer(GL_FRAMEBUFFER, to.raw_target);
    glProgramUniform1i(taps, kUniformTaps, frame.quality == Quality::kFull ? kTaps : kInteractiveTaps);
    glProgramUniform1f(taps, kUniformTurned, static_cast<float>(view.shift) / float{kFineViews});
    taps.draw_in(glm::ivec2(0), view.size, Fullscreen::Pixels::kCovered);
    for (const bool across : {true, false}) {
        glBindTextureUnit(kUnitOcclusion, across ? to.raw : to.half_blurred);
        glBindFramebuffer(GL_FRAMEBUFFER, across ? to.half_target : to.blurred_target);
        glProgramUniform2i(blur_, kUniformAlong, across ? 1 : 0, across ? 0 : 1);
        blur_.draw_in(glm::ivec2(0), view.size, Fullscreen::Pixels::kCovered);
    }
}

} // namespace ramus::render
