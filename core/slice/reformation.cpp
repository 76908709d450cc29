#include "core/slice/reformation.h"

#include "core/base/infinity.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::slice {

namespace {

glm::dvec3 turned(const Axes& axes, double angle_deg) {
    const double angle = glm::radians(angle_deg);
    return std::cos(angle) * axes.right + std::sin(angle) * axes.down;
}

Reformation straightened(const VesselPath& path, double angle_deg, double width_mm) {
    const auto half = static_cast<int>(std::max(1.0, std::round(0.5 * width_mm / path.step_mm)));
    Reformation picture{ReformationKind::kStraightened, path.step_mm, 2 * half + 1, {}, {}};
    for (const PathSample& sample : path.samples) {
        const glm::dvec3 right = path.step_mm * turned(sample.axes, angle_deg);
        picture.axis.emplace_back(half, picture.rows.size());
        picture.rows.push_back({sample.at - double(half) * right, right, sample.tangent, sample.arc_mm, double(half)});
    }
    return picture;
}

// The direction from the start to the sample farthest from it.
glm::dvec3 main_direction(const VesselPath& path) {
    const glm::dvec3 start = path.samples.front().at;
    const auto far = std::ranges::max_element(
        path.samples, {}, [&](const PathSample& sample) { return glm::distance(sample.at, start); });
    const double length = glm::distance(far->at, start);
    return length > 0.0 ? (far->at - start) / length : path.samples.front().tangent;
}

// The row that `down` pixels of way at right angles to the vector of interest lead to, between two samples.
ReformationRow stretched_row(const VesselPath& path, const Reformation& picture, std::size_t segment, double down,
                             const glm::dvec3& right, glm::dvec3& normal) {
    const PathSample& a = path.samples[segment];
    const PathSample& b = path.samples[segment + 1];
    const double step = picture.axis[segment + 1].y - picture.axis[segment].y;
    const double share = step > 0.0 ? std::clamp((down - picture.axis[segment].y) / step, 0.0, 1.0) : 0.0;
    const glm::dvec3 tangent = a.tangent + share * (b.tangent - a.tangent);
    const glm::dvec3 across = tangent - glm::dot(tangent, right) / glm::dot(right, right) * right;
    constexpr double kAlong = 1e-3; // the axis runs along the vector: the plane of the row before holds
    if (glm::length(across) > kAlong) normal = glm::normalize(across);
    const double column = picture.axis[segment].x + share * (picture.axis[segment + 1].x - picture.axis[segment].x);
    const glm::dvec3 at = a.at + share * (b.at - a.at);
    return {at - column * right, right, normal, a.arc_mm + share * (b.arc_mm - a.arc_mm), column};
}

Reformation stretched(const VesselPath& path, double angle_deg, double width_mm) {
    const Axes axes = axes_across(main_direction(path));
    const glm::dvec3 interest = turned(axes, angle_deg);
    const double mm = path.step_mm;
    Reformation picture{ReformationKind::kStretched, mm, 0, {}, {}};
    double least = kInfinity, most = -kInfinity, down = 0.0;
    for (std::size_t n = 0; n < path.samples.size(); ++n) {
        const double along = glm::dot(path.samples[n].at, interest);
        if (n > 0) {
            const glm::dvec3 way = path.samples[n].at - path.samples[n - 1].at;
            down += glm::length(way - glm::dot(way, interest) * interest);
        }
        picture.axis.emplace_back(along / mm, down / mm);
        least = std::min(least, along), most = std::max(most, along);
    }
    const double first = std::floor((least - 0.5 * width_mm) / mm);
    picture.columns = static_cast<int>(std::ceil((most + 0.5 * width_mm) / mm) - first) + 1;
    for (glm::dvec2& pixel : picture.axis) pixel.x -= first;
    constexpr double kRounding = 1e-6;
    const auto count = static_cast<std::size_t>(down / mm + kRounding) + 1;
    glm::dvec3 normal = glm::cross(interest, axes.to_viewer()); // any, if the axis begins along the vector
    std::size_t segment = 0;
    for (std::size_t row = 0; row < count; ++row) {
        const auto at = static_cast<double>(row);
        while (segment + 2 < path.samples.size() && picture.axis[segment + 1].y < at) ++segment;
        picture.rows.push_back(stretched_row(path, picture, segment, at, mm * interest, normal));
    }
    return picture;
}

} // namespace

std::string_view name_of(ReformationKind kind) { return kReformations[static_cast<std::size_t>(kind)].second; }

std::optional<ReformationKind> reformation_named(std::string_view name) { return paired_with(kReformations, name); }

Reformation reformation_along(const VesselPath& path, ReformationKind kind, double angle_deg, double width_mm) {
    return kind == ReformationKind::kStretched ? stretched(path, angle_deg, width_mm)
                                               : straightened(path, angle_deg, width_mm);
}

std::vector<float> sampled(const volume::Volume& volume, const Reformation& picture, const Sampling& sampling) {
    const auto columns = static_cast<std::size_t>(picture.columns);
    std::vector<float> values(columns * picture.rows.size());
    tbb::parallel_for(std::size_t{0}, picture.rows.size(), [&](std::size_t n) {
        const ReformationRow& row = picture.rows[n];
        const std::vector<float> line =
            sampled(volume, PixelGrid{row.first, row.right, row.normal, {picture.columns, 1}}, sampling);
        std::ranges::copy(line, values.begin() + static_cast<std::ptrdiff_t>(n * columns));
    });
    return values;
}

std::vector<std::optional<Lumen>> lumens_of_rows(const Reformation& picture, const LoopsOfPlane& loops) {
    std::vector<std::optional<Lumen>> lumens(picture.rows.size());
    tbb::parallel_for(std::size_t{0}, lumens.size(), [&](std::size_t n) {
        const Plane plane = picture.rows[n].plane();
        lumens[n] = lumen_around(loops(plane), plane, plane.point);
    });
    return lumens;
}

std::optional<PicturePlace> place_of(const Reformation& picture, const glm::dvec2& pixel) {
    const auto last = static_cast<double>(picture.rows.size() - 1);
    if (!(pixel.x >= -0.5 && pixel.y >= -0.5 && pixel.x <= picture.columns - 0.5 && pixel.y <= last + 0.5)) return {};
    const double down = std::clamp(pixel.y, 0.0, last);
    const auto low = static_cast<std::size_t>(down);
    const ReformationRow& a = picture.rows[low];
    const ReformationRow& b = picture.rows[std::min(low + 1, picture.rows.size() - 1)];
    const double share = down - static_cast<double>(low);
    const auto between = [&](const auto& from, const auto& to) { return from + share * (to - from); };
    return PicturePlace{between(a.place(pixel.x), b.place(pixel.x)), between(a.arc_mm, b.arc_mm),
                        (pixel.x - between(a.axis_column, b.axis_column)) * picture.mm_per_pixel};
}

glm::dvec2 pixel_of(const Reformation& picture, const VesselPath& path, double arc_mm) {
    const double on = std::clamp(arc_mm, 0.0, path.length_mm()) / path.step_mm;
    const auto low = std::min(static_cast<std::size_t>(on), picture.axis.size() - 2);
    return picture.axis[low] +
           std::min(on - static_cast<double>(low), 1.0) * (picture.axis[low + 1] - picture.axis[low]);
}

} // namespace ramus::slice
