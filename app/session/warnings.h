// What a person should know of the tree and of what was done: what reading its file assumed, repaired and finds
// strange, files that were not written, a surface that is shown coarser than it is. A warning stays until somebody has
// read it, and stays in the list after that; the same thing is not told twice. Values only, no window.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct Warning {
    std::string what;      // one sentence, or a few
    std::string where;     // a file, a place in one, or a vessel; empty: the tree as a whole
    std::string remedy;    // what can be done
    std::string command{}; // that leads there: "doctor"; empty: none
    bool of_tree = false;  // it goes with the tree
    bool read = false;
    [[nodiscard]] bool same_as(const Warning& other) const { return what == other.what && where == other.where; }
};

class WarningList {
public:
    [[nodiscard]] const std::vector<Warning>& all() const { return list_; } // the newest last
    [[nodiscard]] std::size_t unread() const;
    // One that is there, read or not, comes to the end and is unread again.
    void add(Warning warning);
    void add(const Error& error) { add(Warning{error.what, error.where, error.hint}); }
    // The notes of this tree take the place of those of the one before; what was read of them stays read.
    void follow(const std::shared_ptr<const tree::VesselTree>& tree, const std::string& file);
    void mark_read(std::size_t index);
    void mark_all_read();

private:
    std::vector<Warning> list_;
    std::shared_ptr<const tree::VesselTree> tree_;
};

// A warning for each topic of the tree's notes.
[[nodiscard]] std::vector<Warning> warnings_of(const tree::VesselTree& tree, const std::string& file);

} // namespace ramus::app
