// Edits of a session's tree (core/tree/edit_tree.h): made once, with what else follows from the new tree.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/edit_tree.h"

#include <memory>

namespace ramus::app {

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
