// Warnings about the tree and about actions: what reading its file assumed, repaired or found implausible, files that
// were not written, a surface that is shown coarser than it is. A warning stays unread until a person reads it, and
// stays in the list afterwards; repeated warnings are merged. Plain values, no window.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct Warning {
    std::string what;      // a sentence or more
    std::string where;     // a file, a place in one, or a vessel; empty: the tree as a whole
    std::string remedy;    // what to do
    std::string command{}; // command for the remedy: "doctor"; empty: none
    bool of_tree = false;  // removed with the tree
    bool read = false;
    [[nodiscard]] bool same_as(const Warning& other) const { return what == other.what && where == other.where; }
};

class WarningList {
public:
    [[nodiscard]] const std::vector<Warning>& all() const { return list_; } // newest last
    [[nodiscard]] std::size_t unread() const;
    // A repeated warning moves to the end and becomes unread.
    void add(Warning warning);
    void add(const Error& error) { add(Warning{error.what, error.where, error.hint}); }
    // Replaces the notes of the previous tree by those of this tree; notes that were read stay read.
    void follow(const std::shared_ptr<const tree::VesselTree>& tree, const std::string& file);
    void mark_read(std::size_t index);
    void mark_all_read();

private:
    std::vector<Warning> list_;
    std::shared_ptr<const tree::VesselTree> tree_;
};

// One warning per topic of the tree's notes.
[[nodiscard]] std::vector<Warning> warnings_of(const tree::VesselTree& tree, const std::string& file);

} // namespace ramus::app
