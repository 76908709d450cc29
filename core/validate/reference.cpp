#include "core/validate/reference.h"

#include "core/base/infinity.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::validate {

namespace {

constexpr double kStep = 0.25; // of a place, in radii

// A branch as a curve with a parameter, the length from its first point.
class Run {
public:
    Run(const tree::VesselTree& tree, const tree::Branch& branch, double grain_mm)
        : tree_(tree), points_(branch.points), grain_mm_(grain_mm), until_(points_.size(), 0.0) {
        for (std::size_t i = 1; i < points_.size(); ++i)
            until_[i] = until_[i - 1] + glm::distance(position(i - 1), position(i));
    }
    [[nodiscard]] double length() const { return until_.back(); }

    [[nodiscard]] Place at(double along) const {
        const std::size_t i = segment_at(along);
        const double length = until_[i + 1] - until_[i];
        const double share = length > 0.0 ? std::clamp((along - until_[i]) / length, 0.0, 1.0) : 0.0;
        Place place;
        place.along = along;
        place.at = glm::mix(position(i), position(i + 1), share);
        place.radius = std::lerp(tree_.points[points_[i]].radius, tree_.points[points_[i + 1]].radius, share);
        return place;
    }
    // The chord over half a radius to either side, since the direction jumps at corners. At least over two voxels to
    // either side, since steps between voxels have only 26 directions.
    [[nodiscard]] glm::dvec3 direction(const Place& place) const {
        const double reach = std::max(0.5 * place.radius, 2.0 * grain_mm_);
        const glm::dvec3 chord =
            at(std::min(place.along + reach, length())).at - at(std::max(place.along - reach, 0.0)).at;
        const double size = glm::length(chord);
        if (size > 1e-9 * place.radius) return chord / size;
        const std::size_t i = segment_at(place.along);
        const glm::dvec3 along = position(i + 1) - position(i);
        return glm::length(along) > 0.0 ? glm::normalize(along) : glm::dvec3(0.0, 0.0, 1.0);
    }
    [[nodiscard]] double reach_of_bend(const Place& place) const {
        return std::max(1.5 * place.radius, 3.0 * grain_mm_);
    }
    // Whether the chords over the reach before and after a place differ by more than 35 degrees.
    [[nodiscard]] bool turns_at(const Place& place) const {
        constexpr double kCosine = 0.8192;
        const double reach = reach_of_bend(place);
        const glm::dvec3 before = place.at - at(std::max(place.along - reach, 0.0)).at;
        const glm::dvec3 behind = at(std::min(place.along + reach, length())).at - place.at;
        return glm::dot(before, behind) < kCosine * glm::length(before) * glm::length(behind);
    }

private:
    [[nodiscard]] const glm::dvec3& position(std::size_t i) const { return tree_.points[points_[i]].position; }
    [[nodiscard]] std::size_t segment_at(double along) const {
        const auto after = std::upper_bound(until_.begin() + 1, until_.end() - 1, along);
        return static_cast<std::size_t>(after - until_.begin()) - 1;
    }
    const tree::VesselTree& tree_;
    const std::vector<std::uint32_t>& points_;
    double grain_mm_;
    std::vector<double> until_; // by point: mm from the first point
};

void put_places(const Run& run, int branch, std::pair<bool, bool> free_ends, std::vector<Place>& places) {
    const std::size_t first = places.size();
    for (double along = 0.0; along < run.length();) {
        Place place = run.at(along);
        place.branch = branch;
        place.direction = run.direction(place);
        place.to_end =
            std::min(free_ends.first ? along : kInfinity, free_ends.second ? run.length() - along : kInfinity);
        places.push_back(place);
        along += kStep * place.radius;
    }
    constexpr double kSpread = 1.0 / 6.0; // decrease of Place::scale per mm away from a wider place
    const auto spread = [&](std::size_t from, std::size_t to) {
        const double away = std::abs(places[to].along - places[from].along);
        places[to].scale = std::max({places[to].scale, places[to].radius, places[from].scale - kSpread * away});
    };
    for (std::size_t i = first; i < places.size(); ++i) spread(std::max(i, first + 1) - 1, i);
    for (std::size_t i = places.size(); i-- > first;) spread(std::min(i + 1, places.size() - 1), i);
    for (std::size_t i = first; i < places.size(); ++i) {
        places[i].turns = run.turns_at(places[i]);
        if (!places[i].turns) continue;
        const double reach = run.reach_of_bend(places[i]);
        for (std::size_t j = i; j < places.size() && places[j].along <= places[i].along + reach; ++j)
            places[j].bent = true;
        for (std::size_t j = i; j-- > first && places[j].along >= places[i].along - reach;) places[j].bent = true;
    }
    for (std::size_t i = first; i < places.size(); ++i)
        places[i].step = (i + 1 < places.size() ? places[i + 1].along : run.length()) - places[i].along;
}

} // namespace

bool is_alone(const Place& place) {
    constexpr double kFromEnd = 1.5; // radii: nearer to a free end, the surface closes
    return !place.bent && place.beside >= kFar && place.to_end >= kFromEnd * place.radius;
}

NearbyVessels::NearbyVessels(const tree::Links& links) : links_(links) {
    along_.resize(links.size(), 0.0);
    for (std::size_t n = 1; n < along_.size(); ++n)
        if (links[n].branch == links[n - 1].branch)
            along_[n] = along_[n - 1] + glm::distance(links[n - 1].a.position, links[n - 1].b.position);
    const auto hold = [&](Bounds<glm::dvec3>& box, std::uint32_t link) {
        const tree::Link of = links[link];
        for (const tree::Point& end : {of.a, of.b}) box.hold(end.position, kOwn * end.radius);
    };
    const auto middle = [&](std::uint32_t link, int axis) {
        return links[link].a.position[axis] + links[link].b.position[axis];
    };
    boxes_ = halved_boxes(static_cast<std::uint32_t>(along_.size()), hold, middle);
}

// `radii`: the sum of the radii of the place and of the link.
bool NearbyVessels::is_out(const ButFor& but, std::uint32_t link, double share, double radii) const {
    const tree::Link one = links_[link];
    if (one.branch != but.near_on) return false;
    const double along = along_[link] + share * glm::distance(one.a.position, one.b.position);
    return std::abs(along - but.along) < kFar * radii;
}

NearbyVessels::Nearest NearbyVessels::nearest(const tree::Point& place, double most, const ButFor& but,
                                              double enough) const {
    Nearest best{most, tree::kNoBranch, 0.0};
    if (boxes_.nodes.empty()) return best;
    const double reach = kOwn * place.radius;
    std::array<std::uint32_t, 64>
        open; // each level halves the links, so the depth is limited by the bits of their number
    open[0] = 0;
    std::size_t count = 1;
    while (count > 0) {
        const std::uint32_t at = open[--count];
        const BoxNode& node = boxes_.nodes[at];
        if (glm::any(glm::lessThan(place.position, node.box.least - reach)) ||
            glm::any(glm::greaterThan(place.position, node.box.most + reach)))
            continue;
        if (node.count == 0) {
            open[count++] = node.first;
            open[count++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const tree::Link link = links_[boxes_.order[i]];
            if (link.branch == but.branches[0] || link.branch == but.branches[1]) continue;
            const double closeness = tree::closeness(place, link);
            if (closeness >= best.closeness) continue;
            const double share = tree::nearest_share(place.position, link);
            const double radius = tree::point_on(link, share).radius;
            if (is_out(but, boxes_.order[i], share, place.radius + radius)) continue;
            best = {closeness, link.branch, radius};
            if (closeness < enough) return best;
        }
    }
    return best;
}

Reference::Reference(const tree::VesselTree& source)
    : grain_mm_(source.voxels ? tree::mean_size_mm(*source.voxels) : 0.0), axes_(tree::prune(source, 0.0)) {
    const tree::VesselTree& tree = axes_.prepared.tree;
    std::vector<int> degree(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches) ++degree[branch.points.front()], ++degree[branch.points.back()];
    first_.push_back(0);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        put_places(Run(tree, branch, grain_mm_), static_cast<int>(id),
                   {degree[branch.points.front()] == 1, degree[branch.points.back()] == 1}, places_);
        first_.push_back(places_.size());
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places_.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Place& place = places_[i];
            place.beside =
                axes_.vessels.nearest({place.at, place.radius}, kFar, {{}, place.branch, place.along}, 0.0).closeness;
        }
    });
}

} // namespace ramus::validate
