#include "core/field/apart/vessel_views.h"

#include "core/tree/contacts/links.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::field {

namespace {

// Beyond this many radii from its axis no point is inside a vessel, four of whose kind meet there.
constexpr double kClaimRadii = 1.25;
// So near to what is cut off, in radii, a point may have to be moved away.
constexpr double kBesideRadii = 0.5;

} // namespace

VesselViews::VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces)
    : kernel_(kernel), surface_phi_(std::sqrt(-std::log(kernel.isovalue))),
      merged_(tree::ContactLimits(kernel.width).merged), reach_radii_(kernel.support_radii), segments_(segments),
      contacts_(pieces) {}

bool VesselViews::enter(SegmentIndices list) {
    list_ = list;
    if (!contacts_.enter(list)) return false;
    list_axes();
    return true;
}

void VesselViews::list_axes() {
    kept_apart_.clear();
    others_.clear();
    piece_of_axis_.clear();
    axis_moved_.clear();
    kept_axes_.clear(list_.size());
    other_axes_.clear(list_.size());
    any_moved_ = false;
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        const FieldSegment& s = segments_[list_[n]];
        const int piece = contacts_.piece(n);
        (piece >= 0 ? kept_apart_ : others_).push_back(n);
        if (piece >= 0) piece_of_axis_.push_back(piece);
        (piece >= 0 ? kept_axes_ : other_axes_)
            .add({s.ax, s.ay, s.az}, {s.ux, s.uy, s.uz}, static_cast<double>(s.length), static_cast<double>(s.radius),
                 static_cast<double>(s.slope));
        if (piece < 0) continue;
        axis_moved_.push_back(contacts_.shape(piece).move != tree::AxisMove{} ? 1 : 0);
        any_moved_ = any_moved_ || axis_moved_.back() != 0;
    }
    kept_feet_.rows.reserve(kept_axes_.count);
    other_feet_.rows.reserve(other_axes_.count);
    if (any_moved_) list_counted_axes();
}

void VesselViews::list_counted_axes() {
    counted_feet_.rows.reserve(kept_axes_.count);
    counted_axes_.clear(kept_apart_.size());
    for (std::size_t n = 0; n < kept_apart_.size(); ++n) {
        const FieldSegment& s = segments_[list_[kept_apart_[n]]];
        const PieceShape& shape = contacts_.shape(contacts_.piece(kept_apart_[n]));
        const auto counted = [&](double along) {
            const glm::dvec3 place = kept_axes_.at(n, along);
            const double share = tree::share_along(place - shape.start, shape.end - shape.start);
            return place + shape.move.at(share);
        };
        const auto length = static_cast<double>(s.length), radius = static_cast<double>(s.radius);
        const auto slope = static_cast<double>(s.slope);
        const glm::dvec3 start = counted(0.0), end = counted(length);
        const double counts = std::max(glm::distance(start, end), 1e-300);
        if (axis_moved_[n] == 0)
            counted_axes_.add({s.ax, s.ay, s.az}, {s.ux, s.uy, s.uz}, length, radius, slope);
        else
            counted_axes_.add(start, (end - start) / counts, counts, radius, slope * length / counts);
    }
}

SeenSegment VesselViews::seen_on(const Axes& axes, const AxisFeet& feet, const std::vector<std::uint32_t>& places,
                                 std::uint32_t axis) const {
    const std::uint32_t place = places[axis];
    return {place,
            contacts_.piece(place),
            axis,
            std::sqrt(feet.of(axis, kFootDistance2)),
            feet.of(axis, kFootRadius),
            feet.of(axis, kFootRelative2),
            axes.at(axis, feet.of(axis, kFootAlong))};
}

namespace {

std::uint32_t nearest_in_radii(const AxisFeet& feet) {
    return *std::ranges::min_element(feet.near, {}, [&](std::uint32_t n) { return feet.of(n, kFootRelative2); });
}

} // namespace

VesselViews::Sight VesselViews::look(const glm::dvec3& point) {
    point_ = point;
    counted_known_ = others_known_ = beside_contact_ = false;
    find_feet(kept_axes_, point_, reach_radii_, kept_feet_);
    if (kept_feet_.near.empty()) return Sight::kPlain;
    if (any_left_out()) {
        see_all();
        return Sight::kParted;
    }
    const std::uint32_t nearest = nearest_in_radii(kept_feet_);
    if (kept_feet_.of(nearest, kFootRelative2) > kClaimRadii * kClaimRadii) return Sight::kPlain;
    const SeenSegment own = seen_on(kept_axes_, kept_feet_, kept_apart_, nearest);
    const double spare = shadow_on(own).spare;
    beside_contact_ = spare < kBesideRadii * own.radius;
    if (!(spare < 0.0) || nearest_place() != own.place) return Sight::kPlain;
    see_all();
    return Sight::kCut;
}

void VesselViews::find_others() {
    if (!others_known_) find_feet(other_axes_, point_, reach_radii_, other_feet_);
    others_known_ = true;
}

std::size_t VesselViews::nearest_place() {
    find_others();
    const bool kept = !kept_feet_.near.empty(), other = !other_feet_.near.empty();
    if (!kept && !other) return kNone;
    const std::uint32_t k = kept ? nearest_in_radii(kept_feet_) : 0, o = other ? nearest_in_radii(other_feet_) : 0;
    return !other || (kept && kept_feet_.of(k, kFootRelative2) <= other_feet_.of(o, kFootRelative2)) ? kept_apart_[k]
                                                                                                     : others_[o];
}

void VesselViews::see_all() {
    find_others();
    seen_.clear();
    seen_kept_.clear();
    auto other = other_feet_.near.begin();
    const auto add_others = [&](std::uint32_t before) {
        for (; other != other_feet_.near.end() && others_[*other] < before; ++other)
            seen_.push_back(seen_on(other_axes_, other_feet_, others_, *other));
    };
    for (const std::uint32_t axis : kept_feet_.near) {
        add_others(kept_apart_[axis]);
        seen_kept_.push_back(static_cast<std::uint32_t>(seen_.size()));
        seen_.push_back(seen_on(kept_axes_, kept_feet_, kept_apart_, axis));
    }
    add_others(static_cast<std::uint32_t>(list_.size()));
}

bool VesselViews::any_left_out() {
    near_pieces_.assign(contacts_.words(), 0);
    for (const std::uint32_t axis : kept_feet_.near) {
        const auto piece = static_cast<std::size_t>(piece_of_axis_[axis]);
        near_pieces_[piece / 64] |= std::uint64_t{1} << piece % 64;
    }
    for (const std::uint32_t a : kept_feet_.near) {
        const auto partners = contacts_.partners(piece_of_axis_[a]);
        bool any = false;
        for (std::size_t w = 0; w < partners.size(); ++w) any = any || (partners[w] & near_pieces_[w]) != 0;
        if (!any) continue;
        for (const std::uint32_t b : kept_feet_.near)
            if (b > a && leaves_out(a, b)) return true; // symmetric
    }
    return false;
}

bool VesselViews::leaves_out(std::uint32_t a, std::uint32_t b) const {
    const auto apart_from = static_cast<double>(contacts_.apart_from(piece_of_axis_[a], piece_of_axis_[b]));
    if (!(apart_from > 0.0)) return false;
    const double most = apart_from * (kept_feet_.of(a, kFootRadius) + kept_feet_.of(b, kFootRadius));
    const glm::dvec3 between =
        kept_axes_.at(a, kept_feet_.of(a, kFootAlong)) - kept_axes_.at(b, kept_feet_.of(b, kFootAlong));
    return glm::dot(between, between) < most * most;
}

std::uint64_t VesselViews::add_terms() {
    terms_.clear(seen_.size());
    for (const SeenSegment& seen : seen_) terms_.add(segments_[list_[seen.place]], point_);
    kernel_.sum->find_terms(kernel_, terms_);
    whole_ = {};
    for (std::size_t n = 0; n < seen_.size(); ++n) add_term(n, 1.0, whole_);
    return terms_.count;
}

double VesselViews::left_out(const SeenSegment& a, const SeenSegment& b) const {
    const auto apart_from = static_cast<double>(contacts_.apart_from(a.piece, b.piece));
    if (!(apart_from > 0.0)) return 0.0;
    const double closeness = glm::distance(a.foot, b.foot) / (a.radius + b.radius);
    const double whole = 0.5 * (std::min(merged_, apart_from) + apart_from);
    const double begin = std::min(whole, 1.12 * merged_); // a little above, for more than two vessels
    const double x = std::clamp((apart_from - closeness) / (apart_from - begin), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

void VesselViews::add_term(std::size_t seen, double share, VesselView& view) const {
    view.value += share * static_cast<double>(terms_.row(SegmentTerms::kValue)[seen]);
    view.gradient +=
        share * glm::dvec3(terms_.row(SegmentTerms::kGradientX)[seen], terms_.row(SegmentTerms::kGradientY)[seen],
                           terms_.row(SegmentTerms::kGradientZ)[seen]);
}

VesselView VesselViews::view(std::size_t seen) const {
    VesselView view = whole_;
    view.seen = seen;
    const SeenSegment& own = seen_[seen];
    if (own.piece < 0) return view;
    for (const std::uint32_t other : seen_kept_)
        if (contacts_.apart_from(own.piece, seen_[other].piece) > 0.0F)
            add_term(other, -left_out(own, seen_[other]), view);
    return view;
}

// Where some axis of the vessel is moved that reaches the point, the nearest one in mm of the axes as they count.
// What else a brick knows of changes nothing: bricks that a point belongs to agree.
glm::dvec3 VesselViews::foot_as_it_counts(const SeenSegment& own) const {
    if (own.piece < 0 || !any_moved_) return own.foot;
    const auto of_vessel = [&](std::uint32_t n) { return !contacts_.apart(own.piece, piece_of_axis_[n]); };
    if (std::ranges::none_of(kept_feet_.near, [&](std::uint32_t n) { return axis_moved_[n] != 0 && of_vessel(n); }))
        return own.foot;
    if (!counted_known_) find_feet(counted_axes_, point_, 0.0, counted_feet_);
    counted_known_ = true;
    std::uint32_t nearest = own.axis;
    for (const std::uint32_t other : kept_feet_.near)
        if (counted_feet_.of(other, kFootDistance2) < counted_feet_.of(nearest, kFootDistance2) && of_vessel(other))
            nearest = other;
    return counted_axes_.at(nearest, counted_feet_.of(nearest, kFootAlong));
}

WayOut VesselViews::way_out(const SeenSegment& own) const {
    WayOut way{foot_as_it_counts(own), glm::dvec3(0.0), 0.0, own.radius, own.foot};
    way.direction = point_ - way.foot;
    way.length = glm::length(way.direction);
    way.direction /= std::max(way.length, 1e-300);
    return way;
}

Shadow VesselViews::shadow_on(const SeenSegment& own) const {
    const ObstacleRange range = contacts_.obstacles(own.piece);
    return range.count == 0 ? Shadow{} : nearest_shadow(contacts_.all().obstacles(), range, way_out(own));
}

glm::dvec3 VesselViews::toward(const SeenSegment& own, const Shadow& shadow) const {
    return toward_shadow(contacts_.all().obstacles(), shadow.obstacle, way_out(own));
}

void VesselViews::list_vessels() {
    vessels_.clear();
    if (seen_.empty()) return;
    constexpr std::size_t kMostVessels = 6;
    const auto relative2 = [&](std::uint32_t n) { return seen_[n].relative2; };
    vessels_.push_back(
        static_cast<std::size_t>(std::ranges::min_element(seen_, {}, &SeenSegment::relative2) - seen_.begin()));
    left_ = seen_kept_; // of what is seen, whose vessel is not listed
    while (true) {
        const SeenSegment& listed = seen_[vessels_.back()];
        std::erase_if(left_, [&](std::uint32_t n) { return !apart(listed, seen_[n]); });
        if (left_.empty() || vessels_.size() == kMostVessels) return;
        vessels_.push_back(*std::ranges::min_element(left_, {}, relative2));
    }
}

VesselViews::Verdict VesselViews::judge() const {
    Verdict verdict;
    const auto isovalue = static_cast<float>(kernel_.isovalue);
    const auto below = static_cast<double>(std::nextafter(isovalue, 0.0F));
    for (const std::size_t vessel : vessels_) {
        if (seen_[vessel].relative2 > kClaimRadii * kClaimRadii) break;
        double value = view(vessel).value;
        if (shadow_on(seen_[vessel]).spare < 0.0) value = std::min(value, below);
        const bool claims = static_cast<float>(value) >= isovalue;
        bool better = claims ? verdict.owner == kNone : verdict.owner == kNone && value > verdict.value;
        if (claims && !better) better = glm::length(way_from(vessel)) < glm::length(way_from(verdict.owner));
        if (!better) continue;
        verdict.value = value;
        if (claims) verdict.owner = vessel;
    }
    return verdict;
}

std::size_t VesselViews::nearest_of_vessel(std::uint32_t place) const {
    const int piece = contacts_.piece(place);
    std::size_t nearest = kNone;
    for (std::size_t n = 0; n < seen_.size(); ++n)
        if (!contacts_.apart(piece, seen_[n].piece) &&
            (nearest == kNone || seen_[n].relative2 < seen_[nearest].relative2))
            nearest = n;
    return nearest;
}

} // namespace ramus::field
