// Document: the session that is open, the tree it is about, and the way back. Every change of what undo covers goes
// through change(), which remembers what it changed; files are not covered, and of the camera only what a step that
// changes other things too does with it. There is no limit to the steps: they are kept small
// (app/session/marks_change.h). No GL, no window.
//
// Looking never costs work: a step that changes nothing but how the tree is looked at (differ_in_looks_alone(): the
// selection, colours, depth cues) is put between what is done and what is undone, and what is undone can still be
// redone. It then gives what it gave, seen as it is looked at by then, unless it changed that itself. Any other change
// forgets what was undone. Steps of looking are none that closing would lose.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/marks_change.h"
#include "app/session/numbers.h"
#include "app/session/session.h"
#include "core/base/error.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct MadeEdit; // app/session/tree_edits.h

class Document {
public:
    // Another tree, or none: history starts anew. `facts` are the tree's, where they are known already; `file`: the
    // session file that it came from; empty for none.
    // `base`: the tree as its file has it, where the session has edits; they are those that made `tree` of it.
    void open(std::shared_ptr<const tree::VesselTree> tree, Session session,
              std::shared_ptr<const TreeFacts> facts = nullptr, std::filesystem::path file = {},
              std::shared_ptr<const tree::VesselTree> base = nullptr);

    [[nodiscard]] const Session& session() const { return session_; }
    [[nodiscard]] const Marks& marks() const { return session_.marks; }
    // As edited: another one after every edit, and after undo and redo of one.
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& tree() const { return tree_; }
    // As its file has it: the same until another file is opened, or this one is read in another way.
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& base_tree() const { return base_; }
    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return facts_; } // null without a tree
    [[nodiscard]] const tree::Dependency& dependency() const;                              // empty without a tree
    // Whether there is something to see: a tree, or masks, scans and meshes without one.
    [[nodiscard]] bool has_scene() const { return branch_count() > 0 || !session_.marks.context.empty(); }
    [[nodiscard]] std::filesystem::path subject() const { return subject_of(session_); }
    // Who says the unit and the sides of what is shown. Without a tree that is known to who has read what is shown.
    [[nodiscard]] const tree::Claims& claims() const { return tree_ ? tree_->claims : claims_; }
    void set_claims(const tree::Claims& claims) { claims_ = claims; }
    // How its lengths are written.
    [[nodiscard]] Lengths lengths() const { return Lengths(claims()); }
    [[nodiscard]] int branch_count() const { return tree_ ? static_cast<int>(tree_->branches.size()) : 0; }
    // The session file that it was read from or saved to last; empty: none yet.
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    // Nothing is remembered when nothing differs.
    void change(Marks next);
    // The tree and what is marked on it. Fails where it is not the tree that the edit was made of.
    Result<void> take_edit(const MadeEdit& made);
    // Made here. A refusal leaves all as it was.
    Result<void> edit_tree(const tree::Edit& edit);
    // The same with another tree, that the file makes when it is read as next.reading says; for sessions without edits,
    // which are those of the tree before. What is seen of it stays: the camera goes along where another unit or other
    // axes move the tree, and back when this is undone.
    void change_tree(std::shared_ptr<const tree::VesselTree> tree, Marks next);
    void set_camera(const render::Camera& camera);

    // What one command changes is one step, with a name: changes between begin_step() and the end_step() that belongs
    // to it. Steps inside a step are part of it. Where such a step has moved the camera, undo and redo move it too,
    // unless somebody has moved it since: what a person looks at stays.
    void begin_step();
    void end_step(const std::string& name);
    // The step that is being made; null: nothing changed since begin_step().
    [[nodiscard]] const MarksChange* last_change() const;

    bool undo(); // false: there was nothing to undo
    bool redo();
    [[nodiscard]] bool can_undo() const { return position_ > 0; }
    [[nodiscard]] bool can_redo() const { return position_ < steps_.size(); }

    // All steps that are remembered, oldest first, by their names ("hide 12 branches"); the first position() of them
    // are done, the others undone.
    [[nodiscard]] std::size_t step_count() const { return steps_.size(); }
    [[nodiscard]] const std::string& step_name(std::size_t step) const { return steps_[step].name; }
    [[nodiscard]] std::size_t position() const { return position_; }

    // Whether there is something a session file does not have yet; and something that is worth asking a person about:
    // how it is looked at alone is not.
    [[nodiscard]] bool modified() const { return unsaved_ || session_.marks != saved_; }
    [[nodiscard]] bool has_unsaved_work() const;
    [[nodiscard]] std::size_t unsaved_changes() const; // steps of work away from what was saved
    void mark_saved(std::filesystem::path file);
    // What was opened is in no session file, however it looks: it was recovered, after so many changes.
    void mark_unsaved(std::size_t changes);

    // Another number after every change of the session, its camera or what is saved.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

private:
    struct TreeWithFacts {
        std::shared_ptr<const tree::VesselTree> tree;
        std::shared_ptr<const TreeFacts> facts;
    };
    struct Step {
        std::string name;
        std::vector<MarksChange> changes;                                         // one, nearly always
        std::shared_ptr<const std::pair<render::Camera, render::Camera>> cameras; // before and after; null: the same
        std::shared_ptr<const std::pair<TreeWithFacts, TreeWithFacts>> trees;     // likewise
        bool tree_moves = false; // the second of them lies elsewhere, or is larger or smaller
        bool looks_alone = true; // of all its changes
    };
    // The tree after so many edits of the session.
    struct EditedState {
        std::size_t edits = 0;
        std::shared_ptr<const tree::VesselTree> tree;
        std::shared_ptr<const TreeFacts> facts;
    };
    void take_change(Marks next);
    void forget_undone();
    void carry_undone(const Marks& now);
    [[nodiscard]] std::size_t work_between(std::size_t first, std::size_t last) const;
    void keep_tree();
    void follow_edits(const std::vector<tree::Edit>& before);
    void take_step(const Step& step, const std::vector<MarksChange>& changes, MarksChange::Direction direction);
    void go_to_tree(const TreeWithFacts& other, bool moves);

    std::shared_ptr<const tree::VesselTree> tree_, base_;
    std::shared_ptr<const TreeFacts> facts_;
    std::vector<EditedState> known_; // ascending; so that undo need not make all edits again
    Session session_;
    tree::Claims claims_; // without a tree
    std::filesystem::path file_;
    Marks saved_;
    bool unsaved_ = false;
    std::vector<Step> steps_;
    std::size_t position_ = 0;
    std::size_t saved_position_ = 0;
    std::size_t lost_changes_ = 0; // between what was saved and where the history left the way there
    int depth_ = 0;                // of begin_step()
    render::Camera step_camera_;   // as it was at the outermost of them
    bool joining_ = false;         // the last step is the one that is being made
    std::uint64_t revision_ = 0;
};

} // namespace ramus::app
