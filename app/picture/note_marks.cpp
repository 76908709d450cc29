#include "app/picture/note_marks.h"

#include "app/session/reading_options.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <unordered_map>

namespace ramus::app {

namespace {

using tree::Note;

constexpr glm::vec3 kRepairedColour{0.98F, 0.80F, 0.30F}, kSuspectColour{1.00F, 0.45F, 0.72F};
constexpr double kLeastPoints = 9.0;  // radius of a ring, of 1/96 inch
constexpr double kBeyondVessel = 1.5; // radii
constexpr int kCorners = 40;

// Millimetres that one pixel spans where `at` is.
double mm_per_pixel_at(const render::Frame& frame, const glm::dvec3& at) {
    const render::Camera& camera = frame.camera;
    const double at_focus = render::mm_per_pixel(camera, frame.size);
    if (camera.orthographic) return at_focus;
    const glm::dvec3 forward = render::axes_of(camera).forward;
    const double focus = glm::dot(camera.focal_point - camera.position, forward);
    const double depth = glm::dot(at - camera.position, forward);
    return focus > 0.0 ? at_focus * std::max(depth, 0.0) / focus : at_focus;
}

std::vector<glm::dvec3> circle(const render::CameraAxes& axes, const glm::dvec3& centre, double radius_mm) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * (i % kCorners) / kCorners;
        points.push_back(centre + radius_mm * (std::cos(angle) * axes.right + std::sin(angle) * axes.up));
    }
    return points;
}

struct PlaceHash {
    std::size_t operator()(const glm::dvec3& p) const {
        const std::hash<double> hash;
        return hash(p.x) ^ (hash(p.y) * 3) ^ (hash(p.z) * 7);
    }
};

} // namespace

void mark_notes(render::Frame& frame, const tree::VesselTree& tree, int current) {
    std::vector<std::size_t> marked;
    for (std::size_t n = 0; n < tree.notes.size() && marked.size() < kMostNoteMarks; ++n)
        if (tree.notes[n].at) marked.push_back(n);
    const auto chosen = static_cast<std::size_t>(current);
    const bool has_current = current >= 0 && chosen < tree.notes.size() && tree.notes[chosen].at;
    if (has_current && std::ranges::find(marked, chosen) == marked.end()) marked.push_back(chosen);
    if (marked.empty()) return;
    // Most stand at a point of the tree, and go around the vessel there.
    std::unordered_map<glm::dvec3, double, PlaceHash> radius_at;
    for (const std::size_t n : marked) radius_at.emplace(*tree.notes[n].at, 0.0);
    for (const tree::Point& point : tree.points)
        if (const auto found = radius_at.find(point.position); found != radius_at.end()) found->second = point.radius;
    const render::CameraAxes axes = render::axes_of(frame.camera);
    for (const std::size_t n : marked) {
        const Note& note = tree.notes[n];
        const bool is_current = has_current && n == chosen;
        const double least = kLeastPoints * static_cast<double>(frame.pixel_ratio) * mm_per_pixel_at(frame, *note.at);
        const double radius = std::max(kBeyondVessel * radius_at[*note.at], is_current ? 1.5 * least : least);
        frame.lines.push_back({circle(axes, *note.at, radius),
                               note.kind == Note::Kind::kRepaired ? kRepairedColour : kSuspectColour,
                               is_current ? 3.4F : 1.8F});
    }
    if (has_current) frame.labels.push_back({*tree.notes[chosen].at, topic_label(tree.notes[chosen].topic)});
}

} // namespace ramus::app
