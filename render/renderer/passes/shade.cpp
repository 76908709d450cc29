#include "render/renderer/renderer_impl.h"
#include "render/scene/colour.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>

namespace ramus::render {

using namespace record;

namespace {

constexpr float kLesionOpacity = 0.6F; // where they face the eye (tuned by eye: solid, and vessels inside show)

// Linear, of 65535.
std::uint16_t linear_word(float srgb) {
    return static_cast<std::uint16_t>(std::lround(65535.0F * linear(std::clamp(srgb, 0.0F, 1.0F))));
}

bool hidden(const Frame& frame, std::size_t id) {
    return id < frame.states.size() && frame.states[id] == BranchState::kHidden;
}

} // namespace

// One small record a branch; nothing else changes when the user points at things. Returns the variants that they need.
unsigned Renderer::Impl::send_records(const Frame& frame, const GpuMesh* mesh, Extent extent) {
    // Cones and lines may be of branches that the surface does not have yet.
    const std::size_t lines = lines_.shown() != nullptr ? lines_.shown()->runs.size() : 0;
    const auto count =
        std::max({std::size_t{1}, lines, mesh != nullptr ? std::size_t(mesh->shown()->branch_count()) : 0});
    std::vector<std::array<std::uint16_t, 4>> records(count);
    const bool any_highlight = std::ranges::find(frame.states, BranchState::kHighlighted) != frame.states.end();
    unsigned variant = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const BranchState state = i < frame.states.size() ? frame.states[i] : BranchState::kNormal;
        const bool highlighted = state == BranchState::kHighlighted;
        const glm::vec3 own = i < frame.colours.size() ? frame.colours[i] : frame.appearance.vessel;
        const glm::vec3 colour = highlighted ? frame.appearance.highlight : own;
        unsigned flags = (any_highlight && !highlighted ? kCalm : 0U) | (highlighted ? kHighlighted : 0U) |
                         (int(i) == frame.hovered ? kHovered : 0U);
        records[i] = {linear_word(colour.x), linear_word(colour.y), linear_word(colour.z),
                      static_cast<std::uint16_t>(flags)};
    }
    for (const int id : frame.hovered_dependents)
        if (id >= 0 && static_cast<std::size_t>(id) < count) records[static_cast<std::size_t>(id)][3] |= kGlowing;
    for (const int id : frame.selected) {
        const auto index = static_cast<std::size_t>(id);
        if (id < 0 || index >= count || hidden(frame, index)) continue; // an outline is dear; what is hidden has none
        std::uint16_t& flags = records[index][3];
        flags = static_cast<std::uint16_t>((flags & ~kCalm) | kSelected); // what is selected is never calm
        variant |= kOutline;
    }
    for (const LostPart& part : frame.lost) {
        const auto index = static_cast<std::size_t>(part.branch);
        const bool somewhere = part.whole() || (lines_.shown() && lines_.shown()->at(part.branch, 0.0));
        if (part.branch < 0 || index >= count || !somewhere) continue;
        records[index][3] |= part.whole() ? kLost : kCut;
        variant |= kCuts;
    }
    auto marked = records;
    region_at_ = glm::ivec2(0);
    region_size_ = inner_;
    if (extent == Extent::kChanged) {
        std::vector<std::uint8_t> changed(count, 0);
        for (std::size_t i = 0; i < count; ++i) {
            if (i < records_.size() && records[i] == records_[i]) continue;
            marked[i][3] |= kChanged;
            changed[i] = 1;
        }
        if (mesh != nullptr) find_region(frame, *mesh->shown(), changed);
    }
    records_ = std::move(records);
    if (count > branch_capacity_) {
        branch_capacity_ = count;
        make_buffer_texture(branch_buffer_, branch_texture_, GL_RGBA16UI, nullptr, sizeof(records_[0]) * count);
    }
    glNamedBufferSubData(branch_buffer_, 0, static_cast<GLsizeiptr>(sizeof(records_[0]) * count), marked.data());
    return variant;
}

// By the bounds of the pages that have triangles of them: there are some hundred, each in one place. Lines reach beyond
// pages, and a picture that is enlarged has no pixels of its own: they are drawn as a whole.
void Renderer::Impl::find_region(const Frame& frame, const PagedMesh& mesh, const std::vector<std::uint8_t>& changed) {
    if (has_glass_ || !frame.lines.empty() || frame.skeleton || inner_ != size_) return;
    const Projector project(frame.camera, frame.size);
    glm::dvec2 lower(frame.size), upper(0.0);
    for (const auto& page : mesh.triangle_pages()) {
        const auto has_changed = [&](std::int32_t branch) { return changed[static_cast<std::size_t>(branch)] != 0; };
        const bool any =
            std::ranges::any_of(page->runs, has_changed, &TrianglePage::Run::branch) ||
            std::ranges::any_of(page->borders, [&](const auto& p) { return has_changed(p[0]) || has_changed(p[1]); });
        if (page->count == 0 || !any) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const auto at = project(mesh.origin() + glm::dvec3(glm::mix(page->lower, page->upper, high)));
            if (!at) return; // behind the eye
            lower = glm::min(lower, glm::dvec2(*at));
            upper = glm::max(upper, glm::dvec2(*at));
        }
    }
    constexpr double kRounding = 2.0; // pixels
    const glm::ivec2 first(glm::clamp(glm::floor(lower - kRounding), glm::dvec2(0.0), glm::dvec2(size_)));
    const glm::ivec2 last(glm::clamp(glm::ceil(upper + kRounding), glm::dvec2(0.0), glm::dvec2(size_)));
    region_size_ = glm::max(last - first, glm::ivec2(0));
    region_at_ = {first.x, size_.y - first.y - region_size_.y};
}

Result<const Program*> Renderer::Impl::shading(unsigned variant) {
    Program& program = shade_[variant];
    if (program != 0) return &program;
    std::string defines;
    for (const auto& [bit, name] : {std::pair{kGlass, "GLASS"},
                                    {kOutline, "OUTLINE"},
                                    {kMargins, "MARGINS"},
                                    {kScale, "SCALE"},
                                    {kCuts, "CUTS"},
                                    {kOnlyChanged, "CHANGED"},
                                    {kHalos, "HALOS"},
                                    {kContours, "CONTOURS"},
                                    {kChromadepth, "CHROMADEPTH"},
                                    {kShadows, "SHADOWS"},
                                    {kLayer, "LAYER"},
                                    {kContext, "CONTEXT"}})
        if ((variant & bit) != 0) defines += std::string("#define ") + name + "\n";
    auto made = make_program("fullscreen.vert", "shade.frag", defines);
    if (!made) return tl::unexpected(made.error());
    program = std::move(*made);
    return &program;
}

LookBlock Renderer::Impl::look_of(const Frame& frame, bool outlined) const {
    const Appearance& a = frame.appearance;
    const Background& b = frame.background;
    const float point = frame.pixel_ratio * static_cast<float>(inner_.y) / static_cast<float>(size_.y);
    return {glm::vec4(b.top, b.transparent ? 1.0F : 0.0F),
            glm::vec4(b.bottom, a.depth_cue),
            linear(a.glass, has_glass_ ? 1.0F : 0.0F),
            linear(a.selection, outlined ? std::max(1.0F, 1.6F * point) : 0.0F),
            {a.key, a.fill, a.rim, a.specular},
            {a.occlusion, std::clamp(a.glass_opacity, 0.0F, 2.0F), std::max(1.0F, point), a.shadows},
            linear(a.centerline, 1.0F),
            linear(a.lesion, kLesionOpacity),
            linear(a.lost, 1.0F),
            linear(0.5F * (b.top + b.bottom), 1.0F),
            {a.halos, a.contours, a.chromadepth, std::max(1.0F, 2.6F * point)}};
}

Result<void> Renderer::Impl::shade(const Frame& frame, const GpuMesh* mesh, Extent extent) {
    const unsigned variant =
        send_records(frame, mesh, extent) | send_scene(frame) | (has_glass_ ? kGlass : 0U) |
        (extent == Extent::kChanged ? kOnlyChanged : 0U) | (frame.appearance.halos > 0.0F ? kHalos : 0U) |
        (frame.appearance.contours > 0.0F ? kContours : 0U) |
        (frame.appearance.chromadepth > 0.0F ? kChromadepth : 0U) | (frame.appearance.shadows > 0.0F ? kShadows : 0U);
    const bool outlined = (variant & kOutline) != 0;

    const LookBlock look = look_of(frame, outlined);
    glNamedBufferSubData(look_block_, 0, sizeof look, &look);
    const auto program = shading(variant);
    if (!program) return tl::unexpected(program.error());
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockView, view_block_);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockLook, look_block_);
    if (has_glass_ && !gl_has_lists())
        if (auto peeled = peel(frame, mesh != nullptr ? *mesh : no_mesh_, variant); !peeled) return peeled;
    glBindFramebuffer(GL_FRAMEBUFFER, lit_target_);
    if (extent == Extent::kAll) fullscreen(background_);
    const auto shade_rows = [&](Band band) {
        const int first = std::max(region_at_.y, band.first);
        const int last = std::min(region_at_.y + region_size_.y, band.first + band.count);
        if (first >= last) return;
        glBindFramebuffer(GL_FRAMEBUFFER, lit_target_);
        glBindTextureUnit(kUnitSurface, surface_);
        glBindTextureUnit(kUnitDepth, depth_);
        glBindTextureUnit(kUnitOpaqueDepth, opaque_depth_);
        glBindTextureUnit(kUnitContext, context_texture_);
        glBindTextureUnit(kUnitIdNormal, id_normal_);
        glBindTextureUnit(kUnitOcclusion, blurred_);
        glBindTextureUnit(kUnitBranches, branch_texture_);
        if (has_glass_ && gl_has_lists()) bind_panes(**program, band);
        glEnable(GL_SCISSOR_TEST);
        glScissor(region_at_.x, first, region_size_.x, last - first);
        // An outline reaches beyond the surface it surrounds.
        fullscreen(**program, outlined && extent == Extent::kAll ? Pixels::kAll : Pixels::kCovered);
        glDisable(GL_SCISSOR_TEST);
    };
    if (!has_glass_) shade_rows({0, inner_.y});
    for (const Band band : has_glass_ ? bands_ : std::vector<Band>{}) {
        if (bands_.size() > 1) { // its lists have given way to those of other bands
            std::uint64_t again = 0;
            list_panes(frame, mesh != nullptr ? *mesh : no_mesh_, band, again).finish();
            resolve(band);
        }
        shade_rows(band);
    }
    return {};
}

} // namespace ramus::render
