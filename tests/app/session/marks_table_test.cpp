// Every member of Marks has one row in the table that session files, undo and edits of the tree read.
#include "app/session/marks_change.h"
#include "app/session/marks_table.h"
#include "app/session/member_count.h"
#include "app/session/session_file.h"

#include <doctest/doctest.h>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

// A value that is not the default one in any member.
Marks full_marks() {
    Marks marks;
    marks.edits = {{.kind = tree::Edit::Kind::kDelete, .branches = {3}}};
    marks.selection = {1, 4};
    marks.states = {tree::BranchState::kNormal, tree::BranchState::kHidden};
    marks.lesions = {{.sphere = {1.0, 2.0, 3.0, 4.0}},
                     {.file = "/data/lesion.stl", .axes = "LPS", .name = "tumour"},
                     {.file = "/data/tumours.nii",
                      .labels = {volume::LabelChoice(std::string("cyst")), 3},
                      .units = "cm",
                      .part = 2}};
    marks.context.emplace_back();
    marks.context.front().file = "/data/liver.nii.gz";
    marks.cuts = {{2, 0.25}};
    marks.measurements = {{.kind = Measurement::Kind::kDiameter, .places = {measure::BranchPlace{2, 0.5}}}};
    marks.names = {{1, "left"}, {2, "right"}};
    marks.subtree_names = {2};
    marks.systems = {{"portal vein", {1, 2, 3}}};
    marks.colour_by = *colouring_named("diameter");
    marks.colour_map = ColourMap::kGrey;
    marks.colour_look = {.range = {{1.0, 2.0}}, .logarithmic = true, .legend = false};
    marks.pins = {{.at = {1.0, 2.0, 3.0}, .name = "here"}};
    marks.scans = {{.file = "/data/ct.nii.gz", .checksum = "0123", .window = slice::Window{40.0, 400.0}},
                   {.file = "/data/labels.nii.gz", .checksum = "4567", .units = "cm", .labels = true, .name = "lumen"}};
    organ::Sheet sheet;
    sheet.size = {2, 2};
    sheet.heights = {0.5, 1.5, 2.5, 3.5};
    sheet.removes_below = true;
    marks.resections = {{.kind = Resection::Kind::kPlane, .point = {1, 2, 3}, .normal = {0, 1, 0}},
                        {.kind = Resection::Kind::kSheet, .sheet = sheet},
                        {.kind = Resection::Kind::kSurface, .file = "/data/cut.stl", .axes = "LPS", .other_side = true},
                        {.kind = Resection::Kind::kCuts, .margin_mm = 5.0},
                        {.kind = Resection::Kind::kLesion, .margin_mm = 10.0, .lesion = 2, .name = "wedge"}};
    marks.plans = {.name = "B", .place = 1, .others = {{"A", {{2, 0.5}}, {{.kind = Resection::Kind::kCuts}}}}};
    marks.views = {{"behind the vein", {.position = {1.0, 2.0, 3.0}}}};
    for_each_object(marks, []<class T>(T& object) {
        object.colour = {1, 2, 3};
        if constexpr (SurfaceObject<T>) object.opacity = 0.75;
    });
    marks.planning = {.bands_mm = {1.0, 3.0}, .reconstruct_mm = 4.0, .touch_mm = 1.5};
    marks.glass = {.opacity = 1.5, .grey = 0.25};
    marks.depth_cues.set(depth_cues().front(), !marks.depth_cues.has(depth_cues().front()));
    marks.comparison.mode = Comparison::Mode::kBlend;
    marks.comparison.mask = "/data/mask.nii";
    marks.deviation = {.from = DeviationChoice::From::kFile, .file = "/data/other.ply"};
    marks.organ = {.source = {"/data/liver.nii", {3}, "cm"},
                   .rule = organ::Rule::kWall,
                   .roles = {organ::Role::kDrains, organ::Role::kSupplies},
                   .large_vessels_mm = 4.0,
                   .weight_kg = 70.0,
                   .height_cm = 170.0,
                   .least_of_weight = 0.8,
                   .least_of_standard = 25.0,
                   .territories = TerritoriesOf::kGeneration,
                   .generation = 3,
                   .system = 1,
                   .opacity = 0.25,
                   .apart_mm = 15.0,
                   .hidden = {"removed"}};
    marks.skeleton = marks.contact_marks = marks.shortest_distances = true;
    marks.options.smooth_passes = 3;
    marks.reading.radius_mm = 0.5;
    number_objects(marks);
    return marks;
}

} // namespace

TEST_CASE("every member of Marks has a row of its own") {
    // The base counts as one member.
    CHECK(marks_table().size() == member_count<SceneObjects>() + member_count<Marks>() - 1);
    const Marks marks;
    std::set<const void*> members;
    for (const MarksRow& row : marks_table()) members.insert(row.address(marks));
    CHECK(members.size() == marks_table().size());
}

TEST_CASE("marks that differ from the default in every member are restored from a session file") {
    Session session;
    session.tree.path = "/data/tree.swc";
    session.marks = full_marks();
    for (const MarksRow& row : marks_table()) {
        CAPTURE(row.entries.front().key);
        CHECK_FALSE(row.same(session.marks, Marks{}));
    }
    const auto read = session_from_json(to_json(session, "/data"), "/data", "test.json");
    REQUIRE(read);
    for (const MarksRow& row : marks_table()) {
        CAPTURE(row.entries.front().key);
        CHECK(row.same(read->session.marks, session.marks));
    }
}

TEST_CASE("a change transforms every member to its new value, and its reverse restores the old one") {
    const Marks none, full = full_marks();
    const MarksChange change = MarksChange::between(none, full);
    Marks marks = none;
    change.apply(marks, ChangeDirection::kForward);
    CHECK(marks == full);
    change.apply(marks, ChangeDirection::kBack);
    CHECK(marks == none);
    CHECK(change.edits_tree());
    CHECK(change.selects());
    CHECK(change.restated() == std::vector{1});
    CHECK_FALSE(MarksChange::between(full, full).edits_tree());
}

TEST_CASE("the change of one member does not affect the others") {
    const Marks full = full_marks();
    for (const MarksRow& row : marks_table()) {
        Marks one;
        row.take(one, full);
        Marks marks;
        MarksChange::between(marks, one).apply(marks, ChangeDirection::kForward);
        CHECK(marks == one);
        CHECK(differ_in_looks_alone(Marks{}, one) == row.is_look);
    }
}
