#include "app/actions/command_runner.h"
#include "app/tools/lasso.h"
#include "app/tools/pixel_polygon.h"
#include "app/tools/tool.h"
#include "tests/support/command_stage.h"
#include "tests/support/grown_tree.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <random>

using namespace ramus;
using namespace ramus::app;
using test::Ids;

namespace {

using Polygon = std::vector<glm::dvec2>;

// The even-odd rule as it is written down, over all edges.
bool inside_plainly(const Polygon& corners, glm::dvec2 p) {
    bool inside = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
        if ((corners[j].y > p.y) != (corners[i].y > p.y) &&
            p.x < (corners[i].x - corners[j].x) * (p.y - corners[j].y) / (corners[i].y - corners[j].y) + corners[j].x)
            inside = !inside;
    return inside;
}

std::vector<int> inside_plainly(const tree::VesselTree& tree, const render::Camera& camera, glm::ivec2 size,
                                const Polygon& corners, bool any_part) {
    std::vector<int> ids;
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const auto& points = tree.branches[id].points;
        double in = 0.0, all = 0.0;
        bool any = false;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const auto at = [&](std::size_t k) { return tree.points[points[k]].position; };
            double weight = 0.0;
            if (i > 0) weight += 0.5 * glm::distance(at(i - 1), at(i));
            if (i + 1 < points.size()) weight += 0.5 * glm::distance(at(i), at(i + 1));
            all += weight;
            const auto pixel = render::project(camera, size, at(i));
            if (!pixel || !inside_plainly(corners, glm::dvec2(*pixel))) continue;
            in += weight;
            any = true;
        }
        if (any_part ? any : any && 2.0 * in >= all) ids.push_back(static_cast<int>(id));
    }
    return ids;
}

Polygon scribble(std::mt19937& random, std::size_t corners, double width, double height) {
    std::uniform_real_distribution<double> x(-0.1 * width, 1.1 * width), y(-0.1 * height, 1.1 * height);
    Polygon polygon;
    for (std::size_t i = 0; i < corners; ++i) polygon.emplace_back(x(random), y(random));
    return polygon;
}

// A hand's stroke around a place: wavy, and closed by itself.
Polygon stroke(std::mt19937& random, glm::dvec2 centre, double radius, std::size_t corners) {
    std::uniform_real_distribution<double> wave(0.75, 1.25);
    Polygon polygon;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 6.283185307 * static_cast<double>(i) / static_cast<double>(corners);
        polygon.push_back(centre + radius * wave(random) * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return polygon;
}

// A straight vessel of two branches along x at z = 0, four segments of 10 mm and one; and one at z = 20 before it.
tree::VesselTree rods() {
    tree::VesselTree tree;
    for (int i = 0; i <= 4; ++i) tree.points.push_back({{10.0 * i, 0.0, 0.0}, 1.0});
    tree.points.push_back({{50.0, 0.0, 0.0}, 1.0});
    tree.points.push_back({{0.0, 30.0, 0.0}, 1.0}); // nearer to an anterior viewer
    tree.points.push_back({{40.0, 30.0, 0.0}, 1.0});
    tree.branches.resize(3);
    tree.branches[0].points = {0, 1, 2, 3, 4};
    tree.branches[0].children = {1};
    tree.branches[1].points = {4, 5};
    tree.branches[1].parent = 0;
    tree.branches[2].points = {6, 7};
    return tree;
}

} // namespace

TEST_CASE("a pixel is inside a polygon exactly when the plain even-odd loop says so" * doctest::test_suite("slow")) {
    std::mt19937 random(7);
    const auto agree = [&](const Polygon& corners, const std::vector<glm::dvec2>& points) {
        const PixelPolygon polygon(corners);
        std::size_t wrong = 0, inside = 0;
        for (const glm::dvec2& point : points) {
            wrong += polygon.contains(point) != inside_plainly(corners, point) ? 1 : 0;
            inside += polygon.contains(point) ? 1 : 0;
        }
        CHECK(wrong == 0);
        return inside;
    };
    // Everywhere, and where it is hard: on corners, at their heights, on edges, and a rounding away from all those.
    const auto trials = [&](const Polygon& corners) {
        std::vector<glm::dvec2> points = scribble(random, 500, 800.0, 600.0);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const glm::dvec2 a = corners[i], b = corners[(i + 1) % corners.size()];
            const glm::dvec2 middle = 0.5 * (a + b);
            for (const glm::dvec2& p : {a, middle, glm::dvec2(middle.x, a.y), glm::dvec2(-1e3, a.y)})
                for (const double x : {p.x, std::nextafter(p.x, -1e9), std::nextafter(p.x, 1e9)})
                    for (const double y : {p.y, std::nextafter(p.y, -1e9), std::nextafter(p.y, 1e9)})
                        points.emplace_back(x, y);
        }
        return points;
    };
    std::size_t inside = 0;
    for (const std::size_t corners : {3, 4, 5, 17, 100, 500})
        for (int i = 0; i < 10; ++i) {
            const Polygon crossing = scribble(random, corners, 800.0, 600.0);
            inside += agree(crossing, trials(crossing));
            Polygon whole = crossing; // corners on whole pixels share heights
            for (glm::dvec2& corner : whole) corner = glm::round(corner / 40.0) * 40.0;
            inside += agree(whole, trials(whole));
        }
    CHECK(inside > 10000);
    const double tiny = 1e-300, thin = std::nextafter(100.0, 200.0);
    for (const Polygon& degenerate :
         {Polygon{}, Polygon{{5, 5}}, Polygon{{5, 5}, {9, 9}}, Polygon{{5, 5}, {5, 5}, {5, 5}},
          Polygon{{0, 100}, {50, 100}, {100, 100}}, Polygon{{0, 0}, {50, 50}, {100, 100}},
          Polygon{{0, 100}, {50, thin}, {100, 100}}, Polygon{{0, 0}, {10, tiny}, {20, 0}},
          Polygon{{0, 0}, {100, 0}, {100, 100}, {0, 100}, {0, 0}}, Polygon{{0, 0}, {9, 9}, {9, 0}, {0, 9}, {9, 9}},
          Polygon{{-1e6, -1e6}, {1e6, -1e6}, {0, 1e6}}}) {
        if (!degenerate.empty())
            (void)agree(degenerate, trials(degenerate));
        else
            CHECK_FALSE(PixelPolygon(degenerate).contains({0, 0}));
    }
}

TEST_CASE("the runs of a row cover exactly the pixels inside the polygon") {
    std::mt19937 random(11);
    const Polygon corners = scribble(random, 40, 300.0, 200.0);
    const PixelPolygon polygon(corners);
    for (double y = -30.5; y < 240.0; y += 1.0) {
        const auto runs = polygon.spans(y);
        for (double x = -40.25; x < 340.0; x += 1.5) {
            bool in_run = false;
            for (const auto& [left, right] : runs) in_run = in_run || (x >= left && x < right);
            CHECK(in_run == polygon.contains({x, y}));
        }
    }
}

TEST_CASE("a simplified line stays near the line and keeps its ends") {
    std::mt19937 random(3);
    Polygon line = stroke(random, {200, 150}, 100.0, 400);
    const Polygon fewer = simplified(line, 2.0);
    CHECK(fewer.size() < line.size());
    CHECK(fewer.front() == line.front());
    CHECK(fewer.back() == line.back());
    for (const glm::dvec2& point : line) {
        double nearest = 1e9;
        for (std::size_t i = 0; i + 1 < fewer.size(); ++i) {
            const glm::dvec2 along = fewer[i + 1] - fewer[i];
            const double t = std::clamp(glm::dot(point - fewer[i], along) / glm::dot(along, along), 0.0, 1.0);
            nearest = std::min(nearest, glm::distance(point, fewer[i] + t * along));
        }
        CHECK(nearest <= 2.0 + 1e-9);
    }
}

TEST_CASE("a lasso takes branches with half of their length inside, or with any part inside") {
    const tree::VesselTree tree = rods();
    render::Camera camera;
    camera.position = {20.0, 500.0, 0.0};
    camera.focal_point = {20.0, 0.0, 0.0};
    camera.orthographic = true;
    camera.scale = 50.0; // 1 mm a pixel
    const glm::ivec2 size(100, 100);
    const auto x_of = [&](double x) { return render::project(camera, size, {x, 0.0, 0.0})->x; };
    const auto lassoed = [&](double from, double to, bool any, std::vector<std::uint8_t> hidden = {},
                             const render::BranchPicture* visible = nullptr) {
        const PixelPolygon polygon({{x_of(from), 40}, {x_of(to), 40}, {x_of(to), 60}, {x_of(from), 60}});
        return branches_inside(tree, camera, size, polygon, {any, visible}, hidden);
    };
    // Branch 0 has weights 5 10 10 10 5 at 0, 10, 20, 30 and 40 mm; 1 and 2 have two points each.
    CHECK(lassoed(-1, 11, false) == Ids{2});      // 15 of 40, one of two
    CHECK(lassoed(-1, 21, false) == Ids{0, 2});   // 25
    CHECK(lassoed(9, 21, false) == Ids{0});       // 20 of 40: just half
    CHECK(lassoed(-1, 1, true) == Ids{0, 2});     // an end of both
    CHECK(lassoed(11, 19, true).empty());         // between two points
    CHECK(lassoed(-1, 60, true) == Ids{0, 1, 2}); // backwards works as well:
    CHECK(lassoed(60, -1, true) == Ids{0, 1, 2});
    CHECK(lassoed(-1, 60, true, {0, 1}) == Ids{0, 2}); // what is hidden is never in

    // Seen: branch 2 before 0 up to 25 mm, then 0, and nothing of 1.
    render::BranchPicture picture{100, 100, std::vector<int>(10000, tree::kNoBranch)};
    for (int y = 45; y < 55; ++y)
        for (int x = 0; x < 100; ++x) {
            const double mm = 20.0 + (50.0 - x - 0.5) * (x_of(1.0) < x_of(0.0) ? 1.0 : -1.0);
            picture.branches[static_cast<std::size_t>(100 * y + x)] = mm < 25.0 ? 2 : mm < 45.0 ? 0 : -1;
        }
    CHECK(lassoed(-1, 60, false, {}, &picture) == Ids{0, 2});
    CHECK(lassoed(-1, 21, true, {}, &picture) == Ids{2});
    CHECK(lassoed(29, 31, false, {}, &picture) == Ids{0}); // 10 of the 15 that are seen
    CHECK(lassoed(39, 41, false, {}, &picture).empty());   // 5 of the 15

    camera.orthographic = false;
    camera.position = {20.0, -100.0, 0.0}; // everything lies behind
    camera.focal_point = {20.0, -200.0, 0.0};
    CHECK(branches_inside(tree, camera, size, PixelPolygon({{-1e6, -1e6}, {1e6, -1e6}, {1e6, 1e6}, {-1e6, 1e6}}),
                          {true, nullptr})
              .empty());
}

TEST_CASE("lassoing 30,000 branches takes exactly those that a plain count of centerline points takes" *
          doctest::test_suite("slow")) {
    const auto tree = test::grown_tree(30000);
    REQUIRE(tree);
    REQUIRE(tree->branches.size() >= 30000);
    render::Box box;
    for (const tree::Point& point : tree->points) box.include(point.position);
    const glm::ivec2 size(1600, 1200);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> x(300.0, 1300.0), y(200.0, 1000.0), radius(20.0, 400.0);
    std::size_t taken = 0;
    for (int i = 0; i < 6; ++i) {
        render::Camera camera = render::camera_for(box, render::kViews[static_cast<std::size_t>(i)], size, i % 2 == 1);
        if (i > 3) camera = render::zoomed(camera, 8.0); // among the branches: some are behind the camera
        for (const Polygon& corners :
             {stroke(random, {x(random), y(random)}, radius(random), 500), scribble(random, 60, 1600.0, 1200.0)})
            for (const bool any : {false, true}) {
                const auto ids = branches_inside(*tree, camera, size, PixelPolygon(corners), {any, nullptr});
                CHECK(ids == inside_plainly(*tree, camera, size, corners, any));
                taken += ids.size();
            }
    }
    CHECK(taken > 30000);
}

namespace {

struct LassoPicture final : test::TestPicture {
    Result<render::BranchPicture> branch_picture() override {
        return render::BranchPicture{100, 100, std::vector<int>(10000, 2)}; // branch 2 is before everything
    }
};

// The same, drawn elsewhere.
struct ComingPicture final : test::TestPicture {
    bool there = false;
    Deferred<Result<render::BranchPicture>> deferred_branch_picture() override {
        const auto take = []() -> Result<render::BranchPicture> {
            return render::BranchPicture{100, 100, std::vector<int>(10000, 2)};
        };
        return {[this] { return there; }, take};
    }
};

class TestTools final : public ToolHost {
public:
    void use_tool(std::string_view) override {}
    [[nodiscard]] std::string_view tool() const override { return "lasso"; }
    [[nodiscard]] ToolSettings& tool_settings() override { return settings; }
    ToolSettings settings;
};

// Seen from the front, 100 mm high.
Session open_rods(Document& document) {
    Session session;
    session.camera.position = {20.0, 500.0, 0.0};
    session.camera.focal_point = {20.0, 0.0, 0.0};
    session.camera.orthographic = true;
    session.camera.scale = 50.0;
    document.open(std::make_shared<const tree::VesselTree>(rods()), session);
    return session;
}

} // namespace

TEST_CASE("the lasso command selects, adds and removes, and refuses what it cannot read") {
    Document document;
    LassoPicture host;
    host.size = {100, 100};
    TestTools tools;
    const Session session = open_rods(document);
    Assets assets;
    ActionContext context{.document = document, .picture = host, .assets = assets, .tools = &tools};
    const auto run = [&](const std::string& line) -> std::string {
        const auto lines = parse_script(line, "c.txt");
        REQUIRE(lines);
        const auto done = run_script(context, *lines, "c.txt");
        return done ? "" : done.error().message();
    };
    const auto around = [&](double from, double to) {
        const auto at = [&](double x) {
            return std::to_string(render::project(session.camera, {100, 100}, {x, 0.0, 0.0})->x);
        };
        return at(from) + ",40 " + at(to) + ",40 " + at(to) + ",60 " + at(from) + ",60";
    };
    CHECK(run("lasso " + around(-1, 60)).empty());
    CHECK(document.marks().selection == Ids{0, 1, 2});
    CHECK(run("lasso --remove " + around(45, 60)).empty());
    CHECK(document.marks().selection == Ids{0, 2});
    CHECK(run("select 1\nlasso --add --any " + around(-1, 1)).empty());
    CHECK(document.marks().selection == Ids{0, 1, 2});
    CHECK(run("lasso --visible " + around(-1, 60)).empty());
    CHECK(document.marks().selection == Ids{2});
    CHECK(run("hide\nlasso " + around(-1, 60)).empty());
    CHECK(document.marks().selection == Ids{0, 1});
    CHECK(run("undo\nundo\nundo").empty());
    CHECK(document.marks().selection == Ids{0, 1, 2});
    CHECK(run("lasso 80,1 90,1 85,9").empty()); // nothing is there
    CHECK(document.marks().selection.empty());

    CHECK(run("select 1").empty());
    CHECK(run("lasso 1,1 2,2").starts_with("c.txt:1: lasso takes at least three corners"));
    CHECK(run("lasso 1,1 2,2 3").starts_with("c.txt:1: \"3\" is not a pixel"));
    CHECK(run("lasso 1,1 2,2 3,nan").starts_with("c.txt:1: \"3,nan\" is not a pixel"));
    CHECK(run("lasso 1,1 2,2 3,inf").starts_with("c.txt:1: \"3,inf\" is not a pixel"));
    CHECK(run("lasso --some 1,1 2,2 3,3").starts_with("c.txt:1: lasso has no option --some"));
    CHECK(run("lasso --add --remove 1,1 2,2 3,3").starts_with("c.txt:1: lasso adds or removes, not both"));
    CHECK(document.marks().selection == Ids{1});

    CHECK(run("lasso-mode any\nlasso-depth visible").empty());
    CHECK(tools.settings.lasso_any_part);
    CHECK(tools.settings.lasso_visible);
    CHECK(run("lasso-mode half\nlasso-depth through").empty());
    CHECK_FALSE(tools.settings.lasso_any_part);
    CHECK_FALSE(tools.settings.lasso_visible);
    CHECK(run("lasso-mode some").starts_with("c.txt:1: lasso-mode is half or any"));
}

TEST_CASE("a lasso of visible branches waits for the picture, and uses the view in which it was drawn") {
    Document document;
    ComingPicture host;
    host.size = {100, 100};
    const Session session = open_rods(document);
    Assets assets;
    ActionContext context{.document = document, .picture = host, .assets = assets};
    CommandRunner runner({});
    const std::vector<std::string> around{"lasso", "--visible", "0,0", "100,0", "100,100", "0,100"};
    REQUIRE(runner.run(context, around));
    REQUIRE(runner.run(context, std::vector<std::string>{"hide"}));
    render::Camera away = session.camera;
    away.position.x += 1000.0;
    away.focal_point.x += 1000.0;
    document.set_camera(away);
    CHECK(runner.update(context).empty());
    CHECK(document.marks().selection.empty());
    host.there = true;
    CHECK(runner.update(context).empty());
    CHECK(document.marks().selection == Ids{2});
    CHECK(branches_in_state(document.marks(), tree::BranchState::kHidden) == Ids{2});
}
