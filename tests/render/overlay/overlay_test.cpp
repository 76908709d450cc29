#include "render/image/text.h"
#include "render/overlay/captions.h"
#include "render/overlay/overlay.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numeric>

using namespace ramus::render;

namespace {

// Bright pixels of the letter as a picture of 0 and 1 (faces are dark, letters light).
int bright(const Image& image, int x0, int x1, int y0, int y1) {
    int count = 0;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) count += image.pixel(x, y)[1] > 165 ? 1 : 0;
    return count;
}

std::vector<Sprite> painted(const Frame& frame) { return OverlayPainter().paint(SpriteSource(frame)); }

} // namespace

TEST_CASE("scale bars have round lengths that fit") {
    CHECK(scale_bar_length_mm(9.99) == doctest::Approx(5.0));
    CHECK(scale_bar_length_mm(10.0) == doctest::Approx(10.0));
    CHECK(scale_bar_length_mm(49.0) == doctest::Approx(20.0));
    CHECK(scale_bar_length_mm(0.0031) == doctest::Approx(0.002));
    CHECK(scale_bar_label(20.0) == "20 mm");
    CHECK(scale_bar_label(0.5) == "500 \xb5m");
    CHECK(scale_bar_label(200.0) == "20 cm");
    CHECK(scale_bar_label(1.0) == "1 mm");
}

TEST_CASE("the scale bar is as long as it says") {
    Frame frame;
    frame.size = {900, 700};
    frame.camera.orthographic = true;
    frame.camera.scale = 35.0; // 0.1 mm a pixel: at most 150 pixels, so 10 mm = 100 pixels
    frame.overlays.orientation_cube = false;
    const auto sprites = painted(frame);
    REQUIRE(sprites.size() == 1);
    const Image& bar = sprites[0].image;
    const int row = bar.height - 3; // two pixels of halo below, then the line
    int ink = 0;
    for (int x = 0; x < bar.width; ++x) ink += bar.pixel(x, row)[0] > 200 ? 1 : 0;
    CHECK(ink == 100);
}

TEST_CASE("every letter that overlays need has ink, and they differ from each other") {
    std::vector<Coverage> drawn;
    for (const char c : std::string("0123456789.mcn\xb5RLAPSI")) {
        drawn.push_back(draw_text(std::string(1, c), 24.0));
        CHECK(std::accumulate(drawn.back().values.begin(), drawn.back().values.end(), 0) > 255 * 8);
    }
    for (std::size_t i = 0; i < drawn.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) CHECK(drawn[i].values != drawn[j].values);
    CHECK(draw_text("20 mm", 10.0).width > draw_text("2 mm", 10.0).width);
}

TEST_CASE("the cube shows one face head-on in an anatomical view, and three from a corner") {
    const OrientationCube cube;
    std::vector<Image> faces;
    for (const View view : kViews) {
        const Image face = cube.paint(looking(Camera{}, view), 96);
        CHECK(bright(face, 0, 96, 0, 96) > 60);
        for (const Image& other : faces) CHECK(compare(face, other, 60)->differing > 40);
        faces.push_back(face);
    }
    // An L has its foot at the lower right and its stem at the left: neither mirrored nor upside down.
    const Image left = cube.paint(looking(Camera{}, View::kLeft), 96);
    CHECK(bright(left, 0, 48, 0, 96) > bright(left, 48, 96, 0, 96));
    CHECK(bright(left, 0, 96, 48, 96) > bright(left, 0, 96, 0, 48));
    // A P has its bowl at the upper right.
    const Image back = cube.paint(looking(Camera{}, View::kPosterior), 96);
    CHECK(bright(back, 49, 96, 0, 48) > bright(back, 49, 96, 50, 96) + 5);
    const Image corner = OrientationCube().paint(turned(looking(Camera{}, View::kAnterior), 35.0, 30.0), 96);
    CHECK(corner.pixel(0, 0)[3] == 0); // round about the cube nothing
    CHECK(corner.pixel(48, 48)[3] > 200);
}

TEST_CASE("overlays keep clear of the insets and leave small pictures alone") {
    Frame frame;
    frame.size = {1000, 800};
    frame.overlays.inset_left = 200, frame.overlays.inset_right = 150, frame.overlays.inset_bottom = 90;
    for (const Sprite& sprite : OverlayPainter().paint(SpriteSource(frame))) {
        CHECK(sprite.corner.x >= 200);
        CHECK(sprite.corner.x + sprite.image.width <= 850);
        CHECK(sprite.corner.y + sprite.image.height <= 710);
    }
    frame.size = {90, 60};
    frame.overlays = {};
    CHECK(OverlayPainter().paint(SpriteSource(frame)).empty());
}

TEST_CASE("labels of one place are side by side, and keep clear of what else is written") {
    Frame frame;
    frame.size = {900, 700};
    frame.camera.orthographic = true;
    frame.camera.scale = 35.0;
    frame.overlays.orientation_cube = false;
    const auto labelled = [&](const std::vector<glm::dvec3>& places) {
        frame.labels.clear();
        for (const glm::dvec3& place : places) frame.labels.push_back({frame.camera.focal_point + place, "20.1 mm"});
        return painted(frame);
    };
    const auto overlapping = [](const std::vector<Sprite>& sprites) {
        const auto end = [](const Sprite& s) { return s.corner + glm::ivec2(s.image.width, s.image.height); };
        int count = 0;
        for (std::size_t a = 0; a < sprites.size(); ++a)
            for (std::size_t b = 0; b < a; ++b)
                count += glm::all(glm::lessThan(sprites[a].corner, end(sprites[b]))) &&
                                 glm::all(glm::lessThan(sprites[b].corner, end(sprites[a])))
                             ? 1
                             : 0;
        return count;
    };
    const auto alone = labelled({{}}), five = labelled({{}, {}, {}, {}, {}});
    REQUIRE(five.size() == alone.size() + 4);
    CHECK(five[alone.size() - 1].corner == alone.back().corner); // the first one stays
    CHECK(overlapping(five) == 0);
    const auto at_edge = labelled({{40.0, 30.0, 30.0}, {40.0, 30.0, 30.0}, {-40.0, -30.0, -30.0}});
    CHECK(overlapping(at_edge) == 0);
}

TEST_CASE("letters say which way of the patient a direction goes, the most first") {
    CHECK(orientation_letters({1, 0, 0}) == "R");
    CHECK(orientation_letters({-1, 0.1, 0}) == "L");
    CHECK(orientation_letters(glm::normalize(glm::dvec3(-1, 0.8, 0.1))) == "LA");
    CHECK(orientation_letters(glm::normalize(glm::dvec3(0.7, -0.8, -0.9))) == "IPR");
    Frame frame;
    frame.size = {600, 400};
    frame.camera = looking(Camera{}, View::kAnterior);
    frame.overlays.orientation_cube = frame.overlays.scale_bar = false;
    CHECK(painted(frame).empty());
    frame.overlays.orientation_letters = true;
    CHECK(painted(frame).size() == 4);
    // A caption that is longer than the picture takes more lines, and the letters make way.
    const int letter_top = painted(frame)[2].corner.y;
    frame.overlays.caption = "One line";
    const auto one = painted(frame);
    REQUIRE(one.size() == 5);
    for (int i = 0; i < 20; ++i) frame.overlays.caption += " and some more words";
    const auto more = painted(frame);
    CHECK(more[0].image.height > 2 * one[0].image.height);
    CHECK(more[0].corner.x + more[0].image.width <= frame.size.x);
    CHECK(more[3].corner.y >= more[0].corner.y + more[0].image.height);
    CHECK(letter_top < one[3].corner.y);
    // Who draws something below the caption knows where it ends.
    CHECK(OverlayPainter().caption_bottom(SpriteSource(frame)) == more[0].corner.y + more[0].image.height);
    frame.overlays.caption.clear();
    CHECK(OverlayPainter().caption_bottom(SpriteSource(frame)) == 0);
}

TEST_CASE("a heading is as large as a picture has room for") {
    const std::string words = "Isosurface of the tree's voxels 50 %, truncated cones 50 %";
    Frame frame;
    frame.size = {800, 600};
    const Image large = OverlayPainter().heading(words, SpriteSource(frame));
    CHECK(large.width < 800);
    frame.size = {300, 200};
    const Image small = OverlayPainter().heading(words, SpriteSource(frame));
    CHECK(small.width <= 300 - 2 * 6);      // margins of 3 % of the height
    CHECK(small.height < 2 * large.height); // two lines, of smaller letters
    frame.overlays.heading = words;
    const auto sprites = painted(frame);
    REQUIRE(sprites.size() == 2); // the cube; no scale bar, since nobody has said of what
    CHECK(sprites.back().image == small);
}
