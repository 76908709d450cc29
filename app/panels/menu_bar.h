// The menus of the bar.
#pragma once

#include <string>

namespace ramus::app {

struct BarMenus {
    bool wanted = false, open = false, close = false; // to be opened; open; to be closed
    int keys = 0;                                     // frames for which menus have the arrow keys
    bool by_keys = false;                             // F10 has opened them: the arrows stay theirs between two menus
    bool focused = false;                             // the bar has the keyboard
    std::string open_name;                            // of the open menu; empty: none
    bool entry = false;                               // an arrow has gone from the menu into its entries
    int step = 0;                                     // how many menus further left and right lead
    // Whether left and right lead from menu to menu.
    [[nodiscard]] bool steps() const { return by_keys && !open_name.empty() && !entry; }
    [[nodiscard]] bool have_keys() const { return wanted || keys > 0; }
};

} // namespace ramus::app
