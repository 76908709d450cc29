#include "render/renderer/passes/shade_pass.h"

#include "core/base/bounds.h"
#include "render/gl/gl_context.h"

#include <algorithm>
#include <glm/common.hpp>
#include <string>
#include <utility>

namespace ramus::render {

namespace {

// Bits of the variants of shade.frag.
enum Variant : unsigned {
    kGlass = 1,
    kOutline = 2,
    kShadows = 4,
    kMargins = 8,
    kScale = 16,
    kCuts = 32,
    kOnlyChanged = 64,
    kHalos = 128,
    kContours = 256,
    kChromadepth = 512,
    kLayer = 1024,
    kContext = 2048,
    kValues = 4096,
};
constexpr std::pair<Variant, const char*> kVariants[] = {
    {kGlass, "GLASS"},     {kOutline, "OUTLINE"},   {kMargins, "MARGINS"},
    {kScale, "SCALE"},     {kCuts, "CUTS"},         {kOnlyChanged, "CHANGED"},
    {kHalos, "HALOS"},     {kContours, "CONTOURS"}, {kChromadepth, "CHROMADEPTH"},
    {kShadows, "SHADOWS"}, {kLayer, "LAYER"},       {kContext, "CONTEXT"},
    {kValues, "VALUES"}};

unsigned if_any(float strength, Variant variant) { return strength > 0.0F ? unsigned{variant} : 0U; }

} // namespace

Result<void> ShadePass::make() {
    tables_.make();
    look_block_ = make_buffer(sizeof(LookBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return background_.make("background.frag");
}

void ShadePass::release() {
    records_ = {};
    tables_.release();
}

Result<const Fullscreen*> ShadePass::program(unsigned variant) {
    Fullscreen& program = programs_[variant];
    if (program.made()) return &program;
    std::string defines;
    for (const auto& [bit, name] : kVariants)
        if ((variant & bit) != 0) defines += std::string("#define ") + name + "\n";
    if (auto made = program.make("shade.frag", defines); !made) return tl::unexpected(made.error());
    return &program;
}

// Uses the bounds of pages with triangles of these branches; there are some hundred pages, each compact.
Region region_of(const Subject& subject, const ViewSetup& view, bool has_glass,
                 const std::vector<std::uint8_t>& changed) {
    const Region all{glm::ivec2(0), view.size};
    const Frame& frame = subject.frame;
    // Lines extend beyond pages, and an enlarged picture has no pixels of its own.
    if (!subject.has_mesh() || has_glass || !frame.lines.empty() || frame.skeleton || view.enlarged()) return all;
    const PagedMesh& mesh = *subject.mesh.shown();
    const Projector project(frame.camera, frame.size);
    Bounds<glm::dvec2> changed_pixels;
    for (const auto& page : mesh.triangle_pages()) {
        const auto has_changed = [&](std::int32_t branch) { return changed[static_cast<std::size_t>(branch)] != 0; };
        const bool any =
            std::ranges::any_of(page->runs, has_changed, &TrianglePage::Run::branch) ||
            std::ranges::any_of(page->borders, [&](const auto& p) { return has_changed(p[0]) || has_changed(p[1]); });
        if (page->count == 0 || !any) continue;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::bvec3 high((corner & 1) != 0, (corner & 2) != 0, (corner & 4) != 0);
            const auto at = project(mesh.origin() + glm::dvec3(glm::mix(page->lower, page->upper, high)));
            if (!at) return all; // behind the eye
            changed_pixels.hold(glm::dvec2(*at));
        }
    }
    constexpr double kRounding = 2.0; // pixels
    const glm::dvec2 size(view.picture);
    const glm::ivec2 first(glm::clamp(glm::floor(changed_pixels.least - kRounding), glm::dvec2(0.0), size));
    const glm::ivec2 last(glm::clamp(glm::ceil(changed_pixels.most + kRounding), glm::dvec2(0.0), size));
    const glm::ivec2 found = glm::max(last - first, glm::ivec2(0));
    return {{first.x, view.picture.y - first.y - found.y}, found};
}

void ShadePass::bind(const ViewTargets& targets) const {
    glBindTextureUnit(kUnitSurface, targets.samples.id_normal);
    glBindTextureUnit(kUnitDepth, targets.samples.depth);
    glBindTextureUnit(kUnitOpaqueDepth, targets.resolved.opaque_depth);
    glBindTextureUnit(kUnitIdNormal, targets.resolved.id_normal);
    glBindTextureUnit(kUnitOcclusion, targets.occlusion.blurred);
    glBindTextureUnit(kUnitBranches, records_.table());
    glBindTextureUnit(kUnitValues, targets.samples.values);
}

void ShadePass::draw_rows(const Fullscreen& program, const ViewTargets& targets, const Region& region,
                          Fullscreen::Pixels pixels) const {
    glBindFramebuffer(GL_FRAMEBUFFER, targets.lit.framebuffer);
    bind(targets);
    program.draw_in(region.at, region.size, pixels);
}

Result<Region> ShadePass::draw(const Subject& subject, ViewTargets& targets, Extent extent) {
    const Appearance& look = subject.frame.appearance;
    const bool glass = targets.has_glass, part = extent == Extent::kChanged;
    const BranchRecords::Made records = records_.send(subject, part);
    const SceneTables::Needs needs = tables_.send(subject);
    const unsigned seen_through = (records.any_cut ? kCuts : 0U) | (needs.context ? kContext : 0U);
    const unsigned variant = seen_through | (needs.margins ? kMargins : 0U) | (needs.scale ? kScale : 0U) |
                             (needs.values ? kValues : 0U) | (records.any_selected ? kOutline : 0U) |
                             (glass ? kGlass : 0U) | (part ? kOnlyChanged : 0U) | if_any(look.halos, kHalos) |
                             if_any(look.contours, kContours) | if_any(look.chromadepth, kChromadepth) |
                             if_any(look.shadows, kShadows);
    const LookBlock block = look_of(subject.frame, targets.view, glass, records.any_selected);
    glNamedBufferSubData(look_block_, 0, sizeof block, &block);
    RAMUS_TRY(light, program(variant));
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockLook, look_block_);
    if (glass && !gl_has_lists()) {
        RAMUS_TRY(of_layer, program(kGlass | kLayer | seen_through));
        bind(targets);
        layers_.draw_all(subject, targets, *of_layer);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, targets.lit.framebuffer);
    if (!part) background_.draw();

    const Region region =
        part ? region_of(subject, targets.view, glass, records.changed) : Region{glm::ivec2(0), targets.view.size};
    // Outlines extend beyond their surface.
    const auto pixels = records.any_selected && !part ? Fullscreen::Pixels::kAll : Fullscreen::Pixels::kCovered;
    if (!glass || !gl_has_lists()) {
        draw_rows(*light, targets, region, pixels);
        return region;
    }
    const std::vector<Band>& bands = targets.lists.bands;
    for (const Band band : bands) {
        if (bands.size() > 1) lists_.draw_again(subject, targets, band);
        const int first = std::max(region.at.y, band.first), last = std::min(region.end().y, band.first + band.count);
        bind_lists(*light, targets, band);
        draw_rows(*light, targets, {{region.at.x, first}, {region.size.x, last - first}}, pixels);
    }
    return region;
}

} // namespace ramus::render
