// Shadows against where geometry says that they end: a tube before a plane, seen from the front without perspective.
#include "tests/support/beside_scene.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <numbers>
#include <numeric>
#include <vector>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::decoded;
using ramus::test::kPixelMm;

namespace {

constexpr double kRadius = 1.5, kHeight = 2.0; // mm: of the tube, and of its axis over the plane

struct ShadowScene : ramus::test::BesideScene {
    explicit ShadowScene(double angle) {
        const CameraAxes axes = axes_of(frame.camera);
        const glm::dvec3 right = axes.right, up = axes.up, front = -axes.forward;
        const glm::dvec3 along = std::cos(angle) * right + std::sin(angle) * up;
        TriangleMesh tube, plane;
        add_capsule(tube, glm::vec3(kHeight * front - 60.0 * along), glm::vec3(kHeight * front + 60.0 * along),
                    float(kRadius), float(kRadius), 0, 96);
        for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
            plane.positions.emplace_back(60.0 * a * right + 60.0 * b * up);
            plane.normals.emplace_back(front);
        }
        plane.triangles = {{0, 1, 2}, {0, 2, 3}};
        frame.mesh = std::make_shared<const PagedMesh>(tube);
        frame.context = {{std::make_shared<const TriangleMesh>(plane), nullptr, {0.5F, 0.5F, 0.5F}, 1.0F, false}};
        frame.size = {600, 600};
        frame.camera.scale = 0.5 * kPixelMm * frame.size.y;
        frame.appearance.occlusion = 0.0F;
    }
    [[nodiscard]] Image picture_with(float shadows, bool refined) {
        frame.appearance.shadows = shadows;
        draw();
        if (refined) CHECK(renderer->refine()->changed);
        return renderer->read_image();
    }
};

// Where the shadow of the light's middle ends, pixels from the tube's axis. Of shaders/look/light.glsl: the light
// across the tube and towards the eye. The tangent of the tube that runs to it and lies farther from it meets the plane
// on the other side of the tube.
double edge_of(double angle) {
    const double across = 0.429 * std::sin(angle) + 0.572 * std::cos(angle), towards_eye = 0.699;
    return (kHeight * across + kRadius * std::hypot(across, towards_eye)) / towards_eye / kPixelMm;
}

// How much darker the plane is, by how far beyond the shadow's edge.
struct Darkness {
    double distance, share; // pixels
};
std::vector<Darkness> across_edge(ShadowScene& scene, double angle, bool refined) {
    const Image plain = scene.picture_with(0.0F, refined), dark = scene.picture_with(1.0F, refined);
    const double edge = edge_of(angle);
    std::vector<Darkness> found;
    const int middle = scene.frame.size.x / 2;
    for (int y = 0; y < scene.frame.size.y; ++y)
        for (int x = 0; x < scene.frame.size.x; ++x) {
            const double dx = x + 0.5 - middle, dy = middle - (y + 0.5);
            const double below = std::sin(angle) * dx - std::cos(angle) * dy - edge;
            if (std::abs(below) > 20.0 || std::abs(std::cos(angle) * dx + std::sin(angle) * dy) > 150.0) continue;
            found.push_back({below, 1.0 - decoded(dark.pixel(x, y)[0]) / decoded(plain.pixel(x, y)[0])});
        }
    return found;
}

// The mean of what lies within half a pixel, every quarter of a pixel from -20 to 20.
std::vector<double> profile_of(const std::vector<Darkness>& all) {
    std::vector<double> sums(161), counts(161);
    for (const Darkness& one : all)
        for (int i = 0; i < 161; ++i) {
            if (std::abs(one.distance + 20.0 - 0.25 * i) > 0.5) continue;
            sums[std::size_t(i)] += one.share;
            counts[std::size_t(i)] += 1.0;
        }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= std::max(counts[i], 1.0);
    return sums;
}

// How much of the light the tube takes from the plane there, the less the farther the tube is: of the formulas in
// shaders/look/shadow.glsl and shadow_ray.glsl the mean over the light's disc.
double hidden_at(double below_edge, double edge, double angle) {
    constexpr double kReach = 2.2 * 0.055 * 600 * kPixelMm;
    constexpr int kPoints = 400;
    const double s = -(below_edge + edge) * kPixelMm; // across the tube, mm
    double sum = 0.0;
    for (int i = 0; i < kPoints; ++i) {
        const double turn = 2.39996323 * i, from_middle = 0.09 * std::sqrt((i + 0.5) / kPoints);
        const double a = from_middle * std::cos(turn), b = from_middle * std::sin(turn);
        const double x = -0.429 + 0.8 * a - 0.4194 * b, y = 0.572 + 0.6 * a + 0.5592 * b, z = 0.699 - 0.715 * b;
        const double across = -std::sin(angle) * x + std::cos(angle) * y;
        // Where the ray enters the circle: |(s, -height) + t reach (across, z)| = radius.
        const double p = across * across + z * z, q = s * across - kHeight * z;
        const double root = q * q - p * (s * s + kHeight * kHeight - kRadius * kRadius);
        if (root > 0.0) sum += std::max(0.0, 1.0 - (-q - std::sqrt(root)) / p / kReach);
    }
    return sum / kPoints;
}

} // namespace

TEST_CASE("a shadow ends where its tangent says, as softly everywhere along its edge" * doctest::test_suite("slow")) {
    for (const double degrees : {0.0, 17.0, 40.0}) {
        const double angle = degrees / 180.0 * std::numbers::pi;
        ShadowScene scene(angle);
        for (const bool refined : {false, true}) {
            CAPTURE(degrees);
            CAPTURE(refined);
            const std::vector<Darkness> all = across_edge(scene, angle, refined);
            const std::vector<double> profile = profile_of(all);
            const double within = profile[30], beyond = profile[150]; // 12 pixels inside, 17 outside
            CHECK(within > 0.15);
            CHECK(std::abs(beyond) < 0.01);
            double squares = 0.0;
            std::size_t count = 0;
            for (const Darkness& one : all) {
                const double at = 4.0 * (one.distance + 20.0);
                const auto low = std::size_t(std::clamp(at, 0.0, 159.0));
                if (at < 4.0 || at > 156.0) continue;
                const double mean = std::lerp(profile[low], profile[low + 1], at - double(low));
                squares += std::pow((one.share - mean) / within, 2.0), ++count;
            }
            REQUIRE(count > 5000);
            const double rough = std::sqrt(squares / double(count));
            // Against the geometry, up to the share of all light that is the key's.
            std::vector<double> wanted;
            for (int i = 0; i < 161; ++i) wanted.push_back(hidden_at(0.25 * i - 20.0, edge_of(angle), angle));
            const double share = std::inner_product(profile.begin() + 30, profile.end(), wanted.begin() + 30, 0.0) /
                                 std::inner_product(wanted.begin() + 30, wanted.end(), wanted.begin() + 30, 0.0);
            double off = 0.0;
            for (std::size_t i = 30; i < 161; ++i) off += std::pow(profile[i] / share - wanted[i], 2.0) / 131.0;
            double steepest = 0.0; // of a pixel's step
            for (std::size_t i = 30; i + 4 < profile.size(); ++i)
                steepest = std::max(steepest, (profile[i] - profile[i + 4]) / within);
            MESSAGE("shadow's edge: off by " << std::sqrt(off) << ", uneven by " << rough << ", at most " << steepest
                                             << " of it a pixel");
            CHECK(rough < 0.02);
            CHECK(std::sqrt(off) < 0.06);
            CHECK(steepest < 0.13); // 0.16 where the light is a point
        }
    }
}
