// The picture while it moves, where OpenGL is software: made by the caster, then sent as it is.
#include "render/renderer/renderer_impl.h"
#include "render/scene/colour.h"

#include <algorithm>
#include <cstring>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace ramus::render {

namespace {

constexpr int kTaps = 20; // of the occlusion, as at rest

template <std::size_t N> void put(float (&to)[N], const glm::vec4& from) {
    for (std::size_t i = 0; i < N; ++i) to[i] = from[static_cast<glm::length_t>(i)];
}

// What send_scene() tells OpenGL. Points into the frame.
caster::Meaning meaning_of(const Frame& frame, const glm::dmat4& eye) {
    caster::Meaning meaning;
    meaning.cuts = cut_places(frame.lost, *frame.centerlines, eye);
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

} // namespace

void Renderer::Impl::add_bodies(const Frame& frame, caster::Meaning& meaning) const {
    meaning.context = context_colours(frame);
    const float point = frame.pixel_ratio;
    for (std::size_t i = 0; i < frame.context.size(); ++i) {
        const Shape* shape = shapes_.of(frame.context[i], true);
        if (shape == nullptr) continue;
        meaning.bodies.push_back({&shape->made_of(), record::kSolid | record::kContext | number_of(i),
                                  frame.context[i].clear(), shape->lines() ? 0.5F * kContextLineWidth * point : 0.0F});
    }
    std::size_t index = frame.lesions.spheres.size();
    for (const auto& lesion : frame.lesions.meshes)
        if (const Shape* shape = shapes_.of(lesion); shape != nullptr)
            meaning.bodies.push_back({&shape->made_of(), record::kSolid | number_of(index++), true, 0.0F});
        else
            ++index;
}

std::uint64_t Renderer::Impl::cast(const Frame& frame, const std::vector<Layer>& layers) {
    const glm::dmat4 eye = eye_matrix(frame.camera);
    caster::Meaning meaning = meaning_of(frame, eye);
    add_bodies(frame, meaning);
    caster_.follow(frame.centerlines, frame.width > 0.0F);
    (void)look_at(frame, drawn_ != nullptr ? drawn_->shown()->bounds() : lines_.bounds());
    has_glass_ = std::ranges::find(layers, Layer::kGlass) != layers.end();
    const unsigned variant = send_records(frame, drawn_, Extent::kAll);
    const bool outlined = (variant & kOutline) != 0;
    caster::View view;
    view.width = size_.x;
    view.height = size_.y;
    constexpr int kAcross = caster::kTile * caster::kOccludedTiles;
    view.stride = (size_.x + kAcross - 1) / kAcross * kAcross;
    view.centre_x = view_.pixel_to_eye.x;
    view.centre_y = view_.pixel_to_eye.y;
    view.mm_a_pixel = view_.pixel_to_eye.z;
    view.flat = frame.camera.orthographic;
    view.near_mm = view_.depth_range.x;
    view.far_mm = view_.depth_range.y;
    view.reach_pixels = view_.depth_range.z;
    view.reach_mm = view_.depth_range.w;
    view.taps = frame.appearance.occlusion > 0.0F ? kTaps : 0;
    const LookBlock block = look_of(frame, outlined);
    caster::Look look;
    std::memcpy(&look, &block, sizeof look);
    return caster_.draw(frame, view, eye, look, outlined, layers, records_, meaning);
}

} // namespace ramus::render
