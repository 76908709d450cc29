// The window's surface: what it shows on the way, and that it ends where a surface made from nothing ends.
#include "app/workspace/surface_maker.h"
#include "core/mesh/surface.h"
#include "tests/support/grown_tree.h"
#include "tests/support/packed_trees.h"

#include <algorithm>
#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

struct Shop {
    explicit Shop(tree::VesselTree of = test::grown_tree(400).value())
        : tree(std::make_shared<const tree::VesselTree>(std::move(of))), maker(tree) {}

    std::shared_ptr<const tree::VesselTree> tree;
    SurfaceMaker maker;
    std::vector<ReadySurface> shown;

    void make(const SurfaceRequest& request) {
        shown.clear();
        Job job;
        do {
            auto made = maker.next(request, job);
            REQUIRE(made);
            shown.push_back(std::move(*made));
        } while (shown.back().provisional || shown.back().preview_follows);
        for (const ReadySurface& surface : shown) CHECK(surface.request == request);
    }
};

std::vector<glm::vec3> sorted_positions(const render::PagedMesh& mesh) {
    auto positions = mesh.positions();
    std::ranges::sort(positions, [](const glm::vec3& a, const glm::vec3& b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    });
    return positions;
}

void check_same(const render::PagedMesh& mesh, const render::PagedMesh& other) {
    CHECK(mesh.triangle_count() == other.triangle_count());
    CHECK(mesh.bounds() == other.bounds());
    CHECK(mesh.origin() == other.origin());
    CHECK(sorted_positions(mesh) == sorted_positions(other));
}

} // namespace

TEST_CASE("the preview comes first, and the final surface equals one computed from scratch" *
          doctest::test_suite("slow")) {
    Shop shop;
    SurfaceRequest request;
    shop.make(request);
    REQUIRE(shop.shown.size() == 2);
    CHECK(shop.shown[0].provisional);
    CHECK_FALSE(shop.shown[1].provisional);
    CHECK(2 * shop.shown[0].mesh->triangle_count() < shop.shown[1].mesh->triangle_count());
    CHECK(shop.shown[1].preview == shop.shown[0].mesh);
    Job job;
    check_same(*shop.shown[1].mesh, *make_ready(*shop.tree, request, job)->mesh);
}

TEST_CASE("false loops are cut in the window's surface too, whichever branches are hidden before and after" *
          doctest::test_suite("slow")) {
    Shop shop(test::packed_trees(25));
    SurfaceRequest request;
    const int last = static_cast<int>(shop.tree->branches.size()) - 1;
    for (const std::vector<int>& hidden : {std::vector<int>{}, {last}, {}, {34}}) {
        request.hidden = hidden;
        shop.make(request);
        Job job;
        const auto flags = hidden_flags(hidden, shop.tree->branches.size());
        const auto made = mesh::make_surface(*shop.tree, as_drawn(request.options), job, flags);
        REQUIRE(made);
        CHECK((made->statistics.matched.false_loops.cut > 0) ==
              (hidden != std::vector<int>{34})); // the vessel that threads a fork
        check_same(*shop.shown.back().mesh, *paged(made->mesh, *shop.tree));
    }
}

TEST_CASE("hiding and showing branches updates the surface page by page" * doctest::test_suite("slow")) {
    Shop shop;
    SurfaceRequest request;
    shop.make(request);
    const auto all = shop.shown.back().mesh;
    request.hidden = tree::subtree(*shop.tree, 350);
    std::ranges::sort(request.hidden);
    shop.make(request);
    const ReadySurface without = shop.shown.back();
    CHECK_FALSE(shop.shown.front().provisional); // a small change: no preview in its place
    CHECK(without.preview);
    Job job;
    check_same(*without.mesh, *make_ready(*shop.tree, request, job)->mesh);
    CHECK(without.mesh->positions([&](int b) { return std::ranges::binary_search(request.hidden, b); }).empty());
    std::size_t changed = 0;
    for (std::size_t i = 0; i < without.mesh->triangle_pages().size(); ++i)
        changed += i >= all->triangle_pages().size() || without.mesh->triangle_pages()[i] != all->triangle_pages()[i];
    CHECK(changed > 0);
    CHECK(4 * changed < all->triangle_pages().size());

    request.hidden.clear();
    shop.make(request);
    check_same(*shop.shown.back().mesh, *all);

    request.hidden.resize(shop.tree->branches.size());
    for (std::size_t b = 0; b < request.hidden.size(); ++b) request.hidden[b] = static_cast<int>(b);
    shop.make(request);
    CHECK(shop.shown.back().mesh->triangle_count() == 0);
    request.hidden = {3};
    shop.make(request);
    check_same(*shop.shown.back().mesh, *make_ready(*shop.tree, request, job)->mesh);
}

TEST_CASE("a cancelled surface does not affect the next one" * doctest::test_suite("slow")) {
    Shop shop;
    SurfaceRequest request;
    shop.make(request);
    request.options.width = 3.0;
    Job cancelled;
    cancelled.cancel();
    CHECK_FALSE(shop.maker.next(request, cancelled));
    request.hidden = {1};
    shop.make(request);
    Job job;
    check_same(*shop.shown.back().mesh, *make_ready(*shop.tree, request, job)->mesh);
    request.options.method = mesh::Method::kTruncatedCones;
    shop.make(request);
    CHECK(shop.shown.back().mesh->positions([](int b) { return b == 1; }).empty());
}

TEST_CASE("the surface of an edited tree is computed even if no cones can be shown before" *
          doctest::test_suite("slow")) {
    tree::Graph graph; // a vessel so long that its preview comes after cones were given up
    for (std::uint32_t i = 0; i <= 50; ++i) {
        graph.points.push_back({{0.0, 0.0, 400.0 * i}, 0.5});
        if (i > 0) graph.edges.emplace_back(i - 1, i);
    }
    graph.roots = {0};
    Shop shop(tree::build_tree(std::move(graph), tree::Repair::kUsual, [](auto) { return std::string(); }).value());
    const auto& tree = shop.tree;
    SurfaceRequest request;
    request.options.detail = 20'000; // cones of so many sides have more vertices than can be numbered
    request.options.cell_mm = 0.4;   // and are nothing to the surface
    request.options.threads = 1;
    SurfaceFollower follower({});
    Job job;
    REQUIRE_FALSE(first_cones(*tree, request, job));
    follower.change_tree(tree, request);
    CHECK(follower.between_trees());
    bool waited = true; // for whatever is to be shown
    while (follower.worker().busy() || follower.awaited(request)) {
        follower.drain();
        waited = waited && (follower.shown().mesh || follower.between_trees());
        follower.follow(request, false);
    }
    CHECK(waited);
    CHECK(follower.problem().empty());
    REQUIRE(follower.shown().mesh);
    CHECK_FALSE(follower.shown().provisional);
    CHECK(follower.shown().request == request);
}
