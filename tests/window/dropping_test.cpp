// Files that are dropped on the window: read on a worker, then context, or a lesion for who plans.
#include "app/actions/command_runner.h"
#include "core/io/meshes/mesh_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/nifti_file.h"
#include "tests/support/viewer_stage.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

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
        REQUIRE(viewer.interface().volume.open());
        CHECK(viewer.interface().dialog_open());
    };
    const auto marks = [&]() -> const app::Marks& { return stage.workspace.document.marks(); };
    const int branches = stage.workspace.document.branch_count();

    drop();
    press(stage, GLFW_KEY_ESCAPE, "Escape");
    CHECK_FALSE(viewer.interface().volume.open());
    CHECK(marks().context.empty());
    CHECK(stage.workspace.document.branch_count() == branches);

    drop();
    CHECK(viewer.interface().volume.as == app::VolumeDialog::As::kTree);
    press(stage, GLFW_KEY_DOWN, "Down");
    CHECK(viewer.interface().volume.as == app::VolumeDialog::As::kContext);
    press(stage, GLFW_KEY_ENTER, "Return");
    CHECK_FALSE(viewer.interface().volume.open());
    REQUIRE(marks().context.size() == 1);
    CHECK(marks().context[0].file == mask.string());
    CHECK(viewer.files().settings().drop_beside);

    REQUIRE(app::run_command(viewer.actions(), std::vector<std::string>{"undo"}));
    drop();
    CHECK(viewer.interface().volume.as == app::VolumeDialog::As::kContext); // as last time
    press(stage, GLFW_KEY_T, "T");
    CHECK(stage.workspace.document.session().tree.path == mask);
    CHECK(stage.workspace.document.branch_count() == 1);
    CHECK(marks().context.empty());
    CHECK_FALSE(viewer.files().settings().drop_beside);
    CHECK(viewer.interface().doctor.of_mask);
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
    const app::Marks& marks = stage.workspace.document.marks();

    viewer.files().dropped(ball);
    CHECK(marks.context.empty()); // not yet: it is being read
    CHECK(viewer.commands().busy());
    const render::Image with = stage.settle();
    REQUIRE(marks.context.size() == 1);
    CHECK(marks.context[0].file == ball.string());
    CHECK(marks.lesion_meshes.empty());
    const glm::ivec2 middle = viewer.layout().view_at + viewer.layout().view_size / 2;
    int differing = 0;
    for (int x = middle.x - 40; x < middle.x + 40; ++x)
        differing +=
            std::equal(with.pixel(x, middle.y), with.pixel(x, middle.y) + 3, before.pixel(x, middle.y)) ? 0 : 1;
    CHECK(differing > 40);

    viewer.files().dropped(bad); // a mask by its name: what it holds cannot be read
    stage.settle();
    CHECK_FALSE(viewer.interface().volume.open());
    CHECK(marks.context.size() == 1);
    REQUIRE(viewer.interface().errors.size() == 1);
    CHECK(viewer.interface().errors.front().message().find("bad.nii") != std::string::npos);
    press(stage, GLFW_KEY_ESCAPE, "Escape");
    CHECK(viewer.interface().errors.empty());

    viewer.actions().window->toggle("plan");
    viewer.files().dropped(ball);
    stage.settle();
    CHECK(marks.context.size() == 1);
    CHECK(marks.lesion_meshes == std::vector<std::string>{ball.string()});
    CHECK(stage.workspace.document.step_count() == 2);
}

TEST_CASE("the labels that are chosen are those that commands get") {
    app::VolumeDialog dialog;
    CHECK(dialog.label_words().empty()); // nothing is known of the file yet: all
    CHECK(dialog.context_labels() == std::vector<std::int32_t>{0});
    app::VolumeFacts facts;
    facts.mask = true;
    for (const int label : {1, 2, 5}) facts.labels.push_back({label, "", 1, 1.0});
    dialog.take(facts);
    CHECK(dialog.label_words().empty());
    dialog.together = true;
    CHECK(dialog.label_words() == "together");
    dialog.labels[1] = 0;
    CHECK(dialog.label_words() == "1+5");
    CHECK(dialog.context_labels() == std::vector<std::int32_t>{1, 5});
    dialog.together = false;
    CHECK(dialog.label_words() == "1,5");
    dialog.labels = {0, 0, 0};
    CHECK(dialog.context_labels().empty());
}
