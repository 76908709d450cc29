// What stands in for the surface while the view moves: round cones along the centerlines, found by a ray a pixel.
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"
#include "tests/support/built_tree.h"
#include "tests/support/gl_test.h"
#include "tests/support/straight_vessels.h"
#include "tests/support/surface_frame.h"
#include "tests/support/tube_mesh.h"

#include <algorithm>
#include <cmath>
#include <doctest/doctest.h>
#include <functional>
#include <glm/geometric.hpp>
#include <string>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;

namespace {

// None begins just where another ends: those would be one vessel, smooth at their joint.
const std::array<ramus::test::StraightVessel, 4> kVessels{{{{0, 0, -30}, {0, 0, 10}, 5.0F, 5.0F},
                                                           {{0, 0, 10.001F}, {-25, 0, 30}, 4.0F, 4.0F},
                                                           {{0, 0, 10.002F}, {22, 10, 28}, 2.0F, 2.0F},
                                                           {{-20, 12, -14}, {20, 14, -10}, 1.0F, 1.0F}}};

// The cones' own surface, finely.
struct Scene {
    ramus::test::WatchedContext context;
    std::unique_ptr<Renderer> renderer = Renderer::create().value();
    Frame frame;

    explicit Scene(bool orthographic) {
        frame = ramus::test::frame_of(kVessels, 160, {640, 480}, orthographic);
        frame.quality = Quality::kInteractive;
    }
    ~Scene() {
        CHECK(context->make_current()); // there may be another one
        renderer.reset();
    }
    DrawStatistics draw() {
        REQUIRE(context->make_current());
        const auto done = renderer->draw(frame);
        REQUIRE_MESSAGE(done.has_value(), (done ? "" : done.error().message()));
        return *done;
    }
};

// Mean of 255, over the pixels of a picture that show vessels.
double apart_on_vessels(const Image& picture, const Image& other, const BranchPicture& branches, std::size_t& vessels) {
    double sum = 0.0;
    vessels = 0;
    for (std::size_t i = 0; i < branches.branches.size(); ++i) {
        if (branches.branches[i] == kNoBranch) continue;
        ++vessels;
        for (std::size_t k = 4 * i; k < 4 * i + 3; ++k) sum += std::abs(picture.rgba[k] - other.rgba[k]) / 3.0;
    }
    return sum / double(vessels);
}

} // namespace

TEST_CASE("cones stand in for the surface while the view moves, and look like it" * doctest::test_suite("slow")) {
    for (const bool orthographic : {false, true}) {
        CAPTURE(orthographic);
        Scene still(orthographic), moving(orthographic);
        still.frame.quality = Quality::kFull;
        const Camera there = turned(still.frame.camera, 30.0, 20.0);
        CHECK(moving.draw().triangles > 100'000);
        moving.frame.camera = still.frame.camera = there;
        const DrawStatistics turned_by = moving.draw();
        CHECK(turned_by.cones == kVessels.size());
        CHECK(turned_by.triangles == 0);
        const Image cones = moving.renderer->read_image();
        const BranchPicture cone_branches = moving.renderer->read_branches();
        const Pick cone_pick = moving.renderer->pick(320, 300);
        CHECK(still.draw().triangles > 100'000);
        const Image surface = still.renderer->read_image();
        const BranchPicture surface_branches = still.renderer->read_branches();

        std::size_t vessels = 0, other_branch = 0;
        const double apart = apart_on_vessels(cones, surface, surface_branches, vessels);
        for (std::size_t i = 0; i < surface_branches.branches.size(); ++i)
            if (surface_branches.branches[i] != kNoBranch)
                other_branch += cone_branches.branches[i] != surface_branches.branches[i] ? 1 : 0;
        MESSAGE("mean difference " << apart << " of 255; " << 100.0 * double(other_branch) / double(vessels)
                                   << " % show another branch");
        REQUIRE(vessels > 20'000);
        CHECK(apart < 0.1);
        CHECK(double(other_branch) < 0.001 * double(vessels));
        const Pick pick = still.renderer->pick(320, 300);
        CHECK(cone_pick.branch == pick.branch);
        CHECK(glm::distance(cone_pick.position, pick.position) < 0.05);

        // It stays until the view rests.
        moving.frame.hovered = 1;
        CHECK(moving.draw().cones == kVessels.size());
        CHECK(moving.renderer->read_image() != cones);
        moving.frame.hovered = kNoBranch;

        // At rest, and where anything but the camera changes, it is the surface.
        moving.frame.quality = Quality::kFull;
        CHECK(moving.draw().triangles > 100'000);
        moving.frame.quality = Quality::kInteractive;
        moving.frame.camera = turned(there, 5.0, 0.0);
        moving.frame.states[3] = BranchState::kHidden;
        CHECK(moving.draw().triangles > 70'000);
        moving.frame.camera = there;
        CHECK(moving.draw().cones == kVessels.size() - 1);
    }
}

TEST_CASE("a surface that only its mesh can tell is drawn by that while the view moves, too") {
    Scene moving(false);
    moving.frame.only_mesh = true;
    CHECK(moving.draw().cones == 0);
    moving.frame.camera = turned(moving.frame.camera, 30.0, 20.0);
    const DrawStatistics turned_by = moving.draw();
    CHECK(turned_by.cones == 0);
    CHECK(turned_by.triangles > 100'000);
    moving.frame.surface_awaited = true; // the surface before stays
    moving.frame.camera = turned(moving.frame.camera, 5.0, 0.0);
    CHECK(moving.draw().cones == 0);
    moving.frame.surface_awaited = false;
    moving.frame.only_mesh = false;
    moving.frame.camera = turned(moving.frame.camera, 5.0, 0.0);
    CHECK(moving.draw().cones == kVessels.size());
}

TEST_CASE("of a convolution surface the cones have the field's normals") {
    const ramus::tree::VesselTree tree = ramus::test::built_tree(
        {{{0, 0, -30}, 5}, {{0, 0, 10}, 5}, {{-25, 0, 30}, 4}, {{22, 10, 28}, 2}}, {{0, 1}, {1, 2}, {1, 3}});
    ramus::mesh::SurfaceOptions options;
    options.smooth_passes = 0;
    Scene still(false), moving(false);
    still.frame = moving.frame = ramus::test::surface_frame(tree, options, {640, 480});
    moving.frame.quality = Quality::kInteractive;
    moving.frame.surface_awaited = true; // by cones alone
    (void)moving.draw();
    moving.frame.camera = still.frame.camera = turned(still.frame.camera, 30.0, 20.0);
    CHECK(moving.draw().cones > 0);
    const Image cones = moving.renderer->read_image();
    CHECK(still.draw().triangles > 1'000);
    std::size_t vessels = 0;
    const double apart =
        apart_on_vessels(cones, still.renderer->read_image(), still.renderer->read_branches(), vessels);
    MESSAGE("mean difference " << apart << " of 255");
    REQUIRE(vessels > 20'000);
    CHECK(apart < 2.0); // 16 where the normals' depth is turned round
}

TEST_CASE("a surface that is not there yet is seen along its centerlines, in the first picture too" *
          doctest::test_suite("slow")) {
    Scene awaiting(false), still(false);
    still.frame.quality = Quality::kFull;
    CHECK(still.draw().triangles > 100'000);
    const Image surface = still.renderer->read_image();
    const BranchPicture branches = still.renderer->read_branches();
    const Pick pick = still.renderer->pick(320, 300);

    // What is there is another one's.
    const auto wanted = awaiting.frame.mesh;
    TriangleMesh other;
    add_capsule(other, {0, 0, -10}, {0, 0, 10}, 9.0F, 9.0F, 0);
    awaiting.frame.mesh = std::make_shared<const PagedMesh>(other);
    awaiting.frame.surface_awaited = true;
    const DrawStatistics first = awaiting.draw();
    CHECK(first.cones == kVessels.size());
    CHECK(first.triangles == 0);
    CHECK_FALSE(first.pending); // nothing is sent that nobody will see
    CHECK(first.uploaded == 0);
    const auto difference = [&] {
        std::size_t vessels = 0;
        return apart_on_vessels(awaiting.renderer->read_image(), surface, branches, vessels);
    };
    CHECK(difference() < 0.1);
    CHECK(awaiting.renderer->pick(320, 300).branch == pick.branch);
    CHECK_FALSE(awaiting.draw().geometry); // nothing changed

    // It comes, and the picture stays until the view rests.
    awaiting.frame.mesh = wanted;
    awaiting.frame.surface_awaited = false;
    CHECK(awaiting.draw().cones == kVessels.size());
    CHECK(difference() < 0.1);
    awaiting.frame.quality = Quality::kFull;
    CHECK(awaiting.draw().triangles > 100'000);
    CHECK(difference() == 0.0);

    // In full, and with what cannot be cast, the mesh before is what there is.
    awaiting.frame.mesh = std::make_shared<const PagedMesh>(other);
    awaiting.frame.surface_awaited = true;
    const std::uint64_t before = awaiting.draw().triangles;
    CHECK(before > 0);
    CHECK(before < 100'000);
    awaiting.frame.quality = Quality::kInteractive;
    awaiting.frame.centerlines = nullptr;
    CHECK(awaiting.draw().triangles == before);
}

std::shared_ptr<TriangleMesh> a_mesh(glm::vec3 from, glm::vec3 to, float radius, int around = 60) {
    auto mesh = std::make_shared<TriangleMesh>();
    add_capsule(*mesh, from, to, radius, 0.7F * radius, 0, around);
    return mesh;
}

struct Look {
    std::string name;
    std::function<void(Frame&)> put_on;
};
const std::vector<Look> kLooks{
    {"glass", [](Frame& f) { f.states[3] = BranchState::kDefocused; }},
    {"dense glass, selected",
     [](Frame& f) {
         f.states[3] = BranchState::kDefocused;
         f.selected = {3};
         f.appearance.glass_opacity = 1.6F;
     }},
    {"highlighted and selected",
     [](Frame& f) {
         f.states[1] = BranchState::kHighlighted;
         f.selected = {2};
     }},
    {"hidden", [](Frame& f) { f.states[0] = BranchState::kHidden; }},
    {"hovered",
     [](Frame& f) {
         f.hovered = 0;
         f.hovered_dependents = {1, 2};
     }},
    {"own colours",
     [](Frame& f) {
         f.colours = {{0.2F, 0.6F, 0.9F}, {0.9F, 0.8F, 0.1F}, {0.1F, 0.9F, 0.3F}};
     }},
    {"by diameter",
     [](Frame& f) {
         f.scale.value = ColourScale::Value::kDiameter;
         f.scale.low = 1.0F, f.scale.high = 11.0F;
         f.scale.ramp = {{0.1F, 0.1F, 0.5F}, {0.2F, 0.7F, 0.4F}, {0.95F, 0.9F, 0.2F}};
     }},
    {"by diameter, logarithmic",
     [](Frame& f) {
         f.scale.value = ColourScale::Value::kDiameter;
         f.scale.logarithmic = true;
         f.scale.low = 1.0F, f.scale.high = 11.0F;
         f.scale.ramp = {{0.1F, 0.1F, 0.5F}, {0.95F, 0.9F, 0.2F}};
     }},
    {"lost branches",
     [](Frame& f) {
         f.states[3] = BranchState::kDefocused;
         f.lost = {{1, 0.0, 1.0}, {3, 0.0, 1.0}};
     }},
    {"cut, with the way to the root",
     [](Frame& f) {
         f.lost = {{0, 0.55, 1.0}, {1, 0.0, 1.0}, {3, 0.2, 0.7}};
         f.scale.value = ColourScale::Value::kRootDistance;
         f.scale.low = 0.0F, f.scale.high = 60.0F;
         f.scale.ramp = {{0.1F, 0.1F, 0.5F}, {0.95F, 0.9F, 0.2F}};
     }},
    {"cut, with a line",
     [](Frame& f) {
         f.lost = {{2, 0.4, 1.0}};
         f.lines = {{{{-20, -20, -20}, {20, 18, 25}}, {0.2F, 0.9F, 0.4F}, 2.0F}};
     }},
    {"a lesion and its margins",
     [](Frame& f) {
         f.lesions.spheres = {{8.0, -6.0, 4.0, 6.0}, {-14.0, 3.0, 20.0, 4.0}};
         f.lesions.looks = {{{0.2F, 0.6F, 0.9F}, 0.4F}};
         f.margins.bands = {{3.0F, {0.9F, 0.2F, 0.1F}}, {8.0F, {0.9F, 0.8F, 0.2F}}, {15.0F, {0.2F, 0.6F, 0.3F}}};
         f.colours = {{0.3F, 0.4F, 0.9F}, {0.8F, 0.4F, 0.4F}, {0.3F, 0.4F, 0.9F}, {0.8F, 0.4F, 0.4F}};
     }},
    {"lesions in glass and behind it",
     [](Frame& f) {
         f.states[0] = f.states[3] = BranchState::kDefocused;
         f.lesions.spheres = {{1.0, 1.0, -12.0, 7.0}, {6.0, 14.0, -8.0, 5.0}};
     }},
    {"margins of meshes",
     [](Frame& f) {
         auto grid = std::make_shared<DistanceGrid>();
         grid->size = {40, 36, 44};
         grid->corner = {-20.0, -18.0, -30.0};
         for (int i = 0; i < 40 * 36 * 44; ++i) {
             const glm::dvec3 at = grid->corner + glm::dvec3(i % 40, i / 40 % 36, i / 1440);
             grid->values.push_back(static_cast<float>(glm::distance(at, glm::dvec3(4.0, 2.0, -4.0)) - 6.0));
         }
         f.lesions.distances = grid;
         f.margins.bands = {{2.0F, {0.9F, 0.2F, 0.1F}}, {6.0F, {0.9F, 0.8F, 0.2F}}};
         f.colours = {{0.8F, 0.4F, 0.4F}, {0.3F, 0.4F, 0.9F}};
     }},
    {"a lesion that is a mesh, in glass",
     [](Frame& f) {
         f.states[0] = BranchState::kDefocused;
         f.lesions.spheres = {{-14.0, 3.0, 20.0, 4.0}};
         f.lesions.meshes = {a_mesh({2, -4, -14}, {6, 4, -2}, 5.0F)};
         f.lesions.looks = {{}, {{0.9F, 0.3F, 0.6F}, 0.8F}};
     }},
    {"clear and opaque context",
     [](Frame& f) {
         f.states[3] = BranchState::kDefocused;
         f.context = {{a_mesh({-20, 6, -12}, {14, -4, 16}, 9.0F), nullptr, {0.8F, 0.6F, 0.5F}, 0.3F, false},
                      {a_mesh({6, 14, -28}, {20, 12, -6}, 4.0F), nullptr, {0.9F, 0.9F, 0.8F}, 1.0F, false}};
     }},
    {"open context, seen from both sides",
     [](Frame& f) {
         auto open = std::make_shared<TriangleMesh>(*a_mesh({-16, 6, -12}, {14, -4, 16}, 9.0F));
         std::erase_if(open->triangles, [&](const glm::uvec3& t) { return open->positions[t.x].y > 4.0F; });
         f.context = {{open, nullptr, {0.3F, 0.6F, 0.8F}, 0.4F, false}};
     }},
    {"context as lines",
     [](Frame& f) {
         f.context = {{a_mesh({-20, 6, -12}, {14, -4, 16}, 9.0F, 14), nullptr, {0.6F, 0.9F, 1.0F}, 0.8F, true}};
     }},
    {"shadows", [](Frame& f) { f.appearance.shadows = 1.0F; }},
    {"contours and near red", [](Frame& f) { f.appearance.contours = 1.0F, f.appearance.chromadepth = 1.0F; }},
    {"halos, no fog", [](Frame& f) { f.appearance.halos = 1.0F, f.appearance.depth_cue = 0.0F; }},
    {"no occlusion", [](Frame& f) { f.appearance.occlusion = 0.0F; }},
    {"nothing behind", [](Frame& f) { f.background.transparent = true; }},
};

// Of the pixels where the still picture shows branches, and of all: how far apart the pictures are, of 255.
struct Difference {
    double on_vessels, everywhere;
};
Difference difference(const Image& moving, const Image& still, const BranchPicture& branches) {
    double sum = 0.0, everywhere = 0.0;
    std::size_t vessels = 0;
    for (std::size_t i = 0; i < still.rgba.size(); ++i) {
        const double apart = std::abs(moving.rgba[i] - still.rgba[i]);
        everywhere += apart;
        if (branches.branches[i / 4] == kNoBranch) continue;
        sum += apart;
        ++vessels;
    }
    REQUIRE(vessels > 20'000);
    return {sum / double(vessels), everywhere / double(still.rgba.size())};
}

// Of 108 places all over the picture, those where the two renderers point at something else.
int pointed_elsewhere(Renderer& a, Renderer& b) {
    int count = 0;
    for (int n = 0; n < 108; ++n) {
        const int column = n % 12, row = n / 12;
        const Pick here = a.pick(53.0 * column + 20.0, 53.0 * row + 20.0);
        const Pick there = b.pick(53.0 * column + 20.0, 53.0 * row + 20.0);
        count += here.branch != there.branch || here.lesion != there.lesion ? 1 : 0;
    }
    return count;
}

TEST_CASE("every look is the same while the view moves" * doctest::test_suite("slow")) {
    for (const bool orthographic : {false, true}) {
        Scene still(orthographic), moving(orthographic);
        const Camera there = turned(still.frame.camera, 24.0, 12.0);
        still.frame.quality = Quality::kFull;
        for (const Look& look : kLooks) {
            CAPTURE(look.name);
            CAPTURE(orthographic);
            const Frame plain_still = still.frame, plain_moving = moving.frame;
            look.put_on(still.frame);
            look.put_on(moving.frame);
            moving.frame.surface_awaited = true; // by cones alone: thick vessels have no triangles
            moving.draw();
            moving.frame.camera = still.frame.camera = there;
            CHECK(moving.draw().cones > 0);
            const Image on_the_way = moving.renderer->read_image(); // of the context that is current
            still.draw();
            CHECK(pointed_elsewhere(*moving.renderer, *still.renderer) <= 1); // on an edge
            const Difference apart =
                difference(on_the_way, still.renderer->read_image(), still.renderer->read_branches());
            MESSAGE(look.name << ": " << apart.on_vessels << " of 255, " << apart.everywhere << " in all the picture");
            CHECK(apart.on_vessels < 0.1);
            CHECK(apart.everywhere < 0.012);
            still.frame = plain_still;
            moving.frame = plain_moving;
        }
    }
}

TEST_CASE("what is around the eye is cut off before it, not left out") {
    Scene scene(false);
    scene.draw();
    scene.frame.camera = turned(scene.frame.camera, 24.0, 12.0);
    scene.draw();
    const Image without = scene.renderer->read_image();
    auto tube = std::make_shared<TriangleMesh>(*a_mesh({-40, -200, 0}, {40, 260, 10}, 60.0F, 10));
    tube->triangles.pop_back(); // open: it is seen from within
    scene.frame.context = {{tube, nullptr, {0.3F, 0.6F, 0.8F}, 0.2F, false}};
    CHECK(scene.draw().cones > 0);
    const Image within = scene.renderer->read_image();
    std::size_t veiled = 0;
    for (std::size_t i = 0; i < within.rgba.size(); i += 4) veiled += within.rgba[i + 2] != without.rgba[i + 2] ? 1 : 0;
    CHECK(4.0 * double(veiled) > 0.97 * double(within.rgba.size())); // but where the hole is
}

TEST_CASE("what is selected shows its outline through what hides it, while the view moves, too" *
          doctest::test_suite("slow")) {
    Scene scene(false);
    scene.frame.selected = {0};
    scene.draw();
    scene.frame.camera = turned(scene.frame.camera, 24.0, 12.0);
    std::array<int, 2> through_twig{}, through_trunk{}; // pixels, while it moves and at rest
    for (const std::size_t rests : {0U, 1U}) {
        scene.frame.quality = rests == 1 ? Quality::kFull : Quality::kInteractive;
        scene.frame.lines.clear();
        CHECK((scene.draw().cones > 0) == (rests == 0));
        const Image before = scene.renderer->read_image();
        // Along the trunk's axis: the trunk hides it, which is selected, and in the middle the twig, which is not.
        scene.frame.lines = {
            {.points = {{0, 0, -29}, {0, 0, 9}}, .colour = {0, 1, 0}, .width = 4.0F, .of_selection = true}};
        scene.draw();
        const Image after = scene.renderer->read_image();
        const BranchPicture branches = scene.renderer->read_branches();
        for (std::size_t i = 0; i < branches.branches.size(); ++i) {
            if (std::equal(&before.rgba[4 * i], &before.rgba[4 * i] + 4, &after.rgba[4 * i])) continue;
            through_twig.at(rests) += branches.branches[i] == 3 ? 1 : 0;
            through_trunk.at(rests) += branches.branches[i] == 0 ? 1 : 0;
        }
    }
    MESSAGE(through_twig[0] << " pixels while it moves, " << through_twig[1] << " at rest");
    CHECK(through_twig[1] > 30);
    CHECK(std::abs(through_twig[0] - through_twig[1]) < 0.2 * through_twig[1]);
    CHECK(through_trunk[0] < 0.1 * through_twig[0]); // a pixel on an edge is both
    CHECK(through_trunk[1] < 0.1 * through_twig[1]);
}
