// The table of all user commands: name, keys, help and action. Menus, keys, `--commands` files, the help overlay and
// tests read it; app/actions/command_runner.h runs its entries.
#pragma once

#include "app/actions/action.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

struct Command {
    std::string name;              // as in a commands file
    std::string arguments;         // "ID...", "[FILE]", "NAME"; empty: none
    std::string help;              // one sentence
    std::string menu;              // its menu; empty: none
    std::string submenu;           // its submenu; empty: directly in the menu
    std::string label;             // its text in the menu
    std::vector<std::string> keys; // "Ctrl+Z"; the first one is shown in the menu
    CommandAction action;
    std::vector<std::string> preset;                                  // arguments given by menu and keys
    bool (*enabled)(const Document&) = nullptr;                       // null: always
    std::function<bool(const Document&)> checked;                     // empty: not a switch
    std::function<bool(const ActionContext&, const Command&)> in_use; // a switch of the interface
    std::string (*label_now)(const Document&) = nullptr;              // the label, if it depends on the document
    [[nodiscard]] bool scripted() const { return preset.empty(); } // false: an entry that presets arguments of another

    // For tables: Command("fit", "", "Brings ...", fit).in_menu("View", "Fit", {"F"}).when(has_tree).
    Command(std::string its_name, std::string its_arguments, std::string its_help, CommandAction its_action)
        : name(std::move(its_name)), arguments(std::move(its_arguments)), help(std::move(its_help)),
          action(std::move(its_action)) {}
    Command in_menu(std::string its_menu, std::string its_label, std::vector<std::string> its_keys = {}) && {
        menu = std::move(its_menu), label = std::move(its_label), keys = std::move(its_keys);
        return std::move(*this);
    }
    Command in_submenu(std::string its_submenu) && { return with(&Command::submenu, std::move(its_submenu)); }
    Command on_keys(std::vector<std::string> its_keys) && { return with(&Command::keys, std::move(its_keys)); }
    Command giving(std::vector<std::string> words) && { return with(&Command::preset, std::move(words)); }
    Command when(bool (*is)(const Document&)) && { return with(&Command::enabled, is); }
    Command checked_when(std::function<bool(const Document&)> is) && { return with(&Command::checked, std::move(is)); }
    Command in_use_when(std::function<bool(const ActionContext&, const Command&)> is) && {
        return with(&Command::in_use, std::move(is));
    }
    Command labelled(std::string (*now)(const Document&)) && { return with(&Command::label_now, now); }

private:
    template <class Value> Command with(Value Command::*member, Value value) {
        this->*member = std::move(value);
        return std::move(*this);
    }
};

// In the order of menus and help. Entries with different presets may have the same name: the views.
[[nodiscard]] const std::vector<Command>& command_table();
[[nodiscard]] const Command* find_command(std::string_view name);
[[nodiscard]] const Command* command_for_key(std::string_view key); // "Ctrl+Shift+Z"
[[nodiscard]] std::string label_of(const Command& command, const Document& document);

} // namespace ramus::app
