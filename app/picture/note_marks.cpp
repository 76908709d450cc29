#include "app/picture/note_marks.h"

#include "app/picture/place_marks.h"
#include "app/session/reading_options.h"

#include <algorithm>
#include <unordered_map>

namespace ramus::app {

namespace {

using tree::Note;

constexpr glm::vec3 kRepairedColour{0.98F, 0.80F, 0.30F}, kSuspectColour{1.00F, 0.45F, 0.72F};
constexpr double kBeyondVessel = 1.5; // radii

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
    // Most notes are at a point of the tree, and the ring surrounds the vessel there.
    std::unordered_map<glm::dvec3, double, PlaceHash> radius_at;
    for (const std::size_t n : marked) radius_at.emplace(*tree.notes[n].at, 0.0);
    for (const tree::Point& point : tree.points)
        if (const auto found = radius_at.find(point.position); found != radius_at.end()) found->second = point.radius;
    for (const std::size_t n : marked) {
        const Note& note = tree.notes[n];
        frame.lines.push_back(ring_facing_eye(frame, *note.at, kBeyondVessel * radius_at[*note.at],
                                              note.kind == Note::Kind::kRepaired ? kRepairedColour : kSuspectColour,
                                              has_current && n == chosen));
    }
    if (has_current) frame.labels.push_back({*tree.notes[chosen].at, topic_label(tree.notes[chosen].topic)});
}

} // namespace ramus::app
