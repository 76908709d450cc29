// Pages of a surface, and a copy on the graphics card that follows them.
#include "core/field/vessel_field.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "render/gl/gl_context.h"
#include "render/image/image.h"
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/grown_tree.h"
#include "tests/support/tree_field.h"
#include "tests/support/tube_mesh.h"

#include <algorithm>
#include <chrono>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <thread>
#include <vector>

using namespace ramus;
using namespace ramus::render;

namespace {

// A surface that branches come and go from, and what a viewer sees of it.
struct Explorer {
    tree::VesselTree tree = test::grown_tree(300).value();
    mesh::Polygonizer polygonizer;
    std::shared_ptr<const PagedMesh> mesh;
    ramus::test::WatchedContext context;
    std::unique_ptr<Renderer> renderer = Renderer::create().value();
    Frame frame;

    Explorer() {
        update({});
        frame.size = {320, 240};
        frame.camera = camera_for(mesh->positions(), View::kAnterior, frame.size);
        frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    }
    ~Explorer() { renderer.reset(); }
    void update(const std::vector<std::uint8_t>& hidden) {
        Job job;
        REQUIRE(polygonizer.update(test::make_field(tree, {}, hidden), {}, job));
        const mesh::SurfaceEdit edit = polygonizer.take_edit();
        mesh = std::make_shared<const PagedMesh>(mesh ? mesh->edited(polygonizer.slots(), edit)
                                                      : PagedMesh(polygonizer.slots()));
        frame.mesh = mesh;
    }
    [[nodiscard]] std::vector<std::uint8_t> without_subtree(int branch) const {
        std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
        for (const int below : tree::subtree(tree, branch)) hidden[static_cast<std::size_t>(below)] = 1;
        return hidden;
    }
    // What a renderer that has never seen this tree makes of the surface without gaps.
    [[nodiscard]] Image from_nothing() const {
        Frame fresh = frame;
        fresh.mesh = std::make_shared<const PagedMesh>(polygonizer.compact(), mesh->origin());
        CHECK(fresh.mesh->bounds() == mesh->bounds());
        CHECK(fresh.mesh->triangle_count() == mesh->triangle_count());
        const auto other = Renderer::create().value();
        REQUIRE(other->draw(fresh));
        return other->read_image();
    }
};

} // namespace

TEST_CASE("after hiding and showing, the picture is the one of a mesh made from nothing" *
          doctest::test_suite("slow")) {
    Explorer explorer;
    const auto whole = explorer.renderer->draw(explorer.frame).value();
    CHECK(explorer.renderer->read_image() == explorer.from_nothing());
    for (const int branch : {280, 150, 40}) {
        for (const bool hide : {true, false}) {
            explorer.update(hide ? explorer.without_subtree(branch) : std::vector<std::uint8_t>{});
            const auto done = explorer.renderer->draw(explorer.frame).value();
            CHECK(done.geometry);
            CHECK_FALSE(done.pending);
            CHECK(explorer.renderer->read_image() == explorer.from_nothing());
            if (branch == 280) CHECK(4 * done.uploaded < whole.uploaded);
        }
    }
}

TEST_CASE("where the processor draws, the pages of a large mesh are shared, and what is written to them is the card's" *
          doctest::test_suite("slow")) {
    Explorer explorer;
    explorer.tree = test::grown_tree(1500).value();
    explorer.polygonizer = {};
    explorer.mesh = nullptr;
    explorer.update({});
    const auto before = explorer.mesh;
    REQUIRE(before->memory() != nullptr); // large enough
    explorer.frame.camera =
        camera_for(before->farthest(fitting_directions({}, explorer.frame.size)), View::kAnterior, explorer.frame.size);
    const auto whole = explorer.renderer->draw(explorer.frame, 1).value();
    CHECK(whole.uploaded == 0); // nothing is sent
    CHECK_FALSE(whole.pending);

    // The same pages, each for itself.
    const PagedMesh apart = PagedMesh(mesh::TriangleMesh(), before->origin()).edited(explorer.polygonizer.slots(), [&] {
        mesh::SurfaceEdit edit;
        edit.vertices = {{0, explorer.polygonizer.slots().positions.size()}};
        edit.triangles = {{0, explorer.polygonizer.slots().triangles.size()}};
        return edit;
    }());
    REQUIRE(apart.memory() == nullptr);
    CHECK(apart.bytes_beside(*before) > PagedMesh::kSharedFrom);
    const Image shared = explorer.renderer->read_image();
    Frame sent = explorer.frame;
    sent.mesh = std::make_shared<const PagedMesh>(apart);
    const auto other = Renderer::create().value();
    CHECK(other->draw(sent).value().uploaded == apart.bytes_beside(*before));
    CHECK(other->read_image() == shared);

    explorer.update(explorer.without_subtree(700));
    const std::size_t differs = explorer.mesh->bytes_beside(*before);
    CHECK(differs > 0);
    CHECK(4 * differs < apart.bytes_beside(*before));
    const auto less = explorer.renderer->draw(explorer.frame).value();
    CHECK(less.uploaded == differs);
    CHECK(explorer.renderer->read_image() == explorer.from_nothing());

    // The mesh before is what it was.
    const auto same = [](const GpuVertex& a, const GpuVertex& b) {
        return a.position == b.position && a.branch == b.branch && a.dominance == b.dominance && a.normal == b.normal;
    };
    for (std::size_t page = 0; page < apart.vertex_pages().size(); ++page)
        REQUIRE(std::ranges::equal(apart.vertex_pages()[page]->vertices, before->vertex_pages()[page]->vertices, same));
    for (std::size_t page = 0; page < apart.triangle_pages().size(); ++page)
        REQUIRE(std::ranges::equal(apart.triangle_pages()[page]->triangles, before->triangle_pages()[page]->triangles));
    explorer.update({});
    (void)explorer.renderer->draw(explorer.frame).value();
    CHECK(explorer.renderer->read_image() == explorer.from_nothing());

    // Once much of it lies elsewhere, all pages lie side by side again.
    std::vector<std::uint8_t> half(explorer.tree.branches.size(), 0);
    std::fill(half.begin() + static_cast<std::ptrdiff_t>(half.size() / 2), half.end(), 1);
    explorer.update(half);
    const auto& memory = explorer.mesh->memory();
    REQUIRE(memory != nullptr);
    CHECK(memory != before->memory());
    for (std::size_t page = 0; page < explorer.mesh->vertex_pages().size(); ++page)
        REQUIRE(explorer.mesh->vertex_pages()[page].get() == memory->vertex_page(page));
    CHECK(explorer.renderer->draw(explorer.frame, 1).value().uploaded == 0);
    CHECK(explorer.renderer->read_image() == explorer.from_nothing());
}

TEST_CASE("a large mesh comes over several frames, and the one before is drawn until it is there" *
          doctest::test_suite("slow")) {
    Explorer explorer;
    REQUIRE(explorer.renderer->draw(explorer.frame));
    const Image before = explorer.renderer->read_image();
    explorer.update(explorer.without_subtree(20));
    const std::size_t budget = 200'000;
    int frames = 0;
    DrawStatistics done;
    for (; frames < 1000; ++frames) {
        done = explorer.renderer->draw(explorer.frame, budget).value();
        CHECK(done.uploaded < budget + sizeof(VertexPage));
        if (!done.pending) break;
        CHECK_FALSE(done.shaded);
        CHECK(explorer.renderer->read_image() == before);
    }
    CHECK(frames > 2);
    CHECK(explorer.renderer->read_image() == explorer.from_nothing());
    // Changing one's mind half-way.
    const auto without = explorer.mesh;
    explorer.update({});
    REQUIRE(explorer.renderer->draw(explorer.frame, budget));
    explorer.frame.mesh = without;
    const auto back = explorer.renderer->draw(explorer.frame, budget).value();
    CHECK_FALSE(back.pending);
    CHECK_FALSE(back.shaded);
}

TEST_CASE("another tree leaves nothing of the one before while it comes" * doctest::test_suite("slow")) {
    Explorer explorer;
    REQUIRE(explorer.renderer->draw(explorer.frame));
    mesh::TriangleMesh tube;
    test::add_capsule(tube, {1000, 0, 0}, {1000, 0, 50}, 5.0F, 5.0F, 7, 96);
    explorer.frame.mesh = std::make_shared<const PagedMesh>(tube);
    explorer.frame.camera = camera_for(explorer.frame.mesh->positions(), View::kAnterior, explorer.frame.size);
    auto done = explorer.renderer->draw(explorer.frame, 1).value();
    CHECK(done.pending);
    CHECK(explorer.renderer->pick(160, 120).branch == kNoBranch);
    for (int i = 0; i < 100 && done.pending; ++i) done = explorer.renderer->draw(explorer.frame, 1).value();
    CHECK(explorer.renderer->pick(160, 120).branch == 7);
}

TEST_CASE("the preview stands in while the view moves, and only then" * doctest::test_suite("slow")) {
    Explorer explorer;
    mesh::TriangleMesh tube;
    test::add_capsule(tube, {0, 0, -50}, {0, 0, 50}, 5.0F, 5.0F, 7);
    explorer.frame.preview = std::make_shared<const PagedMesh>(tube, explorer.mesh->origin());
    auto done = explorer.renderer->draw(explorer.frame).value();
    CHECK(done.triangles == explorer.mesh->triangle_count());
    const Image full = explorer.renderer->read_image();
    explorer.frame.quality = Quality::kInteractive;
    done = explorer.renderer->draw(explorer.frame).value();
    CHECK(done.triangles == tube.triangles.size());
    explorer.frame.quality = Quality::kFull;
    REQUIRE(explorer.renderer->draw(explorer.frame));
    CHECK(explorer.renderer->read_image() == full);
    explorer.frame.preview = nullptr; // it is not looked at
    CHECK_FALSE(explorer.renderer->draw(explorer.frame)->shaded);
}

TEST_CASE("what no triangle uses influences nothing") {
    mesh::TriangleMesh tube;
    test::add_capsule(tube, {0, 0, 0}, {0, 0, 50}, 5.0F, 5.0F, 2);
    const PagedMesh plain(tube);
    mesh::TriangleMesh gappy = tube;
    gappy.positions.emplace_back(1e6F, 0.0F, 0.0F);
    gappy.normals.emplace_back(1.0F, 0.0F, 0.0F);
    gappy.radii.push_back(1.0F);
    gappy.branches.push_back(99);
    gappy.triangles.insert(gappy.triangles.begin() + 5, 3, glm::uvec3(0));
    const PagedMesh gaps(gappy, plain.origin());
    CHECK(gaps.bounds() == plain.bounds());
    CHECK(gaps.triangle_count() == plain.triangle_count());
    CHECK(gaps.branch_count() == 3);
    CHECK(gaps.positions() == plain.positions());
    CHECK(gaps.positions([](int branch) { return branch != 2; }).empty());
}

// Of linear functions: a camera that is fitted to the few points is the one that is fitted to all of them.
TEST_CASE("the farthest positions of a surface are all that a camera is fitted to, with and without hidden branches" *
          doctest::test_suite("slow")) {
    Explorer explorer;
    const PagedMesh& mesh = *explorer.mesh;
    const glm::ivec2 size(300, 200);
    for (const int hidden : {tree::kNoBranch, 0, 3, 40}) {
        const auto wanted = [&](int branch) { return branch != hidden; };
        for (const View view : kViews)
            for (const bool orthographic : {false, true}) {
                const Camera from = looking({.orthographic = orthographic}, view);
                const auto few = mesh.farthest(fitting_directions(from, size), wanted);
                CHECK(few.size() <= fitting_directions(from, size).size());
                const Camera by_few = fitted(from, few, size), by_all = fitted(from, mesh.positions(wanted), size);
                // The same numbers in another order of sums: apart by rounding.
                CHECK(glm::distance(by_few.position, by_all.position) < 1e-9);
                CHECK(glm::distance(by_few.focal_point, by_all.focal_point) < 1e-9);
                CHECK(by_few.scale == doctest::Approx(by_all.scale).epsilon(1e-12));
            }
    }
    CHECK(mesh.farthest(std::vector{glm::dvec3(1, 0, 0)}, [](int) { return false; }).empty());
}

TEST_CASE("a surface that nobody has any more is given back: a small one at once, a large one soon") {
    for (const int around : {8, 1424}) {
        CAPTURE(around);
        mesh::TriangleMesh mesh;
        test::add_capsule(mesh, {0, 0, 0}, {5, 0, 0}, 1, 1, 0, around);
        const bool large = mesh.triangles.size() > 2'000'000;
        CHECK(large == (around > 8));
        auto surface = shared(PagedMesh(mesh));
        CHECK(surface->triangle_count() == mesh.triangles.size());
        const std::weak_ptr<const TrianglePage> page = surface->triangle_pages().back();
        auto other = surface;
        surface.reset();
        CHECK_FALSE(page.expired());
        other.reset();
        for (int waits = 0; waits < 10'000 && large && !page.expired(); ++waits)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        CHECK(page.expired());
    }
}
