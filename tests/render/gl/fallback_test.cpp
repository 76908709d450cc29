// OpenGL 3.3 and 4.3 draw what 4.5 draws: the same scenes, to within one step of a byte.
#include "render/renderer/renderer.h"
#include "tests/support/gl_test.h"
#include "tests/support/icosphere.h"
#include "tests/support/tube_mesh.h"

#include <array>
#include <doctest/doctest.h>
#include <functional>
#include <random>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::largest_difference;
using ramus::test::WatchedContext;

namespace {

constexpr GlVersion kFull{4, 5}, kWithLists{4, 3}, kFloor{3, 3};
constexpr int kVessels = 12;

// Vessels that cross before and behind each other; three go on from the end of another.
struct Tree {
    std::shared_ptr<const PagedMesh> mesh;
    std::shared_ptr<const Centerlines> lines;

    Tree() {
        TriangleMesh triangles;
        auto centerlines = std::make_shared<Centerlines>();
        std::mt19937 random(7);
        std::uniform_real_distribution<float> coordinate(-25.0F, 25.0F), radius(2.0F, 7.0F);
        glm::vec3 end(0.0F);
        for (int i = 0; i < kVessels; ++i) {
            const glm::vec3 from =
                i % 4 == 3 ? end : glm::vec3(coordinate(random), coordinate(random), coordinate(random));
            end = {coordinate(random), coordinate(random), coordinate(random)};
            const float first = radius(random), last = radius(random);
            add_capsule(triangles, from, end, first, last, i, 48);
            centerlines->runs.push_back({static_cast<std::uint32_t>(centerlines->points.size()), 2});
            for (const auto& [at, r] : {std::pair{from, first}, {end, last}}) {
                centerlines->points.emplace_back(at, 0.0F);
                centerlines->details.push_back({2.0F * r, i});
            }
        }
        mesh = std::make_shared<const PagedMesh>(triangles);
        lines = centerlines;
    }
};

const Tree& tree() {
    static const Tree the_tree;
    return the_tree;
}

Frame plain(bool orthographic) {
    Frame frame;
    frame.mesh = tree().mesh;
    frame.centerlines = tree().lines;
    frame.size = {320, 240};
    frame.camera = turned(camera_for(frame.mesh->positions(), View::kAnterior, frame.size, orthographic), 25.0, 10.0);
    frame.states.assign(kVessels, BranchState::kNormal);
    return frame;
}

struct Case {
    const char* name;
    std::function<void(Frame&)> change;
};

std::shared_ptr<const TriangleMesh> ball(glm::dvec3 centre, double radius) {
    return std::make_shared<const TriangleMesh>(ramus::test::icosphere(3, centre, radius));
}

const std::array<Case, 13> kCases{{
    {"plain", [](Frame&) {}},
    {"glass", [](Frame& f) { f.states.assign(kVessels, BranchState::kDefocused); }},
    {"glass before and behind opaque vessels, and where it meets them",
     [](Frame& f) {
         for (int i = 0; i < kVessels; ++i)
             if (i % 3 != 2) f.states[std::size_t(i)] = BranchState::kDefocused;
     }},
    {"faint glass, selected and hovered",
     [](Frame& f) {
         for (int i = 0; i < kVessels; i += 2) f.states[std::size_t(i)] = BranchState::kDefocused;
         f.appearance.glass_opacity = 0.4F;
         f.selected = {0, 3};
         f.hovered = 2;
         f.hovered_dependents = {4, 5};
     }},
    {"highlighted and hidden, clear background",
     [](Frame& f) {
         f.states[1] = BranchState::kHighlighted;
         f.states[2] = BranchState::kHidden;
         f.states[4] = BranchState::kDefocused;
         f.background.transparent = true;
     }},
    {"values of vertices, beside glass",
     [](Frame& f) {
         std::vector<float> values;
         for (const std::uint32_t vertex : f.mesh->used_vertices()) {
             values.resize(vertex + 1, kNotKnown);
             values[vertex] = f.mesh->position(vertex).x;
         }
         f.mesh = std::make_shared<const PagedMesh>(f.mesh->with_values(values));
         f.scale = {ColourScale::Value::kSurface, -20.0F, 20.0F, false, 0, {{0.1F, 0.1F, 0.5F}, {0.95F, 0.9F, 0.2F}}};
         f.states[3] = BranchState::kDefocused;
     }},
    {"lesions with margins",
     [](Frame& f) {
         f.lesions.spheres = {{5.0, 0.0, 5.0, 6.0}};
         f.lesions.meshes = {std::make_shared<const TriangleMesh>(ramus::test::icosphere(3, {-10, 5, -10}, 5.0))};
         f.margins.bands = {{5.0F, {0.9F, 0.2F, 0.2F}}, {10.0F, {0.9F, 0.8F, 0.2F}}};
         f.colours = {{0.3F, 0.4F, 0.9F}, {0.8F, 0.4F, 0.4F}, {0.4F, 0.7F, 0.5F}};
     }},
    {"cuts, through glass as well",
     [](Frame& f) {
         f.lost = {{0, 0.5, 1.0}, {1, 0.0, 1.0}, {3, 0.25, 1.0}};
         f.states[3] = f.states[1] = BranchState::kDefocused;
     }},
    {"context: an organ, an opaque bone and lines, around opaque vessels",
     [](Frame& f) {
         f.context = {{ball({0, 0, 0}, 20.0), nullptr, {0.8F, 0.5F, 0.4F}, 0.25F, false},
                      {ball({12, 5, -10}, 8.0), nullptr, {0.9F, 0.9F, 0.8F}, 1.0F, false},
                      {ball({-12, 5, 10}, 9.0), nullptr, {0.2F, 0.9F, 0.9F}, 0.9F, true}};
     }},
    {"context among glass",
     [](Frame& f) {
         for (int i = 0; i < kVessels; i += 2) f.states[std::size_t(i)] = BranchState::kDefocused;
         f.context = {{ball({0, 0, 0}, 20.0), nullptr, {0.8F, 0.5F, 0.4F}, 0.25F, false},
                      {ball({4, 0, -3}, 15.0), nullptr, {0.3F, 0.5F, 0.9F}, 0.5F, false}};
         f.selected = {1};
         f.hovered = 2;
     }},
    {"lesions among glass and context",
     [](Frame& f) {
         for (int i = 0; i < kVessels; i += 2) f.states[std::size_t(i)] = BranchState::kDefocused;
         f.context = {{ball({0, 0, 0}, 20.0), nullptr, {0.8F, 0.5F, 0.4F}, 0.25F, false},
                      {ball({-12, 5, 10}, 9.0), nullptr, {0.2F, 0.9F, 0.9F}, 0.9F, true}};
         f.lesions.spheres = {{5.0, 0.0, 5.0, 6.0}, {8.0, 3.0, 2.0, 7.0}};
         f.lesions.meshes = {ball({-10, 5, -10}, 8.0), ball({-6, 0, -8}, 6.0)};
         f.selected = {1};
         f.hovered = 2;
     }},
    {"depth cues and marks",
     [](Frame& f) {
         f.appearance.halos = f.appearance.contours = f.appearance.chromadepth = 1.0F;
         f.lines.push_back({{{-20, 0, -20}, {0, 10, 0}, {20, 0, 20}}});
     }},
    {"in a hurry", [](Frame& f) { f.quality = Quality::kInteractive, f.states[0] = BranchState::kDefocused; }},
}};

Image draw(const Frame& frame, GlVersion newest) {
    const WatchedContext context(newest);
    CHECK(gl_version() <= newest);
    const auto renderer = Renderer::create();
    REQUIRE_MESSAGE(renderer.has_value(), (renderer ? "" : renderer.error().message()));
    const auto done = (*renderer)->draw(frame);
    REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
    return (*renderer)->read_image();
}

} // namespace

TEST_CASE("OpenGL 3.3 and 4.3 draw what 4.5 draws" * doctest::test_suite("slow")) {
    for (const bool orthographic : {false, true})
        for (const Case& one : kCases) {
            CAPTURE(one.name);
            CAPTURE(orthographic);
            Frame frame = plain(orthographic);
            one.change(frame);
            const Image full = draw(frame, kFull);
            const int lists = largest_difference(full, draw(frame, kWithLists));
            const int floor = largest_difference(full, draw(frame, kFloor));
            CHECK(lists <= 1);
            CHECK(floor <= 1);
            MESSAGE(std::string(one.name), ": 4.3 differs by ", lists, ", 3.3 by ", floor, " of 255");
        }
}
