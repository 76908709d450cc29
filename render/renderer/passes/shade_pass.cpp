#include "render/renderer/passes/shade_pass.h"

#include "core/base/bounds.h"
#include "render/gl/gl_context.h"
#include "render/renderer/frame_changes.h"

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
    kPlanes = 8192,
    kGuide = 16384,
    kCaps = 32768,
};
constexpr std::pair<Variant, const char*> kVariants[] = {
    {kGlass, "GLASS"},     {kOutline, "OUTLINE"},   {kMargins, "MARGINS"},
    {kScale, "SCALE"},     {kCuts, "CUTS"},         {kOnlyChanged, "CHANGED"},
    {kHalos, "HALOS"},     {kContours, "CONTOURS"}, {kChromadepth, "CHROMADEPTH"},
    {kShadows, "SHADOWS"}, {kLayer, "LAYER"},       {kContext, "CONTEXT"},
    {kValues, "VALUES"},   {kPlanes, "PLANES"},     {kGuide, "GUIDE"},
    {kCaps, "CAPS"}};

// For slices, which samples see at their own positions.
void set_samples(GLuint program, const ViewTargets& targets) {
    glProgramUniform2fv(program, kUniformSamplePositions, kMostSamples, &targets.samples.positions[0].x);
}

unsigned caps_in(const ViewSetup& view) { return view.cap_values ? unsigned{kCaps} : 0U; }

unsigned if_any(float strength, Variant variant) { return strength > 0.0F ? unsigned{variant} : 0U; }

} // namespace

Result<void> ShadePass::make() {
    tables_.make();
    planes_.make();
    look_block_ = make_buffer(sizeof(LookBlock), nullptr, GL_DYNAMIC_STORAGE_BIT);
    return background_.make("background.frag");
}

void ShadePass::release() {
    records_ = {};
    tables_.release();
    planes_.release();
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

Result<ShadePass::Prepared> ShadePass::prepare(const Subject& subject, const ViewTargets& targets, bool mark_changed,
                                               unsigned more) {
    const Appearance& look = subject.frame.appearance;
    const bool glass = targets.has_glass;
    Prepared made{nullptr, records_.send(subject, mark_changed), 0};
    const SceneTables::Needs needs = tables_.send(subject);
    const unsigned seen_through = (made.records.any_cut ? kCuts : 0U) | (needs.context ? kContext : 0U);
    const unsigned variant = seen_through | (needs.margins ? kMargins : 0U) | (needs.scale ? kScale : 0U) |
                             (needs.values ? kValues : 0U) | (made.records.any_selected ? kOutline : 0U) |
                             (glass ? kGlass : 0U) | (mark_changed ? kOnlyChanged : 0U) | if_any(look.halos, kHalos) |
                             if_any(look.contours, kContours) | if_any(look.chromadepth, kChromadepth) |
                             if_any(look.shadows, kShadows) | caps_in(targets.view) | more;
    made.of_layers = kGlass | kLayer | seen_through | caps_in(targets.view) | more;
    const LookBlock block = look_of(subject.frame, targets.view, glass, made.records.any_selected);
    glNamedBufferSubData(look_block_, 0, sizeof block, &block);
    RAMUS_TRY(light, program(variant));
    made.light = light;
    set_caps(*light, targets.view);
    glBindBufferBase(GL_UNIFORM_BUFFER, kBlockLook, look_block_);
    return made;
}

// Before OpenGL 4.3.
Result<void> ShadePass::draw_layers(const Subject& subject, ViewTargets& targets, unsigned variant) {
    if (!targets.has_glass || gl_has_lists()) return {};
    RAMUS_TRY(of_layer, program(variant));
    set_samples(*of_layer, targets);
    set_caps(*of_layer, targets.view);
    bind(targets);
    layers_.draw_all(subject, targets, *of_layer);
    return {};
}

void ShadePass::for_bands(const Subject& subject, ViewTargets& targets, const Fullscreen& program, const Region& region,
                          const std::function<void(const Region&)>& draw) const {
    if (!targets.has_glass || !gl_has_lists()) return draw(region);
    const std::vector<Band>& bands = targets.lists.bands;
    for (const Band band : bands) {
        if (bands.size() > 1) lists_.draw_again(subject, targets, band);
        const int first = std::max(region.at.y, band.first), last = std::min(region.end().y, band.first + band.count);
        bind_lists(program, targets, band);
        draw({{region.at.x, first}, {region.size.x, last - first}});
    }
}

Result<Region> ShadePass::draw(const Subject& subject, ViewTargets& targets, Extent extent) {
    const bool part = extent == Extent::kChanged;
    targets.has_planes = false;
    if (!part) targets.sliced.guided = false;
    RAMUS_TRY(made, prepare(subject, targets, part, 0));
    if (auto layers = draw_layers(subject, targets, made.of_layers); !layers) return tl::unexpected(layers.error());
    glBindFramebuffer(GL_FRAMEBUFFER, targets.lit.framebuffer);
    if (!part) background_.draw();

    const Region region = part ? region_of(subject, targets.view, targets.has_glass, made.records.changed)
                               : Region{glm::ivec2(0), targets.view.size};
    // Outlines extend beyond their surface.
    const auto pixels = made.records.any_selected && !part ? Fullscreen::Pixels::kAll : Fullscreen::Pixels::kCovered;
    for_bands(subject, targets, *made.light, region, [&](const Region& rows) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets.lit.framebuffer);
        bind(targets);
        made.light->draw_in(rows.at, rows.size, pixels);
    });
    return region;
}

// Says where it is simple to put slices among the surfaces; valid until something is shaded otherwise.
Result<void> ShadePass::guide_planes(const Subject& subject, ViewTargets& targets, bool outlined) {
    if (targets.sliced.guided) return {};
    const unsigned glass = targets.has_glass ? kGlass : 0U;
    RAMUS_TRY(guide, program(kGuide | glass | caps_in(targets.view) | (outlined ? kOutline : 0U)));
    set_caps(*guide, targets.view);
    const Region all{glm::ivec2(0), targets.view.size};
    for_bands(subject, targets, *guide, all, [&](const Region& rows) {
        glBindFramebuffer(GL_FRAMEBUFFER, targets.sliced.guide_framebuffer);
        bind(targets);
        guide->draw_in(rows.at, rows.size);
    });
    targets.sliced.guided = true;
    return {};
}

Result<void> ShadePass::draw_planes(const Subject& subject, ViewTargets& targets, const Region& region) {
    targets.make_sliced();
    RAMUS_TRY(made, prepare(subject, targets, false, kPlanes));
    if (auto sent = planes_.send(subject.frame, targets.view); !sent) return sent;
    if (auto guided = guide_planes(subject, targets, made.records.any_selected); !guided) return guided;
    const bool depths = lies_over_depths(subject.frame); // for overlays
    Fullscreen& simple = simple_slices_.at(2 * (planes_.count() - 1) + (depths ? 1 : 0));
    if (!simple.made()) {
        const std::string planes =
            "#define PLANES " + std::to_string(planes_.count()) + (depths ? "\n#define DEPTHS\n" : "\n");
        if (auto built = simple.make("slices.frag", planes); !built) return built;
    }
    const auto bind_all = [&] {
        glBindFramebuffer(GL_FRAMEBUFFER, depths ? targets.sliced.framebuffer : targets.sliced.colour_framebuffer);
        bind(targets);
        glBindTextureUnit(kUnitImage, targets.lit.colour);
        glBindTextureUnit(kUnitSliceGuide, targets.sliced.guide);
    };
    bind_all();
    simple.draw_in(region.at, region.size, Fullscreen::Pixels::kAllDepths);
    if (auto layers = draw_layers(subject, targets, made.of_layers); !layers) return layers;
    set_samples(*made.light, targets);
    for_bands(subject, targets, *made.light, region, [&](const Region& rows) {
        bind_all();
        made.light->draw_in(rows.at, rows.size, Fullscreen::Pixels::kCovered);
    });
    targets.has_planes = true;
    return {};
}

Result<void> ShadePass::draw_all(const Subject& subject, ViewTargets& targets) {
    RAMUS_TRY(all, draw(subject, targets, Extent::kAll));
    return subject.frame.planes.empty() ? Result<void>() : draw_planes(subject, targets, all);
}

} // namespace ramus::render
