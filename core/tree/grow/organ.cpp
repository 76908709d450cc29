#include "core/tree/grow/organ.h"

#include <algorithm>

namespace ramus::tree::growth {

namespace {

// Extent of the shape below from left to right, in its own units, before any seed varies it.
constexpr double kNominalWidth = 208.0;

// Near an ellipsoid's surface this is the distance to it, to first order.
double ellipsoid_distance(const Vec& point, const Vec& centre, const Vec& semi_axes) {
    const Vec q = (point - centre) / semi_axes;
    const Vec g = q / semi_axes;
    const double level = glm::length(q);
    const double slope = glm::length(g);
    if (slope <= 0.0) return -std::min({semi_axes.x, semi_axes.y, semi_axes.z});
    return level * (level - 1.0) / slope;
}

double smooth_min(double a, double b, double blend) {
    const double h = std::max(blend - (a > b ? a - b : b - a), 0.0) / blend;
    return std::min(a, b) - h * h * blend * 0.25;
}

} // namespace

Liver::Liver(double width_mm, Random& random) {
    // Drawn by eye after CT anatomy: right lobe, medial segment, left lateral segment and its tip, caudate lobe.
    lobes_ = {
        {{40, -6, -2}, {62, 58, 70}},  {{30, 8, 22}, {56, 56, 46}},   {{-4, 24, 16}, {46, 38, 36}},
        {{-46, 22, 26}, {44, 30, 25}}, {{-74, 18, 32}, {34, 22, 16}}, {{4, -26, 20}, {24, 22, 30}},
    };
    // The porta hepatis with the visceral concavity, the groove of the vena cava, the kidney's impression.
    hollows_ = {{{-14, -22, -54}, {50, 44, 50}}, {{6, -62, 22}, {17, 22, 60}}, {{52, -72, -44}, {30, 34, 38}}};
    hilum_ = {4, -10, 6};
    root_ = {-20, -26, -46};
    trunks_ = {
        {-1, {27, -6, 7}},   // right portal vein
        {-1, {-30, 12, 18}}, // left portal vein to its umbilical part
        {0, {46, 18, 18}},   // right anterior
        {0, {56, -22, 2}},   // right posterior
        {1, {-62, 20, 28}},  // left lateral
        {1, {-18, 34, 20}},  // left medial
    };
    sectors_ = {{66, -16, -34}, {52, -14, 42}, {44, 28, -18}, {-72, 18, 36}, {22, 14, 46}, {56, 2, -46}, {6, -24, 30}};
    blend_ = 22.0;

    const double scale = width_mm / kNominalWidth;
    for (Blob& blob : lobes_) {
        blob.centre = (blob.centre + 3.0 * random.in_ball()) * scale;
        blob.semi_axes *= scale * (Vec(1.0) + 0.05 * random.in_ball());
    }
    for (Blob& blob : hollows_) {
        blob.centre *= scale;
        blob.semi_axes *= scale;
    }
    hilum_ *= scale;
    root_ *= scale;
    for (Trunk& trunk : trunks_) trunk.end *= scale;
    for (Vec& sector : sectors_) sector *= scale;
    blend_ *= scale;

    low_ = high_ = lobes_.front().centre;
    for (const Blob& blob : lobes_) {
        low_ = glm::min(low_, blob.centre - blob.semi_axes - Vec(0.25 * blend_));
        high_ = glm::max(high_, blob.centre + blob.semi_axes + Vec(0.25 * blend_));
    }

    constexpr int kSteps = 48;
    const Vec step = (high_ - low_) / static_cast<double>(kSteps);
    int inside = 0;
    for (int k = 0; k < kSteps; ++k)
        for (int j = 0; j < kSteps; ++j)
            for (int i = 0; i < kSteps; ++i) inside += depth_mm(low_ + step * (Vec(i, j, k) + 0.5)) > 0.0 ? 1 : 0;
    volume_mm3_ = inside * step.x * step.y * step.z;
}

double Liver::depth_mm(const Vec& point) const {
    double distance = ellipsoid_distance(point, lobes_.front().centre, lobes_.front().semi_axes);
    for (std::size_t i = 1; i < lobes_.size(); ++i)
        distance = smooth_min(distance, ellipsoid_distance(point, lobes_[i].centre, lobes_[i].semi_axes), blend_);
    double depth = -distance;
    for (const Blob& blob : hollows_)
        depth = smooth_min(depth, ellipsoid_distance(point, blob.centre, blob.semi_axes), 0.5 * blend_);
    return depth;
}

} // namespace ramus::tree::growth
