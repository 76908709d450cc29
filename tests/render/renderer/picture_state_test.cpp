// The state of a Renderer's picture, without GL.
#include "render/renderer/picture_state.h"

#include <array>
#include <doctest/doctest.h>
#include <initializer_list>
#include <map>
#include <vector>

using ramus::render::PictureState;
using Stage = PictureState::Stage;
using Event = void (PictureState::*)();

namespace {

constexpr std::array<Stage, 10> kStages{Stage::kEmpty, Stage::kPartial,    Stage::kPartialOverCast, Stage::kAbandoned,
                                        Stage::kCast,  Stage::kDrawn,      Stage::kRefining,        Stage::kFiner,
                                        Stage::kFine,  Stage::kFineInParts};
constexpr std::array<Event, 10> kEvents{
    &PictureState::lose,      &PictureState::begin,         &PictureState::interrupt, &PictureState::finish,
    &PictureState::shade,     &PictureState::shade_changed, &PictureState::cast,      &PictureState::begin_refining,
    &PictureState::show_mean, &PictureState::end_refining};

PictureState after(std::initializer_list<Event> events) {
    PictureState state;
    for (const Event event : events) (state.*event)();
    return state;
}

// Each stage, by a way that leads to it.
std::map<Stage, PictureState> reached() {
    std::map<Stage, PictureState> found{{Stage::kEmpty, PictureState()}};
    std::vector<PictureState> todo{PictureState()};
    while (!todo.empty()) {
        const PictureState from = todo.back();
        todo.pop_back();
        for (const Event event : kEvents) {
            PictureState next = from;
            (next.*event)();
            if (found.try_emplace(next.stage(), next).second) todo.push_back(next);
        }
    }
    return found;
}

} // namespace

TEST_CASE("a picture at rest goes from its first part to the mean of its views") {
    PictureState state;
    CHECK(state.stage() == Stage::kEmpty);
    CHECK_FALSE(state.answers());
    state.begin();
    CHECK(state.stage() == Stage::kPartial);
    CHECK(state.partial());
    CHECK_FALSE(state.answers());
    state.finish();
    CHECK(state.stage() == Stage::kDrawn);
    CHECK(state.held());
    state.begin_refining();
    CHECK(state.stage() == Stage::kRefining);
    state.show_mean();
    state.show_mean();
    CHECK(state.stage() == Stage::kFiner);
    CHECK(state.can_refine());
    state.end_refining();
    CHECK(state.stage() == Stage::kFine);
    CHECK_FALSE(state.can_refine());
    CHECK(state.answers());
}

TEST_CASE("what is shown while another picture is on its way is asked only where the caster made it") {
    PictureState state = after({&PictureState::cast});
    CHECK(state.by_caster());
    state.begin();
    CHECK(state.stage() == Stage::kPartialOverCast);
    CHECK(state.answers());
    state.interrupt();
    CHECK(state.stage() == Stage::kCast);
    state.begin();
    state.finish();
    CHECK_FALSE(state.by_caster());
    state.begin();
    CHECK_FALSE(state.answers());
    state.interrupt(); // the targets have been drawn into
    CHECK(state.stage() == Stage::kAbandoned);
    CHECK_FALSE(state.held());
    CHECK_FALSE(state.answers());
}

TEST_CASE("a mean that was shaded again in parts has to be begun anew") {
    const std::initializer_list<Event> refining{&PictureState::begin, &PictureState::finish,
                                                &PictureState::begin_refining};
    PictureState state = after(refining);
    state.shade_changed(); // nothing but the first view was shown
    CHECK(state.stage() == Stage::kDrawn);
    for (const Event end : {Event(&PictureState::show_mean), Event(&PictureState::end_refining)}) {
        state = after(refining);
        state.show_mean();
        (state.*end)();
        state.shade_changed();
        CHECK(state.stage() == Stage::kFineInParts);
        CHECK(state.can_refine());
        state.shade_changed();
        CHECK(state.stage() == Stage::kFineInParts);
        PictureState again = state;
        again.begin_refining();
        CHECK(again.stage() == Stage::kRefining);
        state.shade();
        CHECK(state.stage() == Stage::kDrawn);
    }
    state = after(refining);
    state.show_mean();
    state.interrupt();
    CHECK(state.stage() == Stage::kFineInParts);
}

TEST_CASE("in every stage, whatever happens, the answers agree with each other") {
    const std::map<Stage, PictureState> all = reached();
    CHECK(all.size() == kStages.size());
    for (const Stage stage : kStages) {
        CAPTURE(int(stage));
        REQUIRE(all.contains(stage));
        const PictureState& state = all.at(stage);
        CHECK(int(state.partial()) + int(state.held()) <= 1);
        CHECK(int(state.by_caster()) + int(state.held()) <= 1);
        CHECK((!state.refining() || state.can_refine()));
        CHECK((!state.can_refine() || state.held()));
        CHECK(state.answers() == (state.held() || state.by_caster()));
        const auto then = [&](Event event) {
            PictureState next = state;
            (next.*event)();
            return next;
        };
        CHECK(then(&PictureState::lose).stage() == Stage::kEmpty);
        CHECK(then(&PictureState::cast).stage() == Stage::kCast);
        CHECK(then(&PictureState::begin).partial());
        CHECK(then(&PictureState::begin).by_caster() == state.by_caster());
        CHECK_FALSE(then(&PictureState::interrupt).partial());
        CHECK_FALSE(then(&PictureState::interrupt).refining());
        for (const Event event :
             {Event(&PictureState::shade), Event(&PictureState::shade_changed), Event(&PictureState::begin_refining),
              Event(&PictureState::show_mean), Event(&PictureState::end_refining)})
            CHECK(then(event).held() == state.held());
    }
}
