// The table of marks: one row per member of Marks with everything the program knows about it: its entries in a session
// file, whether it is a look, its limits, the files it names, and how it is carried to another tree. Session files,
// undo, limits and edits of the tree read this table. A test fails if a member has no row.
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
    // Returns the value; null omits the entry. `folder`: of the session file.
    std::function<nlohmann::json(const Marks&, const std::filesystem::path& folder)> write;
    // Called if the file has the key. Throws Refusal (app/session/json_values.h).
    std::function<void(const nlohmann::json&, const std::filesystem::path& folder, Marks&)> read;
    // Called if the file lacks the key; only needed if that does not mean the default.
    std::function<void(Marks&)> absent{};
};

enum class MarksPlace : std::uint8_t { kSession, kOptions }; // top level of the file, or its object "options"

struct MarksRow {
    std::vector<MarksEntry> entries;
    MarksPlace place = MarksPlace::kSession;
    // A look says how the tree is viewed: undo covers it, but a new look never discards what was undone, and closing
    // the program loses no work with it.
    bool is_look = false;
    std::size_t most = 0;         // largest size of a list; 0: not a list, or no limit
    std::string_view noun{};      // of the list's elements, in messages
    std::string_view file_noun{}; // of the elements that are files; at most kMostShapes
    void (*add_files)(const Marks&, std::vector<std::filesystem::path>&) = nullptr; // appends the files that it names
    int (*largest_branch)(const Marks&) = nullptr; // the largest branch id that it names
    // Carries the value to another tree and returns how many marks were lost. Null: the value stays as it is.
    std::size_t (*carry)(Marks& marks, const BranchMap& map) = nullptr;

    // The difference for undo; by default member_change() for the member's type.
    std::shared_ptr<const MemberChange> (*change)(const Marks& before, const Marks& after) = nullptr;

    // Derived from the member's type.
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
