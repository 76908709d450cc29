// Files that are dropped on the window: read on a worker, then context, or a lesion for who plans.
#include "app/actions/command_runner.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/error_dialog.h"
#include "app/panels/volume_dialog.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/nifti_file.h"
#include "tests/support/viewer_stage.h"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <doctest/doctest.h>
#include <memory>
#include <string>
#include <vector>

using namespace ramus;

namespace {

// A tube of 8 mm in radius along x, beside the stage's tree.
std::filesystem::path tube_mask(const std::filesystem::path& path) {
    constexpr int kLength = 40, kSide = 20;
    test::NiftiFile file;
    file.dim = {3, kLength, kSide, kSide, 1, 1, 1, 1};
    file.rows = {1, 0, 0, -20, 0, 1, 0, -10, 0, 0, 1, -10};
    std::vector<std::uint8_t> voxels;
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kLength; ++x)
                voxels.push_back((y - 10) * (y - 10) + (z - 10) * (z - 10) <= 64 && x > 1 && x < 38 ? 1 : 0);
    file.put(voxels);
    return test::write_plain(path, file.bytes());
}

void press(test::ViewerStage& stage, int key, const char* name) {
    stage.viewer->input().key(key, true, app::KeyPress{name}, {}, stage.now);
    stage.draw();
    stage.viewer->input().key(key, false, std::nullopt, {}, stage.now);
    stage.settle();
}

} // namespace

TEST_CASE("a mask that is dropped on a tree asks what becomes of it; the last answer stands first") {
    test::ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n", {700, 500});
    const auto mask = tube_mask(stage.folder.path() / "tube.nii");
    app::Viewer& viewer = *stage.viewer;
    stage.settle();
    viewer.files().use_settings({});
    const auto drop = [&] {
        viewer.files().dropped(mask);
        stage.settle();
        REQUIRE(viewer.interface().of<app::VolumeDialog>().open());
        CHECK(viewer.interface().dialog_open());
    };
    const auto marks = [&]() -> const app::Marks& { return stage.workspace.document().marks(); };
    const int branches = stage.workspace.document().branch_count();

    drop();
    press(stage, GLFW_KEY_ESCAPE, "Escape");
    CHECK_FALSE(viewer.interface().of<app::VolumeDialog>().open());
    CHECK(marks().context.empty());
    CHECK(stage.workspace.document().branch_count() == branches);

    drop();
    CHECK(viewer.interface().of<app::VolumeDialog>().as == app::VolumeDialog::As::kTree);
    press(stage, GLFW_KEY_DOWN, "Down");
    CHECK(viewer.interface().of<app::VolumeDialog>().as == app::VolumeDialog::As::kContext);
    press(stage, GLFW_KEY_ENTER, "Return");
    CHECK_FALSE(viewer.interface().of<app::VolumeDialog>().open());
    REQUIRE(marks().context.size() == 1);
    CHECK(marks().context[0].file == mask.string());
    CHECK(viewer.files().settings().drop_beside);

    REQUIRE(app::run_command(viewer.actions(), std::vector<std::string>{"undo"}));
    drop();
    CHECK(viewer.interface().of<app::VolumeDialog>().as == app::VolumeDialog::As::kContext); // as last time
    press(stage, GLFW_KEY_T, "T");
    CHECK(stage.workspace.document().session().tree.path == mask);
    CHECK(stage.workspace.document().branch_count() == 1);
    CHECK(marks().context.empty());
    CHECK_FALSE(viewer.files().settings().drop_beside);
    CHECK(viewer.interface().of<app::Doctor>().of_mask);
}

TEST_CASE("a mesh that is dropped on the window is context, or a lesion for who plans; a bad one is named") {
    test::ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n", {700, 500});
    const auto ball = stage.folder.path() / "ball.stl", bad = stage.folder.path() / "bad.nii";
    std::ofstream(bad) << "nothing";
    auto mesh = test::icosphere(3, {0, 0, 0}, 9.0);
    mesh.radii.resize(mesh.positions.size(), 1.0F);
    mesh.branches.resize(mesh.positions.size(), 0);
    REQUIRE(io::write_mesh(mesh, ball));
    app::Viewer& viewer = *stage.viewer;
    const render::Image before = stage.settle();
    viewer.files().use_settings({}); // a person's window: commands do not wait
    const app::Marks& marks = stage.workspace.document().marks();

    viewer.files().dropped(ball);
    CHECK(marks.context.empty()); // not yet: it is being read
    CHECK(viewer.commands().busy());
    const render::Image with = stage.settle();
    REQUIRE(marks.context.size() == 1);
    CHECK(marks.context[0].file == ball.string());
    CHECK(lesion_files(marks).empty());
    const glm::ivec2 middle = viewer.layout().view_at + viewer.layout().view_size / 2;
    int differing = 0;
    for (int x = middle.x - 40; x < middle.x + 40; ++x)
        differing +=
            std::equal(with.pixel(x, middle.y), with.pixel(x, middle.y) + 3, before.pixel(x, middle.y)) ? 0 : 1;
    CHECK(differing > 40);

    viewer.files().dropped(bad); // a mask by its name: what it holds cannot be read
    stage.settle();
    CHECK_FALSE(viewer.interface().of<app::VolumeDialog>().open());
    CHECK(marks.context.size() == 1);
    REQUIRE(viewer.interface().of<app::ErrorDialog>().errors.size() == 1);
    CHECK(viewer.interface().of<app::ErrorDialog>().errors.front().message().find("bad.nii") != std::string::npos);
    press(stage, GLFW_KEY_ESCAPE, "Escape");
    CHECK(viewer.interface().of<app::ErrorDialog>().errors.empty());

    viewer.actions().window->toggle("plan");
    viewer.files().dropped(ball);
    stage.settle();
    CHECK(marks.context.size() == 1);
    CHECK(lesion_files(marks) == std::vector<std::string>{ball.string()});
    CHECK(stage.workspace.document().step_count() == 2);
}

TEST_CASE("a table that is dropped on a tree joins it, and colours can say its numbers") {
    test::ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n", {700, 500});
    const auto table = stage.folder.path() / "flow.csv", bad = stage.folder.path() / "bad.csv";
    std::ofstream(table) << "branch,flow\n0,12\n1,8.5\n2,3.5\n";
    std::ofstream(bad) << "branch,flow\n7,12\n";
    app::Viewer& viewer = *stage.viewer;
    stage.settle();
    viewer.files().use_settings({});
    viewer.files().dropped(table);
    stage.settle();
    const app::Document& document = stage.workspace.document();
    REQUIRE(document.tree()->branch_data.size() == 1);
    CHECK(document.tree()->branch_data[0].name == "flow");
    CHECK(document.tree()->branch_data[0].values == std::vector<double>{12, 8.5, 3.5});
    CHECK(document.branch_count() == 3);
    REQUIRE(app::run_command(viewer.actions(), std::vector<std::string>{"colour-by", "flow"}));
    viewer.files().dropped(bad);
    stage.settle();
    CHECK(viewer.interface().notice.trouble);
    CHECK(viewer.interface().notice.text.find("no branch 7") != std::string::npos);
    CHECK(document.tree()->branch_data.size() == 1);
}

using Words = std::vector<std::string>;

TEST_CASE("the labels that are chosen are those that commands get") {
    app::VolumeDialog dialog;
    CHECK(dialog.tree_words().empty()); // nothing is known of the file yet: all
    CHECK(dialog.context_words() == std::vector<Words>{{}});
    app::VolumeFacts facts;
    facts.mask = facts.all_at_once = true;
    for (const int label : {1, 2, 5}) facts.labels.push_back({label, "", 1, 1.0});
    dialog.take(facts);
    CHECK(dialog.tree_words().empty());
    CHECK(dialog.context_words() == std::vector<Words>{{}});
    dialog.together = true;
    CHECK(dialog.tree_words() == Words{"--labels", "together"});
    dialog.labels[1] = 0;
    CHECK(dialog.tree_words() == Words{"--labels", "1+5"});
    CHECK(dialog.context_words() == std::vector<Words>{{"--label", "1"}, {"--label", "5"}});
    dialog.together = false;
    CHECK(dialog.tree_words() == Words{"--labels", "1,5"});
    CHECK(dialog.why_not().empty());
    dialog.labels = {0, 0, 0};
    CHECK(dialog.why_not() == "No label is chosen");
    // Labels that are no mask's by themselves are named, all of them, too.
    facts.all_at_once = false;
    dialog.take(facts);
    CHECK(dialog.context_words().size() == 3);
    // Those that the file names are things of their own, all of them, too.
    facts.all_at_once = true;
    facts.labels[1].name = "portal vein";
    dialog.take(facts);
    CHECK(dialog.context_words() == std::vector<Words>{{"--label", "1"}, {"--label", "2"}, {"--label", "5"}});
    CHECK(dialog.tree_words().empty());
}

TEST_CASE("a scan begins at Otsu's threshold, and commands get the one that is chosen") {
    app::VolumeFacts facts;
    facts.curve = std::make_shared<const volume::ThresholdCurve>(
        volume::ThresholdCurve{{-10.0, 0.5, 200.0}, {8, 4, 1}, {1, 2, 1}, 1, 1});
    app::VolumeDialog dialog;
    dialog.take(facts);
    CHECK(dialog.scan);
    CHECK(dialog.tree_words() == Words{"--isovalue", "0.5"});
    dialog.threshold = 2;
    CHECK(dialog.context_words() == std::vector<Words>{{"--isovalue", "200"}});
    // What may be either is what somebody says.
    for (const int label : {1, 2}) facts.labels.push_back({label, "", 1, 1.0});
    dialog.take(facts);
    CHECK(facts.may_be_either());
    dialog.scan = false;
    dialog.labels[1] = 0;
    CHECK(dialog.tree_words() == Words{"--labels", "1"});
    facts.curve = nullptr;
    facts.labels.clear();
    dialog.take(facts);
    CHECK_FALSE(dialog.why_not().empty());
}

namespace {

// Brighter toward the axis of a tube of about 6 mm in radius along x, from 400 there to 0; and 900 in a small cube.
std::filesystem::path tube_scan(const std::filesystem::path& path) {
    constexpr int kLength = 40, kSide = 24;
    test::NiftiFile file;
    file.dim = {3, kLength, kSide, kSide, 1, 1, 1, 1};
    file.type = static_cast<int>(test::NiftiType::kInt16);
    file.rows = {1, 0, 0, -20, 0, 1, 0, -12, 0, 0, 1, -12};
    std::vector<std::int16_t> voxels;
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kLength; ++x) {
                const int away = (y - 12) * (y - 12) + (z - 12) * (z - 12);
                const bool cube = x < 5 && y < 4 && z < 4;
                voxels.push_back(static_cast<std::int16_t>(cube ? 900 : std::max(0, 400 - 6 * away) + x));
            }
    file.put(voxels);
    return test::write_plain(path, file.bytes());
}

} // namespace

TEST_CASE("without a tree a scan opens as the surface of its threshold, and a tree comes in among what is shown" *
          doctest::test_suite("slow")) {
    test::ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n", {700, 500});
    const auto scan = tube_scan(stage.folder.path() / "scan.nii");
    app::Viewer& viewer = *stage.viewer;
    stage.settle();
    viewer.files().use_settings({});
    stage.workspace.document().open(nullptr, {});
    const auto rest = [&] {
        for (int i = 0; i < 2000 && (i < 5 || !viewer.resting() || stage.workspace.busy()); ++i) stage.draw();
    };
    viewer.files().dropped(scan);
    rest();
    const app::VolumeDialog& dialog = viewer.interface().of<app::VolumeDialog>();
    REQUIRE(dialog.facts);
    CHECK(dialog.scan);
    const double otsu = dialog.facts->curve->thresholds[dialog.threshold];
    CHECK(otsu > 0.0);
    CHECK(otsu < 900.0);
    press(stage, GLFW_KEY_S, "S");
    rest();
    const app::Document& document = stage.workspace.document();
    REQUIRE(document.marks().context.size() == 1);
    CHECK(document.marks().context[0].isovalue == otsu);
    CHECK(document.marks().context[0].opacity == 1.0);
    CHECK_FALSE(document.tree());
    CHECK(document.has_scene());
    CHECK(stage.workspace.all_shown());
    CHECK(viewer.title().find("scan.nii") != std::string::npos);
    CHECK(viewer.picture().scale_bar().has_value()); // something solid is seen

    viewer.files().dropped(stage.folder.path() / "tree.swc");
    stage.settle();
    CHECK(document.branch_count() == 1);
    CHECK(document.marks().context.size() == 1);
}

TEST_CASE("a scan that is to be context asks for its threshold, and a mask does not" * doctest::test_suite("slow")) {
    test::ViewerStage stage("1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n", {900, 800});
    const auto mask = tube_mask(stage.folder.path() / "tube.nii");
    test::NiftiFile file;
    file.dim = {3, 12, 12, 12, 1, 1, 1, 1};
    file.rows = {2, 0, 0, -12, 0, 2, 0, -12, 0, 0, 2, -12};
    file.type = static_cast<int>(test::NiftiType::kFloat32);
    std::vector<float> values;
    for (int n = 0; n < 12 * 12 * 12; ++n) {
        const glm::ivec3 at{n % 12 - 6, n / 12 % 12 - 6, n / 144 - 6};
        values.push_back(200.5F - 3.0F * static_cast<float>(at.x * at.x + at.y * at.y + at.z * at.z));
    }
    file.put(values);
    const auto scan = test::write_plain(stage.folder.path() / "scan.nii", file.bytes());
    app::Viewer& viewer = *stage.viewer;
    stage.settle();
    viewer.files().use_settings({});
    const auto add = [&](const std::filesystem::path& path) {
        REQUIRE(app::run_command(viewer.actions(), std::vector<std::string>{"context", path.string()}));
        stage.settle();
    };
    const auto& context = stage.workspace.document().marks().context;
    add(mask);
    CHECK_FALSE(viewer.interface().of<app::VolumeDialog>().open());
    REQUIRE(context.size() == 1);
    add(scan);
    REQUIRE(viewer.interface().of<app::VolumeDialog>().open());
    CHECK(viewer.interface().of<app::ErrorDialog>().errors.empty());
    CHECK(viewer.interface().of<app::VolumeDialog>().as == app::VolumeDialog::As::kContext);
    CHECK(viewer.interface().of<app::VolumeDialog>().scan);
    press(stage, GLFW_KEY_ENTER, "Return");
    REQUIRE(context.size() == 2);
    CHECK(context[1].file == scan.string());
    CHECK(context[1].isovalue);
    CHECK(stage.workspace.document().branch_count() == 1); // the tree is still there
}
