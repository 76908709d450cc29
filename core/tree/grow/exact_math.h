// Arithmetic that gives the same bits on every machine. The generator branches on its numbers (is this point nearer
// than that one?), so a single different digit from another C library would grow a different tree. Uses only operations
// that IEEE 754 rounds exactly: + - * / and sqrt.
#pragma once

#include "core/base/splitmix64.h"

#include <bit>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ramus::tree::growth {

using Vec = glm::dvec3;

// Cube root of a positive number, by Newton from an estimate that thirds the exponent.
inline double cube_root(double value) {
    double root = std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) / 3 + 0x2A9F7893782DA1CEULL);
    for (int step = 0; step < 5; ++step) root -= (root - value / (root * root)) / 3.0;
    return root;
}

// The generator splitmix64: the distributions of <random> differ between libraries.
class Random {
public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() { return splitmix64_of_state(state_ += kSplitmixStep); }
    // Uniform in [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
    double between(double low, double high) { return low + (high - low) * unit(); }
    // Uniform in the unit ball, by rejection: no trigonometry.
    Vec in_ball() {
        for (;;) {
            const double x = between(-1, 1);
            const double y = between(-1, 1);
            const double z = between(-1, 1);
            const Vec point(x, y, z);
            if (glm::dot(point, point) <= 1.0) return point;
        }
    }

private:
    std::uint64_t state_;
};

inline Vec direction(const Vec& from, const Vec& to) {
    const Vec d = to - from;
    const double length = glm::length(d);
    return length > 0.0 ? d / length : Vec(0.0);
}

// The closest points of two line segments, as fractions along each, and their distance.
struct Approach {
    double first = 0.0;
    double second = 0.0;
    double distance = 0.0;
};

inline Approach closest_approach(const Vec& a0, const Vec& a1, const Vec& b0, const Vec& b1) {
    const Vec da = a1 - a0;
    const Vec db = b1 - b0;
    const Vec gap = a0 - b0;
    const double aa = glm::dot(da, da);
    const double bb = glm::dot(db, db);
    const double bg = glm::dot(db, gap);
    const auto clamp = [](double t) { return t < 0.0 ? 0.0 : (t > 1.0 ? 1.0 : t); };
    double s = 0.0;
    double t = 0.0;
    if (aa <= 0.0) {
        t = bb > 0.0 ? clamp(bg / bb) : 0.0;
    } else {
        const double ag = glm::dot(da, gap);
        if (bb <= 0.0) {
            s = clamp(-ag / aa);
        } else {
            const double ab = glm::dot(da, db);
            const double denominator = aa * bb - ab * ab;
            s = denominator > 1e-12 * aa * bb ? clamp((ab * bg - ag * bb) / denominator) : 0.0;
            t = (ab * s + bg) / bb;
            if (t < 0.0) {
                t = 0.0;
                s = clamp(-ag / aa);
            } else if (t > 1.0) {
                t = 1.0;
                s = clamp((ab - ag) / aa);
            }
        }
    }
    const Vec d = gap + s * da - t * db;
    return {s, t, glm::length(d)};
}

} // namespace ramus::tree::growth
