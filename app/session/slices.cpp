#include "app/session/slices.h"

#include "core/base/words.h"

#include <algorithm>

namespace ramus::app {

std::string_view name_of(SliceLayout layout) { return kSliceLayouts[static_cast<std::size_t>(layout)].second; }

std::optional<SliceLayout> layout_named(std::string_view name) { return paired_with(kSliceLayouts, name); }

std::vector<slice::Direction> slices_of(SliceLayout layout) {
    switch (layout) {
    case SliceLayout::kPicture:
        return {};
    case SliceLayout::kSlices:
    case SliceLayout::kLarge:
        return {slice::Direction::kAxial, slice::Direction::kCoronal, slice::Direction::kSagittal};
    case SliceLayout::kAxial:
        return {slice::Direction::kAxial};
    case SliceLayout::kCoronal:
        return {slice::Direction::kCoronal};
    case SliceLayout::kSagittal:
        return {slice::Direction::kSagittal};
    case SliceLayout::kOblique:
        break;
    }
    return {slice::Direction::kOblique};
}

bool has_tree(SliceLayout layout) {
    return layout == SliceLayout::kPicture || layout == SliceLayout::kSlices || layout == SliceLayout::kLarge;
}

bool SliceViews::any_in_picture() const { return std::ranges::find(in_picture, true) != in_picture.end(); }

slice::Axes axes_of(const SliceViews& views, slice::Direction direction) {
    return direction == slice::Direction::kOblique ? slice::axes_across(views.oblique_normal)
                                                   : slice::axes_of(direction);
}

glm::vec3 slice_colour(slice::Direction direction) {
    constexpr std::array<glm::vec3, 4> kColours{
        {{0.95F, 0.34F, 0.30F}, {0.38F, 0.78F, 0.36F}, {0.96F, 0.84F, 0.30F}, {0.72F, 0.56F, 0.98F}}};
    return kColours[slice_index(direction)];
}

} // namespace ramus::app
