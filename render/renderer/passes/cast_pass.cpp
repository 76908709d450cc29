#include "render/renderer/look.h"
#include "render/renderer/passes/picture_passes.h"
#include "render/scene/colour.h"
#include "render/scene/record_flags.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::render {

namespace {

constexpr int kCastTaps = 20; // of the occlusion, as at rest

template <std::size_t N> void put(float (&to)[N], const glm::vec4& from) {
    for (std::size_t i = 0; i < N; ++i) to[i] = from[static_cast<glm::length_t>(i)];
}

// What SceneTables tells OpenGL. Points into the frame.
caster::Meaning meaning_of(const Frame& frame, const glm::dmat4& eye) {
    caster::Meaning meaning;
    meaning.cuts = cut_ends(frame.lost, *frame.centerlines, eye);
    for (const glm::dvec4& s : frame.lesions.spheres)
        meaning.lesions.emplace_back(glm::dvec3(eye * glm::dvec4(glm::dvec3(s), 1.0)), s.w);
    if (frame.margins.bands.empty()) return meaning;
    caster::MarginLook& look = meaning.margins.emplace();
    look.spheres = meaning.lesions.empty() ? nullptr : &meaning.lesions.front().x;
    look.sphere_count = static_cast<int>(meaning.lesions.size());
    look.band_count = static_cast<int>(std::min(frame.margins.bands.size(), Margins::kMost));
    for (int i = 0; i < look.band_count; ++i) {
        const Margins::Band& band = frame.margins.bands[static_cast<std::size_t>(i)];
        put(look.bands[i], linear(band.colour, band.within_mm));
    }
    put(look.beyond, linear(frame.margins.beyond, 0.0F));
    const DistanceGrid* grid = frame.lesions.distances.get();
    if (grid == nullptr || !grid->whole()) return meaning;
    look.grid = grid->values.data();
    const glm::dmat4 to_grid =
        glm::translate(glm::scale(glm::dmat4(1.0), glm::dvec3(1.0 / grid->step_mm)), -grid->corner) * glm::inverse(eye);
    for (int i = 0; i < 3; ++i) {
        look.size[i] = grid->size[i];
        put(look.to_grid[i], glm::vec4(glm::row(to_grid, i)));
    }
    return meaning;
}

void add_bodies(const Frame& frame, const GpuShapes& shapes, caster::Meaning& meaning) {
    meaning.context = context_colours(frame);
    const float point = frame.pixel_ratio;
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes.of(frame.context[i], true);
        if (shape == nullptr) continue;
        meaning.bodies.push_back({&shape->made_of(), record::kSolid | record::kContext | number_of(i),
                                  frame.context[i].clear(), shape->lines() ? 0.5F * kContextLineWidth * point : 0.0F});
    }
    std::size_t index = frame.lesions.spheres.size();
    for (const auto& lesion : frame.lesions.meshes)
        if (const Shape* shape = shapes.of(lesion); shape != nullptr)
            meaning.bodies.push_back({&shape->made_of(), record::kSolid | number_of(index++), true, 0.0F});
        else
            ++index;
}

caster::View view_of(const Frame& frame, const ViewSetup& from) {
    constexpr int kAcross = caster::kTile * caster::kOccludedTiles;
    caster::View view;
    view.width = from.picture.x;
    view.height = from.picture.y;
    view.stride = (from.picture.x + kAcross - 1) / kAcross * kAcross;
    view.centre_x = from.block.pixel_to_eye.x;
    view.centre_y = from.block.pixel_to_eye.y;
    view.mm_a_pixel = from.block.pixel_to_eye.z;
    view.flat = frame.camera.orthographic;
    view.near_mm = from.block.depth_range.x;
    view.far_mm = from.block.depth_range.y;
    view.reach_pixels = from.block.depth_range.z;
    view.reach_mm = from.block.depth_range.w;
    view.taps = frame.appearance.occlusion > 0.0F ? kCastTaps : 0;
    return view;
}

} // namespace

std::uint64_t CastPass::draw(const Subject& subject, const ViewSetup& view, BranchRecords& records) {
    const Frame& frame = subject.frame;
    const glm::dmat4 eye = eye_matrix(frame.camera);
    caster::Meaning meaning = meaning_of(frame, eye);
    add_bodies(frame, subject.scene.shapes(), meaning);
    caster_.follow(frame.centerlines, frame.width > 0.0F);
    const bool outlined = records.send(subject, false).any_selected;
    const bool glass = std::ranges::find(subject.layers, Layer::kGlass) != subject.layers.end();
    const LookBlock block = look_of(frame, view, glass, outlined);
    caster::Look look;
    static_assert(sizeof look == sizeof block);
    std::memcpy(&look, &block, sizeof look);
    return caster_.draw(frame, view_of(frame, view), eye, look, outlined, subject.layers, records.records(), meaning);
}

void CastPass::send_picture(const PictureTarget& to) const {
    glTextureSubImage2D(to.colour, 0, 0, 0, to.size.x, to.size.y, GL_RGBA, GL_UNSIGNED_BYTE, caster_.rgba());
}

void CastPass::send_depths(const PictureTarget& picture, const ResolvedTarget& to) const {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, caster_.stride());
    glTextureSubImage2D(to.opaque_depth, 0, 0, 0, picture.size.x, picture.size.y, GL_RED, GL_FLOAT, caster_.depths());
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
}

} // namespace ramus::render
