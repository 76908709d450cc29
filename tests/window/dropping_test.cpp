// Files that are dropped on the window: read on a worker, then context, or a lesion for who plans.
#include "app/window/viewer.h"
#include "core/io/meshes/mesh_file.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/icosphere.h"
#include "tests/support/temporary_folder.h"

#include <doctest/doctest.h>
#include <fstream>
#include <imgui.h>
#include <thread>

using namespace ramus;

TEST_CASE("a mesh that is dropped on the window is context, or a lesion for who plans; a bad one is named") {
    const TemporaryFolder folder;
    const auto file = folder.path() / "tree.swc", ball = folder.path() / "ball.stl", bad = folder.path() / "bad.nii";
    std::ofstream(file) << "1 1 0 0 -20 3 -1\n2 1 0 0 0 2.5 1\n3 1 -15 3 12 1.5 2\n4 1 14 -2 15 1.2 2\n";
    std::ofstream(bad) << "nothing";
    auto mesh = test::icosphere(3, {0, 0, 0}, 9.0);
    mesh.radii.resize(mesh.positions.size(), 1.0F);
    mesh.branches.resize(mesh.positions.size(), 0);
    REQUIRE(io::write_mesh(mesh, ball));

    const test::WatchedContext context;
    struct Imgui {
        Imgui() { ImGui::CreateContext(); }
        ~Imgui() { ImGui::DestroyContext(); }
    } const imgui;
    app::Workspace workspace({});
    workspace.open(file);
    auto renderer = render::Renderer::create();
    REQUIRE(renderer);
    const glm::ivec2 size(700, 500);
    const render::Target target(size.x, size.y);
    auto made = app::Viewer::create(workspace, **renderer, 1.0F);
    REQUIRE(made);
    app::Viewer& viewer = **made;
    viewer.resize(size, 1.0F);
    double now = 0.0;
    const auto settle = [&] {
        for (int i = 0; i < 4000 && (i < 5 || !viewer.resting() || !workspace.surface_ready()); ++i) {
            viewer.draw(now += 0.05, target.framebuffer());
            if (workspace.busy()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        }
        return target.read_image();
    };
    const render::Image before = settle();
    viewer.files().use_settings({}); // a person's window: commands do not wait
    const app::Marks& marks = workspace.document.marks();

    viewer.files().dropped(ball);
    CHECK(marks.context.empty()); // not yet: it is being read
    CHECK(viewer.commands().busy());
    const render::Image with = settle();
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
    settle();
    CHECK(marks.context.size() == 1);
    CHECK(viewer.interface().notice.trouble);
    CHECK(viewer.interface().notice.text.find("bad.nii") != std::string::npos);

    viewer.actions().window->toggle("plan");
    viewer.files().dropped(ball);
    settle();
    CHECK(marks.context.size() == 1);
    CHECK(marks.lesion_meshes == std::vector<std::string>{ball.string()});
    CHECK(workspace.document.step_count() == 2);
}
