// The witness of the kernels that are line integrals (core/field/kernels/powers.h, polynomial.h): integrated by
// Simpson's rule in double precision, from the formulas of their headers, sharing no code with the closed forms.
#pragma once

#include "core/field/kernel.h"
#include "core/field/kernels/kernel_kind.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace ramus::test {

class LineKernel {
public:
    LineKernel(field::KernelKind kind, const field::Kernel& kernel)
        : kind_(kind), reach_(kernel.support_radii), soft_(kernel.numbers[2]) {
        slope_at_end_ = exponent() * power(reach_ * reach_) / (reach_ * reach_ + soft_);
        scale_ = 1.0 / (2.0 * integral(0.0, reach_)); // 1 on the axis of an endless line
    }

    // g(u), not scaled.
    [[nodiscard]] double at(double u) const {
        const double end = reach_ * reach_;
        if (u >= end) return 0.0;
        if (kind_ == field::KernelKind::kPolynomial) return (1.0 - u / end) * (1.0 - u / end);
        return power(u) - power(end) + slope_at_end_ * (u - end);
    }
    [[nodiscard]] double long_vessel(double radii) const { return 2.0 * scale_ * integral(radii * radii, reach_); }

    // Of a segment at a point. `rho`: squared distance to the segment in local radii.
    [[nodiscard]] double of(const field::FieldSegment& s, const glm::dvec3& p, double& rho) const {
        const Foot foot(s, p);
        rho = foot.rho;
        return rho < reach_ * reach_ ? scale_ * (integral(foot.q, foot.to_start) + integral(foot.q, foot.to_end)) : 0.0;
    }
    [[nodiscard]] static double squared_distance(const field::FieldSegment& s, const glm::dvec3& p) {
        return Foot(s, p).rho;
    }

private:
    struct Foot { // of a point, in local radii
        double q, to_start, to_end, rho;
        Foot(const field::FieldSegment& s, const glm::dvec3& p) {
            const glm::dvec3 u(s.ux, s.uy, s.uz), offset = p - glm::dvec3(s.ax, s.ay, s.az);
            const double length = s.length, t = glm::dot(offset, u), clamped = std::clamp(t, 0.0, length);
            const double at_end = s.radius + s.slope * clamped, excess = t - clamped, room = s.beyond * at_end;
            const double r = room > 0.0 ? at_end + s.slope * excess * room / (std::abs(excess) + room) : at_end;
            const glm::dvec3 across = offset - t * u;
            q = glm::dot(across, across) / (r * r);
            to_start = t / r, to_end = (length - t) / r;
            rho = q + std::pow(excess / r, 2.0);
        }
    };
    [[nodiscard]] double exponent() const {
        return kind_ == field::KernelKind::kInverseSquare ? 1.0 : kind_ == field::KernelKind::kInverseCubic ? 1.5 : 2.0;
    }
    [[nodiscard]] double power(double u) const {
        const double v = u + soft_;
        if (kind_ == field::KernelKind::kInverseSquare) return 1.0 / v;
        return kind_ == field::KernelKind::kInverseCubic ? 1.0 / (v * std::sqrt(v)) : 1.0 / (v * v);
    }
    // Of g(q + x^2) for x from 0 to y, odd in y. With x = p sinh(z) the integrand has no peak.
    [[nodiscard]] double integral(double q, double y) const {
        const double most = std::sqrt(std::max(reach_ * reach_ - q, 0.0)),
                     p = soft_ > 0.0 ? std::sqrt(q + soft_) : reach_;
        const double end = std::asinh(std::min(std::abs(y), most) / p);
        constexpr int kSteps = 200;
        double sum = 0.0;
        for (int n = 0; n <= kSteps; ++n) {
            const double z = end * n / kSteps, x = p * std::sinh(z);
            sum += (n == 0 || n == kSteps ? 1.0 : n % 2 == 1 ? 4.0 : 2.0) * at(q + x * x) * p * std::cosh(z);
        }
        return std::copysign(sum * end / (3.0 * kSteps), y);
    }

    field::KernelKind kind_;
    double reach_, soft_, slope_at_end_ = 0.0, scale_ = 1.0;
};

} // namespace ramus::test
