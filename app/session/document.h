// Document: the open session, its tree and the undo history. Marks change only through change() and the functions that
// edit or reread the tree, which record each change. Undo does not cover files; it covers the camera only in steps that
// change other things, too. The number of steps is unlimited, since each is small (app/session/marks_change.h). No GL,
// no window. Not thread-safe.
//
// Changing the view never costs undone work. A step that changes only looks (differ_in_looks_alone(): selection,
// colours, depth cues) is inserted between the done and the undone steps, and the undone steps can still be redone.
// Redoing keeps the current looks, unless the step itself changed them. Any other change discards the undone steps.
// Steps that change only looks do not count as unsaved work.
#pragma once

#include "app/session/branch_facts.h"
#include "app/session/marks_change.h"
#include "app/session/numbers.h"
#include "app/session/session.h"
#include "core/base/error.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

struct MadeEdit; // app/session/tree_edits.h

class Document {
public:
    // Opens a session with its tree (null: no tree) and clears the history. `facts`: of the tree, if known. `file`: the
    // session file it was read from; empty: none. `base`: the unedited tree of the file, if the session's edits
    // produced `tree` from it.
    void open(std::shared_ptr<const tree::VesselTree> tree, Session session,
              std::shared_ptr<const TreeFacts> facts = nullptr, std::filesystem::path file = {},
              std::shared_ptr<const tree::VesselTree> base = nullptr);

    [[nodiscard]] const Session& session() const { return session_; }
    [[nodiscard]] const Marks& marks() const { return session_.marks; }
    // The edited tree; the pointer changes with every edit, and with undo and redo of edits.
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& tree() const { return tree_; }
    // The unedited tree of the file; the pointer changes when a file is opened or reread with other options.
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& base_tree() const { return base_; }
    [[nodiscard]] const std::shared_ptr<const TreeFacts>& facts() const { return facts_; } // null without a tree
    [[nodiscard]] const tree::Dependency& dependency() const;                              // empty without a tree
    // Whether there is anything to show: a tree, or masks, scans or meshes without one.
    [[nodiscard]] bool has_scene() const { return branch_count() > 0 || has_objects_alone(session_.marks); }
    [[nodiscard]] std::filesystem::path subject() const { return subject_of(session_); }
    // The origin of unit and orientation of what is shown. Without a tree, set_claims() provides it.
    [[nodiscard]] const tree::Claims& claims() const { return tree_ ? tree_->claims : claims_; }
    void set_claims(const tree::Claims& claims) { claims_ = claims; }
    // The format of lengths.
    [[nodiscard]] Lengths lengths() const { return Lengths(claims()); }
    [[nodiscard]] int branch_count() const { return tree_ ? static_cast<int>(tree_->branches.size()) : 0; }
    // The session file last read or saved; empty: none.
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    // Replaces the marks. Records nothing if they are equal.
    void change(Marks next);
    // Replaces the tree by an edited one and carries the marks over. Fails if the edit was made from another tree.
    Result<void> take_edit(const MadeEdit& made);
    // Makes the edit and takes it. An error changes nothing.
    Result<void> edit_tree(const tree::Edit& edit);
    // Replaces the tree after its file was reread with next.reading. Only for sessions without edits, which refer to
    // the old tree. If another unit or other axes move the tree, the camera and the saved views follow, and return on
    // undo.
    void change_tree(std::shared_ptr<const tree::VesselTree> tree, Marks next);
    void set_camera(const render::Camera& camera);
    void set_slices(const SliceViews& slices);

    // Groups all changes between begin_step() and the matching end_step() into one named undo step; nested steps are
    // part of the outermost. If the step moves the camera, undo and redo move it, too, unless it was moved otherwise
    // since.
    void begin_step();
    void end_step(const std::string& name);
    // The last change in the current step; null: no change since begin_step().
    [[nodiscard]] const MarksChange* last_change() const;

    bool undo(); // false: nothing to undo
    bool redo();
    [[nodiscard]] bool can_undo() const { return position_ > 0; }
    [[nodiscard]] bool can_redo() const { return position_ < steps_.size(); }

    // The recorded steps, oldest first, with their names ("hide 12 branches"). The first position() steps are done, the
    // others undone.
    [[nodiscard]] std::size_t step_count() const { return steps_.size(); }
    [[nodiscard]] const std::string& step_name(std::size_t step) const { return steps_[step].name; }
    [[nodiscard]] std::size_t position() const { return position_; }

    // modified(): the marks differ from the session file. has_unsaved_work(): the same without looks, which are not
    // worth a warning.
    [[nodiscard]] bool modified() const { return unsaved_ || session_.marks != saved_; }
    [[nodiscard]] bool has_unsaved_work() const;
    [[nodiscard]] std::size_t unsaved_changes() const; // number of steps with work since the last save
    void mark_saved(std::filesystem::path file);
    // Marks the session as unsaved, after recovery; `changes`: how many were recovered.
    void mark_unsaved(std::size_t changes);

    // Changes whenever the session, its camera or its saved state changes.
    [[nodiscard]] std::uint64_t revision() const { return revision_; }

private:
    struct TreeWithFacts {
        std::shared_ptr<const tree::VesselTree> tree;
        std::shared_ptr<const TreeFacts> facts;
    };
    struct Step {
        std::string name;
        std::vector<MarksChange> changes;                                         // nearly always one
        std::shared_ptr<const std::pair<render::Camera, render::Camera>> cameras; // before and after; null: the same
        std::shared_ptr<const std::pair<TreeWithFacts, TreeWithFacts>> trees;     // before and after; null: the same
        bool tree_moves = false;                                                  // the second tree is moved or scaled
        bool looks_alone = true;                                                  // all changes are looks
    };
    // The tree after the session's first `edits` edits.
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
    void follow_way(const std::function<std::optional<Way>(const Way&)>& carry);
    void take_step(const Step& step, const std::vector<MarksChange>& changes, MarksChange::Direction direction);
    void go_to_tree(const TreeWithFacts& other, bool moves);

    std::shared_ptr<const tree::VesselTree> tree_, base_;
    std::shared_ptr<const TreeFacts> facts_;
    std::vector<EditedState> known_; // ascending; spares undo from repeating all edits
    Session session_;
    tree::Claims claims_; // without a tree
    std::filesystem::path file_;
    Marks saved_;
    bool unsaved_ = false;
    std::vector<Step> steps_;
    std::size_t position_ = 0;
    std::size_t saved_position_ = 0;
    std::size_t lost_changes_ = 0; // unsaved steps that are no longer in the history
    int depth_ = 0;                // nesting of begin_step()
    render::Camera step_camera_;   // at the outermost begin_step()
    bool joining_ = false;         // changes go to the last step
    std::uint64_t revision_ = 0;
};

} // namespace ramus::app
