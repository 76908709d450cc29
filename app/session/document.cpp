#include "app/session/document.h"

#include "app/session/carry_over.h"
#include "app/session/session_limits.h"
#include "app/session/tree_edits.h"

#include <algorithm>
#include <functional>
#include <span>

namespace ramus::app {

using Direction = MarksChange::Direction;

void Document::open(std::shared_ptr<const tree::VesselTree> tree, Session session,
                    std::shared_ptr<const TreeFacts> facts, std::filesystem::path file,
                    std::shared_ptr<const tree::VesselTree> base) {
    tree_ = std::move(tree);
    base_ = base ? std::move(base) : tree_;
    facts_ = facts || !tree_ ? std::move(facts) : std::make_shared<const TreeFacts>(facts_of(*tree_));
    session_ = std::move(session);
    number_objects(session_.marks);
    claims_ = {};
    known_.clear();
    keep_tree();
    steps_.clear();
    position_ = 0;
    joining_ = false;
    mark_saved(std::move(file));
}

const tree::Dependency& Document::dependency() const {
    static const tree::Dependency none;
    return facts_ ? facts_->dependency : none;
}

void Document::change(Marks next) {
    // Changes are differences, which require sorted lists.
    if (std::ranges::adjacent_find(next.selection, std::ranges::greater_equal{}) != next.selection.end())
        next.selection = canonical(std::move(next.selection));
    set_state(next, {}, tree::BranchState::kNormal);
    number_objects(next);
    if (next == session_.marks) return;
    const std::vector<tree::Edit> before = session_.marks.edits;
    take_change(std::move(next));
    follow_edits(before);
}

Result<void> Document::edit_tree(const tree::Edit& edit) {
    RAMUS_TRY(made, made_edit(tree_, edit));
    return take_edit(made);
}

Result<void> Document::take_edit(const MadeEdit& made) {
    if (made.before != tree_) return fail("the tree was edited meanwhile", {}, "do it again");
    const BranchMap map = BranchMap::edited(*tree_, *made.after);
    Marks next = carried_over(session_.marks, map).marks;
    next.edits.push_back(made.edit);
    if (auto few = check_counts(next); !few) return few;
    std::erase_if(known_, [&](const EditedState& state) { return state.edits >= next.edits.size(); });
    follow_way([&](const Way& way) { return carried_over(way, map); });
    tree_ = std::shared_ptr<const tree::VesselTree>(made.after, &made.after->tree);
    facts_ = made.facts;
    take_change(std::move(next));
    keep_tree();
    return {};
}

// Slices follow the same vessel on another tree, or none.
void Document::follow_way(const std::function<std::optional<Way>(const Way&)>& carry) {
    auto& along = session_.slices.along;
    if (!along) return;
    if (const auto way = carry(along->way))
        along->way = *way;
    else
        along.reset();
}

// Keeps the first tree, every sixteenth and the last few, so that undo repeats few edits and memory stays small.
void Document::keep_tree() {
    constexpr std::size_t kSpacing = 16, kLast = 4;
    if (!tree_) return;
    const std::size_t now = session_.marks.edits.size();
    known_.push_back({now, tree_, facts_});
    std::erase_if(known_,
                  [&](const EditedState& state) { return state.edits + kLast < now && state.edits % kSpacing != 0; });
}

void Document::follow_edits(const std::vector<tree::Edit>& before) {
    const std::vector<tree::Edit>& now = session_.marks.edits;
    if (now == before || !tree_) return;
    session_.slices.along.reset(); // of the other tree
    const auto common = static_cast<std::size_t>(
        std::mismatch(before.begin(), before.end(), now.begin(), now.end()).first - before.begin());
    std::erase_if(known_, [&](const EditedState& state) { return state.edits > common; });
    const EditedState start = known_.empty() ? EditedState{0, base_, nullptr} : known_.back();
    tree_ = start.tree;
    facts_ = start.facts;
    if (start.edits == now.size() && facts_) return;
    // They succeeded before on the same tree.
    if (start.edits < now.size())
        tree_ = std::make_shared<const tree::VesselTree>(
            tree::apply_all(*start.tree, std::span(now).subspan(start.edits)).value());
    facts_ = std::make_shared<const TreeFacts>(facts_of(*tree_));
    keep_tree();
}

void Document::forget_undone() {
    if (saved_position_ > position_) {
        lost_changes_ += work_between(position_, saved_position_);
        saved_position_ = position_;
    }
    steps_.resize(position_);
}

// Rebases the undone steps onto `now`, which has other looks than the marks they were made from.
void Document::carry_undone(const Marks& now) {
    Marks was = session_.marks, is = now;
    for (auto step = steps_.begin() + static_cast<std::ptrdiff_t>(position_); step != steps_.end(); ++step) {
        Marks was_after = was;
        bool same_branches = !step->trees;
        for (const MarksChange& change : step->changes) {
            change.apply(was_after, Direction::kForward);
            same_branches = same_branches && !change.edits_tree();
        }
        Marks is_after = carry_looks(was, is, was_after, same_branches);
        step->changes = {MarksChange::between(is, is_after)};
        was = std::move(was_after), is = std::move(is_after);
    }
}

std::size_t Document::work_between(std::size_t first, std::size_t last) const {
    return static_cast<std::size_t>(std::count_if(steps_.begin() + static_cast<std::ptrdiff_t>(first),
                                                  steps_.begin() + static_cast<std::ptrdiff_t>(last),
                                                  [](const Step& s) { return !s.looks_alone; }));
}

void Document::take_change(Marks next) {
    set_state(next, {}, tree::BranchState::kNormal);
    const bool looks = differ_in_looks_alone(session_.marks, next);
    if (!looks)
        forget_undone();
    else if (can_redo())
        carry_undone(next);
    MarksChange made = MarksChange::between(session_.marks, next);
    session_.marks = std::move(next);
    ++revision_;
    if (!joining_) {
        steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(position_), Step{"change", {}, nullptr, nullptr});
        if (saved_position_ > position_) ++saved_position_;
        ++position_;
        joining_ = depth_ > 0;
    }
    Step& step = steps_[position_ - 1];
    step.changes.push_back(std::move(made));
    step.looks_alone = step.looks_alone && looks;
}

void Document::go_to_tree(const TreeWithFacts& other, bool moves) {
    const BranchMap map = BranchMap::read_again(*tree_, *other.tree);
    follow_way([&](const Way& way) { return carried_over(way, map); });
    if (moves) session_.camera = carried_over(session_.camera, *tree_, *other.tree);
    tree_ = base_ = other.tree;
    facts_ = other.facts;
    known_.clear();
    keep_tree();
}

void Document::change_tree(std::shared_ptr<const tree::VesselTree> tree, Marks next) {
    begin_step();
    const io::ReadOptions& read = session_.marks.reading;
    const bool moves = read.unit != next.reading.unit || read.orientation != next.reading.orientation;
    if (moves)
        for (SavedView& view : next.views) view.camera = carried_over(view.camera, *tree_, *tree);
    change(std::move(next));
    if (joining_) {
        Step& step = steps_[position_ - 1];
        step.tree_moves = moves;
        const TreeWithFacts before{tree_, facts_};
        auto facts = std::make_shared<const TreeFacts>(facts_of(*tree));
        const TreeWithFacts after{std::move(tree), std::move(facts)};
        step.trees = std::make_shared<const std::pair<TreeWithFacts, TreeWithFacts>>(before, after);
        go_to_tree(after, step.tree_moves);
    }
    end_step("read again");
}

void Document::set_camera(const render::Camera& camera) {
    if (camera == session_.camera) return;
    session_.camera = camera;
    ++revision_;
}

void Document::set_slices(const SliceViews& slices) {
    if (slices == session_.slices) return;
    session_.slices = slices;
    ++revision_;
}

void Document::begin_step() {
    if (depth_++ == 0) step_camera_ = session_.camera;
}

void Document::end_step(const std::string& name) {
    if (--depth_ > 0) return;
    if (joining_) {
        Step& step = steps_[position_ - 1];
        step.name = name;
        if (session_.camera != step_camera_)
            step.cameras =
                std::make_shared<const std::pair<render::Camera, render::Camera>>(step_camera_, session_.camera);
    }
    joining_ = false;
}

const MarksChange* Document::last_change() const { return joining_ ? &steps_[position_ - 1].changes.back() : nullptr; }

bool Document::undo() {
    if (!can_undo()) return false;
    const Step& step = steps_[--position_];
    take_step(step, {step.changes.rbegin(), step.changes.rend()}, Direction::kBack);
    return true;
}

bool Document::redo() {
    if (!can_redo()) return false;
    const Step& step = steps_[position_++];
    take_step(step, step.changes, Direction::kForward);
    return true;
}

void Document::take_step(const Step& step, const std::vector<MarksChange>& changes, Direction direction) {
    joining_ = false;
    const auto before = [&](const auto& both) { return direction == Direction::kForward ? both.first : both.second; };
    const auto after = [&](const auto& both) { return direction == Direction::kForward ? both.second : both.first; };
    const std::vector<tree::Edit> edits = session_.marks.edits;
    for (const MarksChange& change : changes) change.apply(session_.marks, direction);
    const bool camera_stayed = step.cameras && session_.camera == before(*step.cameras);
    if (step.trees)
        go_to_tree(after(*step.trees), step.tree_moves);
    else
        follow_edits(edits);
    if (camera_stayed) session_.camera = after(*step.cameras);
    ++revision_;
}

bool Document::has_unsaved_work() const {
    if (unsaved_) return true;
    return !differ_in_looks_alone(session_.marks, saved_);
}

std::size_t Document::unsaved_changes() const {
    if (!has_unsaved_work()) return 0;
    const std::size_t away = work_between(std::min(position_, saved_position_), std::max(position_, saved_position_));
    return std::max<std::size_t>(away + lost_changes_, 1);
}

void Document::mark_saved(std::filesystem::path file) {
    file_ = std::move(file);
    saved_ = session_.marks;
    saved_position_ = position_;
    lost_changes_ = 0;
    unsaved_ = false;
    ++revision_;
}

void Document::mark_unsaved(std::size_t changes) {
    unsaved_ = true;
    lost_changes_ = changes;
    ++revision_;
}

} // namespace ramus::app
