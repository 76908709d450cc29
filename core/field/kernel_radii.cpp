#include "core/field/kernel_radii.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <utility>
#include <vector>

namespace ramus::field {

namespace {

constexpr int kRounds = 8;          // reduce the error in a 50 % stenosis as long as the vessel is wide to 1 %
constexpr int kFirstSteps = 6;      // steps of Newton's method in the first round
constexpr int kLaterSteps = 2;      // in later rounds, from the radius of the round before
constexpr double kSpacing = 0.5;    // largest distance of places, in radii
constexpr double kLooked = 2.0;     // in radii from the ends of a segment: farther inside the surface has no error
constexpr double kMostChange = 0.3; // largest change of the logarithm of a radius in a round
constexpr double kNode = 2.0;       // in radii of a node: nearer points keep their radius
constexpr double kNodeFades = 1.5;  // in kNode: farther points take the whole change
constexpr double kLeastShare = 0.2; // a point whose segments contribute less than this to the places changes less

struct RadiusPlaceOnAxis {
    double at = 0.0;     // mm along the branch
    double wanted = 0.0; // mm
    double counts = 0.0; // its weight: the length of branch that it represents, mm
    double found = 0.0;  // radius of the surface, mm
    double amiss = 0.0;  // log(wanted / found)
};

// One branch as a straight vessel along z.
class StraightBranch {
public:
    StraightBranch(const tree::PreparedTree& prepared, const tree::Branch& branch, const Kernel& kernel)
        : kernel_(kernel), smooth_(prepared.centerline == tree::Centerline::kSmooth),
          surface_(kernel.long_vessel->place(kernel, kernel.isovalue).measure) {
        for (const std::uint32_t p : branch.points) {
            const tree::Point& point = prepared.tree.points[p];
            const double length =
                at_.empty() ? 0.0 : glm::distance(point.position, prepared.tree.points[before_].position);
            before_ = p;
            at_.push_back(at_.empty() ? 0.0 : at_.back() + length);
            wanted_.push_back(point.radius);
            widest_ = std::max(widest_, kWidest * point.radius);
        }
        for (std::size_t i = 0; i < at_.size(); ++i) held_.push_back(free_at(at_[i]));
        radii_ = next_ = wanted_;
        lay_segments();
        lay_places();
    }

    // The kernel radii of the branch's points, mm.
    [[nodiscard]] const std::vector<double>& radii() {
        double worst = 0.0;
        for (RadiusPlaceOnAxis& place : places_) {
            find(place, kFirstSteps);
            worst = std::max(worst, std::abs(place.amiss));
        }
        if (worst <= kAmiss) return wanted_;
        for (int round = 0; round < kRounds; ++round) {
            change();
            if (round + 1 < kRounds)
                for (RadiusPlaceOnAxis& place : places_) find(place, kLaterSteps);
        }
        return radii_;
    }

private:
    // The share of a change that a place takes: 0 near the branch's ends.
    [[nodiscard]] double free_at(double along) const {
        const auto from = [](double distance, double radius) {
            const double x = std::clamp((distance / radius - kNode) / (kNode * (kNodeFades - 1.0)), 0.0, 1.0);
            return x * x * (3.0 - 2.0 * x);
        };
        return std::min(from(along, wanted_.front()), from(at_.back() - along, wanted_.back()));
    }

    // Segments between the points, and a long one at either end in place of the neighbouring branches.
    void lay_segments() {
        segments_.clear();
        const double before = 4.0 * wanted_.front(), behind = 4.0 * wanted_.back();
        add_segment(at_.front() - before, before, wanted_.front(), wanted_.front());
        for (std::size_t i = 0; i + 1 < at_.size(); ++i)
            add_segment(at_[i], at_[i + 1] - at_[i], radii_[i], radii_[i + 1]);
        add_segment(at_.back(), behind, wanted_.back(), wanted_.back());
    }
    void add_segment(double from, double length, double radius, double end_radius) {
        const double slope = length > 0.0 ? (end_radius - radius) / length : 0.0;
        segments_.push_back({0.0, 0.0, from, 0.0F, 0.0F, 1.0F, static_cast<float>(length), static_cast<float>(radius),
                             static_cast<float>(slope), static_cast<float>(smooth_ ? beyond_for(slope) : 0.0), 0});
    }

    void lay_places() {
        for (std::size_t i = 0; i + 1 < at_.size(); ++i) {
            const double length = at_[i + 1] - at_[i];
            const double spacing = kSpacing * std::min(wanted_[i], wanted_[i + 1]);
            const double pieces = std::max(1.0, std::ceil(length / spacing));
            const auto looked = static_cast<int>(std::ceil(kLooked / kSpacing));
            for (int n = 0; n < static_cast<int>(std::min(pieces, 2.0 * looked)); ++n) {
                // On a long segment only places near its two ends.
                const double piece = n < looked || pieces <= 2.0 * looked ? n : pieces - 2.0 * looked + n;
                const double share = piece / pieces, at = at_[i] + share * length;
                if (free_at(at) > 0.0)
                    places_.push_back({at, std::lerp(wanted_[i], wanted_[i + 1], share), length / pieces,
                                       std::lerp(wanted_[i], wanted_[i + 1], share)});
            }
        }
    }

    // Collects the segments that reach a place on the axis.
    void take_up(double at) {
        const double reach = kernel_.support_radii * widest_;
        const auto first = std::lower_bound(at_.begin(), at_.end(), at - reach) - at_.begin();
        std::size_t n = first > 0 ? static_cast<std::size_t>(first) : 0;
        taken_.clear();
        for (; n < segments_.size(); ++n) {
            const FieldSegment& one = segments_[n];
            if (one.az > at + reach) break;
            const double beyond = std::max({one.az - at, at - one.az - static_cast<double>(one.length), 0.0});
            if (one.length > 0.0F && beyond < kernel_.support_radii * static_cast<double>(one.thickest()))
                taken_.push_back(n);
        }
        terms_.clear(taken_.size());
        for (const std::size_t one : taken_) terms_.add(segments_[one]);
    }
    // The field at a distance from the axis, and its slope away from the axis.
    std::pair<double, double> look(double at, double radius) {
        terms_.see_from({radius, 0.0, at});
        kernel_.sum->find_terms(kernel_, terms_);
        double sum = 0.0, slope = 0.0;
        for (std::size_t n = 0; n < terms_.count; ++n) {
            sum += static_cast<double>(terms_.row(SegmentTerms::kValue)[n]);
            slope += static_cast<double>(terms_.row(SegmentTerms::kGradientX)[n]);
        }
        return {sum, slope};
    }

    // Finds the radius of the surface at a place, by Newton's method in a measure that is nearly linear in the
    // distance.
    void find(RadiusPlaceOnAxis& place, int steps) {
        take_up(place.at);
        for (int step = 0; step < steps; ++step) {
            const auto [sum, slope] = look(place.at, place.found);
            const auto [measure, fall] = kernel_.long_vessel->place(kernel_, sum);
            const double per_mm = -slope / std::max(fall, 1e-12);
            if (!(per_mm > 0.0)) break;
            const double move = (surface_ - measure) / per_mm;
            place.found = std::clamp(place.found + move, 0.5 * place.found, 2.0 * place.found);
            if (std::abs(move) < 1e-5 * place.wanted) break;
        }
        place.amiss = std::log(place.wanted / place.found);
    }

    // Changes the radius of each point by the weighted mean of the errors at the places around. The weight of a place
    // is the field that the vessel at the point adds there. So neighbouring points change by similar amounts.
    void change() {
        for (std::size_t i = 1; i + 1 < at_.size(); ++i) {
            if (!(held_[i] > 0.0)) continue;
            const double reach = kernel_.support_radii * radii_[i];
            auto place = std::ranges::lower_bound(places_, at_[i] - reach, {}, &RadiusPlaceOnAxis::at);
            double amiss = 0.0, counts = 0.0, added = 0.0;
            for (; place != places_.end() && place->at <= at_[i] + reach; ++place) {
                const double away = place->at - at_[i];
                const double radii2 = (place->found * place->found + away * away) / (radii_[i] * radii_[i]);
                const double part = kernel_.long_vessel->value(kernel_, radii2) / kernel_.isovalue * place->counts;
                amiss += part * place->amiss, counts += part, added += part / radii_[i];
            }
            if (!(counts > 0.0)) continue;
            const double mean = amiss / counts * std::min(1.0, added / kLeastShare);
            next_[i] = std::clamp(radii_[i] * std::exp(held_[i] * std::clamp(mean, -kMostChange, kMostChange)),
                                  kNarrowest * wanted_[i], kWidest * wanted_[i]);
        }
        radii_ = next_;
        lay_segments();
    }

    const Kernel& kernel_;
    bool smooth_;
    double surface_;                                        // the measure at the surface
    std::uint32_t before_ = 0;                              // the previous point, while points are added
    double widest_ = 0.0;                                   // upper bound of all kernel radii, mm
    std::vector<double> at_, wanted_, held_, radii_, next_; // by point; mm
    std::vector<FieldSegment> segments_;
    std::vector<RadiusPlaceOnAxis> places_;
    std::vector<std::size_t> taken_; // by column of terms_: the segment
    SegmentTerms terms_;
};

} // namespace

tree::PreparedTree with_kernel_radii(tree::PreparedTree prepared, const Kernel& kernel) {
    std::vector<double> radii(prepared.tree.points.size());
    for (std::size_t p = 0; p < radii.size(); ++p) radii[p] = prepared.tree.points[p].radius;
    tbb::parallel_for(std::size_t(0), prepared.tree.branches.size(), [&](std::size_t id) {
        const tree::Branch& branch = prepared.tree.branches[id];
        StraightBranch straight(prepared, branch, kernel);
        const std::vector<double>& found = straight.radii();
        for (std::size_t i = 1; i + 1 < found.size(); ++i) radii[branch.points[i]] = found[i];
    });
    prepared.kernel_radii = std::move(radii);
    return prepared;
}

} // namespace ramus::field
