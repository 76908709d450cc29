// Makes edits of a session's tree (core/tree/edit_tree.h), with the facts of the result.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/session.h"
#include "core/base/error.h"
#include "core/tree/edit_tree.h"

#include <memory>

namespace ramus::app {

// An edit with its result.
struct MadeEdit {
    tree::Edit edit;
    std::shared_ptr<const tree::VesselTree> before;
    std::shared_ptr<const tree::EditedTree> after;
    std::shared_ptr<const TreeFacts> facts; // of `after`
};
// Thread-safe. Takes about a millisecond per thousand segments. Fails as tree::apply().
[[nodiscard]] Result<MadeEdit> made_edit(std::shared_ptr<const tree::VesselTree> tree, const tree::Edit& edit);

// Applies a session's edits to the file's tree; returns the same pointer if there are none. Fails if the file is not
// the one that was edited (`checksum`: of the current file). `where` names the session in errors.
[[nodiscard]] Result<std::shared_ptr<const tree::VesselTree>> with_edits(std::shared_ptr<const tree::VesselTree> base,
                                                                         const Session& session,
                                                                         const std::string& checksum,
                                                                         const std::string& where);

} // namespace ramus::app
