// The table of what undo covers: one row for each member of Marks holds all that the program knows of the member: its
// entries in a session file, whether it is a look, how many there may be, which files it names, and what becomes of it
// when the tree changes. Session files, undo, limits and edits of the tree read this table; a member without a row does
// not compile.
#pragma once

#include "app/session/member_change.h"
#include "app/session/session.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

class BranchMap; // app/session/carry_over.h

// One key of a session file.
struct MarksEntry {
    std::string key;
    // The value; null: the entry is left out. `folder` is the session file's.
    std::function<nlohmann::json(const Marks&, const std::filesystem::path& folder)> write;
    // Called when the file has the key. Throws Refusal (app/session/json_values.h).
    std::function<void(const nlohmann::json&, const std::filesystem::path& folder, Marks&)> read;
    // What a file without the key means, where that is not the default.
    std::function<void(Marks&)> absent{};
};

enum class MarksPlace : std::uint8_t { kSession, kOptions }; // top level of the file, or its object "options"

struct MarksRow {
    std::vector<MarksEntry> entries;
    MarksPlace place = MarksPlace::kSession;
    // A look says how the tree is viewed: undo covers it, but a new look never discards what was undone, and closing
    // the program loses no work with it.
    bool is_look = false;
    std::size_t most = 0;         // of a list; 0: no list, or no limit
    std::string_view noun{};      // of the list's elements, in messages
    std::string_view file_noun{}; // of those that are files, of which there may be kMostShapes
    void (*add_files)(const Marks&, std::vector<std::filesystem::path>&) = nullptr; // that it names
    int (*largest_branch)(const Marks&) = nullptr;                                  // the largest id that it names
    // Brings the value to another tree, and returns how many marks were lost. Null: the value stays as it is.
    std::size_t (*carry)(Marks& marks, const BranchMap& map) = nullptr;

    // The difference for undo; unless a row says another one, that of the member's type (member_change()).
    std::shared_ptr<const MemberChange> (*change)(const Marks& before, const Marks& after) = nullptr;

    // Follow from the member's type.
    bool (*same)(const Marks&, const Marks&) = nullptr;
    void (*take)(Marks& to, const Marks& from) = nullptr; // copies the member
    std::size_t (*count)(const Marks&) = nullptr;         // of a list
    const void* (*address)(const Marks&) = nullptr;

    template <class T> [[nodiscard]] bool is(T Marks::*member) const {
        static const Marks any;
        return address(any) == &(any.*member);
    }
};

[[nodiscard]] std::span<const MarksRow> marks_table();

} // namespace ramus::app
