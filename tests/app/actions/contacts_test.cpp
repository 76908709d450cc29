// Contacts: going to them, marking them, and finding them behind the window's back.
#include "app/reports/report_tables.h"
#include "app/session/session_file.h"
#include "app/workspace/workspace.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"
#include "tests/support/settle.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

using namespace ramus;
using namespace ramus::app;
using ramus::test::settle;

namespace {

// Tubes of radius 1. The first has a bend of 1 mm, 0.5 after one pass of smoothing, under one that is 2.5 mm high: they
// overlap by 0.5 or touch. The last two overlap by 0.2. Voxels are so large that smoothing reaches from end to end.
constexpr const char* kTubes = "# id type x y z radius parent (mm, RAS) voxel 100 0 0 0 100 0 0 0 100\n"
                               "1 2 0 -10 0 1 -1\n2 2 0 0 1 1 1\n3 2 0 10 0 1 2\n"
                               "4 2 -10 0 2.5 1 -1\n5 2 10 0 2.5 1 4\n"
                               "6 2 30 -10 0 1 -1\n7 2 30 10 0 1 6\n"
                               "8 2 20 0 1.8 1 -1\n9 2 40 0 1.8 1 8\n";

// By how much the round bend is lower than its point: half a radius times the sine of half the angle that it turns by.
double rounded_off(double height) { return 0.5 * height / std::hypot(10.0, height); }

std::vector<double> gaps(const Assets& assets) {
    std::vector<double> gaps;
    for (const tree::Contact& contact : *assets.contacts.list) gaps.push_back(contact.gap);
    return gaps;
}

struct ContactStage : test::CommandStage {
    ContactStage() : CommandStage(*io::parse_tree(kTubes, "tubes.swc")) {}
};

} // namespace

TEST_CASE("going to a contact by its number selects both branches, and shows them next to each other") {
    ContactStage stage;
    render::Camera camera = stage.document.session().camera;
    camera.focal_point = {0, 0, 0};
    camera.position = {0, 0, 200}; // from above, along what lies between the vessels
    camera.view_up = {0, 1, 0};
    stage.document.set_camera(camera);
    stage.good("contact 1");
    CHECK(stage.selection() == test::Ids{2, 3});
    CHECK(stage.host.leaps == 1);
    const render::Camera near = stage.document.session().camera;
    CHECK(glm::distance(near.focal_point, glm::dvec3(30, 0, 0.9)) < 1e-9);
    CHECK(std::abs(render::axes_of(near).forward.z) < 1e-9);
    CHECK(glm::distance(near.position, near.focal_point) < 100.0);
    stage.good("contact 2");
    CHECK(stage.selection() == test::Ids{0, 1});
    const glm::dvec3 between(0, 0, 0.5 * (2.5 + 0.5 - rounded_off(0.5)));
    CHECK(glm::distance(stage.document.session().camera.focal_point, between) < 1e-9);
    stage.good("surface smooth 0\ncontact 1");
    CHECK(stage.selection() == test::Ids{0, 1}); // they overlap more now
    stage.good("undo\nundo");                    // of the smoothing, and of what contact 2 had selected
    CHECK(stage.selection() == test::Ids{2, 3});
    for (const char* wrong : {"contact", "contact 0", "contact 3", "contact x", "contact 1 2"})
        CHECK(stage.bad(wrong).find("which contact?") != std::string::npos);
}

TEST_CASE("a contact is shown with both blends and a line between them, in one step of undo") {
    ContactStage stage;
    stage.good("compare-wipe 0.9\ncontact 2 wipe");
    const Comparison& comparison = stage.marks().comparison;
    CHECK(comparison.mode == Comparison::Mode::kWipe);
    CHECK(compared_surfaces(comparison) == std::vector{Compared::kMerged, Compared::kApart});
    CHECK(comparison.wipe == 0.5); // where the contact is
    CHECK(stage.selection() == test::Ids{0, 1});
    stage.good("undo");
    CHECK(stage.marks().comparison.mode == Comparison::Mode::kOff);
    CHECK(stage.selection().empty());
    CHECK(stage.marks().comparison.wipe == 0.9);
    for (const char* wrong : {"contact wipe", "contact 3 wipe", "contact 1 wiped", "contact 1 wipe wipe"})
        CHECK(stage.bad(wrong).find("which contact?") != std::string::npos);
}

TEST_CASE("a tree without contacts says so") {
    test::CommandStage stage(*io::parse_tree("1 2 0 0 0 1 -1\n2 2 0 0 9 1 1\n", "tube.swc"));
    CHECK(stage.bad("contact 1").find("there is no contact") != std::string::npos);
    CHECK(stage.bad("contacts").find("without a window") != std::string::npos);
    CHECK(stage.bad("report contacts.csv contacts").find("nothing to report of contacts") != std::string::npos);
}

TEST_CASE("marking contacts is one step of undo, and is saved in sessions") {
    ContactStage stage;
    CHECK_FALSE(to_json(stage.document.session(), "/")["options"].contains("contact_marks"));
    stage.good("contact-marks");
    CHECK(stage.marks().contact_marks);
    const auto saved = session_from_json(to_json(stage.document.session(), "/"), "/", "s.json");
    REQUIRE(saved);
    CHECK(saved->session.marks.contact_marks);
    stage.good("undo");
    CHECK_FALSE(stage.marks().contact_marks);
    stage.good("contact-marks on\ncontact-marks off");
    CHECK_FALSE(stage.marks().contact_marks);
    stage.bad("contact-marks perhaps");
    stage.bad("contact-marks on off");
}

TEST_CASE("a report lists contacts") {
    const TemporaryFolder folder;
    ContactStage stage;
    stage.good("name 3 upper\nreport " + (folder.path() / "c.csv").string() + " contacts");
    const std::string text = folder.text("c.csv");
    CHECK(text.starts_with("contact,branch,name,other_branch,other_name,gap,narrowed,other_narrowed,x,y,z,unit\r\n"
                           "1,2,,3,upper,-0.2,0.1,0.1,30,0,0.9,mm\r\n"));
}

TEST_CASE("the window finds contacts in the background, and again after smoothing, edits and undo") {
    const TemporaryFolder folder;
    Workspace workspace({});
    workspace.open(folder.write("tubes.swc", kTubes));
    const auto found = [&](std::vector<double> wanted) {
        const auto& list = workspace.assets().contacts.list;
        if (!list || list->size() != wanted.size() ||
            !workspace.assets().contacts.fits(workspace.document().marks().options))
            return false;
        const std::vector<double> now = gaps(workspace.assets());
        for (std::size_t i = 0; i < wanted.size(); ++i)
            if (std::abs(now[i] - wanted[i]) > 1e-9) return false;
        return true;
    };
    REQUIRE(settle(workspace, [&] { return found({-0.2, rounded_off(0.5)}); }));
    CHECK(settle(workspace, [&] { return !workspace.awaited(WorkKind::kContacts); })); // once its thread has ended

    Marks marks = workspace.document().marks();
    marks.options.smooth_passes = 0;
    workspace.document().change(marks);
    CHECK(workspace.awaited(WorkKind::kContacts));
    REQUIRE(settle(workspace, [&] { return found({-0.5 + rounded_off(1.0), -0.2}); }));

    // Of half the radius, the last vessel is too far away to touch.
    class NoPicture final : public PictureHost {
        [[nodiscard]] glm::ivec2 picture_size() const override { return {400, 300}; }
        [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return nullptr; }
        Result<void> write_picture(const std::filesystem::path& /*path*/) override { return {}; }
    } picture;
    ActionContext context{.document = workspace.document(), .picture = picture, .assets = workspace.assets()};
    const auto run = [&](const std::vector<std::string>& words) { REQUIRE(run_command(context, words)); };
    run({"select", "3"});
    run({"set-radius", "0.5"});
    REQUIRE(settle(workspace, [&] { return found({-0.5 + rounded_off(1.0)}); }));
    run({"undo"});
    REQUIRE(settle(workspace, [&] { return found({-0.5 + rounded_off(1.0), -0.2}); }));

    // There and back before anybody looks: they are looked for again.
    run({"redo"});
    (void)workspace.follow_tree();
    (void)workspace.current_assets();
    run({"undo"});
    (void)workspace.follow_tree();
    (void)workspace.current_assets();
    REQUIRE(settle(workspace, [&] { return found({-0.5 + rounded_off(1.0), -0.2}); }));
}
