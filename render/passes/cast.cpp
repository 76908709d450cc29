// The picture while it moves, where OpenGL is software: made by the caster, then sent as it is.
#include "render/renderer_impl.h"

#include <algorithm>
#include <cstring>

namespace ramus::render {

namespace {

constexpr int kTaps = 20; // of the occlusion, as at rest

} // namespace

std::uint64_t Renderer::Impl::cast(const Frame& frame, const std::vector<Layer>& layers) {
    caster_.follow(frame.centerlines);
    (void)look_at(frame, drawn_->shown()->bounds());
    has_glass_ = std::ranges::find(layers, Layer::kGlass) != layers.end();
    const unsigned variant = send_records(frame, drawn_, Extent::kAll);
    const bool outlined = (variant & kOutline) != 0;
    caster::View view;
    view.width = size_.x;
    view.height = size_.y;
    view.stride = (size_.x + caster::kTile - 1) / caster::kTile * caster::kTile;
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
    const glm::dmat4 eye = eye_matrix(frame.camera);
    return caster_.draw(frame, view, eye, look, outlined, layers, records_,
                        cut_places(frame.lost, *frame.centerlines, eye));
}

} // namespace ramus::render
