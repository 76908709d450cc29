// Files that are dropped on the window: read on a worker, then context, or a lesion for who plans.
#include "core/io/meshes/mesh_file.h"
#include "tests/support/icosphere.h"
#include "tests/support/viewer_stage.h"

#include <doctest/doctest.h>

using namespace ramus;

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

    viewer.files().dropped(bad);
    stage.settle();
    CHECK(marks.context.size() == 1);
    CHECK(viewer.interface().notice.trouble);
    CHECK(viewer.interface().notice.text.find("bad.nii") != std::string::npos);

    viewer.actions().window->toggle("plan");
    viewer.files().dropped(ball);
    stage.settle();
    CHECK(marks.context.size() == 1);
    CHECK(marks.lesion_meshes == std::vector<std::string>{ball.string()});
    CHECK(stage.workspace.document.step_count() == 2);
}
