#include "core/field/separation/vessel_brick.h"

#include "core/field/separation/wall.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <utility>

namespace ramus::field {

namespace {

constexpr unsigned kKnownBits = 12;
// Tuned: where no grid point lies in the corner between a vessel's surface and a wall, vertices miss it by this much.
constexpr double kOnwardCells = 1.8;

} // namespace

VesselBrick::VesselBrick(const ConvolutionField& sum, const Pieces& pieces, Rims rims)
    : sum_(sum.in_brick()), segments_(sum.segments().data()), views_(sum.kernel(), segments_, pieces), rims_(rims) {}

void VesselBrick::enter(SegmentIndices list, const GridAxes& axes) {
    sum_->enter(list, axes);
    ++brick_;
    axes_ = axes;
    onward_ = rims_ == Rims::kOverlapping ? kOnwardCells * (axes.x[1] - axes.x[0]) : 0.0;
    parts_ = views_.enter(list, axes);
}

VesselBrick::Known& VesselBrick::known(const glm::dvec3& point) {
    if (known_.empty()) known_.resize(std::size_t{1} << kKnownBits);
    std::uint64_t number = 0;
    for (int axis = 0; axis < 3; ++axis)
        number = (number ^ std::bit_cast<std::uint64_t>(point[axis])) * 0x9E3779B97F4A7C15ULL;
    return known_[number >> (64 - kKnownBits)];
}

VesselBrick::Verdict VesselBrick::judge(const glm::dvec3& point, float plain) {
    views_.look(point);
    Verdict verdict{plain, kNoOwner};
    if (views_.alone()) return verdict;
    std::uint32_t place = VesselViews::kNone;
    const bool disputed = !views_.is_undisputed(plain); // cheaper than sight()
    const VesselViews::Sight sight = disputed ? views_.sight() : VesselViews::Sight::kPlain;
    if (sight == VesselViews::Sight::kParted) {
        kernels_ += views_.add_terms();
        const VesselViews::Verdict seen = views_.judge();
        verdict.value = static_cast<float>(seen.value);
        place = seen.owner;
    } else if (sight == VesselViews::Sight::kCut) {
        verdict.value = std::min(plain, std::nextafter(views_.isovalue(), 0.0F));
    }
    if (place == VesselViews::kNone) place = views_.nearest();
    // Zones of different bricks agree within what vessels may claim and a cell around it, and differ beyond. A point
    // farther out gets no owner, so that bricks agree on every wall.
    if (place != VesselViews::kNone && views_.may_claim(place))
        verdict.owner = static_cast<Owner>(views_.list()[place]);
    return verdict;
}

float VesselBrick::value_at(const glm::dvec3& point, float plain) {
    // A view is never above the plain sum, so a point outside of the plain surface stays outside.
    if (plain < views_.isovalue() || !views_.in_zone(point)) return plain;
    const Verdict verdict = judge(point, plain);
    if (verdict.owner != kNoOwner) known(point) = {point, verdict.owner, brick_};
    return verdict.value;
}

std::uint64_t VesselBrick::sample_groups(unsigned groups, GridGroups& samples) {
    std::uint64_t kernels = sum_->sample_groups(groups, samples);
    if (!parts_) return kernels;
    const float isovalue = views_.isovalue();
    for (std::size_t group = 0; group < kGroups; ++group) {
        if ((groups >> group & 1U) == 0) continue;
        for (std::size_t n = 0; n < points_in_group(group); ++n) {
            const GridPlace at = kGridPlaces[group][n];
            float& value = samples.value[group][n];
            value = value_at({axes_.x[at.x], axes_.y[at.y], axes_.z[at.z]}, value);
            const auto bit = static_cast<std::uint16_t>(1U << n);
            samples.inside[group] = static_cast<std::uint16_t>(value >= isovalue ? samples.inside[group] | bit
                                                                                 : samples.inside[group] & ~bit);
        }
    }
    return kernels + std::exchange(kernels_, 0);
}

std::uint64_t VesselBrick::sample_lattice(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                          std::span<float> values) {
    const std::uint64_t kernels = sum_->sample_lattice(lattice, points, values);
    if (!parts_) return kernels;
    for (std::size_t n = 0; n < points.size(); ++n)
        values[n] = value_at({lattice.x[points[n].i], lattice.y[points[n].j], lattice.z[points[n].k]}, values[n]);
    return kernels + std::exchange(kernels_, 0);
}

std::uint64_t VesselBrick::find_owners(const LatticeAxes& lattice, std::span<const LatticePoint> points,
                                       std::span<Owner> owners) {
    for (std::size_t n = 0; n < points.size(); ++n)
        owners[n] = owner_at({lattice.x[points[n].i], lattice.y[points[n].j], lattice.z[points[n].k]});
    return std::exchange(kernels_, 0);
}

Owner VesselBrick::owner_at(const glm::dvec3& point) {
    if (!known_.empty()) {
        const Known& there = known(point);
        if (there.brick == brick_ && there.point == point) return there.owner;
    }
    return views_.in_zone(point) ? judge(point, views_.isovalue()).owner : kNoOwner;
}

std::uint32_t VesselBrick::place_of(Owner owner) const {
    const SegmentIndices list = views_.list();
    return static_cast<std::uint32_t>(std::ranges::lower_bound(list, static_cast<std::uint32_t>(owner)) - list.begin());
}

std::uint32_t VesselBrick::place_near(Owner owner, const glm::dvec3& point) {
    if (owner != kNoOwner) return place_of(owner);
    views_.look(point);
    const std::uint32_t nearest = views_.nearest();
    return nearest == VesselViews::kNone ? 0 : nearest;
}

int VesselBrick::piece_of(Owner owner) const {
    return owner == kNoOwner ? -1 : views_.contacts().piece(place_of(owner));
}

Bounds<glm::dvec3> VesselBrick::bounds_of(const OwnedGuess& one, const glm::dvec3& middle, double reach) const {
    const glm::dvec3 corner = axes_.corner();
    const glm::dvec3 lower = corner + glm::dvec3(one.lower), upper = corner + glm::dvec3(one.upper);
    if (one.place == OwnedGuess::Place::kBox) return {lower, upper};
    return {glm::max(lower, middle - reach), glm::min(upper, middle + reach)};
}

bool VesselBrick::is_beside_contact(const glm::dvec3& point) {
    if (!views_.in_zone(point)) return false;
    views_.look(point);
    return views_.sight() != VesselViews::Sight::kPlain || views_.beside_contact();
}

DrawnPoint VesselBrick::draw(const OwnedGuess& whose, const glm::vec3& guess, float onward) {
    constexpr double kNear = 0.03, kOnIt = 0.004; // radii: tolerance of the mesh's rims, and of projected points
    const glm::dvec3 corner = axes_.corner(), from = corner + glm::dvec3(guess);
    const Bounds<glm::dvec3> bounds = bounds_of(whose, from, 0.0);
    const std::uint32_t place = place_near(whose.owner, bounds.least);
    WallPoint point;
    point.position = from;
    DrawnPoint::Place on = DrawnPoint::Place::kWall;
    if (onward == 0.0F) on = go_on_own_surface(views_, place, kNear, point, kernels_);
    if (on == DrawnPoint::Place::kWall) {
        point = move_to_wall(views_, place, from, bounds, static_cast<double>(onward), kernels_);
        const bool goes_on = point.onward != glm::dvec3(0.0);
        if (goes_on) point.position += point.onward, point.normal = point.onward_normal;
        on = go_on_own_surface(views_, place, goes_on ? kNear : kOnIt, point, kernels_);
    }
    return {glm::vec3(point.position - corner), glm::vec3(point.normal), on};
}

std::uint64_t VesselBrick::project_apart(const Projection& guesses, std::span<const OwnedGuess> owned,
                                         const SurfacePoints& to) {
    const glm::dvec3 corner = axes_.corner();
    const auto put = [&](std::size_t n, const WallPoint& point) {
        const bool onward = point.onward != glm::dvec3(0.0);
        to.positions[n] = glm::vec3(point.position + point.onward);
        to.normals[n] = glm::vec3(onward ? point.onward_normal : point.normal);
        to.radii[n] = static_cast<float>(point.radius);
        to.branches[n] = point.branch;
        to.dominance[n] = point.dominance;
    };
    for (const OwnedGuess& one : owned) {
        const bool free = one.place == OwnedGuess::Place::kFree;
        if (one.owner == kNoOwner && free) continue;
        const std::size_t n = one.guess;
        const glm::dvec3 guess = corner + glm::dvec3(guesses.x[n], guesses.y[n], guesses.z[n]);
        const bool plain = !is_beside_contact(guess);
        if (plain && free) continue;
        const glm::dvec3 middle = corner + glm::dvec3(guesses.cx[n], guesses.cy[n], guesses.cz[n]);
        const Bounds<glm::dvec3> bounds = bounds_of(one, middle, static_cast<double>(guesses.reach[n]));
        put(n, move_to_wall(views_, place_near(one.owner, guess), guess, bounds, onward_, kernels_));
    }
    return std::exchange(kernels_, 0);
}

} // namespace ramus::field
