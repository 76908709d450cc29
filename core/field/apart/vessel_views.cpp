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
constexpr double kFarAway = std::numeric_limits<double>::infinity();

using tree::share_along;

bool closer_than(double distance, const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 between = b - a;
    return glm::dot(between, between) < distance * distance;
}

// How far along a way a straight line is nearest to it, mm; both directions are unit vectors.
double nearest_to_line(const glm::dvec3& from, const glm::dvec3& way, const glm::dvec3& start,
                       const glm::dvec3& along) {
    const double cosine = glm::dot(way, along);
    const double sine2 = std::max(1.0 - cosine * cosine, 1e-12);
    return glm::dot(start - from, way - cosine * along) / sine2;
}

SeenSegment seen_from(const FieldSegment& s, const glm::dvec3& point, std::uint32_t place, int piece) {
    const glm::dvec3 start(s.ax, s.ay, s.az);
    const glm::dvec3 u(s.ux, s.uy, s.uz);
    const double t = std::clamp(glm::dot(point - start, u), 0.0, static_cast<double>(s.length));
    SeenSegment seen{place, piece, 0.0, static_cast<double>(s.radius) + static_cast<double>(s.slope) * t,
                     start + t * u};
    seen.distance = glm::distance(point, seen.foot);
    return seen;
}

// Whether the segment's support reaches the point.
bool reaches(const FieldSegment& s, const glm::dvec3& point, double support_radii) {
    const glm::dvec3 from = point - glm::dvec3(s.ax, s.ay, s.az);
    const glm::dvec3 u(s.ux, s.uy, s.uz);
    const double t = std::clamp(glm::dot(from, u), 0.0, static_cast<double>(s.length));
    const glm::dvec3 off = from - t * u;
    const double reach = support_radii * (static_cast<double>(s.radius) + static_cast<double>(s.slope) * t);
    return glm::dot(off, off) < reach * reach;
}

} // namespace

VesselViews::VesselViews(const Kernel& kernel, const FieldSegment* segments, const Pieces& pieces)
    : kernel_(kernel), surface_phi_(std::sqrt(-std::log(kernel.isovalue))),
      merged_(tree::ContactLimits(kernel.width).merged), segments_(segments), contacts_(pieces) {}

bool VesselViews::enter(SegmentIndices list) {
    list_ = list;
    kept_apart_.clear();
    if (!contacts_.enter(list)) return false;
    for (std::uint32_t n = 0; n < list_.size(); ++n)
        if (contacts_.piece(n) >= 0) kept_apart_.push_back(n);
    return true;
}

VesselViews::Sight VesselViews::look(const glm::dvec3& point) {
    point_ = point;
    near_.clear();
    beside_contact_ = false;
    for (const std::uint32_t n : kept_apart_) {
        const FieldSegment& segment = segments_[list_[n]];
        if (reaches(segment, point, kernel_.support_radii))
            near_.push_back(seen_from(segment, point, n, contacts_.piece(n)));
    }
    if (any_left_out()) {
        see_all();
        return Sight::kParted;
    }
    if (near_.empty()) return Sight::kPlain;
    const SeenSegment& own = *std::ranges::min_element(near_, {}, &SeenSegment::relative);
    if (own.relative() > kClaimRadii) return Sight::kPlain;
    const double spare = nearest_shadow(own).spare;
    beside_contact_ = spare < kBesideRadii * own.radius;
    if (!(spare < 0.0)) return Sight::kPlain;
    see_all();
    return seen_[nearest()].place == own.place ? Sight::kCut : Sight::kPlain;
}

void VesselViews::see_all() {
    seen_.clear();
    auto next = near_.begin();
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        if (next != near_.end() && next->place == n) {
            seen_.push_back(*next++);
            continue;
        }
        const FieldSegment& segment = segments_[list_[n]];
        if (contacts_.piece(n) < 0 && reaches(segment, point_, kernel_.support_radii))
            seen_.push_back(seen_from(segment, point_, n, -1));
    }
}

bool VesselViews::any_left_out() {
    near_pieces_.assign(contacts_.words(), 0);
    for (const SeenSegment& seen : near_) {
        const auto piece = static_cast<std::size_t>(seen.piece);
        near_pieces_[piece / 64] |= std::uint64_t{1} << piece % 64;
    }
    for (const SeenSegment& a : near_) {
        const auto partners = contacts_.partners(a.piece);
        bool any = false;
        for (std::size_t w = 0; w < partners.size(); ++w) any = any || (partners[w] & near_pieces_[w]) != 0;
        if (any && std::ranges::any_of(near_, [&](const SeenSegment& b) { return leaves_out(a, b); })) return true;
    }
    return false;
}

std::uint64_t VesselViews::add_terms() {
    terms_.clear(seen_.size());
    for (const SeenSegment& seen : seen_) terms_.add(segments_[list_[seen.place]], point_);
    kernel_.sum->find_terms(kernel_, terms_);
    return terms_.count;
}

bool VesselViews::leaves_out(const SeenSegment& a, const SeenSegment& b) const {
    const auto apart_from = static_cast<double>(contacts_.relation(a.piece, b.piece).apart_from);
    return apart_from > 0.0 && closer_than(apart_from * (a.radius + b.radius), a.foot, b.foot);
}

double VesselViews::left_out(const SeenSegment& a, const SeenSegment& b) const {
    const auto apart_from = static_cast<double>(contacts_.relation(a.piece, b.piece).apart_from);
    if (!(apart_from > 0.0)) return 0.0;
    const double closeness = glm::distance(a.foot, b.foot) / (a.radius + b.radius);
    const double whole = 0.5 * (std::min(merged_, apart_from) + apart_from);
    const double begin = std::min(whole, 1.12 * merged_); // a little above, for more than two vessels
    const double x = std::clamp((apart_from - closeness) / (apart_from - begin), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

VesselView VesselViews::view(std::size_t seen) const {
    VesselView view;
    view.seen = seen;
    const float* value = terms_.row(SegmentTerms::kValue);
    const float* x = terms_.row(SegmentTerms::kGradientX);
    const float* y = terms_.row(SegmentTerms::kGradientY);
    const float* z = terms_.row(SegmentTerms::kGradientZ);
    for (std::size_t n = 0; n < seen_.size(); ++n) {
        const double share = 1.0 - left_out(seen_[seen], seen_[n]);
        view.value += share * static_cast<double>(value[n]);
        view.gradient += share * glm::dvec3(x[n], y[n], z[n]);
    }
    return view;
}

SeenSegment VesselViews::moved(const SeenSegment& own, const glm::dvec3& aside) const {
    if (aside == glm::dvec3(0.0)) return own;
    SeenSegment nearest = own;
    nearest.distance = kFarAway;
    for (const SeenSegment& other : near_) {
        if (other.place != own.place && apart(own, other)) continue;
        SeenSegment seen = seen_from(segments_[list_[other.place]], point_ - aside, other.place, other.piece);
        if (seen.distance >= nearest.distance) continue;
        seen.foot += aside;
        nearest = seen;
    }
    return nearest;
}

VesselViews::Beside VesselViews::beside(std::size_t own, std::size_t other) const {
    const glm::dvec3 aside(contacts_.relation(seen_[own].piece, seen_[other].piece).aside);
    return {point_ - moved(seen_[own], aside).foot, point_ - moved(seen_[other], -aside).foot};
}

VesselViews::Shadow VesselViews::shadow_of(const Obstacle& obstacle, const Way& way) const {
    const PieceShape& shape = *obstacle.shape;
    const glm::dvec3 line = shape.end - shape.start;
    const double length = glm::length(line);
    if (!(way.length > 0.0) || !(length > 0.0)) return {kFarAway, {}};
    // Where the way is nearest to the obstacle's axis, how far it is then, and how long it is within the obstacle.
    double nearest = nearest_to_line(way.foot, way.direction, shape.start, line / length);
    double beside = share_along(way.foot + nearest * way.direction - shape.start, line);
    if (beside <= 0.0 || beside >= 1.0) {
        nearest = glm::dot(shape.start + beside * line - way.foot, way.direction);
        beside = share_along(way.foot + nearest * way.direction - shape.start, line);
    }
    if (!(nearest > 0.0) || nearest > way.length + way.radius) return {kFarAway, {}};
    const glm::dvec3 axis = shape.start + beside * line;
    const glm::dvec3 off = way.foot + nearest * way.direction - axis;
    const double off2 = glm::dot(off, off);
    const double radius = glm::mix(shape.start_radius, shape.end_radius, beside);
    const double lateral = (std::sqrt(off2) - radius) * std::min(way.length / nearest, 1.0);
    const double half_chord = std::sqrt(std::max(radius * radius - off2, 0.0));
    // From where on it is nearer to the obstacle's axis, as that counts, than long.
    const glm::dvec3 between = axis - glm::dvec3(obstacle.relation.aside) - way.foot;
    const double ahead = glm::dot(between, way.direction);
    const double middle = ahead > 0.0 ? 0.5 * glm::dot(between, between) / ahead : kFarAway;
    if (middle >= nearest + half_chord && lateral < 0.0) return {kFarAway, {}};
    const Shadow front{std::max(nearest, middle) - way.length, way.direction};
    if (front.spare >= lateral || !(off2 > 0.0)) return front;
    return {lateral, -off / std::sqrt(off2)};
}

VesselViews::Way VesselViews::way_to(const SeenSegment& own) const {
    Way way{own.foot, point_ - own.foot, own.distance, own.radius};
    way.direction /= std::max(way.length, 1e-300);
    return way;
}

VesselViews::Shadow VesselViews::nearest_shadow(const SeenSegment& own) const {
    Shadow nearest{kFarAway, {}};
    glm::vec3 moved_by(0.0F); // for the obstacle before: those of one contact follow each other
    Way way = way_to(own);
    for (const Obstacle& obstacle : contacts_.obstacles(own.piece)) {
        const PieceShape& shape = *obstacle.shape;
        const double thickness = std::max(shape.start_radius, shape.end_radius);
        const double apart =
            glm::distance(own.foot, 0.5 * (shape.start + shape.end)) - 0.5 * glm::distance(shape.start, shape.end);
        if (apart > thickness + own.distance + own.radius) continue;
        const double beside = share_along(own.foot - shape.start, shape.end - shape.start);
        const double radii = own.radius + glm::mix(shape.start_radius, shape.end_radius, beside);
        if (!closer_than(static_cast<double>(obstacle.relation.apart_from) * radii, own.foot,
                         glm::mix(shape.start, shape.end, beside)))
            continue;
        if (obstacle.relation.aside != moved_by) {
            moved_by = obstacle.relation.aside;
            way = way_to(moved(own, glm::dvec3(moved_by)));
        }
        if (const Shadow shadow = shadow_of(obstacle, way); shadow.spare < nearest.spare) nearest = shadow;
    }
    return nearest;
}

void VesselViews::list_vessels() {
    vessels_.clear();
    constexpr std::size_t kMostVessels = 6;
    while (vessels_.size() < kMostVessels) {
        std::size_t nearest = kNone;
        for (std::size_t n = 0; n < seen_.size(); ++n) {
            if (nearest != kNone && seen_[n].relative() >= seen_[nearest].relative()) continue;
            if (std::ranges::all_of(vessels_, [&](std::size_t v) { return apart(seen_[v], seen_[n]); })) nearest = n;
        }
        if (nearest == kNone) break;
        vessels_.push_back(nearest);
    }
}

VesselViews::Verdict VesselViews::judge() const {
    Verdict verdict;
    const auto isovalue = static_cast<float>(kernel_.isovalue);
    const auto below = static_cast<double>(std::nextafter(isovalue, 0.0F));
    for (const std::size_t vessel : vessels_) {
        if (seen_[vessel].relative() > kClaimRadii) break;
        double value = view(vessel).value;
        if (nearest_shadow(seen_[vessel]).spare < 0.0) value = std::min(value, below);
        const bool claims = static_cast<float>(value) >= isovalue;
        bool better = claims ? verdict.owner == kNone : verdict.owner == kNone && value > verdict.value;
        if (claims && !better) {
            const Beside sides = beside(vessel, verdict.owner);
            better = glm::length(sides.from_own) < glm::length(sides.from_other);
        }
        if (!better) continue;
        verdict.value = value;
        if (claims) verdict.owner = vessel;
    }
    return verdict;
}

std::size_t VesselViews::nearest() const {
    std::size_t nearest = kNone;
    for (std::size_t n = 0; n < seen_.size(); ++n)
        if (nearest == kNone || seen_[n].relative() < seen_[nearest].relative()) nearest = n;
    return nearest;
}

std::size_t VesselViews::nearest_of_vessel(std::uint32_t place) const {
    const int piece = contacts_.piece(place);
    std::size_t nearest = kNone;
    for (std::size_t n = 0; n < seen_.size(); ++n)
        if (!contacts_.apart(piece, seen_[n].piece) &&
            (nearest == kNone || seen_[n].relative() < seen_[nearest].relative()))
            nearest = n;
    return nearest;
}

} // namespace ramus::field
