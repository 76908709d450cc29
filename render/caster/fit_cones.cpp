// Cones that lie where the surface does: it is not quite around the vessels' lines where they bend, and thinner than
// they are at free ends. Once for all pictures.
#include "render/caster/caster.h"
#include "render/caster/fit.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <tbb/parallel_for.h>

namespace ramus::render::caster {

namespace {

// Of a vessel's radius. Beside another one the circle would be that one's as well, which has its own cones. Tuned for
// the least difference from the picture at rest, on grown trees.
constexpr float kLeast = 0.9F, kMost = 1.03F;

// The ball at a free end, in radii: its own, and how far before the end its middle lies. It goes through the tip of the
// surface, which is `beyond` the end, and around the end itself as the surface does, whose radius there is
// sqrt(1 - 1 / width): exp(-w d^2) / 2 is the isovalue exp(-w), and w = width ln 2.
struct Tip {
    float radius, before;
};
Tip tip_of(float width, float beyond) {
    if (width <= 0.0F) return {1.0F, 1.0F - beyond};
    const float at_end = 1.0F - 1.0F / width, reach = std::max(beyond, 0.05F);
    const float radius = std::min(0.5F * (at_end / reach + reach), 1.0F);
    return {radius, radius - beyond};
}

Across across(const glm::vec3& middle, const glm::vec3& way, float radius, std::size_t near) {
    const glm::vec3 aside = std::abs(way.x) < 0.6F * glm::length(way) ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 side = glm::normalize(glm::cross(way, aside)), up = glm::normalize(glm::cross(way, side));
    Across place{};
    for (int i = 0; i < 3; ++i) place.middle[i] = middle[i], place.side[i] = side[i], place.up[i] = up[i];
    place.radius = radius;
    place.least = kLeast, place.most = kMost;
    place.near = static_cast<std::uint32_t>(near);
    return place;
}

} // namespace

void Caster::fit_cones(float width, float beyond_ends) {
    const auto radius = [&](std::size_t point) { return 0.5F * thinned_.details[point].diameter_mm; };
    fitted_ = on_line_;
    for (std::size_t i = 0; i < fitted_.size(); ++i) fitted_[i].w = radius(i);
    if (near_width_ > 0.0F) fit_to_field();
    // A ball of the vessel's radius at a free end would reach beyond it by that.
    const Tip tip = tip_of(width, beyond_ends);
    const auto end_at = [&](std::uint32_t end, std::uint32_t inward) {
        const glm::vec3 way = glm::vec3(on_line_[inward]) - glm::vec3(on_line_[end]);
        const float whole = glm::length(way);
        const float share = whole > 0.0F ? std::min(0.45F, tip.before * radius(end) / whole) : 0.0F;
        fitted_[end] = glm::vec4(glm::vec3(on_line_[end]) + share * way, tip.radius * radius(end));
    };
    for (const Segment& segment : segments_) {
        if (segment.before == Segment::kFree) end_at(segment.point, segment.point + 1);
        if (segment.behind == Segment::kFree) end_at(segment.point + 1, segment.point);
    }
}

void Caster::fit_to_field() {
    std::vector<Piece> pieces(segments_.size() + 1, kNowhere);
    for (std::size_t i = 0; i < segments_.size(); ++i) pieces[i] = piece_of(segments_[i], glm::mat4(1.0F));
    Field field{};
    field.pieces = pieces.data();
    field.first = near_.first.data();
    field.near = near_.segments.data();
    field.root_width = std::sqrt(near_width_);
    std::vector<Across> places;
    std::vector<std::uint32_t> points; // that the places are
    for (std::size_t s = 0; s < segments_.size(); ++s) {
        const std::uint32_t first = segments_[s].point, last = first + 1;
        const auto add = [&](std::uint32_t point, std::uint32_t from, std::uint32_t to) {
            const glm::vec3 way = glm::vec3(on_line_[to]) - glm::vec3(on_line_[from]);
            if (!(glm::length(way) > 0.0F)) return;
            places.push_back(across(glm::vec3(on_line_[point]), way, 0.5F * thinned_.details[point].diameter_mm, s));
            points.push_back(point);
        };
        // Each point with the segment that begins there; a branch's last one with the one that ends there.
        add(first, s > 0 && segments_[s - 1].point + 1 == first ? first - 1 : first, last);
        if (s + 1 == segments_.size() || segments_[s + 1].point != last) add(last, first, last);
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places.size(), 256),
                      [&](const auto& range) { fit_circles(field, places.data() + range.begin(), range.size()); });
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Across& place = places[i];
        fitted_[points[i]] = {place.middle[0], place.middle[1], place.middle[2], place.radius};
    }
}

} // namespace ramus::render::caster
