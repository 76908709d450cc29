#include "core/field/apart/vessel_views.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::field {

namespace {

// Beyond this many radii from its axis no point is inside a vessel, four of whose kind meet there.
constexpr double kClaimRadii = 1.25;

SeenSegment seen_from(const FieldSegment& s, const glm::dvec3& point, std::uint32_t place, int piece) {
    const glm::dvec3 start(s.ax, s.ay, s.az);
    const glm::dvec3 u(s.ux, s.uy, s.uz);
    const auto length = static_cast<double>(s.length);
    const double t = std::clamp(glm::dot(point - start, u), 0.0, length);
    SeenSegment seen{place, piece, 0.0, static_cast<double>(s.radius) + static_cast<double>(s.slope) * t,
                     start + t * u};
    seen.distance = glm::distance(point, seen.foot);
    return seen;
}

} // namespace

VesselViews::VesselViews(const Kernel& kernel, const FieldSegment* segments, const tree::Contacts& contacts)
    : kernel_(kernel), surface_phi_(std::sqrt(-std::log(kernel.isovalue))),
      merged_(tree::ContactLimits(kernel.width).merged), segments_(segments), contacts_(contacts) {}

bool VesselViews::enter(SegmentIndices list) {
    list_ = list;
    return contacts_.enter(list);
}

bool VesselViews::look(const glm::dvec3& point) {
    point_ = point;
    seen_.clear();
    for (std::uint32_t n = 0; n < list_.size(); ++n) {
        const SeenSegment seen = seen_from(segments_[list_[n]], point, n, contacts_.piece(n));
        if (seen.distance < kernel_.support_radii * seen.radius) seen_.push_back(seen);
    }
    terms_.clear(seen_.size());
    for (std::size_t a = 0; a < seen_.size(); ++a) {
        if (seen_[a].piece < 0) continue;
        for (std::size_t b = a + 1; b < seen_.size(); ++b)
            if (left_out(seen_[a], seen_[b]) > 0.0) {
                for (const SeenSegment& seen : seen_) terms_.add(segments_[list_[seen.place]], point);
                return true;
            }
    }
    for (const SeenSegment& seen : seen_) terms_.add(segments_[list_[seen.place]], point);
    return false;
}

std::uint64_t VesselViews::add_terms() {
    kernel_.sum->find_terms(kernel_, terms_);
    return terms_.count;
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

VesselViews::Beside VesselViews::beside(std::size_t own, std::size_t other) const {
    const SeenSegment& a = seen_[own];
    const SeenSegment& b = seen_[other];
    const double share = left_out(a, b);
    return {point_ - a.foot - share * glm::dvec3(contacts_.relation(a.piece, b.piece).aside),
            point_ - b.foot - share * glm::dvec3(contacts_.relation(b.piece, a.piece).aside)};
}

VesselViews::Layer VesselViews::layer_behind(std::size_t own, std::size_t other) const {
    constexpr double kThin = 0.8, kGroove = 0.5; // of the thinner vessel's radius
    const SeenSegment& a = seen_[own];
    const SeenSegment& b = seen_[other];
    Layer layer{std::numeric_limits<double>::infinity(), {}};
    if (!(a.distance > 0.0)) return layer;
    const glm::dvec3 way = (point_ - a.foot) / a.distance;
    const glm::dvec3 to_other = b.foot - a.foot;
    const double along = glm::dot(to_other, way);
    const glm::dvec3 aside = to_other - along * way;
    const double off2 = glm::dot(aside, aside);
    if (along <= 0.0 || off2 >= b.radius * b.radius) return layer;
    const double exit = along + std::sqrt(b.radius * b.radius - off2);
    if (a.distance <= exit || left_out(a, b) < 0.5) return layer;
    const double thinner = std::min(a.radius, b.radius);
    const double off = std::sqrt(off2);
    layer.spare = std::min(a.radius - exit - kThin * thinner, off - kGroove * thinner);
    if (off > 0.0) layer.inward = aside / off;
    return layer;
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
        if (std::ranges::any_of(vessels_,
                                [&](std::size_t v) { return v != vessel && layer_behind(vessel, v).spare < 0.0; }))
            value = std::min(value, below);
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
