// Summarises the notes of a tree: noise in a mask causes hundreds of thousands of notes, each about another place.
#pragma once

#include "core/tree/vessel_tree.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace ramus::tree {

// A note about the whole tree, or all notes of one kind and topic that have places.
struct NoteSummary {
    Note::Kind kind = Note::Kind::kAssumed;
    std::string topic;
    std::string text;               // the text of the first note, followed by how many more there are
    std::size_t count = 1;          // number of notes
    std::vector<glm::dvec3> places; // of the first few notes, mm, RAS
};

// In the order of note_groups().
[[nodiscard]] std::vector<NoteSummary> summed_up(const VesselTree& tree);

// The text with its places: "a loop was closed, and 2 more like it (the first at 1, 2, 3; 4, 5, 6; 7, 8, 9)".
[[nodiscard]] std::string with_places(const NoteSummary& summary);

// If more than 1,000 notes of one kind and topic have places, removes all but the first 100 and adds a note with their
// number. Keeps all notes of cut ends (Note::outward), since surfaces depend on them.
void drop_repeated(std::vector<Note>& notes);

} // namespace ramus::tree
