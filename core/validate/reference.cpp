#include "core/validate/reference.h"

#include "core/base/infinity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::validate {

namespace {

constexpr double kStep = 0.25; // of a place, in radii

tree::PreparedTree smoothed(const tree::VesselTree& source, int passes) {
    tree::PreparedTree prepared = tree::prune(source, 0.0);
    prepared.tree = tree::smooth(std::move(prepared.tree), passes);
    return prepared;
}

// A branch as a line with two radii that can be asked for any place along it.
class Run {
public:
    Run(const tree::VesselTree& smooth, const tree::VesselTree& source, const tree::Branch& branch)
        : smooth_(smooth), source_(source), points_(branch.points), until_(points_.size(), 0.0) {
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
        const auto between = [&](const tree::VesselTree& tree) {
            return std::lerp(tree.points[points_[i]].radius, tree.points[points_[i + 1]].radius, share);
        };
        place.radius = between(smooth_);
        place.input_radius = between(source_);
        place.input_at = glm::mix(source_.points[points_[i]].position, source_.points[points_[i + 1]].position, share);
        return place;
    }
    // The chord over half a radius to either side: at a corner neither the one segment nor the other.
    [[nodiscard]] glm::dvec3 direction(const Place& place) const {
        const double reach = 0.5 * place.radius;
        const glm::dvec3 chord =
            at(std::min(place.along + reach, length())).at - at(std::max(place.along - reach, 0.0)).at;
        const double size = glm::length(chord);
        if (size > 1e-9 * place.radius) return chord / size;
        const std::size_t i = segment_at(place.along);
        const glm::dvec3 along = position(i + 1) - position(i);
        return glm::length(along) > 0.0 ? glm::normalize(along) : glm::dvec3(0.0, 0.0, 1.0);
    }

private:
    [[nodiscard]] const glm::dvec3& position(std::size_t i) const { return smooth_.points[points_[i]].position; }
    [[nodiscard]] std::size_t segment_at(double along) const {
        const auto after = std::upper_bound(until_.begin() + 1, until_.end() - 1, along);
        return static_cast<std::size_t>(after - until_.begin()) - 1;
    }
    const tree::VesselTree& smooth_;
    const tree::VesselTree& source_;
    const std::vector<std::uint32_t>& points_;
    std::vector<double> until_; // mm along, of each point
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
    for (std::size_t i = first; i < places.size(); ++i)
        places[i].step = (i + 1 < places.size() ? places[i + 1].along : run.length()) - places[i].along;
}

} // namespace

NearbyVessels::NearbyVessels(const tree::Links& links) : links_(links) {
    constexpr std::uint32_t kLeaf = 4;
    order_.resize(links.all().size());
    std::iota(order_.begin(), order_.end(), 0U);
    along_.resize(order_.size(), 0.0);
    for (std::size_t n = 1; n < along_.size(); ++n)
        if (links[n].branch == links[n - 1].branch)
            along_[n] = along_[n - 1] + glm::distance(links[n - 1].a.position, links[n - 1].b.position);
    struct Part {
        std::uint32_t first, count;
        std::int64_t second_of; // the node whose second child this is; -1: a first child
    };
    std::vector<Part> parts;
    if (!order_.empty()) parts.push_back({0, static_cast<std::uint32_t>(order_.size()), -1});
    while (!parts.empty()) {
        const Part part = parts.back();
        parts.pop_back();
        if (part.second_of >= 0)
            nodes_[static_cast<std::size_t>(part.second_of)].first = static_cast<std::uint32_t>(nodes_.size());
        Node node{glm::dvec3(kInfinity), glm::dvec3(-kInfinity), part.first, 0};
        for (std::uint32_t i = part.first; i < part.first + part.count; ++i)
            for (const tree::Point* end : {&links[order_[i]].a, &links[order_[i]].b}) {
                node.least = glm::min(node.least, end->position - kOwn * end->radius);
                node.most = glm::max(node.most, end->position + kOwn * end->radius);
            }
        if (part.count <= kLeaf) {
            node.count = part.count;
            nodes_.push_back(node);
            continue;
        }
        const glm::dvec3 size = node.most - node.least;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t half = part.count / 2;
        const auto begin = order_.begin() + part.first;
        std::nth_element(begin, begin + half, begin + part.count, [&](std::uint32_t a, std::uint32_t b) {
            const auto middle = [&](std::uint32_t n) { return links[n].a.position[axis] + links[n].b.position[axis]; };
            return middle(a) < middle(b) || (middle(a) == middle(b) && a < b);
        });
        const auto at = static_cast<std::int64_t>(nodes_.size());
        nodes_.push_back(node);
        parts.push_back({part.first + half, part.count - half, at});
        parts.push_back({part.first, half, -1});
    }
}

// `radii`: the sum of the place's radius and the link's, there.
bool NearbyVessels::is_out(const ButFor& but, std::uint32_t link, double share, double radii) const {
    const tree::Link& one = links_[link];
    if (one.branch != but.near_on) return false;
    const double along = along_[link] + share * glm::distance(one.a.position, one.b.position);
    return std::abs(along - but.along) < kFar * radii;
}

NearbyVessels::Nearest NearbyVessels::nearest(const tree::Point& place, double most, const ButFor& but,
                                              double enough) const {
    Nearest best{most, tree::kNoBranch, 0.0};
    if (nodes_.empty()) return best;
    const double reach = kOwn * place.radius;
    std::array<std::uint32_t, 64> open; // halves: no deeper than the bits of a count of links
    open[0] = 0;
    std::size_t count = 1;
    while (count > 0) {
        const std::uint32_t at = open[--count];
        const Node& node = nodes_[at];
        if (glm::any(glm::lessThan(place.position, node.least - reach)) ||
            glm::any(glm::greaterThan(place.position, node.most + reach)))
            continue;
        if (node.count == 0) {
            open[count++] = node.first;
            open[count++] = at + 1;
            continue;
        }
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const tree::Link& link = links_[order_[i]];
            if (link.branch == but.branches[0] || link.branch == but.branches[1]) continue;
            const double closeness = tree::closeness(place, link);
            if (closeness >= best.closeness) continue;
            const double share = tree::share_along(place.position - link.a.position, link.b.position - link.a.position);
            const double radius = tree::point_on(link, share).radius;
            if (is_out(but, order_[i], share, place.radius + radius)) continue;
            best = {closeness, link.branch, radius};
            if (closeness < enough) return best;
        }
    }
    return best;
}

Reference::Reference(const tree::VesselTree& source, int smooth_passes)
    : smooth_passes_(smooth_passes), prepared_(smoothed(source, smooth_passes)), links_(prepared_), vessels_(links_),
      input_links_(smoothed(source, 0)), input_vessels_(input_links_) {
    const tree::VesselTree& tree = prepared_.tree;
    std::vector<int> degree(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches) ++degree[branch.points.front()], ++degree[branch.points.back()];
    first_.push_back(0);
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        put_places(Run(tree, source, branch), static_cast<int>(id),
                   {degree[branch.points.front()] == 1, degree[branch.points.back()] == 1}, places_);
        first_.push_back(places_.size());
    }
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, places_.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            Place& place = places_[i];
            place.beside =
                vessels_.nearest({place.at, place.radius}, kFar, {{}, place.branch, place.along}, 0.0).closeness;
        }
    });
}

} // namespace ramus::validate
