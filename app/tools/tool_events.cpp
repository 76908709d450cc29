#include "app/tools/tool_events.h"

namespace ramus::app {

void ToolEvents::add(Tool::Event event, const Pointing& pointing, bool picks) {
    const bool move = event == &Tool::move;
    if (!move) {
        add_next_move();
        move_on_its_way_.reset(); // what moves from now on is told after this
    }
    if (!move || !picks) return look_up(event, pointing, [] {});
    if (!move_on_its_way_.expired()) {
        next_move_.emplace(pointing);
        return;
    }
    const auto on_its_way = std::make_shared<const int>(); // gone as well where what is looked up is dropped
    move_on_its_way_ = on_its_way;
    look_up(event, pointing, [this, on_its_way] {
        if (move_on_its_way_.lock() == on_its_way) add_next_move();
    });
}

void ToolEvents::look_up(Tool::Event event, const Pointing& pointing, const std::function<void()>& then) {
    const std::weak_ptr<const int> its_tool = tool_;
    look_up_(pointing.at, [this, event, pointing, then, its_tool](const render::Pick& under) {
        if (its_tool.expired()) return;
        Pointing known = pointing;
        known.under = under;
        tell_(event, known);
        if (!its_tool.expired()) then();
    });
}

void ToolEvents::add_next_move() {
    move_on_its_way_.reset();
    const auto next = std::exchange(next_move_, std::nullopt);
    if (next) add(&Tool::move, *next, true);
}

void ToolEvents::abandon() {
    tool_ = std::make_shared<const int>();
    move_on_its_way_.reset();
    next_move_.reset();
}

} // namespace ramus::app
