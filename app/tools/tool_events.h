// ToolEvents: tells a tool what the pointer did, in the order in which it did it, once it is known what lies under it.
// Moves come faster than places are looked up: of a tool that picks one is looked up at a time, and then the last that
// came meanwhile. A press or a release comes after all moves before it, and before all moves after it.
#pragma once

#include "app/tools/tool.h"

#include <functional>
#include <memory>
#include <optional>

namespace ramus::app {

class ToolEvents {
public:
    // Does `then` with what lies under a pixel once that is known, or drops it with its tree; one after the other, but
    // what is looked up in `then` goes before what waits.
    using LookUp = std::function<void(glm::dvec2 at, const std::function<void(const render::Pick&)>& then)>;
    using Tell = std::function<void(Tool::Event, const Pointing&)>; // its `under` is known

    ToolEvents(LookUp look_up, Tell tell) : look_up_(std::move(look_up)), tell_(std::move(tell)) {}
    // `picks`: as of the tool. One that does not is told of every move.
    void add(Tool::Event event, const Pointing& pointing, bool picks);
    void abandon(); // another tool was taken: nothing is told of what came before

private:
    void look_up(Tool::Event event, const Pointing& pointing, const std::function<void()>& then);
    void add_next_move();

    LookUp look_up_;
    Tell tell_;
    std::shared_ptr<const int> tool_ = std::make_shared<const int>();
    std::weak_ptr<const int> move_on_its_way_; // until it was told, or a press or a release came after it
    std::optional<Pointing> next_move_;
};

} // namespace ramus::app
