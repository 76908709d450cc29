#include "app/session/slices.h"

#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

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
    case SliceLayout::kAlong:
        break;
    }
    return {slice::Direction::kOblique};
}

bool has_tree(SliceLayout layout) {
    return layout == SliceLayout::kPicture || layout == SliceLayout::kSlices || layout == SliceLayout::kLarge ||
           layout == SliceLayout::kAlong;
}

bool SliceViews::any_in_picture() const { return std::ranges::find(in_picture, true) != in_picture.end(); }

slice::Axes axes_of(const SliceViews& views, slice::Direction direction) {
    if (direction != slice::Direction::kOblique) return slice::axes_of(direction);
    const slice::Axes across = slice::axes_across(views.oblique_normal);
    // Another normal may have been set since.
    constexpr double kRightAngle = 1e-6;
    if (!views.oblique_right || std::abs(glm::dot(*views.oblique_right, views.oblique_normal)) > kRightAngle)
        return across;
    slice::Axes followed = across;
    followed.right = *views.oblique_right;
    followed.down = glm::cross(followed.right, across.to_viewer());
    return followed;
}

glm::vec3 slice_colour(slice::Direction direction) {
    constexpr std::array<glm::vec3, 4> kColours{
        {{0.95F, 0.34F, 0.30F}, {0.38F, 0.78F, 0.36F}, {0.96F, 0.84F, 0.30F}, {0.72F, 0.56F, 0.98F}}};
    return kColours[slice_index(direction)];
}

} // namespace ramus::app
