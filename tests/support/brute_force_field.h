// The witness: the convolution field of DESIGN (paper, eqs. 7-10) in double precision, all segments, no cut-off,
// written from the formula and sharing no code with the fast one. 1/2 [erf + erf] is taken from the standard library.
#pragma once

#include "core/field/skeleton.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <vector>

namespace ramus::test {

class BruteForceField {
public:
    struct Sample {
        double value = 0.0;
        glm::dvec3 gradient{0.0};
        double radius = 0.0; // at the foot on the strongest contributor
        std::size_t strongest = 0;
    };

    BruteForceField(const tree::PreparedTree& prepared, double width) : w_(width * std::numbers::ln2) {
        const bool smooth = prepared.centerline == tree::Centerline::kSmooth;
        std::size_t ordinal = 0;
        for (const tree::Branch& branch : prepared.tree.branches) {
            for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
                const tree::Point& a = prepared.tree.points[branch.points[i - 1]];
                const tree::Point& b = prepared.tree.points[branch.points[i]];
                const double length = glm::distance(a.position, b.position);
                const double slope = (b.radius - a.radius) / length;
                if (!(length > 0.0)) continue;
                const double beyond = smooth ? field::beyond_for(slope) : 0.0;
                segments_.push_back({a.position, (b.position - a.position) / length, length, a.radius, b.radius, beyond,
                                     prepared.segment_source[ordinal]});
                constexpr double kReach = 5.0; // radii: beyond 4.2 kernel() is 0 across and, as good as, along
                const double reach = kReach * std::max(a.radius, b.radius) * (1.0 + std::abs(slope) * beyond);
                reaches_.push_back({0.5 * (a.position + b.position), std::pow(0.5 * length + reach, 2.0)});
            }
        }
    }

    // The part of the field whose kernels are not nothing, in double precision, at a point and right beside it.
    [[nodiscard]] BruteForceField around(glm::dvec3 p) const {
        BruteForceField part(w_);
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const glm::dvec3 off = p - reaches_[i].middle;
            if (glm::dot(off, off) < reaches_[i].squared) part.segments_.push_back(segments_[i]);
        }
        return part;
    }

    [[nodiscard]] double isovalue() const { return std::exp(-w_); }

    [[nodiscard]] double value(glm::dvec3 p) const {
        double sum = 0.0;
        for (const Segment& s : segments_) sum += kernel(s, p).h;
        return sum;
    }

    [[nodiscard]] Sample sample(glm::dvec3 p) const {
        Sample result;
        double best = -1.0;
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            const Kernel k = kernel(segments_[i], p);
            result.value += k.h;
            if (k.h > best) best = k.h, result.radius = k.r, result.strongest = i;
        }
        result.gradient = gradient(p, result.radius);
        return result;
    }

    // Central differences: independent of any derivation, and exact to 1e-9 of the gradient at this step.
    [[nodiscard]] glm::dvec3 gradient(glm::dvec3 p, double radius) const {
        const double step = 1e-5 * radius;
        glm::dvec3 gradient(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 plus = p;
            glm::dvec3 minus = p;
            plus[axis] += step;
            minus[axis] -= step;
            gradient[axis] = (value(plus) - value(minus)) / (2.0 * step);
        }
        return gradient;
    }

    // What each branch adds to the field at a point.
    [[nodiscard]] std::map<int, double> shares(glm::dvec3 p) const {
        std::map<int, double> shares;
        for (const Segment& s : segments_) shares[s.branch] += kernel(s, p).h;
        return shares;
    }

    // First-order distance to the isosurface in units of the local radius.
    [[nodiscard]] double relative_distance(const Sample& s) const {
        return std::abs(s.value - isovalue()) / glm::length(s.gradient) / s.radius;
    }

private:
    explicit BruteForceField(double w) : w_(w) {}

    struct Segment {
        glm::dvec3 a, u;
        double length, ra, rb;
        double beyond; // as in field::FieldSegment
        int branch;
    };
    struct Kernel {
        double h, r;
    };
    struct Reach { // the ball in which a segment's kernel is not nothing
        glm::dvec3 middle;
        double squared; // of the ball's radius, mm^2
    };

    [[nodiscard]] Kernel kernel(const Segment& s, glm::dvec3 p) const {
        const glm::dvec3 v = p - s.a;
        const double t = glm::dot(v, s.u);
        const double slope = (s.rb - s.ra) / s.length;
        const double at_end = s.ra + slope * std::clamp(t, 0.0, s.length);
        const double excess = t - std::clamp(t, 0.0, s.length);
        const double room = s.beyond * at_end;
        const double r = room > 0.0 ? at_end + slope * excess * room / (std::abs(excess) + room) : at_end;
        const glm::dvec3 off = v - t * s.u;
        const double q = w_ * glm::dot(off, off) / (r * r);
        if (q > 60.0) return {0.0, r}; // below 1e-26: nothing, in double precision, next to the isovalue
        const double scale = std::sqrt(w_) / r;
        return {std::exp(-q) * 0.5 * (std::erf(scale * t) + std::erf(scale * (s.length - t))), r};
    }

    double w_;
    std::vector<Segment> segments_;
    std::vector<Reach> reaches_; // of each; none in a part of a field
};

} // namespace ramus::test
