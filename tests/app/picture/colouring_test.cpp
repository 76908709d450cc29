// What colours say: maps, quantities, legends, and the frame that a session with plans becomes.
#include "app/assets/centerlines.h"
#include "app/assets/measured.h"
#include "app/picture/colouring.h"
#include "app/picture/compose.h"
#include "app/session/session_file.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"
#include "tests/support/grown_tree.h"
#include "tests/support/two_systems.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using render::ColourScale;

namespace {

std::shared_ptr<const tree::VesselTree> tree_of(int branches) {
    return std::make_shared<const tree::VesselTree>(test::grown_tree(branches).value());
}

struct ColouringStage : test::CommandStage {
    explicit ColouringStage(int branches) : test::CommandStage(tree_of(branches)) {}
    render::Frame frame() {
        refresh(assets, document);
        return compose(document.session(), assets, std::make_shared<const render::PagedMesh>(), {.size = {400, 300}});
    }
};

double luminance(const glm::vec3& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; }

} // namespace

TEST_CASE("colour maps increase in brightness, and their dark end is visible on a dark background") {
    for (const ColourMap map : kColourMaps) {
        CAPTURE(name_of(map));
        const auto ramp = ramp_of(map, 50);
        for (std::size_t i = 1; i < ramp.size() && map != ColourMap::kCoolwarm; ++i) // brightest in its middle
            CHECK(luminance(ramp[i]) > luminance(ramp[i - 1]));
        CHECK(luminance(ramp.front()) > 0.1);
        CHECK(colour_at(map, -3.0) == ramp.front());
        CHECK(colour_at(map, 7.0) == ramp.back());
    }
}

// The values that matplotlib 3.9 publishes, at the two ends and in the middle.
TEST_CASE("colour maps agree with the published ones") {
    const auto near = [](const glm::vec3& a, const glm::vec3& b) { return glm::length(a - b) < 2e-6F; };
    const auto middle = [](ColourMap map, double darkest) { return colour_at(map, (0.5 - darkest) / (1.0 - darkest)); };
    CHECK(near(colour_at(ColourMap::kCoolwarm, 0.0), {0.229806F, 0.298718F, 0.753683F}));
    CHECK(near(middle(ColourMap::kCoolwarm, 0.0), {0.865395F, 0.865410F, 0.865396F}));
    CHECK(near(colour_at(ColourMap::kCoolwarm, 1.0), {0.705673F, 0.015556F, 0.150233F}));
    CHECK(near(middle(ColourMap::kPlasma, 0.1), {0.798216F, 0.280197F, 0.469538F}));
    CHECK(near(colour_at(ColourMap::kPlasma, 1.0), {0.940015F, 0.975158F, 0.131326F}));
    CHECK(near(middle(ColourMap::kViridis, 0.12), {0.127568F, 0.566949F, 0.550556F}));
    CHECK(near(colour_at(ColourMap::kGrey, 1.0), {1.0F, 1.0F, 1.0F}));
}

TEST_CASE("data of the tree's file have colours and a legend, by range, map and logarithm") {
    tree::VesselTree tree = test::built_tree({{{0, 0, 0}, 3}, {{0, 0, 40}, 3}, {{20, 0, 60}, 2}, {{-20, 0, 60}, 2}},
                                             {{0, 1}, {1, 2}, {1, 3}});
    tree.branch_data = {{"flow", {1.0, 12.5, tree::kUnknownValue}}};
    tree.point_data = {{"other", {5, 5, 5, 5}}, {"pressure", {90, 80, 60, tree::kUnknownValue}}};
    Marks marks;
    const auto colouring = [&] { return colouring_of(tree, facts_of(tree), marks, nullptr); };
    const auto texts = [&] {
        std::vector<std::string> all;
        for (const auto& tick : colouring().legend.ticks) all.push_back(tick.text);
        return all;
    };
    marks.colour_by = ColourBy::array("flow");
    CHECK(colouring().legend.title == "flow");
    CHECK(colouring().branches[0] == colour_at(ColourMap::kViridis, 0.0));
    CHECK(colouring().branches[1] == colour_at(ColourMap::kViridis, 1.0));
    CHECK(colouring().branches[2] == kUnknownColour);
    CHECK(colouring().legend.swatches.back().text == "not known");
    marks.colour_look.range = {2.0, 10.0};
    marks.colour_map = ColourMap::kCoolwarm;
    CHECK(colouring().branches[1] == colour_at(ColourMap::kCoolwarm, 1.0));
    CHECK(texts() == std::vector<std::string>{"4", "6", "8", "< 2", "> 10"});
    marks.colour_look.logarithmic = true;
    CHECK(texts() == std::vector<std::string>{"5", "< 2", "> 10"});
    marks.colour_look.range = {1.0, 1e6}; // over many decades powers of ten alone
    CHECK(texts() == std::vector<std::string>{"1", "10", "100", "1000", "10000", "100000", "1000000"});
    marks.colour_look.legend = false;
    CHECK(colouring().legend.title.empty());
    marks.colour_look = {};
    marks.colour_by = ColourBy::array("pressure");
    const Colouring along = colouring();
    CHECK(along.scale.value == render::ColourScale::Value::kOfLines);
    CHECK(along.scale.list == 1);
    CHECK(along.some_unknown);
    CHECK(along.scale.low == 60.0F);
    CHECK(along.scale.high == 90.0F);
    CHECK(along.branches[2] == colour_at(ColourMap::kCoolwarm, 2.0 / 3.0)); // what is known of it: 80
    marks.colour_by = ColourBy::array("gone");                              // of a session whose tree has it no more
    CHECK(colouring().branches == std::vector<glm::vec3>(3, kUnknownColour));
    CHECK(colouring_of_tree("flow", tree)->data == "flow");
    CHECK(colouring_of_tree("file:pressure", tree)->data == "pressure");
    CHECK(colouring_of_tree("diameter", tree)->kind == ColourBy::kQuantity);
    CHECK_FALSE(colouring_of_tree("weather", tree));
}

TEST_CASE("every quantity colours every branch and has a legend") {
    ColouringStage stage(60);
    REQUIRE(stage.run("name 3 Segment\nlesion 0,0,0,4"));
    for (const ColouringRow& row : colourings()) {
        const ColourBy quantity = row.by;
        CAPTURE(name_of(quantity));
        REQUIRE(stage.run("colour-by " + std::string(name_of(quantity))));
        const render::Frame frame = stage.frame();
        const bool plain = quantity == ColourBy::kNothing || quantity == ColourBy::kState;
        CHECK(frame.colours.size() == (plain ? 0 : stage.document.tree()->branches.size()));
        const bool unexplained = quantity == ColourBy::kNothing || quantity == ColourBy::kBranch;
        CHECK(frame.overlays.legend.title.empty() == unexplained);
        if (!unexplained) CHECK(frame.overlays.legend.bar.size() + frame.overlays.legend.swatches.size() > 0);
        for (const auto& tick : frame.overlays.legend.ticks) {
            CHECK(tick.at >= -1e-9);
            CHECK(tick.at <= 1.0 + 1e-9);
        }
        CHECK((frame.scale.value != ColourScale::Value::kNone) ==
              (quantity == Quantity::kDiameter || quantity == Quantity::kRootDistance));
        CHECK(frame.margins.bands.empty() == (quantity != ColourBy::kLesion));
    }
    CHECK_FALSE(stage.run("colour-by weather"));
    CHECK_FALSE(stage.run("colour-map rainbow"));
}

TEST_CASE("the ticks of a diameter legend stand where the colours of those diameters are") {
    ColouringStage stage(200);
    REQUIRE(stage.run("colour-by diameter\ncolour-map cividis"));
    const render::Frame frame = stage.frame();
    REQUIRE(frame.overlays.legend.ticks.size() >= 2);
    for (const auto& tick : frame.overlays.legend.ticks) {
        const double mm = std::stod(tick.text), low = frame.scale.low, high = frame.scale.high;
        CHECK(tick.at == doctest::Approx(std::log(mm / low) / std::log(high / low)).epsilon(0.01));
    }
    CHECK(frame.scale.ramp == ramp_of(ColourMap::kCividis));
}

TEST_CASE("names colour their dependents, and characters beyond Latin-1 become question marks") {
    ColouringStage stage(60);
    const auto& branches = stage.document.tree()->branches;
    const auto parent = static_cast<std::size_t>(
        std::ranges::find_if(branches, [](const auto& b) { return b.generation == 1 && !b.children.empty(); }) -
        branches.begin());
    REQUIRE(stage.run("name " + std::to_string(parent) + " Lebervene subtree\ncolour-by label"));
    const auto colours = stage.frame().colours;
    const auto child = static_cast<std::size_t>(branches[parent].children.front());
    CHECK(colours[child] == colours[parent]);
    CHECK(colours[0] != colours[parent]);
    CHECK(latin1("V\xC3\xA9n\xC3\xBC") == "V\xE9n\xFC");
    CHECK(latin1("a\xE2\x80\x93\xCE\xB2 z") == "a?? z");
}

TEST_CASE("margins follow the session's bands, and a branch has the colour of the nearest band that it reaches") {
    ColouringStage stage(60);
    Marks marks = stage.document.marks();
    const auto& tree = *stage.document.tree();
    const glm::dvec3 root = tree.points[tree.branches[0].points[0]].position;
    marks.lesions = {{.sphere = {root.x, root.y, root.z, 3.0}}};
    marks.planning.bands_mm = {2.0, 30.0};
    marks.colour_by = ColourBy::kLesion;
    stage.document.change(marks);
    const render::Frame frame = stage.frame();
    REQUIRE(frame.margins.bands.size() == 2);
    CHECK(frame.margins.bands[1].within_mm == 30.0F);
    CHECK(frame.lesions.spheres.size() == 1);
    CHECK(frame.colours[0] == kBeyondMargins); // the picture has margins in its place
    const auto branches = colouring_of(tree, *stage.document.facts(), marks, stage.assets.plan.get()).branches;
    CHECK(branches[0] == margin_colour(0, 2));
    REQUIRE(frame.overlays.legend.swatches.size() == 3);
    CHECK(frame.overlays.legend.swatches[0].text == "up to 2");
    CHECK(frame.overlays.legend.swatches[2].text == "beyond 30");
    const auto& distances = stage.assets.plan->lesion_distances_mm;
    for (std::size_t id = 0; id < distances.size(); ++id)
        if (distances[id] > 30.0) CHECK(branches[id] == kBeyondMargins);
}

TEST_CASE("beyond the margins systems stay distinguishable, and the legend says which is which") {
    ColouringStage stage(60);
    tree::VesselTree tree = *stage.document.tree();
    tree.systems = {{"portal vein", {40, 90, 230}}, {"hepatic vein", {220, 60, 60}}};
    for (std::size_t id = 0; id < tree.branches.size(); ++id) tree.branches[id].system = id % 2 == 0 ? 0 : 1;
    Marks marks = stage.document.marks();
    const glm::dvec3 root = tree.points[tree.branches[0].points[0]].position;
    marks.lesions = {{.sphere = {root.x, root.y, root.z, 1.0}}};
    marks.planning.bands_mm = {2.0, 5.0};
    marks.colour_by = ColourBy::kLesion;
    Plan plan;
    plan.lesions.spheres = spheres_of(marks);
    plan.lesion_distances_mm = measure::wall_distances(tree, plan.lesions);
    const Colouring colouring = colouring_of(tree, *stage.document.facts(), marks, &plan);
    REQUIRE(colouring.beyond.size() == tree.branches.size());
    CHECK(colouring.beyond[0] == colouring.beyond[2]);
    CHECK(glm::distance(colouring.beyond[0], colouring.beyond[1]) > 0.3F);
    // With any number of margins: from the fourth on they were as blue as the portal vein beyond them.
    for (std::size_t count = 1; count <= render::Margins::kMost; ++count)
        for (std::size_t margin = 0; margin < count; ++margin)
            for (std::size_t id = 0; id < 2; ++id)
                CHECK(glm::distance(colouring.beyond[id], margin_colour(margin, count)) > 0.2F);
    REQUIRE(colouring.legend.swatches.size() == 4);
    CHECK(colouring.legend.swatches[2].text == "beyond 5: portal vein");
    CHECK(colouring.legend.swatches[2].colour == colouring.beyond[0]);
    CHECK(colouring.legend.swatches[3].text == "beyond 5: hepatic vein");
}

TEST_CASE("branches beyond cuts are lost, and each cut has a ring") {
    ColouringStage stage(60);
    REQUIRE(stage.run("cut 1 0.25"));
    const render::Frame frame = stage.frame();
    const auto& tree = *stage.document.tree();
    REQUIRE(frame.centerlines);
    for (const render::LostPart& part : frame.lost) {
        CHECK(part.whole() == (part.branch != 1));
        if (part.branch == 1) CHECK(part.from == doctest::Approx(0.25));
    }
    CHECK(frame.lost.size() == tree::subtree(tree, 1).size());
    REQUIRE(frame.lines.size() == 1);
    const auto place = frame.centerlines->at(1, 0.25).value();
    for (const glm::dvec3& p : frame.lines[0].points)
        CHECK(glm::distance(p, place.position) == doctest::Approx(1.35 * place.radius_mm));
}

TEST_CASE("measurements are drawn with their numbers") {
    ColouringStage stage(60);
    Marks marks = stage.document.marks();
    const auto& tree = *stage.document.tree();
    const int child = tree.branches[0].children.front();
    marks.measurements = {{.kind = Measurement::Kind::kDistance, .points = {glm::dvec3(0), glm::dvec3(3, 4, 0)}},
                          {.kind = Measurement::Kind::kPath, .places = {{{0, 0.5}, {child, 0.5}}}},
                          {.kind = Measurement::Kind::kDiameter, .places = {{{0, 0.5}}}},
                          {.kind = Measurement::Kind::kAngle, .places = {{{child, 0.5}}}}};
    stage.document.change(marks);
    const render::Frame frame = stage.frame();
    REQUIRE(frame.labels.size() >= 4);
    CHECK(frame.labels[0].text == "5.00 mm");
    CHECK(frame.labels[0].at == glm::dvec3(1.5, 2, 0));
    CHECK(frame.labels[1].text.starts_with("path "));
    CHECK(frame.labels[2].text.starts_with("\xD8 "));
    CHECK(frame.labels[3].text.ends_with("\xB0"));
    // The picture tells what the command and the tables tell (in the fonts' encoding).
    for (std::size_t i = 0; i < 4; ++i) {
        const std::string told = measured(tree, marks.measurements[i], {})->value_text();
        CAPTURE(frame.labels[i].text);
        CHECK(frame.labels[i].text.find(told.substr(0, told.find_first_not_of("0123456789."))) != std::string::npos);
    }
    CHECK(frame.labels.size() == 4); // one each
    // What the tree no longer has is left out.
    marks.measurements = {{.kind = Measurement::Kind::kDiameter, .places = {{{100000, 0.5}}}}};
    stage.document.change(marks);
    CHECK(stage.frame().labels.empty());
}

TEST_CASE("glass and colours are commands, undone and saved like everything else") {
    ColouringStage stage(20);
    const Marks before = stage.document.marks();
    REQUIRE(stage.run("glass-opacity 1.5\nglass-grey 0.25\ncolour-by root-distance\ncolour-map magma"));
    const Marks& marks = stage.document.marks();
    CHECK(marks.glass == GlassLook{1.5, 0.25});
    CHECK(marks.colour_map == ColourMap::kMagma);
    for (const char* wrong : {"glass-opacity 2.1", "glass-opacity", "glass-grey -0.1", "glass-grey x", "colour-map"})
        CHECK_FALSE(stage.run(wrong));
    const auto json = to_json(stage.document.session(), "/");
    const auto read = session_from_json(json, "/", "test");
    REQUIRE(read);
    CHECK(read->session.marks == marks);
    REQUIRE(stage.run("undo\nundo\nundo\nundo"));
    CHECK(stage.document.marks() == before);
}

TEST_CASE("centerlines run from root to leaf with the file's lengths, whatever the options") {
    const auto tree = tree_of(120);
    for (const mesh::SurfaceOptions& options :
         {mesh::SurfaceOptions{}, mesh::SurfaceOptions{.smooth_passes = 4, .prune_ratio = 0.5}}) {
        const auto lines = centerlines_of(*tree, options).lines;
        REQUIRE(lines->runs.size() == tree->branches.size());
        std::size_t drawn = 0;
        for (std::size_t id = 0; id < tree->branches.size(); ++id) {
            const auto run = lines->runs[id];
            if (run.count == 0) continue; // pruned
            ++drawn;
            const auto begin = *lines->at(static_cast<int>(id), 0.0), end = *lines->at(static_cast<int>(id), 1.0);
            CHECK(end.from_root_mm - begin.from_root_mm ==
                  doctest::Approx(tree::length_mm(*tree, tree->branches[id])).epsilon(1e-4));
            const int parent = tree->branches[id].parent;
            if (parent == tree::kNoBranch) continue;
            const auto before = *lines->at(parent, 1.0);
            CHECK(glm::distance(before.position, begin.position) < 1e-4);
            CHECK(before.from_root_mm == doctest::Approx(begin.from_root_mm).epsilon(1e-4));
        }
        CHECK((drawn == tree->branches.size()) == (options.prune_ratio == 0.0));
        for (std::size_t i = 0; i < lines->points.size(); ++i) CHECK(lines->details[i].diameter_mm > 0.0F);
    }
}

TEST_CASE("depth cues are switched by a command, undone, and shown") {
    ColouringStage stage(20);
    CHECK(stage.frame().appearance.occlusion == 1.0F);
    CHECK(stage.frame().appearance.halos == 0.0F);
    REQUIRE(stage.run("depth-cue halos\ndepth-cue occlusion off\ndepth-cue chromadepth on\ndepth-cue chromadepth on\n"
                      "depth-cue shadows on"));
    const render::Appearance look = stage.frame().appearance;
    CHECK(look.halos == 1.0F);
    CHECK(look.occlusion == 0.0F);
    CHECK(look.chromadepth == 1.0F);
    CHECK(look.shadows == 1.0F);
    CHECK(look.contours == 0.0F);
    REQUIRE(stage.run("depth-cue halos"));
    CHECK(stage.frame().appearance.halos == 0.0F);
    REQUIRE(stage.run("undo"));
    CHECK(stage.frame().appearance.halos == 1.0F);
    for (const char* wrong : {"depth-cue", "depth-cue mist", "depth-cue fog maybe", "depth-cue fog on off"})
        CHECK_FALSE(stage.run(wrong));
}

TEST_CASE("a system that is completely hidden is not in the legend") {
    const tree::VesselTree tree = test::two_systems();
    const TreeFacts facts = facts_of(tree);
    Marks marks;
    marks.colour_by = ColourBy::kSystem;
    const auto swatches = [&] { return colouring_of(tree, facts, marks, nullptr).legend.swatches; };
    CHECK(swatches().size() == 2);
    set_state(marks, std::vector{3}, tree::BranchState::kHidden);
    REQUIRE(swatches().size() == 1);
    CHECK(swatches()[0].text == "portal vein");
    set_state(marks, std::vector{0, 1}, tree::BranchState::kHidden); // a part of the other one
    CHECK(swatches().size() == 1);
}
