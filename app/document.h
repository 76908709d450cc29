// Document: the session that is open, the tree it is about, and the way back. Every change of what undo covers goes
// through change(), which remembers the value before; the camera and files are not covered. No GL, no window.
#pragma once

#include "app/branch_facts.h"
#include "app/plan.h"
#include "app/session.h"

#include <cstdint>
#include <memory>

namespace ramus::app {

class Document {
public:
    // Another tree, or none: history starts anew. `facts` are the tree's, where they are known already.
    void open(std::shared_ptr<const tree::VesselTree> tree, Session session,
              std::shared_ptr<const TreeFacts> facts = nullptr);

    [[nodiscard]] const Session& session() const { return session_; }
    [[nodiscard]] const Marks& marks() const { return session_.marks; }
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& tree() const { return tree_; }
    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return facts_; } // null without a tree
    [[nodiscard]] const tree::Dependency& dependency() const;                              // empty without a tree
    [[nodiscard]] int branch_count() const { return tree_ ? static_cast<int>(tree_->branches.size()) : 0; }

    // What follows from lesions, cuts and limits, as they are now: computed when it is first asked for. Null without a
    // tree.
    [[nodiscard]] std::shared_ptr<const Plan> plan() const;

    // Nothing is remembered when nothing differs.
    void change(Marks next);
    void set_camera(const render::Camera& camera) { session_.camera = camera; }

    bool undo(); // false: there was nothing to undo
    bool redo();
    [[nodiscard]] bool can_undo() const { return !past_.empty(); }
    [[nodiscard]] bool can_redo() const { return !future_.empty(); }

    // Whether there is something a session file does not have yet.
    [[nodiscard]] bool modified() const { return session_.marks != saved_; }
    void mark_saved() { saved_ = session_.marks; }

private:
    static constexpr std::size_t kMostSteps = 1000;
    std::shared_ptr<const tree::VesselTree> tree_;
    std::shared_ptr<const TreeFacts> facts_;
    mutable std::shared_ptr<const Plan> plan_; // of `planned_`
    mutable Marks planned_;                    // of these, what plans follow from
    Session session_;
    Marks saved_;
    std::vector<Marks> past_, future_;
};

} // namespace ramus::app
