// What a tool is told of, and when, where it is known late what lies under the pointer.
#include "app/actions/command_runner.h"
#include "app/tools/tool_events.h"
#include "tests/support/command_stage.h"

#include <algorithm>
#include <deque>
#include <doctest/doctest.h>
#include <iterator>
#include <string>
#include <vector>

using namespace ramus;
using namespace ramus::app;

namespace {

struct Late {
    test::CommandStage stage{tree::VesselTree{}};
    ToolSettings settings;
    CommandRunner runner{{}};
    std::deque<bool> known; // of each place that was looked up
    std::vector<std::string> told;
    ToolEvents events{[this](glm::dvec2 at, const auto& then) { look_up(at, then); },
                      [this](Tool::Event event, const Pointing& pointing) { tell(event, pointing); }};

    void look_up(glm::dvec2 at, const std::function<void(const render::Pick&)>& then) {
        const std::size_t index = known.size();
        known.push_back(false);
        const auto act = [at, then](ActionContext&) -> Result<void> {
            then(render::Pick{static_cast<int>(at.x), {}});
            return {};
        };
        REQUIRE(runner.await(stage.context, {[this, index] { return known[index]; }, act}));
    }
    void tell(Tool::Event event, const Pointing& pointing) {
        CHECK(pointing.pick().branch == static_cast<int>(pointing.at.x));
        const std::string name = event == &Tool::move ? "move" : event == &Tool::press ? "press" : "release";
        told.push_back(name + " " + std::to_string(pointing.pick().branch));
    }
    void add(Tool::Event event, double x, bool picks = true) {
        events.add(event, {.at = {x, 0.0}, .modifiers = {}, .document = stage.document, .settings = settings}, picks);
    }
    // The first `count` of what was looked up become known.
    void answer(std::size_t count) {
        for (std::size_t i = 0; i < count && i < known.size(); ++i) known[i] = true;
        CHECK(runner.update(stage.context).empty());
    }
    void answer_all() {
        for (int i = 0; i < 20; ++i) answer(known.size());
    }
};
using Words = std::vector<std::string>;

} // namespace

TEST_CASE_FIXTURE(Late, "a tool is told of the last of the moves that came while one was looked up") {
    for (const double x : {1.0, 2.0, 3.0, 4.0}) add(&Tool::move, x);
    CHECK(told.empty());
    CHECK(known.size() == 1);
    answer_all();
    CHECK(told == Words{"move 1", "move 4"});
}

TEST_CASE_FIXTURE(Late, "moves after a press are told after it, whatever was on its way when it came") {
    for (std::size_t moves_before = 0; moves_before <= 3; ++moves_before)
        for (std::size_t answered = 0; answered <= 5; ++answered) {
            CAPTURE(moves_before);
            CAPTURE(answered);
            told.clear();
            known.clear();
            for (std::size_t i = 0; i < moves_before; ++i) add(&Tool::move, static_cast<double>(i));
            add(&Tool::press, 10);
            add(&Tool::move, 11);
            add(&Tool::move, 12);
            answer(answered);
            add(&Tool::move, 13);
            add(&Tool::release, 14);
            add(&Tool::move, 15);
            answer_all();
            const auto place = [&](const std::string& what) { return std::ranges::find(told, what) - told.begin(); };
            CHECK(place("press 10") < place("move 11"));
            CHECK(place("move 11") < place("move 13"));
            CHECK(place("move 13") + 1 == place("release 14"));
            CHECK(told.back() == "move 15");
            for (std::size_t i = 0; i < moves_before; ++i) {
                const auto at = place("move " + std::to_string(i));
                CHECK((at < place("press 10") || at == std::ssize(told)));
            }
            if (moves_before > 0) CHECK(place("move " + std::to_string(moves_before - 1)) + 1 == place("press 10"));
        }
}

TEST_CASE_FIXTURE(Late, "a tool that does not pick is told of every move") {
    add(&Tool::press, 1, false);
    for (const double x : {2.0, 3.0, 4.0}) add(&Tool::move, x, false);
    add(&Tool::release, 4, false);
    answer_all();
    CHECK(told == Words{"press 1", "move 2", "move 3", "move 4", "release 4"});
}

TEST_CASE_FIXTURE(Late, "another tool is told of nothing that came before it was taken") {
    add(&Tool::press, 1);
    for (const double x : {2.0, 3.0}) add(&Tool::move, x);
    events.abandon();
    add(&Tool::move, 5);
    answer_all();
    CHECK(told == Words{"move 5"});
}
