#include "core/tree/contacts/spread_axes.h"

#include "core/base/sort_unique.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <unordered_map>

namespace ramus::tree {

namespace {

// Two links that are close, or that moves may bring close.
struct ClosePair {
    std::array<std::uint32_t, 2> link;
    double thinner = 0.0;                // radius, mm
    glm::dvec3 lean{0.0};                // unit: preferred direction of the second link where the axes cross
    std::array<Link, 2> at;              // with radii of 1, so that closest_approach() minimises the distance
    std::array<std::uint32_t, 4> ends{}; // numbers of their ends: of the first link, of the second
};

// The closest approach of two links.
struct Between {
    glm::dvec3 from_first{0.0}; // mm, from the first link to the second one
    double share_a = 0.0, share_b = 0.0;
};

Between between(const Link& a, const Link& b) {
    const Approach approach = closest_approach(a, b);
    return {point_on(b, approach.share_b).position - point_on(a, approach.share_a).position, approach.share_a,
            approach.share_b};
}

Link moved(Link link, const glm::dvec3& start, const glm::dvec3& end) {
    link.a.position += start;
    link.b.position += end;
    return link;
}

// Points spread evenly over a unit sphere (a spiral with golden angles).
constexpr int kDirections = 96;
glm::dvec3 direction(int n) {
    const double z = 1.0 - (2.0 * n + 1.0) / kDirections;
    const double angle = n * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double radius = std::sqrt(1.0 - z * z);
    return {radius * std::cos(angle), radius * std::sin(angle), z};
}

// A short move (mm) of the whole second vessel that separates the pairs best, and the least distance that it gives, in
// radii of the thinner vessel.
struct OneMove {
    glm::dvec3 move{0.0};
    double least = 0.0;
};
OneMove best_move(std::span<const ClosePair> pairs, double thinner) {
    OneMove best;
    std::vector<const ClosePair*> order; // the pair that ruled out the last move is tested first
    for (const ClosePair& pair : pairs) order.push_back(&pair);
    for (const double share : {0.5, 0.75, 1.0, 1.25, 1.5}) {
        for (int n = 0; n < kDirections; ++n) {
            const glm::dvec3 move = share * kLeastDistance * thinner * direction(n);
            double least = std::numeric_limits<double>::max();
            for (std::size_t k = 0; k < order.size(); ++k) {
                const ClosePair& pair = *order[k];
                least = std::min(least, glm::length(between(pair.at[0], moved(pair.at[1], move, move)).from_first) /
                                            pair.thinner);
                if (least > best.least) continue;
                std::swap(order[k], order.front());
                break;
            }
            if (least > best.least) best = {move, least};
        }
        if (best.least >= kLeastDistance) break;
    }
    return best;
}

class Spreading {
public:
    explicit Spreading(const Links& links) : links_(links) {}

    // Adds the pairs of a contact. Returns whether any of them is too close.
    bool add(const Island& island) {
        const std::size_t first = pairs_.size();
        double least = kLeastDistance;
        double thinner = 0.0;
        for (const OrientedPair& oriented : island.pairs) {
            ClosePair pair{oriented.link, std::numeric_limits<double>::max(), {}, {}, {}};
            for (std::size_t side = 0; side < 2; ++side) {
                const Link link = links_[pair.link[side]];
                pair.ends[2 * side] = number(link.from), pair.ends[2 * side + 1] = number(link.to);
                pair.thinner = std::min({pair.thinner, link.a.radius, link.b.radius});
                pair.at[side] = link;
                pair.at[side].a.radius = pair.at[side].b.radius = 1.0;
            }
            const double distance = glm::length(between(pair.at[0], pair.at[1]).from_first) / pair.thinner;
            if (distance < least) least = distance, thinner = pair.thinner;
            if (distance < kLeastDistance + 2.0 * kFarthestAside) pairs_.push_back(pair);
        }
        if (!(least < kLeastDistance)) return false;
        const OneMove one = best_move(std::span(pairs_).subspan(first), thinner);
        const double length = glm::length(one.move);
        for (std::size_t n = first; n < pairs_.size(); ++n)
            if (length > 0.0) pairs_[n].lean = one.move / length;
        moves_.resize(points_.size(), glm::dvec3(0.0));
        // Along a long contact the vessels may wind around each other, so a single move does not fit all of it.
        if (length_of(island) > kLongContact * thinner) return true;
        std::vector<std::uint8_t> done(points_.size(), 0);
        for (const OrientedPair& oriented : island.pairs)
            for (std::size_t side = 0; side < 2; ++side)
                for (const std::uint32_t point : {links_[oriented.link[side]].from, links_[oriented.link[side]].to})
                    if (const std::uint32_t n = number(point); done[n] == 0)
                        done[n] = 1, moves_[n] += (side == 0 ? -0.5 : 0.5) * one.move;
        return true;
    }

    void run() {
        constexpr int kSmoothed = 40, kPasses = 120;
        list_neighbours();
        moves_.resize(points_.size(), glm::dvec3(0.0));
        for (int pass = 0; pass < kPasses; ++pass) {
            if (!push()) break;
            if (pass < kSmoothed) smooth();
            for (std::size_t n = 0; n < points_.size(); ++n) {
                const double most = kFarthestAside * points_[n].radius;
                const double length = glm::length(moves_[n]);
                if (length > most) moves_[n] *= most / length;
            }
        }
    }

    [[nodiscard]] glm::dvec3 move(std::uint32_t point) const {
        const auto found = numbers_.find(point);
        return found == numbers_.end() ? glm::dvec3(0.0) : moves_[found->second];
    }

private:
    struct MovedPoint {
        std::uint32_t point = 0;           // of the tree
        double radius = 0.0;               // mm
        std::vector<std::uint32_t> beside; // numbers of its neighbours along the vessels; kFixed: does not move
    };
    static constexpr std::uint32_t kFixed = 0xFFFFFFFFU;
    static constexpr double kLongContact = 30.0; // radii of the thinner vessel

    // The length (mm) of the contact along its first vessel.
    [[nodiscard]] double length_of(const Island& island) const {
        std::vector<std::uint32_t> first;
        for (const OrientedPair& pair : island.pairs) first.push_back(pair.link[0]);
        sort_unique(first);
        double length = 0.0;
        for (const std::uint32_t link : first)
            length += glm::distance(links_[link].a.position, links_[link].b.position);
        return length;
    }

    std::uint32_t number(std::uint32_t point) {
        const auto [at, added] = numbers_.try_emplace(point, static_cast<std::uint32_t>(points_.size()));
        if (added) points_.push_back({point, 0.0, {}});
        return at->second;
    }

    void list_neighbours() {
        for (MovedPoint& moved : points_)
            for (const std::uint32_t n : links_.at(moved.point)) {
                const Link link = links_[n];
                const bool starts = link.from == moved.point;
                const auto found = numbers_.find(starts ? link.to : link.from);
                moved.beside.push_back(found == numbers_.end() ? kFixed : found->second);
                moved.radius = starts ? link.a.radius : link.b.radius;
            }
    }

    // Moves the ends of links that are too close away from each other, by the mean of the moves that their pairs need.
    // Returns whether any pair was too close.
    bool push() {
        bool any = false;
        pushes_.assign(points_.size(), glm::dvec3(0.0));
        counts_.assign(points_.size(), 0.0);
        for (const ClosePair& pair : pairs_) {
            const std::array<std::uint32_t, 4>& ends = pair.ends;
            const Between now = between(moved(pair.at[0], moves_[ends[0]], moves_[ends[1]]),
                                        moved(pair.at[1], moves_[ends[2]], moves_[ends[3]]));
            const double lacks = kLeastDistance * pair.thinner - glm::length(now.from_first);
            if (!(lacks > 1e-6 * pair.thinner)) continue;
            any = true;
            constexpr double kLean = 0.2; // of the thinner radius: decides where the axes cross
            const glm::dvec3 way = now.from_first + kLean * pair.thinner * pair.lean;
            const double length = glm::length(way);
            if (!(length > 0.0)) continue;
            const std::array<double, 4> weight{1.0 - now.share_a, now.share_a, 1.0 - now.share_b, now.share_b};
            for (std::size_t n = 0; n < ends.size(); ++n) {
                pushes_[ends[n]] += (n < 2 ? -0.5 : 0.5) * lacks * weight[n] / length * way;
                counts_[ends[n]] += weight[n];
            }
        }
        for (std::size_t n = 0; n < points_.size(); ++n)
            if (counts_[n] > 0.0) moves_[n] += pushes_[n] / std::max(counts_[n], 0.5);
        return any;
    }

    void smooth() {
        pushes_ = moves_;
        for (std::size_t n = 0; n < points_.size(); ++n) {
            glm::dvec3 mean(0.0);
            for (const std::uint32_t beside : points_[n].beside)
                if (beside != kFixed) mean += pushes_[beside];
            mean /= static_cast<double>(points_[n].beside.size());
            moves_[n] = glm::mix(moves_[n], mean, 0.3);
        }
    }

    const Links& links_;
    std::vector<ClosePair> pairs_;
    std::vector<MovedPoint> points_;
    std::unordered_map<std::uint32_t, std::uint32_t> numbers_;
    std::vector<glm::dvec3> moves_, pushes_;
    std::vector<double> counts_;
};

} // namespace

std::vector<AxisMove> spread_axes(const Links& links, std::span<const Island> islands) {
    Spreading spreading(links);
    bool any = false;
    for (const Island& island : islands)
        if (island.contact) any = spreading.add(island) || any;
    if (!any) return {};
    spreading.run();
    std::vector<AxisMove> moves(links.size());
    for (std::size_t n = 0; n < moves.size(); ++n)
        moves[n] = {glm::vec3(spreading.move(links[n].from)), glm::vec3(spreading.move(links[n].to))};
    return moves;
}

} // namespace ramus::tree
