// What every kind of object of the scene can do: colour, opacity, its place in the camera, and its place under the
// pointer.
#include "app/picture/scene_objects.h"
#include "tests/support/context_stage.h"

#include <algorithm>

using namespace ramus;
using namespace ramus::app;

namespace {

struct ObjectsStage : test::ContextStage {
    ObjectsStage() {
        commands.good("lesion 8,0,10,3\nlesion-mesh \"" + ball("tumour.stl", {0, 30, 10}) + "\"\ncontext \"" +
                      ball("organ.stl", {40, 0, 10}) + "\"\nmeasure distance 0,0,0 0,0,20\npin 5,3,5 \"first\"");
    }
    void look() {
        const std::vector<glm::vec3> corners{{-15, -15, -5}, {15, 15, 35}};
        commands.document.set_camera(render::camera_for(corners, render::View::kAnterior, commands.host.size));
    }
    [[nodiscard]] render::Frame frame() {
        return compose(commands.document.session(), commands.current_assets(), nullptr, {.size = commands.host.size});
    }
    [[nodiscard]] std::optional<ObjectPlace> under(const glm::dvec3& at, const render::Pick& pick = {}) {
        const render::Camera& camera = commands.document.session().camera;
        const auto pixel = render::project(camera, commands.host.size, at);
        REQUIRE(pixel);
        return object_under({camera, commands.host.size, 1.0F, glm::dvec2(*pixel), pick}, commands.current_assets(),
                            commands.marks());
    }
};

// Each kind with the number of one of its objects, and the middle of that.
struct One {
    const char* object;
    glm::dvec3 middle;
};
const std::vector<One> kEach{{"lesion 1", {8, 0, 10}},
                             {"lesion 2", {0, 30, 10}},
                             {"context 1", {40, 0, 10}},
                             {"measurement 1", {0, 0, 10}},
                             {"pin 1", {5, 3, 5}}};

int in_colour(const render::Frame& frame, const glm::vec3& colour) {
    const auto is = [&](const auto& thing) {
        return glm::all(glm::lessThan(glm::abs(thing.colour - colour), glm::vec3(1e-4F)));
    };
    return static_cast<int>(std::ranges::count_if(frame.lesions.looks, is) + std::ranges::count_if(frame.context, is) +
                            std::ranges::count_if(frame.lines, is));
}

} // namespace

TEST_CASE("every kind of object has a colour, and only surfaces an opacity") {
    ObjectsStage stage;
    const glm::vec3 colour = glm::vec3(0x12, 0xcc, 0x34) / 255.0F;
    CHECK(in_colour(stage.frame(), colour) == 0);
    for (const One& one : kEach) {
        CAPTURE(std::string(one.object));
        const std::string which = one.object;
        stage.commands.good("object-colour " + which + " 12cc34");
        CHECK(in_colour(stage.frame(), colour) > 0);
        stage.commands.good("undo");
        CHECK(in_colour(stage.frame(), colour) == 0);
        if (which.starts_with("lesion") || which.starts_with("context"))
            stage.commands.good("object-opacity " + which + " 0.5");
        else
            CHECK(stage.commands.bad("object-opacity " + which + " 0.5").find("no opacity") != std::string::npos);
    }
    CHECK(stage.frame().lesions.looks.at(1).opacity == 0.5F);
    CHECK(stage.frame().context.at(0).opacity == 0.5F);
    for (const char* line :
         {"object-colour lesion 1 red", "object-colour lesion 9 12cc34", "object-colour house 1 12cc34",
          "object-colour lesion 1", "object-opacity lesion 1 2", "object-centre pin 2"})
        stage.commands.bad(line);
}

TEST_CASE("a hidden lesion is invisible, and its margins stay") {
    ObjectsStage stage;
    stage.commands.good("colour-by lesion\nobject-hide lesion 1\nobject-hide lesion 2");
    const render::Frame frame = stage.frame();
    REQUIRE(frame.lesions.spheres.size() == 1);
    CHECK(frame.lesions.looks.at(0).opacity == 0.0F);
    CHECK(frame.lesions.meshes.empty());
    CHECK_FALSE(frame.margins.bands.empty());
}

TEST_CASE("an object comes into the middle of the picture, whatever its kind") {
    ObjectsStage stage;
    for (const One& one : kEach) {
        CAPTURE(std::string(one.object));
        stage.commands.good("object-centre " + std::string(one.object));
        const glm::dvec3 middle = stage.commands.document.session().camera.focal_point;
        CHECK(glm::distance(middle, one.middle) < 0.01);
    }
}

TEST_CASE("the object under the pointer, in front of others and only where it is visible") {
    ObjectsStage stage;
    stage.look();
    CHECK(stage.under({5, 3, 5})->kind == Pin::kNoun);
    CHECK(glm::distance(stage.under({5, 3, 5})->at, glm::dvec3(5, 3, 5)) < 1e-9);
    const auto line = stage.under({0, 0, 13});
    REQUIRE(line);
    CHECK(line->kind == Measurement::kNoun);
    CHECK(glm::distance(line->at, glm::dvec3(0, 0, 13)) < 0.05);
    CHECK_FALSE(stage.under({-30, 0, 0}));
    // What the picture says of lesions: the first in the frame, then the second.
    for (const int lesion : {0, 1}) {
        const auto found = stage.under({-30, 0, 0}, {.lesion = lesion, .position = {1, 2, 3}});
        REQUIRE(found);
        CHECK(*found == ObjectPlace{Lesion::kNoun, static_cast<std::size_t>(lesion), {1, 2, 3}});
    }
    CHECK(stage.under({5, 3, 5}, {.lesion = 0})->kind == Pin::kNoun);
    stage.commands.good("object-hide pin 1");
    CHECK(stage.under({5, 3, 5}, {.lesion = 0})->kind == Lesion::kNoun);
    stage.commands.good("object-hide lesion 1"); // it keeps its number in the frame
    CHECK_FALSE(stage.under({-30, 0, 0}, {.lesion = 0}));
    CHECK(stage.under({-30, 0, 0}, {.lesion = 1})->index == 1);
}

TEST_CASE("rows say what an object is, its value, and what is wrong") {
    ObjectsStage stage;
    const auto words = [&](const char* kind, std::size_t index) {
        return words_of({kind, index, {}}, stage.commands.marks(), stage.commands.current_assets(),
                        stage.commands.document.lengths());
    };
    CHECK(words("lesion", 0).title == "Lesion 1");
    CHECK(words("lesion", 0).value == "\xC3\x98 6.00 mm");
    CHECK(words("lesion", 1).title == "tumour.stl");
    CHECK(words("context", 0).title == "organ.stl");
    CHECK(words("measurement", 0).title == "Distance");
    CHECK(words("measurement", 0).value == "20.0 mm");
    CHECK(words("pin", 0).title == "first");
    stage.commands.good("object-name context 1 liver\nobject-name measurement 1 stem");
    CHECK(words("context", 0).title == "liver");
    CHECK(words("measurement", 0).title == "stem");
}
