#include "render/scene/camera.h"
#include "tests/support/aslant_camera.h"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <nlohmann/json.hpp>

using namespace ramus::render;

namespace {

const glm::ivec2 kSize(800, 600);

bool near(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-9) {
    return glm::distance(a, b) <= tolerance;
}

} // namespace

TEST_CASE("anatomical views show the patient as a radiologist expects") {
    // RAS: +x right, +y anterior, +z superior; what lies toward the viewer, at the right and at the top of the picture.
    const glm::dvec3 r(1, 0, 0), l(-1, 0, 0), a(0, 1, 0), p(0, -1, 0), s(0, 0, 1), i(0, 0, -1);
    struct Expected {
        View view;
        glm::dvec3 toward_viewer, at_right, at_top;
    };
    for (const Expected& e : {Expected{View::kAnterior, a, l, s},
                              {View::kPosterior, p, r, s},
                              {View::kLeft, l, p, s},
                              {View::kRight, r, a, s},
                              {View::kSuperior, s, r, a},
                              {View::kInferior, i, l, a}}) {
        CAPTURE(name_of(e.view));
        const CameraAxes axes = axes_of(looking(ramus::test::aslant_camera(), e.view));
        CHECK(near(-axes.forward, e.toward_viewer));
        CHECK(near(axes.right, e.at_right));
        CHECK(near(axes.up, e.at_top));
        CHECK(view_named(name_of(e.view)) == e.view);
    }
    CHECK_FALSE(view_named("front").has_value());
}

TEST_CASE("projecting and unprojecting are each other's inverse, and agree with the matrices") {
    for (const bool orthographic : {false, true}) {
        const Camera camera = ramus::test::aslant_camera(orthographic);
        const glm::dvec3 point(25.0, -4.0, 41.0);
        const auto pixel = project(camera, kSize, point);
        REQUIRE(pixel.has_value());
        CHECK(near(unproject(camera, kSize, glm::dvec2(*pixel), pixel->z), point, 1e-8));
        const glm::dvec4 clip =
            projection_matrix(camera, kSize, 1.0, 1000.0) * (view_matrix(camera) * glm::dvec4(point, 1.0));
        CHECK((0.5 + 0.5 * clip.x / clip.w) * kSize.x == doctest::Approx(pixel->x));
        CHECK((0.5 - 0.5 * clip.y / clip.w) * kSize.y == doctest::Approx(pixel->y));
    }
    CHECK_FALSE(project(ramus::test::aslant_camera(), kSize,
                        ramus::test::aslant_camera().position - axes_of(ramus::test::aslant_camera()).forward)
                    .has_value());
}

TEST_CASE("a fitted camera shows all points, touching the margin on one axis") {
    const std::vector<glm::vec3> points{{-40, 3, 7}, {60, -12, 80}, {11, 45, -9}, {0, 0, 0}};
    for (const bool orthographic : {false, true}) {
        for (const View view : kViews) {
            const Camera camera = camera_for(points, view, kSize, orthographic);
            double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
            for (const glm::vec3& point : points) {
                const auto pixel = project(camera, kSize, glm::dvec3(point));
                REQUIRE(pixel.has_value());
                left = std::min(left, pixel->x), right = std::max(right, pixel->x);
                top = std::min(top, pixel->y), bottom = std::max(bottom, pixel->y);
            }
            CAPTURE(name_of(view));
            CHECK(left >= 0.0);
            CHECK(right <= kSize.x);
            CHECK(top >= 0.0);
            CHECK(bottom <= kSize.y);
            // The margin is 3 % of the picture at each side.
            CHECK(std::max((right - left) / kSize.x, (bottom - top) / kSize.y) ==
                  doctest::Approx(1.0 / 1.06).epsilon(1e-3));
        }
    }
}

TEST_CASE("an empty or flat scene still has a camera") {
    const Camera empty = fitted(Camera{}, Box{}, kSize);
    CHECK(glm::distance(empty.position, empty.focal_point) > 0.1);
    const std::vector<glm::vec3> one_point{{5, 6, 7}};
    const Camera flat = camera_for(one_point, View::kLeft, kSize);
    CHECK(near(flat.focal_point, {5, 6, 7}));
    CHECK(glm::distance(flat.position, flat.focal_point) > 0.01);
}

TEST_CASE("turning keeps the distance and the focal point, and the axes stay orthonormal") {
    Camera camera = ramus::test::aslant_camera();
    const double distance = glm::distance(camera.position, camera.focal_point);
    for (int i = 0; i < 500; ++i) camera = turned(camera, 4.25, -3.7);
    CHECK(glm::distance(camera.position, camera.focal_point) == doctest::Approx(distance));
    CHECK(camera.focal_point == ramus::test::aslant_camera().focal_point);
    const CameraAxes axes = axes_of(camera);
    CHECK(glm::dot(axes.up, axes.forward) == doctest::Approx(0.0));
    CHECK(near(axes.up, camera.view_up));
}

TEST_CASE("zooming never reaches the focal point, whatever the factor") {
    Camera camera = ramus::test::aslant_camera();
    for (int i = 0; i < 2000; ++i) camera = zoomed(camera, 1.5);
    CHECK(glm::distance(camera.position, camera.focal_point) > 0.0);
    CHECK(zoomed(ramus::test::aslant_camera(), 0.0) == ramus::test::aslant_camera());
    CHECK(zoomed(ramus::test::aslant_camera(), -1.0) == ramus::test::aslant_camera());
    CHECK(zoomed(ramus::test::aslant_camera(), std::numeric_limits<double>::quiet_NaN()) ==
          ramus::test::aslant_camera());
}

TEST_CASE("changing the projection keeps the size at the focal point") {
    const Camera camera = ramus::test::aslant_camera();
    const Camera parallel = with_projection(camera, true);
    CHECK(mm_per_pixel(parallel, kSize) == doctest::Approx(mm_per_pixel(camera, kSize)));
    CHECK(near(with_projection(zoomed(parallel, 2.0), false).position, zoomed(camera, 2.0).position, 1e-6));
}

TEST_CASE("between two cameras the ends are exact and the way is smooth") {
    const Camera from = looking(ramus::test::aslant_camera(), View::kAnterior),
                 to = looking(ramus::test::aslant_camera(), View::kLeft);
    CHECK(interpolated(from, to, 0.0) == from);
    CHECK(interpolated(from, to, 1.0) == to);
    const Camera middle = interpolated(from, to, 0.5);
    CHECK(near(-axes_of(middle).forward, glm::normalize(glm::dvec3(-1, 1, 0)), 1e-9));
    CHECK(glm::distance(middle.position, middle.focal_point) ==
          doctest::Approx(glm::distance(from.position, from.focal_point)));
}

TEST_CASE("a camera survives its JSON to the last bit") {
    Camera camera = ramus::test::aslant_camera(true);
    camera.position.x = 0.1 + 0.2;
    camera.view_angle = 29.999999999999996;
    const auto again = parse_camera(to_json(camera).dump(), "test");
    REQUIRE(again.has_value());
    CHECK(*again == camera);
    CHECK(parse_camera("{}", "test").value() == Camera{});
}

TEST_CASE("cameras that cannot be drawn are refused with a reason") {
    for (const char* text : {"", "[]", "{\"position\": [1, 2]}", "{\"position\": [1, 2, \"x\"]}", "{\"zoom\": 2}",
                             "{\"view_angle\": 0}", "{\"view_angle\": 180}", "{\"scale\": -1}", "{\"orthographic\": 1}",
                             "{\"position\": [0, 0, 0]}", "{\"view_up\": [0, 1, 0]}", "{\"view_up\": [0, 0, 0]}",
                             "{\"scale\": 1e999}", "{\"position\": [1e300, 0, 0]}"}) {
        CAPTURE(text);
        const auto camera = parse_camera(text, "here.json");
        REQUIRE_FALSE(camera.has_value());
        CHECK(camera.error().where == "here.json");
        CHECK_FALSE(camera.error().hint.empty());
    }
}
