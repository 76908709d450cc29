// What an edit of the tree (core/tree/edit_tree.h) means for what people have marked on it: branches get other ids, and
// marks follow the vessel that they were put on.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/edit_tree.h"

#include <memory>

namespace ramus::app {

// A new branch is selected, and has the state, as the old one that it mostly is. A name goes to the part nearest to the
// root. Cuts and measurements stay where they are in space, and go where their vessel has gone.
[[nodiscard]] Marks carried_over(const Marks& marks, const tree::VesselTree& before, const tree::EditedTree& after);

// What an edit makes of a tree.
struct MadeEdit {
    tree::Edit edit;
    std::shared_ptr<const tree::VesselTree> before;
    std::shared_ptr<const tree::EditedTree> after;
    std::shared_ptr<const TreeFacts> facts; // of that
};
// On any thread: it takes about a millisecond for a thousand segments. Fails as tree::apply().
[[nodiscard]] Result<MadeEdit> made_edit(std::shared_ptr<const tree::VesselTree> tree, const tree::Edit& edit);

// The tree of the file with a session's edits; the same pointer where there are none. Fails when the file is not the
// one that was edited (`checksum`: its own). `where` names the session in the message.
[[nodiscard]] Result<std::shared_ptr<const tree::VesselTree>> with_edits(std::shared_ptr<const tree::VesselTree> base,
                                                                         const Session& session,
                                                                         const std::string& checksum,
                                                                         const std::string& where);

} // namespace ramus::app
