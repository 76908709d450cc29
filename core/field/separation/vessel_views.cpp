#include "core/field/separation/vessel_views.h"

#include "core/tree/contacts/links.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

namespace ramus::field {

VesselViews::VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces)
    : kernel_(kernel), surface_measure_(kernel.long_vessel->place(kernel, kernel.isovalue).measure),
      reach_radii_(kernel.support_radii), segments_(segments), contacts_(pieces) {}

bool VesselViews::enter(SegmentIndices list, const GridAxes& axes) {
    list_ = list;
    if (!contacts_.enter(list)) return false;
    find_zone(axes);
    if (zone_.empty()) return false;
    list_axes();
    looked_ = terms_ready_ = false;
    relations_ready_.assign(static_cast<std::size_t>(contacts_.piece_count()), 0);
    if (relations_.size() < relations_ready_.size()) relations_.resize(relations_ready_.size());
    return true;
}

void VesselViews::list_axes() {
    axes_.clear(list_.size());
    moved_.assign(list_.size(), 0);
    in_contact_.assign(list_.size(), 0);
    any_moved_ = false;
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        const FieldSegment& s = segments_[list_[n]];
        axes_.add({s.ax, s.ay, s.az}, {s.ux, s.uy, s.uz}, static_cast<double>(s.length), static_cast<double>(s.radius),
                  static_cast<double>(s.slope), static_cast<double>(s.beyond));
        const PieceShape* const shape = shape_of(n);
        if (piece(n) >= 0) axes_.mark_last();
        in_contact_[n] = shape != nullptr ? 1 : 0;
        moved_[n] = shape != nullptr && shape->move != tree::AxisMove{} ? 1 : 0;
        any_moved_ = any_moved_ || moved_[n] != 0;
    }
    feet_.reserve(list_.size());
    if (any_moved_) list_counted_axes();
}

// Includes pieces whose partners are not in this brick's list: another brick that shares points may have them.
const PieceShape* VesselViews::shape_of(std::uint32_t place) const {
    return contacts_.all().shape(contacts_.all().of_segment(list_[place]));
}

// Radii of moved axes are never used.
void VesselViews::list_counted_axes() {
    counted_axes_.clear(list_.size());
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        const FieldSegment& s = segments_[list_[n]];
        glm::dvec3 start(s.ax, s.ay, s.az), end = start + static_cast<double>(s.length) * glm::dvec3(s.ux, s.uy, s.uz);
        if (moved_[n] != 0) {
            const PieceShape& shape = *shape_of(n);
            for (glm::dvec3* const place : {&start, &end})
                *place += shape.move.at(share_along(*place - shape.start, shape.end - shape.start));
        }
        const double length = glm::distance(start, end);
        counted_axes_.add(start, (end - start) / std::max(length, 1e-300), length, 1.0, 0.0);
    }
}

const AxisRelations& VesselViews::relations_of(int piece) {
    const auto of = static_cast<std::size_t>(piece);
    AxisRelations& relations = relations_[of];
    if (relations_ready_[of] != 0) return relations;
    relations_ready_[of] = 1;
    relations.resize(list_.size());
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        const auto from = static_cast<double>(contacts_.apart_from(piece, this->piece(n)));
        if (from < 0.0)
            relations.row(kInContact)[n] = in_contact_[n], relations.row(kIsMoved)[n] = moved_[n];
        else
            relations.row(kIsApart)[n] = 1.0;
        if (!(from > 0.0)) continue;
        const double whole = 0.5 * (std::min(kernel_.limits.merged, from) + from);
        // A little above `merged`, since more than two vessels may meet.
        const double begin = std::min(whole, 1.12 * kernel_.limits.merged);
        relations.row(kTogetherFrom)[n] = from;
        relations.row(kFade)[n] = 1.0 / std::max(from - begin, 1e-9);
    }
    return relations;
}

void VesselViews::look(const glm::dvec3& point) {
    if (looked_ && point == point_) return;
    looked_ = true;
    point_ = point;
    sight_known_ = terms_known_ = false;
    grouped_ = false;
    known_count_ = 0;
    find_feet(axes_, point_, reach_radii_, feet_);
}

VesselViews::Sight VesselViews::sight() {
    if (!std::exchange(sight_known_, true)) sight_ = find_sight();
    return sight_;
}

VesselViews::Sight VesselViews::find_sight() {
    beside_contact_ = false;
    if (alone()) return Sight::kPlain;
    const std::uint32_t own = feet_.marked.nearest;
    if (any_left_out(own)) return Sight::kParted;
    if (feet_.of(own, kFootRelative2) > claim_radii2()) return Sight::kPlain;
    const double spare = shadow_on(own, contacts_.piercing(piece(own)), beside_mm_).spare;
    beside_contact_ = spare < beside_mm_;
    return spare < 0.0 && nearest() == own ? Sight::kCut : Sight::kPlain;
}

double VesselViews::tree_radius(std::uint32_t place) const {
    const FieldSegment& s = segments_[list_[place]];
    if (s.excess == 0.0F && s.excess_slope == 0.0F) return radius(place);
    const double along = glm::distance(foot(place), glm::dvec3(s.ax, s.ay, s.az));
    return radius(place) + static_cast<double>(s.excess) + static_cast<double>(s.excess_slope) * along;
}

double VesselViews::distance(std::uint32_t place) const { return std::sqrt(feet_.of(place, kFootDistance2)); }

bool VesselViews::any_left_out(std::uint32_t nearest) {
    const auto has = [](std::span<const std::uint64_t> bits, int piece) {
        return (bits[static_cast<std::size_t>(piece) / 64] >> static_cast<unsigned>(piece) % 64 & 1U) != 0;
    };
    near_piece_bits_.assign(contacts_.words(), 0);
    for (const std::uint32_t n : kept_apart()) {
        const auto of = static_cast<std::size_t>(piece(n));
        near_piece_bits_[of / 64] |= std::uint64_t{1} << of % 64;
    }
    const auto any_near = [&](std::span<const std::uint64_t> bits) {
        for (std::size_t w = 0; w < bits.size(); ++w)
            if ((bits[w] & near_piece_bits_[w]) != 0) return true;
        return false;
    };
    // The relation is symmetric, so each pair needs to be tested only once, with b >= from.
    const auto is_left_out = [&](std::uint32_t a, std::uint32_t from) {
        const auto partners = contacts_.partners(piece(a));
        if (!any_near(partners)) return false;
        return std::ranges::any_of(
            kept_apart(), [&](std::uint32_t b) { return b >= from && has(partners, piece(b)) && leaves_out(a, b); });
    };
    if (is_left_out(nearest, 0)) return true; // the most frequent case
    return std::ranges::any_of(kept_apart(), [&](std::uint32_t a) { return is_left_out(a, a + 1); });
}

bool VesselViews::leaves_out(std::uint32_t a, std::uint32_t b) const {
    const auto from = static_cast<double>(contacts_.apart_from(piece(a), piece(b)));
    if (!(from > 0.0)) return false;
    const double most = from * (radius(a) + radius(b));
    const glm::dvec3 between = foot(a) - foot(b);
    return glm::dot(between, between) < most * most;
}

bool VesselViews::is_undisputed(float plain) {
    // An assumed bound: all partners together add less than this many straight vessels at the least distance.
    constexpr double kVessels = 4.0;
    const std::uint32_t own = nearest();
    const double other2 = piece(own) < 0 ? std::numeric_limits<double>::infinity()
                                         : least_relative2(feet_, relations_of(piece(own)), list_.size());
    if (other2 < claim_radii2()) return false;
    const double most = kVessels * kernel_.long_vessel->value(kernel_, other2);
    return static_cast<double>(plain) - most >= kernel_.isovalue && !(shadow_on(own, 0.0).spare < 0.0);
}

std::uint64_t VesselViews::add_terms() {
    if (!terms_ready_) {
        terms_.clear(list_.size());
        for (const std::uint32_t segment : list_) terms_.add(segments_[segment]);
        terms_ready_ = true;
    }
    if (std::exchange(terms_known_, true)) return 0;
    terms_.see_from(point_);
    kernel_.sum->find_terms(kernel_, terms_);
    whole_ = {};
    gradient_known_ = false;
    const float* const terms = terms_.row(SegmentTerms::kValue);
    for (const std::uint32_t n : seen()) whole_.value += static_cast<double>(terms[n]);
    return terms_.count;
}

VesselViews::Vessel& VesselViews::vessel(std::uint32_t place) {
    for (std::size_t n = 0; n < known_count_; ++n)
        if (known_vessels_[n].place == place) return known_vessels_[n];
    if (known_count_ < known_vessels_.size()) ++known_count_;
    Vessel& added = known_vessels_[known_count_ - 1];
    added.place = place;
    added.knows_way = added.knows_left_out = false;
    return added;
}

std::span<const double> VesselViews::left_out(Vessel& own) {
    if (own.knows_left_out) return own.left_out;
    own.knows_left_out = true;
    own.left_out.resize(AxisRelations::padded(list_.size()));
    if (const int of = piece(own.place); of >= 0)
        find_left_out(feet_, own.place, relations_of(of), list_.size(), own.left_out.data());
    else
        std::ranges::fill(own.left_out, 0.0);
    return own.left_out;
}

double VesselViews::value(std::uint32_t own) {
    double value = whole_.value;
    if (piece(own) < 0) return value;
    const std::span<const double> left = left_out(own);
    const float* const terms = terms_.row(SegmentTerms::kValue);
    for (const std::uint32_t other : kept_apart()) value -= left[other] * static_cast<double>(terms[other]);
    return value;
}

VesselView VesselViews::view(std::uint32_t own) {
    const auto gradient = [x = terms_.row(SegmentTerms::kGradientX), y = terms_.row(SegmentTerms::kGradientY),
                           z = terms_.row(SegmentTerms::kGradientZ)](std::uint32_t n) {
        return glm::dvec3(x[n], y[n], z[n]);
    };
    if (!std::exchange(gradient_known_, true)) {
        glm::dvec3 sum(0.0);
        for (const std::uint32_t n : seen()) sum += gradient(n);
        whole_.gradient = sum;
    }
    VesselView view{own, value(own), whole_.gradient};
    if (piece(own) < 0) return view;
    const std::span<const double> left = left_out(own);
    for (const std::uint32_t other : kept_apart())
        if (left[other] > 0.0) view.gradient -= left[other] * gradient(other);
    return view;
}

// Uses only axes that reach the point, so that all bricks that share the point agree.
glm::dvec3 VesselViews::foot_as_it_counts(std::uint32_t own) {
    if (piece(own) < 0 || !any_moved_) return foot(own);
    const AxisRelations& relations = relations_of(piece(own));
    return find_counted_foot(counted_axes_, point_, feet_, own, relations).value_or(foot(own));
}

const WayOut& VesselViews::way_out(Vessel& own) {
    if (own.knows_way) return own.way;
    own.knows_way = true;
    WayOut& way = own.way;
    way = {foot_as_it_counts(own.place), glm::dvec3(0.0), 0.0, radius(own.place), foot(own.place)};
    way.direction = point_ - way.foot;
    way.length = glm::length(way.direction);
    way.direction /= std::max(way.length, 1e-300);
    return way;
}

Shadow VesselViews::shadow_on(std::uint32_t own, double below) {
    return shadow_on(own, contacts_.obstacles(piece(own)), below);
}

Shadow VesselViews::shadow_on(std::uint32_t own, const ObstacleRange& range, double below) {
    return range.count == 0 ? Shadow{}
                            : nearest_shadow(contacts_.all().obstacles(), range, way_out(vessel(own)), below);
}

ShadowSide VesselViews::side_of(std::uint32_t own, const Shadow& shadow) {
    return side_of_shadow(contacts_.all().obstacles(), shadow.obstacle, way_out(vessel(own)));
}

bool VesselViews::nearer(std::uint32_t a, std::uint32_t b) const {
    if (a == kNone || b == kNone) return a != kNone;
    const double there = feet_.of(a, kFootRelative2), here = feet_.of(b, kFootRelative2);
    return there < here || (there == here && a < b);
}

void VesselViews::group_by_piece() {
    if (grouped_) return;
    grouped_ = true;
    near_pieces_.clear();
    nearest_of_piece_.assign(static_cast<std::size_t>(contacts_.piece_count()), kNone);
    nearest_of_others_ = kNone;
    const double* const relative2 = feet_.rows.row(kFootRelative2);
    for (const std::uint32_t n : seen()) { // ascending, so that the lowest place of several wins
        const int of = piece(n);
        std::uint32_t& nearest = of < 0 ? nearest_of_others_ : nearest_of_piece_[static_cast<std::size_t>(of)];
        if (nearest == kNone && of >= 0) near_pieces_.push_back(of);
        if (nearest == kNone || relative2[n] < relative2[nearest]) nearest = n;
    }
}

void VesselViews::list_vessels(double most_radii2) {
    group_by_piece();
    vessels_.clear(), candidates_.clear();
    const std::uint32_t first = nearest();
    if (first == kNone || feet_.of(first, kFootRelative2) > most_radii2) return;
    vessels_.push_back(first);
    for (const int other : near_pieces_) {
        const std::uint32_t there = nearest_of_piece_[static_cast<std::size_t>(other)];
        if (feet_.of(there, kFootRelative2) <= most_radii2 && apart(first, there)) candidates_.push_back(there);
    }
    while (!candidates_.empty() && vessels_.size() < kMostVessels) { // candidates are apart from all listed vessels
        std::uint32_t next = kNone;
        for (const std::uint32_t n : candidates_)
            if (nearer(n, next)) next = n;
        vessels_.push_back(next);
        std::erase_if(candidates_, [&](std::uint32_t n) { return n == next || !apart(next, n); });
    }
}

VesselViews::Verdict VesselViews::judge() {
    Verdict verdict;
    const auto isovalue = static_cast<float>(kernel_.isovalue);
    const auto below = static_cast<double>(std::nextafter(isovalue, 0.0F));
    list_vessels(claim_radii2());
    for (const std::uint32_t vessel : vessels_) {
        double value = this->value(vessel);
        if (value > below && shadow_on(vessel, 0.0).spare < 0.0) value = below;
        const bool claims = static_cast<float>(value) >= isovalue;
        bool better = claims ? verdict.owner == kNone : verdict.owner == kNone && value > verdict.value;
        if (claims && !better) better = glm::length(way_from(vessel)) < glm::length(way_from(verdict.owner));
        if (!better) continue;
        verdict.value = value;
        if (claims) verdict.owner = vessel;
    }
    return verdict;
}

bool VesselViews::is_within_another(std::uint32_t own) {
    list_vessels(claim_radii2());
    return std::ranges::any_of(vessels_, [&](std::uint32_t other) {
        return other != own && apart(own, other) && value(other) >= kernel_.isovalue &&
               !(shadow_on(other, 0.0).spare < 0.0);
    });
}

std::uint32_t VesselViews::nearest_of_vessel(std::uint32_t place) {
    group_by_piece();
    std::uint32_t nearest = nearest_of_others_;
    for (const int other : near_pieces_)
        if (!contacts_.apart(piece(place), other)) {
            const std::uint32_t there = nearest_of_piece_[static_cast<std::size_t>(other)];
            if (nearer(there, nearest)) nearest = there;
        }
    return nearest;
}

} // namespace ramus::field
