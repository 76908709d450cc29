// Commands that move the camera to a branch and along the vessels, and those for names and the overview.
#include "app/actions/command_table.h"
#include "app/actions/script.h"
#include "app/assets/assets.h"
#include "tests/support/grown_tree.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <map>

using namespace ramus;
using namespace ramus::app;

namespace {

class TestHost final : public PictureHost, public WindowHost {
public:
    [[nodiscard]] glm::ivec2 picture_size() const override { return {400, 300}; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return nullptr; }
    Result<void> write_picture(const std::filesystem::path&) override { return {}; }
    void camera_leapt() override { ++moves; }
    void flew(int branch, double fraction) override { flown = {branch, fraction}; }
    void toggle(std::string_view part) override {
        if (!parts.erase(std::string(part))) parts[std::string(part)] = "";
    }
    void set_overview(std::string_view setting) override { parts["overview"] = setting; }
    void open_flight(int branch) override { parts["fly-along"] = std::to_string(branch); }
    void close_flight() override { parts.erase("fly-along"); }
    void ask_for_name(int branch) override { parts["name"] = std::to_string(branch); }
    void ask_for_radius() override { parts["radius"] = "asked"; }
    bool dismiss() override { return false; }
    void set_ui_scale(double) override {}
    [[nodiscard]] double ui_scale() const override { return 1.0; }
    void set_light_theme(bool) override {}
    [[nodiscard]] bool light_theme() const override { return false; }
    void set_ground(app::Ground) override {}
    [[nodiscard]] app::Ground ground() const override { return app::Ground::kDark; }
    [[nodiscard]] bool shows(std::string_view part) const override { return parts.contains(std::string(part)); }
    int moves = 0;
    std::pair<int, double> flown{-1, -1.0};
    std::map<std::string, std::string> parts;
};

struct TravelStage {
    Document document;
    TestHost host;
    Assets assets;
    ActionContext context{.document = document, .picture = host, .assets = assets, .window = &host};
    TravelStage() {
        auto tree = test::grown_tree(120);
        REQUIRE(tree);
        document.open(std::make_shared<const tree::VesselTree>(std::move(*tree)), {});
    }
    Result<void> run(std::string_view text) {
        const auto lines = parse_script(text, "c.txt");
        return lines ? run_script(context, *lines, "c.txt") : tl::unexpected(lines.error());
    }
    void good(std::string_view text) {
        const auto done = run(text);
        REQUIRE_MESSAGE(done, (done ? "" : done.error().message()));
    }
    [[nodiscard]] const render::Camera& camera() const { return document.session().camera; }
};

} // namespace

TEST_CASE("centre moves the middle of a branch to the middle of the picture, without a step of undo") {
    TravelStage stage;
    const render::Camera before = stage.camera();
    stage.good("centre 17");
    CHECK(stage.host.moves == 1);
    CHECK_FALSE(stage.document.can_undo());
    const tree::VesselTree& tree = *stage.document.tree();
    double nearest = 1e9;
    const auto& points = tree.branches[17].points;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 a = tree.points[points[i - 1]].position;
        const glm::dvec3 b = tree.points[points[i]].position;
        const double t = glm::clamp(glm::dot(stage.camera().focal_point - a, b - a) / glm::dot(b - a, b - a), 0.0, 1.0);
        nearest = std::min(nearest, glm::distance(stage.camera().focal_point, a + t * (b - a)));
    }
    CHECK(nearest < 1e-9);
    const glm::dvec3 direction = before.focal_point - before.position;
    CHECK(glm::distance(stage.camera().focal_point - stage.camera().position, direction) < 1e-9);
    const glm::dvec3 centred = stage.camera().position;
    stage.good("go-to 3\ngo-to 17");
    CHECK(glm::distance(stage.camera().position, centred) < 1e-9);
    const render::Camera there = stage.camera();
    for (const char* wrong : {"centre", "centre 1 2", "centre x", "centre 999", "go-to -1"})
        CHECK_FALSE(stage.run(wrong));
    CHECK(stage.camera() == there);
}

TEST_CASE("fly moves the camera along the path to a branch") {
    TravelStage stage;
    stage.good("fly 40 0.25");
    CHECK(stage.host.flown == std::pair(40, 0.25));
    CHECK(stage.host.moves == 0); // step by step: nobody leads the eye
    const FlyPath path(*stage.document.tree(), 40);
    CHECK(stage.camera() == path.camera_at(0.25, stage.camera()));
    CHECK_FALSE(stage.document.can_undo());
    const render::Camera there = stage.camera();
    for (const char* wrong :
         {"fly", "fly 40", "fly 40 1.5", "fly 40 -0.1", "fly 40 soon", "fly 4000 0.5", "fly 40 0.5 1"})
        CHECK_FALSE(stage.run(wrong));
    CHECK(stage.camera() == there);
    stage.good("fly 40 0.25 inside");
    CHECK(stage.camera() == FlyPath(*stage.document.tree(), 40, Flight::kInside).camera_at(0.25, there));
    // The path is made once for a flight, and anew for another end.
    const auto first = stage.host.flights.to(stage.document.tree(), 40);
    stage.good("fly 40 0.5");
    CHECK(stage.host.flights.to(stage.document.tree(), 40) == first);
    CHECK(stage.host.flights.to(stage.document.tree(), 41) != first);
}

TEST_CASE("fly-along opens for the selected branch, else for the farthest end, and closes again") {
    TravelStage stage;
    stage.good("fly-along");
    const int farthest = std::stoi(stage.host.parts.at("fly-along"));
    const auto& facts = stage.document.facts()->branches;
    const auto end = [&](std::size_t id) { return facts[id].root_distance_mm + facts[id].length_mm; };
    for (std::size_t id = 0; id < facts.size(); ++id) CHECK(end(id) <= end(static_cast<std::size_t>(farthest)));
    stage.good("fly-along");
    CHECK_FALSE(stage.host.shows("fly-along"));
    stage.good("select 12\nfly-along");
    CHECK(stage.host.parts.at("fly-along") == "12");
    stage.good("fly-along 30");
    CHECK(stage.host.parts.at("fly-along") == "30");
    CHECK_FALSE(stage.run("fly-along 1 2"));
    CHECK_FALSE(stage.run("fly-along 4711"));
}

TEST_CASE("rename asks for the name of the selected branch") {
    TravelStage stage;
    CHECK_FALSE(stage.run("rename")); // nothing is selected
    stage.good("select 5\nrename");
    CHECK(stage.host.parts.at("name") == "5");
    stage.good("select-subtree 2\nrename");
    CHECK(stage.host.parts.at("name") == "2");
    const tree::Branch& root = stage.document.tree()->branches[0];
    REQUIRE(root.children.size() >= 2);
    stage.good("select " + std::to_string(root.children[0]) + " " + std::to_string(root.children[1]));
    CHECK_FALSE(stage.run("rename")); // neither depends on the other
    stage.good("rename 9");
    CHECK(stage.host.parts.at("name") == "9");
    CHECK_FALSE(stage.run("rename 1 2"));
    CHECK_FALSE(stage.run("rename x"));
}

TEST_CASE("overview shows, hides and turns its picture") {
    TravelStage stage;
    stage.good("overview");
    CHECK(stage.host.shows("overview"));
    stage.good("overview distance");
    CHECK(stage.host.parts.at("overview") == "distance");
    stage.good("overview generation\noverview off\noverview on");
    CHECK(stage.host.parts.at("overview") == "on");
    CHECK_FALSE(stage.run("overview sideways"));
    CHECK_FALSE(stage.run("overview on off"));
}
