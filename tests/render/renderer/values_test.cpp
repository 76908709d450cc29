// Surfaces with a value for each vertex: a picture of them has the colours of the scale, and of nothing else. Witness:
// a surface whose values are all the same looks as one in that colour of the scale does.
#include "render/image/image.h"
#include "tests/support/gl_test.h"
#include "tests/support/small_tree.h"

#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <memory>
#include <vector>

using namespace ramus::render;
using ramus::test::largest_difference;
using ramus::test::SmallTree;

namespace {

constexpr glm::vec3 kLow{0.1F, 0.2F, 0.9F}, kHigh{0.9F, 0.7F, 0.1F}, kNeutral{0.6F, 0.6F, 0.6F};
constexpr int kRounding =
    3; // of a byte: the scale goes through half floats, and both to linear light in ways of their own

std::shared_ptr<const PagedMesh> valued(const PagedMesh& mesh, const std::function<float(glm::vec3)>& value) {
    std::vector<float> values;
    for (const std::uint32_t vertex : mesh.used_vertices()) {
        values.resize(vertex + 1, kNotKnown);
        values[vertex] = value(mesh.position(vertex));
    }
    return std::make_shared<const PagedMesh>(mesh.with_values(values));
}

// A scale from 0 to 2 mm over a neutral colour.
void show_values(Frame& frame, const std::function<float(glm::vec3)>& value) {
    frame.mesh = valued(*frame.mesh, value);
    frame.scale = {ColourScale::Value::kSurface, 0.0F, 2.0F, false, 0, {kLow, kHigh}};
    frame.colours.assign(4, kNeutral);
}

Image in_one_colour(SmallTree& scene, const glm::vec3& colour) {
    Frame frame = scene.frame;
    frame.scale = {};
    frame.colours.assign(4, colour);
    REQUIRE(scene.renderer->draw(frame));
    return scene.renderer->read_image();
}

} // namespace

TEST_CASE("a surface of one value has the colour of the scale there, and values beyond an end have the end's" *
          doctest::test_suite("slow")) {
    SmallTree scene;
    const auto plain = scene.frame.mesh;
    for (const auto& one : {std::pair(0.0F, kLow), std::pair(1.0F, 0.5F * (kLow + kHigh)), std::pair(2.0F, kHigh),
                            std::pair(7.5F, kHigh), std::pair(-3.0F, kLow)}) {
        const float value = one.first;
        CAPTURE(value);
        scene.frame.mesh = plain;
        show_values(scene.frame, [&](glm::vec3) { return value; });
        CHECK(largest_difference(scene.draw(), in_one_colour(scene, one.second)) <= kRounding);
    }
}

TEST_CASE("values go on evenly between vertices, and each place has its own" * doctest::test_suite("slow")) {
    SmallTree scene;
    show_values(scene.frame, [](glm::vec3 at) { return 1.0F + at.z / 60.0F; }); // along the trunk, -30 to 10
    const Image picture = scene.draw();
    for (const float z : {-25.0F, -18.0F, -3.0F, 4.0F}) {
        const float share = 0.5F * (1.0F + z / 60.0F);
        const Image same = in_one_colour(scene, (1.0F - share) * kLow + share * kHigh);
        const glm::ivec2 at(scene.pixel_of({0.0, 5.0, z}));
        for (int k = 0; k < 3; ++k)
            CHECK(std::abs(picture.pixel(at.x, at.y)[k] - same.pixel(at.x, at.y)[k]) <= 4); // a pixel is 0.3 mm
    }
}

TEST_CASE("where no value is known the branches' own colour is seen, up to the vertices that have one") {
    SmallTree scene;
    show_values(scene.frame, [](glm::vec3) { return kNotKnown; });
    CHECK(largest_difference(scene.draw(), in_one_colour(scene, kNeutral)) <= kRounding);
    // One corner that is not known makes its triangles unknown: no colour of the scale that nobody measured.
    SmallTree part;
    show_values(part.frame, [](glm::vec3 at) { return at.x < 0.0F ? 2.0F : kNotKnown; });
    const Image picture = part.draw(), neutral = in_one_colour(part, kNeutral), high = in_one_colour(part, kHigh);
    int as_neutral = 0, as_high = 0, others = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const auto near = [&](const Image& other) {
                for (int k = 0; k < 3; ++k)
                    if (std::abs(picture.pixel(x, y)[k] - other.pixel(x, y)[k]) > kRounding) return false;
                return true;
            };
            if (near(neutral) && near(high)) continue; // background
            as_neutral += near(neutral) ? 1 : 0;
            as_high += near(high) ? 1 : 0;
            others += !near(neutral) && !near(high) ? 1 : 0;
        }
    CHECK(as_neutral > 1000);
    CHECK(as_high > 1000);
    CHECK(others < 400); // pixels that the line between both goes through
}

TEST_CASE("a surface without values is never coloured by a scale of them") {
    SmallTree scene;
    scene.frame.scale = {ColourScale::Value::kSurface, 0.0F, 2.0F, false, 0, {kLow, kHigh}};
    scene.frame.colours.assign(4, kNeutral);
    CHECK(scene.draw() == in_one_colour(scene, kNeutral));
}

TEST_CASE("while a surface is on its way, the one before does not wear its scale") {
    SmallTree scene;
    show_values(scene.frame, [](glm::vec3) { return 2.0F; });
    const Image high = scene.draw();
    scene.frame.mesh = valued(*ramus::test::small_tree_mesh(), [](glm::vec3) { return 0.0F; });
    const auto done = scene.renderer->draw(scene.frame, 1); // a byte: nearly nothing comes
    REQUIRE(done);
    CHECK(done->pending);
    const Image meanwhile = scene.renderer->read_image();
    CHECK(largest_difference(meanwhile, high) > 20);
    CHECK(largest_difference(meanwhile, in_one_colour(scene, kNeutral)) <= kRounding);
    CHECK(largest_difference(scene.draw(), in_one_colour(scene, kLow)) <= kRounding);
}

TEST_CASE("triangles where branches meet have their values too, in front of glass as well" *
          doctest::test_suite("slow")) {
    for (const bool glass : {false, true}) {
        CAPTURE(glass);
        SmallTree scene;
        ramus::mesh::TriangleMesh mesh;
        ramus::test::add_capsule(mesh, {0, 0, -30}, {0, 0, 30}, 6.0F, 6.0F, 0, 48);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) mesh.branches[i] = mesh.positions[i].x < 1.0F ? 0 : 1;
        scene.frame.mesh = std::make_shared<const PagedMesh>(mesh);
        if (glass) scene.frame.states[1] = BranchState::kDefocused;
        show_values(scene.frame, [](glm::vec3) { return 2.0F; });
        CHECK(largest_difference(scene.draw(), in_one_colour(scene, kHigh)) <= kRounding);
    }
}

TEST_CASE("values are sent by themselves, and once") {
    SmallTree scene;
    REQUIRE(scene.renderer->draw(scene.frame));
    show_values(scene.frame, [](glm::vec3) { return 1.0F; });
    const auto done = scene.renderer->draw(scene.frame);
    REQUIRE(done);
    const std::size_t pages = scene.frame.mesh->value_pages().size();
    CHECK(done->uploaded == pages * sizeof(ValuePage));
    scene.frame.scale.high = 3.0F;
    const auto again = scene.renderer->draw(scene.frame);
    REQUIRE(again);
    CHECK(again->uploaded == 0);
    CHECK_FALSE(again->geometry);
}

TEST_CASE("what is hidden, glass or highlighted stays so" * doctest::test_suite("slow")) {
    for (const BranchState state : {BranchState::kHidden, BranchState::kDefocused, BranchState::kHighlighted}) {
        SmallTree scene;
        scene.frame.states[0] = state;
        show_values(scene.frame, [](glm::vec3) { return 2.0F; });
        CAPTURE(static_cast<int>(state));
        CHECK(largest_difference(scene.draw(), in_one_colour(scene, kHigh)) <= kRounding);
    }
}

TEST_CASE("while the view moves the colours stay: no cones stand in") {
    SmallTree scene;
    auto lines = std::make_shared<Centerlines>();
    lines->runs = {{0, 2}};
    lines->points = {{0.0F, 0.0F, -30.0F, 0.0F}, {0.0F, 0.0F, 10.0F, 40.0F}};
    lines->details = {{10.0F, 0}, {8.0F, 0}};
    scene.frame.centerlines = lines;
    show_values(scene.frame, [](glm::vec3) { return 2.0F; });
    scene.frame.quality = Quality::kInteractive;
    (void)scene.draw();
    scene.frame.camera = turned(scene.frame.camera, 5.0, 0.0);
    const auto moved = scene.renderer->draw(scene.frame);
    REQUIRE(moved);
    CHECK(moved->cones == 0);
    CHECK(largest_difference(scene.renderer->read_image(), in_one_colour(scene, kHigh)) <= kRounding);
    // As it does where the tree is only in one colour: else the test would say nothing.
    scene.frame.scale = {};
    (void)scene.draw();
    scene.frame.camera = turned(scene.frame.camera, 5.0, 0.0);
    const auto cast = scene.renderer->draw(scene.frame);
    REQUIRE(cast);
    CHECK(cast->cones > 0);
}
