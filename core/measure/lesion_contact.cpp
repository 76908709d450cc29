#include "core/measure/lesion_contact.h"

#include "core/base/infinity.h"
#include "core/measure/branch_point.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace ramus::measure {

namespace {

constexpr double kOfRadius = 1e-4; // tolerance of distances to meshes, in radii

// A place of a segment, 0 to 1, and (signed distance to the lesion) - (radius) there, mm.
struct Gap {
    double at = 0.0, mm = kInfinity;
};

tree::Point between(const tree::Point& a, const tree::Point& b, double t) {
    tree::Point place = a;
    place.position = glm::mix(a.position, b.position, t);
    place.radius = glm::mix(a.radius, b.radius, t);
    return place;
}

// Finds the least gap of a segment, if it is below `best`. A signed distance is Lipschitz continuous, so the gaps at
// two places bound the gaps between them.
class LeastGap {
public:
    LeastGap(const Lesion& lesion, const tree::Point& a, const tree::Point& b, double best)
        : lesion_(lesion), a_(a), b_(b), best_{0.0, best},
          slope_(glm::distance(a.position, b.position) + std::abs(b.radius - a.radius)),
          slack_(kOfRadius * std::max(a.radius, b.radius)) {}

    Gap find() {
        if (!lesion_.mesh) look(at_foot());
        const double from = look(0.0), to = look(1.0);
        if (lesion_.mesh) search(0.0, from, 1.0, to);
        return best_;
    }

private:
    double look(double t) {
        const tree::Point place = between(a_, b_, t);
        const double mm = signed_distance(lesion_, place.position) - place.radius;
        if (mm < best_.mm) best_ = {t, mm};
        return mm;
    }
    // The place whose ball touches the segment's tangent cone where the cone is perpendicular to the way to the
    // sphere's centre.
    [[nodiscard]] double at_foot() const {
        const double length = glm::distance(a_.position, b_.position);
        const double slope = length > 0.0 ? (b_.radius - a_.radius) / length : 0.0;
        if (length <= 0.0 || std::abs(slope) >= 1.0) return 0.0;
        const glm::dvec3 along = (b_.position - a_.position) / length;
        const glm::dvec3 c = glm::dvec3(lesion_.sphere[0], lesion_.sphere[1], lesion_.sphere[2]) - a_.position;
        const double foot = glm::dot(c, along), off = glm::length(c - foot * along);
        return std::clamp((foot + slope * off / std::sqrt(1.0 - slope * slope)) / length, 0.0, 1.0);
    }
    // NOLINTNEXTLINE(misc-no-recursion): the depth is limited, since halves shrink to the slack
    void search(double from, double at_from, double to, double at_to) {
        if (0.5 * (at_from + at_to - slope_ * (to - from)) >= best_.mm - slack_) return;
        const double middle = 0.5 * (from + to), there = look(middle);
        if (at_from < at_to) {
            search(from, at_from, middle, there);
            search(middle, there, to, at_to);
        } else {
            search(middle, there, to, at_to);
            search(from, at_from, middle, there);
        }
    }

    const Lesion& lesion_;
    const tree::Point &a_, &b_;
    Gap best_;
    double slope_, slack_;
};

double length_of(const tree::VesselTree& tree, const tree::Branch& branch) {
    double mm = 0.0;
    for (std::size_t i = 1; i < branch.points.size(); ++i)
        mm += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[branch.points[i]].position);
    return mm;
}

// Any unit vector perpendicular to `axis`.
glm::dvec3 any_across(const glm::dvec3& axis) {
    return glm::normalize(glm::cross(axis, std::abs(axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0)));
}

// The circle of a cross-section's wall, compared with a lesion.
class Rim {
public:
    Rim(const Lesion& lesion, const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm, double touch_mm)
        : lesion_(lesion), centre_(centre), u_(any_across(axis)), v_(glm::cross(axis, u_)), radius_(radius_mm),
          touch_(touch_mm) {}

    [[nodiscard]] double touching() const { // radians
        constexpr int kParts = 16;
        double sum = 0.0, before = gap(0.0);
        const double first = before, part = 2.0 * std::numbers::pi / kParts;
        for (int i = 0; i < kParts; ++i) {
            const double next = i + 1 < kParts ? gap((i + 1) * part) : first;
            sum += touching(i * part, before, (i + 1) * part, next);
            before = next;
        }
        return sum;
    }

private:
    [[nodiscard]] double gap(double angle) const {
        return signed_distance(lesion_, centre_ + radius_ * (std::cos(angle) * u_ + std::sin(angle) * v_)) - touch_;
    }
    // NOLINTNEXTLINE(misc-no-recursion): six halves deep
    [[nodiscard]] double touching(double from, double at_from, double to, double at_to) const {
        constexpr double kFine = 2.0 * std::numbers::pi / 3600.0;
        const double span = to - from, sum = at_from + at_to, change = radius_ * span;
        if (sum - change > 0.0) return 0.0;
        if (sum + change <= 0.0) return span;
        if (span < kFine) {
            if ((at_from > 0.0) == (at_to > 0.0)) return at_from > 0.0 ? 0.0 : span;
            return span * std::min(at_from, at_to) / (std::min(at_from, at_to) - std::max(at_from, at_to));
        }
        const double middle = 0.5 * (from + to), there = gap(middle);
        return touching(from, at_from, middle, there) + touching(middle, there, to, at_to);
    }

    const Lesion& lesion_;
    glm::dvec3 centre_, u_, v_;
    double radius_, touch_;
};

double size_of(const Lesion& lesion) {
    if (!lesion.mesh) return 2.0 * lesion.sphere[3];
    const glm::dvec3 size = lesion.mesh->bounds().size();
    return std::max({size.x, size.y, size.z});
}

// The cross-sections along a segment.
class SectionWalk {
public:
    SectionWalk(const Lesion& lesion, const tree::Point& a, const tree::Point& b, double touch_mm)
        : lesion_(lesion), a_(a), b_(b), touch_(touch_mm), length_(glm::distance(a.position, b.position)),
          axis_((b.position - a.position) / length_), slope_(1.0 + std::abs(b.radius - a.radius) / length_) {
        constexpr double kShare = 0.125; // of what a section could miss: the vessel's radius, the lesion
        step_ = kShare * std::min(std::max(a.radius, b.radius), size_of(lesion));
        constexpr double kMostSections = 1000.0;
        step_ = std::max(step_, length_ / kMostSections);
    }

    struct Found {
        double angle_deg = 0.0, at_mm = 0.0, length_mm = 0.0;
    };
    [[nodiscard]] Found find() const {
        Found found;
        Section here = section(0.0);
        const auto keep = [&](const Section& one) {
            if (one.angle_deg > found.angle_deg) found.angle_deg = one.angle_deg, found.at_mm = one.at;
        };
        keep(here);
        while (here.at < length_) {
            const Section next = section(std::min(here.at + std::max(step_, here.sure_mm / slope_), length_));
            keep(next);
            if (here.angle_deg > 0.0 && next.angle_deg > 0.0)
                found.length_mm += next.at - here.at;
            else if (here.angle_deg > 0.0)
                found.length_mm += end_of_contact(here.at, next.at) - here.at;
            else if (next.angle_deg > 0.0)
                found.length_mm += next.at - end_of_contact(next.at, here.at);
            here = next;
        }
        if (found.angle_deg > 0.0 && found.angle_deg < 360.0) refine(found);
        return found;
    }

private:
    struct Section {
        double at = 0.0, angle_deg = 0.0;
        double sure_mm = 0.0; // nothing changes while gaps change by no more
    };
    [[nodiscard]] Section section(double at) const {
        const tree::Point place = between(a_, b_, at / length_);
        const double away = signed_distance(lesion_, place.position);
        if (away - place.radius > touch_) return {at, 0.0, away - place.radius - touch_};
        if (away + place.radius <= touch_) return {at, 360.0, touch_ - away - place.radius};
        return {at, contact_angle_deg(lesion_, place.position, axis_, place.radius, touch_), 0.0};
    }
    [[nodiscard]] double end_of_contact(double touching, double apart) const {
        constexpr int kHalves = 12;
        for (int i = 0; i < kHalves; ++i) {
            const double middle = 0.5 * (touching + apart);
            (section(middle).angle_deg > 0.0 ? touching : apart) = middle;
        }
        return 0.5 * (touching + apart);
    }
    void refine(Found& found) const {
        double low = std::max(0.0, found.at_mm - step_), high = std::min(length_, found.at_mm + step_);
        constexpr int kThirds = 24;
        for (int i = 0; i < kThirds; ++i) {
            const Section one = section(low + (high - low) / 3.0), other = section(high - (high - low) / 3.0);
            const Section& larger = one.angle_deg < other.angle_deg ? other : one;
            if (larger.angle_deg > found.angle_deg) found.angle_deg = larger.angle_deg, found.at_mm = larger.at;
            (one.angle_deg < other.angle_deg ? low : high) = one.angle_deg < other.angle_deg ? one.at : other.at;
        }
    }

    const Lesion& lesion_;
    const tree::Point &a_, &b_;
    double touch_, length_;
    glm::dvec3 axis_;
    double slope_, step_ = 0.0;
};

// Calls visit(i) for each segment from point i - 1 to i that may be nearer than limit(). Uses a lower bound of the
// distance at its first point: the last computed distance minus the length since then.
void for_near_segments(const tree::VesselTree& tree, const tree::Branch& branch, const Lesion& lesion,
                       const auto& limit, const auto& visit) {
    if (branch.points.size() < 2) return;
    double away = signed_distance(lesion, tree.points[branch.points.front()].position); // a lower bound
    bool exact = true;
    for (std::size_t i = 1; i < branch.points.size(); ++i) {
        const tree::Point& a = tree.points[branch.points[i - 1]];
        const tree::Point& b = tree.points[branch.points[i]];
        const double length = glm::distance(a.position, b.position);
        const auto out_of_reach = [&] { return away - length - std::max(a.radius, b.radius) > limit(); };
        if (!exact && !out_of_reach()) away = signed_distance(lesion, a.position);
        if (!out_of_reach()) visit(i);
        away -= length;
        exact = false;
    }
}

} // namespace

double signed_distance(const Lesion& lesion, const glm::dvec3& point) {
    if (!lesion.mesh) {
        const auto& [x, y, z, radius] = lesion.sphere;
        return glm::distance(point, glm::dvec3(x, y, z)) - radius;
    }
    const double away = lesion.mesh->surface_distance(point);
    return lesion.mesh->inside(point) ? -away : away;
}

glm::dvec3 nearest_on(const Lesion& lesion, const glm::dvec3& point) {
    if (lesion.mesh) return lesion.mesh->nearest_on_surface(point);
    const auto& [x, y, z, radius] = lesion.sphere;
    const glm::dvec3 centre(x, y, z), out = point - centre;
    const double length = glm::length(out);
    return centre + radius * (length > 0.0 ? out / length : glm::dvec3(0, 0, 1));
}

NearestWall nearest_wall(const tree::VesselTree& tree, std::span<const int> branches, const Lesion& lesion) {
    NearestWall found;
    Gap best;
    std::size_t best_segment = 0;
    for (const int id : branches) {
        const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
        for_near_segments(
            tree, branch, lesion, [&] { return best.mm; },
            [&](std::size_t i) {
                const Gap gap =
                    LeastGap(lesion, tree.points[branch.points[i - 1]], tree.points[branch.points[i]], best.mm).find();
                if (gap.mm < best.mm) best = gap, best_segment = i, found.branch = id;
            });
    }
    if (found.branch == tree::kNoBranch) return found;
    const tree::Branch& branch = tree.branches[static_cast<std::size_t>(found.branch)];
    const tree::Point &a = tree.points[branch.points[best_segment - 1]], &b = tree.points[branch.points[best_segment]];
    const tree::Point place = between(a, b, best.at);
    double before = best.at * glm::distance(a.position, b.position);
    for (std::size_t i = 1; i < best_segment; ++i)
        before += glm::distance(tree.points[branch.points[i - 1]].position, tree.points[branch.points[i]].position);
    const double length = length_of(tree, branch);
    found.fraction = length > 0.0 ? before / length : 0.0;
    found.distance_mm = std::max(best.mm, 0.0);
    found.overlap_mm = std::max(-best.mm, 0.0);
    // The outward direction of the lesion: from its surface to the place, reversed if the place lies inside.
    found.on_lesion = nearest_on(lesion, place.position);
    const double away = best.mm + place.radius;
    glm::dvec3 out = place.position - found.on_lesion;
    const double out_mm = glm::length(out);
    if (out_mm > kOfRadius * place.radius)
        out *= (away < 0.0 ? -1.0 : 1.0) / out_mm;
    else
        out = any_across(b.position != a.position ? glm::normalize(b.position - a.position) : glm::dvec3(0, 0, 1));
    found.on_wall = found.on_lesion + best.mm * out;
    return found;
}

double contact_angle_deg(const Lesion& lesion, const glm::dvec3& centre, const glm::dvec3& axis, double radius_mm,
                         double touch_mm) {
    return Rim(lesion, centre, axis, radius_mm, touch_mm).touching() * 180.0 / std::numbers::pi;
}

WallContact wall_contact(const tree::VesselTree& tree, int id, const Lesion& lesion, double touch_mm) {
    WallContact contact;
    const tree::Branch& branch = tree.branches[static_cast<std::size_t>(id)];
    double at_mm = 0.0;
    for_near_segments(
        tree, branch, lesion, [&] { return touch_mm; },
        [&](std::size_t i) {
            const tree::Point& a = tree.points[branch.points[i - 1]];
            const tree::Point& b = tree.points[branch.points[i]];
            if (a.position == b.position) return;
            const auto found = SectionWalk(lesion, a, b, touch_mm).find();
            if (found.angle_deg > contact.angle_deg) {
                contact.angle_deg = found.angle_deg;
                at_mm = found.at_mm;
                for (std::size_t k = 1; k < i; ++k)
                    at_mm += glm::distance(tree.points[branch.points[k - 1]].position,
                                           tree.points[branch.points[k]].position);
            }
            contact.length_mm += found.length_mm;
        });
    if (contact.angle_deg <= 0.0) return {};
    contact.branch = id;
    contact.fraction = at_mm / length_of(tree, branch);
    return contact;
}

std::vector<LesionVessels> lesion_vessels(const tree::VesselTree& tree, const Lesions& lesions, double touch_mm) {
    std::vector<Lesion> all;
    for (const auto& sphere : lesions.spheres) all.push_back({sphere, nullptr});
    for (const auto& mesh : lesions.meshes) all.push_back({{}, mesh});
    const bool apart = tree.systems.size() > 1;
    std::vector<std::vector<int>> branches(apart ? tree.systems.size() : 1);
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        branches[apart ? static_cast<std::size_t>(tree.branches[id].system) : 0].push_back(static_cast<int>(id));
    std::vector<LesionVessels> found;
    for (std::size_t lesion = 0; lesion < all.size(); ++lesion)
        for (std::size_t system = 0; system < branches.size(); ++system)
            if (!branches[system].empty()) found.push_back({lesion, static_cast<int>(system), {}, {}, 0, 0.0});
    tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t n) {
        LesionVessels& pair = found[n];
        const Lesion& lesion = all[pair.lesion];
        const std::vector<int>& own = branches[static_cast<std::size_t>(pair.system)];
        pair.nearest = nearest_wall(tree, own, lesion);
        if (pair.nearest.branch == tree::kNoBranch || pair.nearest.distance_mm > touch_mm) return;
        std::vector<WallContact> contacts(own.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, own.size(), 16), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                contacts[i] = wall_contact(tree, own[i], lesion, touch_mm);
        });
        for (const WallContact& contact : contacts) {
            if (contact.branch == tree::kNoBranch) continue;
            ++pair.touched;
            pair.touched_mm += contact.length_mm;
            const auto rank = [](const WallContact& c) { return std::pair(c.angle_deg, c.length_mm); };
            if (rank(pair.contact) < rank(contact)) pair.contact = contact;
        }
    });
    return found;
}

} // namespace ramus::measure
