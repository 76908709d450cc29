#include "app/session/tree_edits.h"

#include "app/session/session_file.h"

#include <utility>

namespace ramus::app {

Result<MadeEdit> made_edit(std::shared_ptr<const tree::VesselTree> tree, const tree::Edit& edit) {
    if (!tree) return fail("there is no tree", {}, "open one first");
    RAMUS_TRY(edited, tree::apply(*tree, edit));
    auto facts = std::make_shared<const TreeFacts>(facts_of(edited.tree));
    return MadeEdit{edit, std::move(tree), std::make_shared<const tree::EditedTree>(std::move(edited)),
                    std::move(facts)};
}

Result<std::shared_ptr<const tree::VesselTree>> with_edits(std::shared_ptr<const tree::VesselTree> base,
                                                           const Session& session, const std::string& checksum,
                                                           const std::string& where) {
    if (session.marks.edits.empty()) return base;
    if (auto same = check_checksum(session, checksum, where); !same) return tl::unexpected(same.error());
    auto edited = tree::apply_all(*base, session.marks.edits);
    if (!edited)
        return fail("an edit of the tree cannot be made again: " + edited.error().what, where,
                    "the session belongs to another tree");
    return std::make_shared<const tree::VesselTree>(std::move(*edited));
}

} // namespace ramus::app
