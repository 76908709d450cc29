// What pictures show beside plain vessels, against what geometry says: centerlines in glass, margins around lesions,
// lost parts, lesions, lines, values along branches, the legend. A tube along x of 5 mm radius, seen from the front
// without perspective, 0.1 mm a pixel.
#include "render/image/text.h"
#include "render/overlay/legend.h"
#include "render/overlay/overlay.h"
#include "tests/support/beside_scene.h"

#include <cmath>
#include <doctest/doctest.h>
#include <glm/geometric.hpp>

using namespace ramus::render;
using ramus::mesh::TriangleMesh;
using ramus::test::add_capsule;
using ramus::test::kPixelMm;

namespace {

struct Scene : ramus::test::BesideScene {
    // `first` and `last`: radii of the tube at x = -20 and x = 20.
    explicit Scene(float first = 5.0F, float last = 5.0F, bool crossed = false, float crossing_y = 12.0F) {
        TriangleMesh mesh;
        add_capsule(mesh, {-20, 0, 0}, {20, 0, 0}, first, last, 0, 96);
        if (crossed) add_capsule(mesh, {8, crossing_y, -15}, {8, crossing_y, 15}, 3.0F, 3.0F, 1, 96);
        frame.mesh = std::make_shared<const PagedMesh>(mesh);
        frame.appearance = {};
        frame.states.assign(2, BranchState::kNormal);
        auto lines = std::make_shared<Centerlines>();
        lines->runs = {{0, 9}, {9, 2}};
        for (int i = 0; i <= 8; ++i) {
            const float t = float(i) / 8.0F;
            lines->points.emplace_back(-20.0F + 40.0F * t, 0.0F, 0.0F, 100.0F + 40.0F * t);
            lines->details.push_back({2.0F * (first + t * (last - first)), 0});
        }
        for (const float z : {-15.0F, 15.0F})
            lines->points.emplace_back(8.0F, crossing_y, z, z), lines->details.push_back({6.0F, 1});
        frame.centerlines = lines;
    }
    Image draw() { return picture(); }
};

int brightness(const std::uint8_t* p) { return p[0] + p[1] + p[2]; }

} // namespace

TEST_CASE("a glass tube shows its centerline in its middle, as wide as it says, on both pixel ratios") {
    for (const float ratio : {1.0F, 2.0F}) {
        Scene scene;
        scene.frame.states[0] = BranchState::kDefocused;
        scene.frame.pixel_ratio = ratio;
        const Image image = scene.draw();
        for (const double x : {-15.0, -3.0, 4.0, 17.0}) {
            const int glass = brightness(scene.colour(image, x, 2.0));
            double ink = 0.0; // of the line, in pixels
            const int line = [&] {
                int most = 0;
                for (int dy = -5; dy <= 5; ++dy) {
                    const glm::ivec2 p = scene.at(x, 0.0);
                    most = std::max(most, brightness(image.pixel(p.x, p.y + dy)));
                }
                return most;
            }();
            for (int dy = -5; dy <= 5; ++dy) {
                const glm::ivec2 p = scene.at(x, 0.0);
                ink += std::max(0, brightness(image.pixel(p.x, p.y + dy)) - glass) / double(line - glass);
            }
            CHECK(line > glass + 150);
            CHECK(line > 400);
            CHECK(ink > 0.6 * 1.6 * ratio); // light adds up in linear light: edges look brighter than their share
            CHECK(ink < 1.6 * ratio + 1.2);
        }
        // Without glass there is no line, and nothing inside the opaque tube shows.
        scene.frame.states[0] = BranchState::kNormal;
        const Image opaque = scene.draw();
        scene.frame.centerlines = nullptr;
        CHECK(scene.draw() == opaque);
    }
}

TEST_CASE("an opaque vessel in front hides a glass one and its centerline") {
    Scene scene(5.0F, 5.0F, true);
    scene.frame.states[0] = BranchState::kDefocused;
    const Image both = scene.draw();
    CHECK(scene.renderer->pick(scene.at(8.0, 0.0).x, scene.at(8.0, 0.0).y).branch == 1);
    scene.frame.states[0] = BranchState::kHidden;
    const Image alone = scene.draw();
    for (const double x : {6.5, 8.0, 9.5})
        for (const double z : {-2.0, 0.0, 3.0})
            for (int k = 0; k < 3; ++k)
                CHECK(std::abs(scene.colour(both, x, z)[k] - scene.colour(alone, x, z)[k]) <= 2);
}

TEST_CASE("opacity and grey of the glass") {
    Scene scene;
    scene.frame.states[0] = BranchState::kDefocused;
    scene.frame.centerlines = nullptr;
    std::vector<int> seen;
    for (const float opacity : {0.0F, 0.5F, 1.0F, 1.5F, 2.0F}) {
        scene.frame.appearance.glass_opacity = opacity;
        seen.push_back(brightness(scene.colour(scene.draw(), 0.0, 3.0)));
    }
    scene.frame.states[0] = BranchState::kHidden;
    CHECK(std::abs(seen[0] - brightness(scene.colour(scene.draw(), 0.0, 3.0))) <= 4);
    for (std::size_t i = 1; i < seen.size(); ++i) CHECK(seen[i] > seen[i - 1] + 10);
    scene.frame.states[0] = BranchState::kDefocused;
    scene.frame.appearance.glass = glm::vec3(0.1F);
    CHECK(brightness(scene.colour(scene.draw(), 0.0, 3.0)) < seen.back() - 100);
}

TEST_CASE("nothing is drawn again for colours, margins, cuts and glass looks" * doctest::test_suite("slow")) {
    Scene scene;
    scene.frame.states[0] = BranchState::kDefocused;
    (void)scene.draw();
    scene.frame.appearance.glass_opacity = 0.4F;
    scene.frame.margins.bands = {{10.0F, {1, 0, 0}}};
    scene.frame.lost = {{0, 0.5, 1.0}};
    scene.frame.scale = {ColourScale::Value::kDiameter, 1.0F, 9.0F, true, 0, {{0, 0, 0}, {1, 1, 1}}};
    const auto done = scene.renderer->draw(scene.frame).value();
    CHECK(done.shaded);
    CHECK_FALSE(done.geometry);
    CHECK(done.uploaded == 0);
}

TEST_CASE("the ring of a margin lies where the distance to the lesion's surface is that margin" *
          doctest::test_suite("slow")) {
    Scene scene;
    scene.frame.lesions.spheres = {{0.0, 5.0, 8.0, 2.0}};
    scene.frame.margins.bands = {{10.0F, {0.9F, 0.1F, 0.1F}}};
    scene.frame.colours = {{0.1F, 0.1F, 0.9F}};
    const Image image = scene.draw();
    // On the tube's front line, at (x, 5, 0): sqrt(x^2 + 8^2) - 2 = 10.
    const double ring = std::sqrt(12.0 * 12.0 - 8.0 * 8.0);
    for (const double side : {-1.0, 1.0}) {
        const std::uint8_t* inside = scene.colour(image, side * (ring - 3.0 * kPixelMm), 0.0);
        const std::uint8_t* outside = scene.colour(image, side * (ring + 3.0 * kPixelMm), 0.0);
        CHECK(inside[0] > inside[2] + 50);
        CHECK(outside[2] > outside[0] + 50);
    }
    // The same distance from a grid, as of a mesh of that shape.
    auto grid = std::make_shared<DistanceGrid>();
    grid->size = {81, 41, 41};
    grid->corner = {-20.0, -10.0, -10.0};
    grid->step_mm = 0.5;
    for (int z = 0; z < 41; ++z)
        for (int y = 0; y < 41; ++y)
            for (int x = 0; x < 81; ++x)
                grid->values.push_back(float(
                    std::max(0.0, glm::distance(grid->corner + 0.5 * glm::dvec3(x, y, z), {0.0, 5.0, 8.0}) - 2.0)));
    scene.frame.lesions.spheres.clear();
    scene.frame.lesions.distances = grid;
    const Image sampled = scene.draw();
    for (const double side : {-1.0, 1.0}) {
        CHECK(scene.colour(sampled, side * (ring - 3.0 * kPixelMm), 0.0)[0] > 100);
        CHECK(scene.colour(sampled, side * (ring + 3.0 * kPixelMm), 0.0)[2] > 100);
        CHECK(scene.colour(sampled, side * (ring - 3.0 * kPixelMm), 0.0)[2] < 100);
    }
}

TEST_CASE("what is lost begins at the cut, with a clean ring" * doctest::test_suite("slow")) {
    Scene scene;
    scene.frame.lost = {{0, 0.25, 0.75}}; // from x = -10 to x = 10
    const Image image = scene.draw();
    for (const double cut : {-10.0, 10.0}) {
        const double outward = cut < 0.0 ? -1.0 : 1.0;
        for (const double z : {-3.0, 0.0, 3.0}) {
            const std::uint8_t* kept = scene.colour(image, cut + outward * 4.0 * kPixelMm, z);
            CHECK(kept[0] > kept[2] + 40);
            const std::uint8_t* lost = scene.colour(image, cut - outward * 4.0 * kPixelMm, z);
            CHECK(lost[2] > lost[0]);
            const std::uint8_t* ring = scene.colour(image, cut, z);
            CHECK(brightness(ring) > brightness(kept));
            CHECK(ring[1] > kept[1] + 20);
        }
    }
    scene.frame.lost = {{0, 0.0, 1.0}};
    const Image all = scene.draw();
    for (const double x : {-19.0, 0.0, 19.0}) CHECK(scene.colour(all, x, 0.0)[2] > scene.colour(all, x, 0.0)[0]);
}

TEST_CASE("a lesion's outline has its radius, it is picked as a lesion, and what lies inside shimmers through" *
          doctest::test_suite("slow")) {
    Scene scene;
    scene.frame.lesions.spheres = {{-5.0, 20.0, 1.0, 9.0}};
    const Image with = scene.draw();
    const glm::ivec2 centre = scene.at(-5.0, 1.0);
    scene.frame.lesions.spheres.clear();
    scene.frame.mesh = nullptr;
    const Image background = scene.draw();
    int up = 0; // rows above the centre that are not background; the tube is 4 mm lower
    while (centre.y - up > 0 && std::abs(brightness(with.pixel(centre.x, centre.y - up)) -
                                         brightness(background.pixel(centre.x, centre.y - up))) > 15)
        ++up;
    CHECK(std::abs(up * kPixelMm - 9.0) < 1.6 * kPixelMm);

    Scene picked;
    picked.frame.lesions.spheres = {{100.0, 0.0, 0.0, 1.0}, {-5.0, 20.0, 1.0, 9.0}};
    (void)picked.draw();
    const Pick pick = picked.renderer->pick(centre.x, centre.y - 80);
    CHECK(pick.lesion == 1);
    CHECK(pick.branch == kNoBranch);
    CHECK(glm::distance(pick.position, {-5.0, 20.0, 1.0}) == doctest::Approx(9.0).epsilon(0.02));
    CHECK(picked.renderer->pick(picked.at(15.0, 0.0).x, picked.at(15.0, 0.0).y).lesion == kNoLesion);

    // The same as a mesh, whichever way its triangles are turned.
    auto ball = std::make_shared<TriangleMesh>();
    add_capsule(*ball, {-5.0F, 20.0F, 0.99F}, {-5.0F, 20.0F, 1.01F}, 9.0F, 9.0F, 0, 96);
    auto turned_in = std::make_shared<TriangleMesh>(*ball);
    for (glm::uvec3& t : turned_in->triangles) std::swap(t.x, t.y);
    for (const auto& shape : {ball, turned_in}) {
        Scene scene_of_mesh;
        scene_of_mesh.frame.lesions.meshes = {shape};
        CHECK(compare(scene_of_mesh.draw(), with, 12)->fraction() < 0.004);
        CHECK(scene_of_mesh.renderer->pick(centre.x, centre.y - 80).lesion == 0);
    }
}

TEST_CASE("colours follow the diameter from point to point") {
    Scene scene(5.0F, 3.0F); // 10 mm wide at x = -20, 6 mm at x = 20: 8 mm at 0
    scene.frame.scale = {ColourScale::Value::kDiameter,           6.0F, 10.0F, false, 0,
                         {{0.1F, 0.2F, 0.9F}, {0.9F, 0.2F, 0.1F}}};
    const Image image = scene.draw();
    int turn = 0, x = scene.at(19.0, 0.0).x;
    const int step = scene.at(-19.0, 0.0).x > x ? 1 : -1;
    for (; x != scene.at(-19.0, 0.0).x; x += step)
        if (image.pixel(x, scene.at(0.0, 0.0).y)[0] > image.pixel(x, scene.at(0.0, 0.0).y)[2]) {
            turn = x;
            break;
        }
    CHECK(std::abs(turn - scene.at(0.0, 0.0).x) * kPixelMm < 2.5); // the light is a little warm
    scene.frame.scale = {ColourScale::Value::kRootDistance,       100.0F, 140.0F, false, 0,
                         {{0.9F, 0.2F, 0.1F}, {0.1F, 0.2F, 0.9F}}};
    const Image distance = scene.draw();
    CHECK(scene.colour(distance, -15.0, 0.0)[0] > scene.colour(distance, -15.0, 0.0)[2] + 40);
    CHECK(scene.colour(distance, 15.0, 0.0)[2] > scene.colour(distance, 15.0, 0.0)[0] + 40);
}

TEST_CASE("lines lie over the picture, fainter where vessels hide them, and labels stand beside their point") {
    Scene scene;
    const Image plain = scene.draw();
    scene.frame.lines = {{{{-12.0, 8.0, -12.0}, {-12.0, 8.0, 12.0}}, {1, 1, 1}, 3.0F},
                         {{{12.0, -8.0, -12.0}, {12.0, -8.0, 12.0}}, {1, 1, 1}, 3.0F}};
    const Image image = scene.draw();
    CHECK(brightness(scene.colour(image, -12.0, 0.0)) > 740); // before the tube
    CHECK(brightness(scene.colour(image, 12.0, 9.0)) > 740);  // beside it
    const int behind = brightness(scene.colour(image, 12.0, 0.0));
    CHECK(behind > brightness(scene.colour(plain, 12.0, 0.0)) + 20);
    CHECK(behind < 700);
    // A way through a vessel is seen as well as any other line.
    for (MarkLine& line : scene.frame.lines) line.inside_mm = 20.0;
    CHECK(brightness(scene.colour(scene.draw(), 12.0, 0.0)) > 740);
    scene.frame.lines.clear();
    scene.frame.labels = {{{0.0, 0.0, 10.0}, "12.3 mm"}};
    const auto sprites = OverlayPainter().paint(SpriteSource(scene.frame));
    REQUIRE(sprites.size() == 1);
    CHECK(std::abs(sprites[0].corner.x - scene.at(0.0, 10.0).x) < 15);
    CHECK(scene.draw() != plain);
}

TEST_CASE("inside a vessel its wall is all around, and the centerline ahead") {
    Scene scene;
    scene.frame.camera = {.position = {-15, 0, 0.5}, .focal_point = {0, 0, 0}, .view_angle = 80.0};
    const auto wall = [](const Image& image) {
        int red = 0;
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x) {
                const std::uint8_t* p = image.pixel(x, y);
                red += p[0] > p[2] + 30 ? 1 : 0;
            }
        return red / double(image.width) / image.height;
    };
    const double without = wall(scene.draw());
    scene.frame.camera.inside = true;
    CHECK(without < 0.1);
    CHECK(wall(scene.draw()) > 0.85); // the rest are the cube, the bar and highlights
    // From outside nothing is different but samples at the outline.
    Scene other;
    const Image outside = other.draw();
    other.frame.camera.inside = true;
    const Image same = other.draw();
    int different = 0;
    for (int y = 0; y < same.height; ++y)
        for (int x = 0; x < same.width; ++x)
            for (int k = 0; k < 3; ++k) different += std::abs(same.pixel(x, y)[k] - outside.pixel(x, y)[k]) > 8 ? 1 : 0;
    CHECK(different < same.width);
}

TEST_CASE("a legend is as sharp as the picture, above the scale bar, and its bar has the map's colours") {
    Legend legend;
    legend.title = "Diameter (mm)";
    legend.bar = {{1, 0, 0}, {0, 0, 1}};
    legend.ticks = {{0.0, "1"}, {1.0, "10"}};
    const Image once = paint_legend(legend, 1.0, {300, 400});
    const Image twice = paint_legend(legend, 2.0, {600, 800});
    CHECK(std::abs(twice.height - 2 * once.height) < 12);
    int red = 0, blue = 0;
    for (int y = 0; y < once.height; ++y) {
        const std::uint8_t* p = once.pixel(12, y);
        if (p[0] > 200 && p[1] < 30) red = y;
        if (p[2] > 200 && p[1] < 30 && blue == 0) blue = y;
    }
    CHECK(blue > 0);
    CHECK(red > blue + 80); // low values below

    legend.swatches.assign(50, {{0, 1, 0}, "name"});
    const Image many = paint_legend(legend, 1.0, {300, 400});
    CHECK(many.height <= 400);

    Frame frame;
    frame.size = {900, 700};
    frame.overlays.legend = legend;
    frame.overlays.scale = Scale{Scale::At::kMiddle, 0.1, 0.0};
    const auto sprites = OverlayPainter().paint(SpriteSource(frame));
    REQUIRE(sprites.size() == 3);
    CHECK(sprites[2].corner.x == sprites[1].corner.x);
    CHECK(sprites[2].corner.y + sprites[2].image.height < sprites[1].corner.y);
    CHECK(sprites[2].corner.y >= 0);
}

TEST_CASE("a point of a centerline") {
    Centerlines lines;
    lines.origin = {1.0, 2.0, 3.0};
    lines.points = {{0, 0, 0, 10}, {4, 0, 0, 14}, {4, 6, 0, 20}};
    lines.details = {{2, 0}, {4, 0}, {4, 0}};
    lines.runs = {{0, 3}, {3, 0}};
    const auto point = lines.at(0, 0.7);
    REQUIRE(point.has_value());
    CHECK(glm::distance(point->position, {5.0, 5.0, 3.0}) < 1e-6);
    CHECK(point->along == glm::dvec3(0, 1, 0));
    CHECK(point->from_root_mm == doctest::Approx(17.0));
    CHECK(lines.at(0, 0.2)->radius_mm == doctest::Approx(1.5));
    CHECK_FALSE(lines.at(1, 0.5).has_value());
    CHECK_FALSE(lines.at(-1, 0.5).has_value());
    CHECK_FALSE(lines.at(7, 0.5).has_value());
}

TEST_CASE("halos darken what lies behind, near the vessel before it; near is red and far is blue") {
    Scene scene(5.0F, 5.0F, true); // the crossing one passes 4 mm before the tube, at x from 5 to 11
    const Image plain = scene.draw();
    scene.frame.appearance.halos = 1.0F;
    const Image halos = scene.draw();
    CHECK(brightness(scene.colour(halos, 11.05, 0.0)) < 0.7 * brightness(scene.colour(plain, 11.05, 0.0))); // seam
    CHECK(brightness(scene.colour(halos, 8.0, 0.0)) == brightness(scene.colour(plain, 8.0, 0.0)));          // in front
    CHECK(brightness(scene.colour(halos, -10.0, 0.0)) == brightness(scene.colour(plain, -10.0, 0.0)));      // far away
    scene.frame.appearance.halos = 0.0F;
    scene.frame.appearance.contours = 1.0F;
    const Image contours = scene.draw();
    CHECK(brightness(scene.colour(contours, -10.0, 4.9)) < 0.75 * brightness(scene.colour(plain, -10.0, 4.9)));
    CHECK(brightness(scene.colour(contours, -10.0, 0.0)) == brightness(scene.colour(plain, -10.0, 0.0)));
    scene.frame.appearance.contours = 0.0F;
    scene.frame.appearance.chromadepth = 1.0F;
    const Image chromatic = scene.draw();
    const std::uint8_t* before = scene.colour(chromatic, 8.0, 0.0);
    const std::uint8_t* behind = scene.colour(chromatic, -10.0, 0.0);
    CHECK(before[0] > before[2] + 40);
    CHECK(int(behind[2]) - int(behind[0]) > int(before[2]) - int(before[0]) + 60);
}

TEST_CASE("a vessel throws a shadow where it stands between another and the light, and nowhere else") {
    Scene scene(5.0F, 5.0F, true, 9.0F); // 1 mm before the tube
    scene.frame.size = {600, 600};
    scene.frame.camera.scale = 0.5 * kPixelMm * scene.frame.size.y;
    const Image plain = scene.draw();
    scene.frame.appearance.shadows = 1.0F;
    const Image shadows = scene.draw();
    const auto share = [&](double x) {
        return double(brightness(scene.colour(shadows, x, 0.0))) / brightness(scene.colour(plain, x, 0.0));
    };
    // The light comes from the upper left, where the patient's right is, and from the front. In the plane across the
    // crossing vessel the tangent that touches it at its left meets the tube at x = 2.0.
    CHECK(share(4.0) < 0.9);
    CHECK(share(4.8) < 0.85);
    CHECK(share(1.0) == doctest::Approx(1.0).epsilon(0.02));
    CHECK(share(-10.0) == doctest::Approx(1.0).epsilon(0.005));
    CHECK(share(8.0) == doctest::Approx(1.0).epsilon(0.005));  // in front
    CHECK(share(12.5) == doctest::Approx(1.0).epsilon(0.005)); // on the side that the light is on
}
