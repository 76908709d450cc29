#include "render/renderer/slice_screen.h"

#include <algorithm>

namespace ramus::render {

bool SliceScreen::draw(const Frame& frame, const SliceView& view) {
    if (drawn_ && drawn_->view == view && same_section(drawn_->frame, frame)) return false;
    image_ = painter_.paint(frame, view);
    if (picture_.size != view.grid.size) picture_.make(view.grid.size);
    picture_.put(image_);
    drawn_ = Drawn{section_source(frame), view};
    return true;
}

Pick SliceScreen::pick(glm::dvec2 at) const {
    if (!drawn_) return {};
    const SliceView& view = drawn_->view;
    const glm::dvec2 pixel = at - 0.5; // the grid counts from the middle of its first pixel
    const double reach = kPickRadius * std::max(1.0, static_cast<double>(view.pixel_ratio));
    Pick pick;
    pick.position = view.grid.place(pixel);
    if (view.along) return pick; // rows have their own places
    if (view.outlines) pick.branch = branch_at(painter_.section(), view.grid, pixel, reach);
    return pick;
}

} // namespace ramus::render
