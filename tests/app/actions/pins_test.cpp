// Pins: texts at places, and what all objects of the scene have in common.
#include "app/reports/report_page.h"
#include "app/reports/table_kinds.h"
#include "app/session/session_file.h"
#include "tests/support/built_tree.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>

using namespace ramus;
using namespace ramus::app;

namespace {

struct PinStage : test::CommandStage {
    PinStage() : CommandStage(test::built_tree({{{0, 0, 0}, 2.0}, {{0, 0, 40}, 2.0}}, {{0, 1}})) {}
};

} // namespace

TEST_CASE("a pin is set, moved, named, hidden and removed, each as one step of undo") {
    PinStage stage;
    const Marks before = stage.marks();
    stage.good("pin 1,2,3 \"left portal vein\"");
    REQUIRE(stage.marks().pins.size() == 1);
    CHECK(stage.marks().pins[0].name == "left portal vein");
    stage.good("pin-move 1 4,5,6");
    CHECK(stage.marks().pins[0].at == glm::dvec3(4, 5, 6));
    stage.good("object-name pin 1 \"right portal vein\"");
    CHECK(stage.marks().pins[0].name == "right portal vein");
    stage.good("object-hide pin 1");
    CHECK_FALSE(stage.marks().pins[0].visible);
    stage.good("object-show pin 1");
    stage.good("object-remove pin 1");
    CHECK(stage.marks().pins.empty());
    for (int step = 0; step < 6; ++step) stage.good("undo");
    CHECK(stage.marks() == before);
}

TEST_CASE("invalid pins and unknown objects are refused") {
    PinStage stage;
    CHECK(stage.bad("pin 1,2").find("X,Y,Z") != std::string::npos);
    CHECK(stage.bad("pin-move 1 1,2,3").find("no pin") != std::string::npos);
    CHECK(stage.bad("object-hide lesion 1").find("no lesion") != std::string::npos);
    stage.good("pin 1,2,3 here");
    CHECK(stage.bad("object-hide pin 2").find("from 1 to 1") != std::string::npos);
    CHECK(stage.bad("object-hide thing 1").find("lesion|context|measurement|pin|resection|scan N") !=
          std::string::npos);
    CHECK(stage.bad("object-name pin 1").find("name") != std::string::npos);
}

TEST_CASE("objects of all kinds are shown, named and removed in the same way") {
    PinStage stage;
    stage.good("lesion 0,0,0,3\nmeasure distance lesion:1@0,0,3 1,1,1\nmeasure distance 0,0,0 1,1,1\npin 0,0,1 x");
    for (const char* kind : {"lesion", "measurement", "pin"}) {
        stage.good("object-hide " + std::string(kind) + " 1");
        stage.good("object-name " + std::string(kind) + " 1 \"a name\"");
    }
    for_each_object(stage.marks(), [&](const SceneObject auto& object) {
        if (object.id == stage.marks().measurements[1].id) return;
        CHECK_FALSE(object.visible);
        CHECK(object.name == "a name");
    });
    // A lesion goes with what is measured from it.
    stage.good("object-remove lesion 1");
    CHECK(stage.marks().measurements.size() == 1);
}

TEST_CASE("the ids of objects do not change when other objects are removed") {
    PinStage stage;
    stage.good("pin 0,0,0 a\npin 0,0,0 b\nlesion 0,0,0,3");
    const int second = stage.marks().pins[1].id;
    stage.good("object-remove pin 1\npin 0,0,0 c");
    CHECK(stage.marks().pins[0].id == second);
    CHECK(stage.marks().pins[1].id != second);
    CHECK(stage.marks().pins[1].id != stage.marks().lesions[0].id);
}

TEST_CASE("a pin is restored from a session file, and listed in a report") {
    PinStage stage;
    stage.good("pin 1.5,-2,1e-7 \"an \\\"odd\\\" one\"\npin 0,0,0 b\nobject-hide pin 2");
    const auto& session = stage.document.session();
    const auto read = session_from_json(to_json(session, "/"), "/", "session");
    REQUIRE(read);
    CHECK(read->session.marks.pins == stage.marks().pins);
    const Table table = table_kind_named("pins")->table(stage.document, stage.assets);
    CHECK(table.rows.size() == 2);
}
