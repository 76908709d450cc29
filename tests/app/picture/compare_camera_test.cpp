// Viewports are narrower than the picture: what comparing does to the camera, and how undo takes that back.
#include "app/picture/compose_sheet.h"
#include "app/picture/fit.h"
#include "app/workspace/surface_maker.h"
#include "core/tree/build_tree.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

// Points along three vessels of a plane that two axes span.
tree::VesselTree flat_tree(int first, int second) {
    tree::VesselTree tree;
    for (int i = 0; i < 30; ++i) {
        tree::Point& point = tree.points.emplace_back();
        point.radius = 0.5;
        point.position = glm::dvec3(0.0);
        point.position[first] = 2.0 * i;
        point.position[second] = 1.5 * (i % 3) * i;
    }
    return tree;
}

// A picture of 800 x 400 with viewports, as windows and files have them.
struct ViewportPicture final : test::TestPicture {
    explicit ViewportPicture(const Document& of) : document(of) {}
    [[nodiscard]] glm::ivec2 picture_size() const override {
        return viewports_of(document.session(), {800, 400}, 1.0F).front().size;
    }
    const Document& document;
};

// A vessel of 60 mm from right to left: wide pictures show it larger than narrow ones.
struct CameraStage {
    CameraStage() {
        tree::Graph graph;
        graph.points = {{{-30, 0, 0}, 2.0}, {{0, 0, 0}, 2.0}, {{30, 0, 5}, 1.0}, {{30, 0, -5}, 1.0}};
        graph.edges = {{0, 1}, {1, 2}, {1, 3}};
        graph.roots = {0};
        auto tree = tree::build_tree(std::move(graph), tree::Repair::kAll, [](std::uint32_t) { return std::string(); });
        REQUIRE(tree);
        document.open(std::make_shared<const tree::VesselTree>(std::move(*tree)), {});
        Job job;
        const auto surface = make_ready(*document.tree(), surface_request(document.marks()), job);
        REQUIRE(surface);
        host.mesh = surface->mesh;
        run("view anterior");
        host.leaps = 0;
    }
    void run(std::string_view text) {
        const auto lines = parse_script(text, "c.txt");
        REQUIRE(lines);
        Assets assets;
        ActionContext context{document, host, assets};
        const auto done = run_script(context, *lines, "c.txt");
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message()));
    }
    [[nodiscard]] const render::Camera& camera() const { return document.session().camera; }
    Document document;
    ViewportPicture host{document};
};

double distance(const render::Camera& camera) { return glm::distance(camera.position, camera.focal_point); }

} // namespace

TEST_CASE("the first view of a flat tree faces its largest side, of any other tree its front") {
    CHECK(opening_view(flat_tree(0, 1)) == render::View::kSuperior);
    CHECK(opening_view(flat_tree(0, 2)) == render::View::kAnterior);
    CHECK(opening_view(flat_tree(1, 2)) == render::View::kLeft);
    CHECK(opening_view(flat_tree(2, 2)) == render::View::kAnterior); // one vessel has no side
    tree::VesselTree deep = flat_tree(0, 1);
    deep.points.push_back({{0.0, 0.0, 10.0}, 0.5});
    CHECK(opening_view(deep) == render::View::kAnterior);
}

TEST_CASE("fit includes objects next to the tree") {
    CameraStage stage;
    const auto in_picture = [&](const glm::dvec3& point) {
        const auto at = render::project(stage.camera(), stage.host.picture_size(), point);
        return at && at->x >= 0.0 && at->y >= 0.0 && at->x <= 800.0 && at->y <= 400.0;
    };
    CHECK_FALSE(in_picture({0, 0, 90}));
    stage.run("lesion 0,0,80,10\nfit");
    for (const glm::dvec3& edge : {glm::dvec3(0, 0, 90), {10, 0, 80}, {-10, 0, 80}, {-30, 0, 0}, {30, 0, 0}})
        CHECK(in_picture(edge));
    // And no more than that.
    CHECK_FALSE(in_picture({0, 0, 120}));
}

TEST_CASE("undo restores the camera from before a comparison exactly, and redo restores that of the comparison") {
    CameraStage stage;
    const render::Camera whole = stage.camera();
    stage.run("compare side-by-side");
    const render::Camera halves = stage.camera();
    // It was as wide as the picture, and is as wide as a viewport of half of it.
    CHECK(distance(halves) > 1.8 * distance(whole));
    CHECK(stage.document.step_count() == 1);
    CHECK(stage.host.leaps == 1);
    stage.run("undo");
    CHECK(stage.camera() == whole);
    CHECK(stage.host.leaps == 2); // the eye is led there
    stage.run("redo");
    CHECK(stage.camera() == halves);
    CHECK(stage.host.leaps == 3);

    stage.run("select 1\ncompare side-by-side cs,cones,iso");
    const render::Camera thirds = stage.camera();
    CHECK(distance(thirds) > 1.3 * distance(halves));
    stage.run("compare off");
    CHECK(distance(stage.camera()) < 1.01 * distance(whole));
    stage.run("undo 4");
    CHECK(stage.camera() == whole);
    CHECK(stage.document.marks() == Marks{});
    stage.run("redo 3");
    CHECK(stage.camera() == thirds);
}

TEST_CASE("undo does not move a camera that the comparison did not move, or that the user moved since") {
    CameraStage stage;
    const render::Camera whole = stage.camera();
    SUBCASE("blended surfaces have the whole picture") {
        stage.run("compare blend\ncompare superimposed");
        CHECK(stage.camera() == whole);
        stage.run("view left\nundo");
        const render::Camera left = stage.camera();
        stage.run("undo\nredo 2");
        CHECK(stage.camera() == left);
    }
    SUBCASE("somebody looks at a part of it") {
        stage.document.set_camera(render::zoomed(whole, 8.0));
        const render::Camera close = stage.camera();
        REQUIRE(distance(close) < distance(whole));
        stage.run("compare side-by-side");
        CHECK(stage.camera() == close);
        stage.run("undo");
        CHECK(stage.camera() == close);
    }
    SUBCASE("somebody has turned it") {
        stage.run("compare side-by-side");
        stage.document.set_camera(render::turned(stage.camera(), 30.0, 0.0));
        const render::Camera turned = stage.camera();
        stage.run("undo");
        CHECK(stage.camera() == turned);
        stage.run("redo");
        CHECK(stage.camera() == turned);
    }
    SUBCASE("other commands do not move it") {
        stage.run("select 1\nview left\nhide\nview superior");
        const render::Camera superior = stage.camera();
        stage.run("undo 2");
        CHECK(stage.camera() == superior);
        stage.run("redo 2");
        CHECK(stage.camera() == superior);
    }
}
