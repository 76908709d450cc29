// Rings in the picture where reading repaired something, or where it looks wrong.
#include "app/picture/note_marks.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus;
using namespace ramus::app;
using tree::Note;

namespace {

render::Frame frame_of(bool orthographic) {
    render::Frame frame;
    frame.size = {800, 600};
    frame.camera.position = {0.0, 300.0, 0.0};
    frame.camera.orthographic = orthographic;
    return frame;
}

tree::VesselTree with_notes() {
    tree::VesselTree tree;
    tree.points = {{{0, 0, 0}, 20.0}, {{50, 0, 0}, 0.1}};
    tree.notes = {{Note::Kind::kAssumed, "units", "of the whole tree", {}},
                  {Note::Kind::kRepaired, "zero-radii", "mended", tree.points[0].position},
                  {Note::Kind::kSuspect, "loops", "strange", tree.points[1].position}};
    return tree;
}

} // namespace

TEST_CASE("every note with a place has a ring around its vessel, visible from everywhere") {
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        render::Frame frame = frame_of(orthographic);
        const tree::VesselTree tree = with_notes();
        mark_notes(frame, tree, -1);
        REQUIRE(frame.lines.size() == 2);
        CHECK(frame.labels.empty());
        CHECK(frame.lines[0].colour != frame.lines[1].colour);
        for (const glm::dvec3& corner : frame.lines[0].points)
            CHECK(glm::distance(corner, tree.points[0].position) == doctest::Approx(30.0)); // 1.5 radii
        // The thin vessel's ring is 9 pixels wide at least, and faces the eye: it is round.
        const auto centre = render::project(frame.camera, frame.size, tree.points[1].position);
        for (const glm::dvec3& corner : frame.lines[1].points) {
            const auto seen = render::project(frame.camera, frame.size, corner);
            CHECK(glm::distance(glm::dvec2(*seen), glm::dvec2(*centre)) == doctest::Approx(9.0).epsilon(0.01));
        }
    }
}

TEST_CASE("the current note is emphasised and has a label") {
    render::Frame frame = frame_of(false);
    mark_notes(frame, with_notes(), 2);
    REQUIRE(frame.labels.size() == 1);
    CHECK(frame.labels[0].text == "Loops");
    CHECK(frame.lines[1].width > frame.lines[0].width);
    render::Frame other = frame_of(false);
    mark_notes(other, with_notes(), 0); // it has no place
    CHECK(other.labels.empty());
}

TEST_CASE("thousands of notes are not all marked, but the current one is") {
    tree::VesselTree tree = with_notes();
    for (int i = 0; i < 5000; ++i)
        tree.notes.push_back({Note::Kind::kSuspect, "pieces", "", glm::dvec3(0.01 * i, 0, 0)});
    render::Frame frame = frame_of(false);
    mark_notes(frame, tree, 4999);
    CHECK(frame.lines.size() == kMostNoteMarks + 1);
    CHECK(frame.labels.size() == 1);
}
