#include "app/session/document.h"

#include <algorithm>
#include <functional>

namespace ramus::app {

using Direction = MarksChange::Direction;

void Document::open(std::shared_ptr<const tree::VesselTree> tree, Session session,
                    std::shared_ptr<const TreeFacts> facts, std::filesystem::path file) {
    tree_ = std::move(tree);
    facts_ = facts || !tree_ ? std::move(facts) : std::make_shared<const TreeFacts>(facts_of(*tree_));
    session_ = std::move(session);
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
    // Changes are made of differences, which need lists in order.
    if (std::ranges::adjacent_find(next.selection, std::ranges::greater_equal{}) != next.selection.end())
        next.selection = canonical(std::move(next.selection));
    set_state(next, {}, render::BranchState::kNormal);
    if (next == session_.marks) return;
    MarksChange made = MarksChange::between(session_.marks, next);
    session_.marks = std::move(next);
    ++revision_;
    if (joining_) {
        steps_.back().changes.push_back(std::move(made));
        return;
    }
    steps_.resize(position_);
    if (saved_position_ > position_) {
        lost_changes_ += saved_position_ - position_;
        saved_position_ = position_;
    }
    steps_.push_back({"change", {}, nullptr});
    steps_.back().changes.push_back(std::move(made));
    ++position_;
    joining_ = depth_ > 0;
}

void Document::set_camera(const render::Camera& camera) {
    if (camera == session_.camera) return;
    session_.camera = camera;
    ++revision_;
}

void Document::begin_step() {
    if (depth_++ == 0) step_camera_ = session_.camera;
}

void Document::end_step(const std::string& name) {
    if (--depth_ > 0) return;
    if (joining_) {
        steps_.back().name = name;
        if (session_.camera != step_camera_)
            steps_.back().cameras =
                std::make_shared<const std::pair<render::Camera, render::Camera>>(step_camera_, session_.camera);
    }
    joining_ = false;
}

const MarksChange* Document::last_change() const { return joining_ ? &steps_.back().changes.back() : nullptr; }

bool Document::undo() {
    if (!can_undo()) return false;
    joining_ = false;
    const Step& step = steps_[--position_];
    for (auto change = step.changes.rbegin(); change != step.changes.rend(); ++change)
        change->apply(session_.marks, Direction::kBack);
    if (step.cameras && session_.camera == step.cameras->second) session_.camera = step.cameras->first;
    ++revision_;
    return true;
}

bool Document::redo() {
    if (!can_redo()) return false;
    joining_ = false;
    const Step& step = steps_[position_++];
    for (const MarksChange& change : step.changes) change.apply(session_.marks, Direction::kForward);
    if (step.cameras && session_.camera == step.cameras->first) session_.camera = step.cameras->second;
    ++revision_;
    return true;
}

bool Document::has_unsaved_work() const {
    if (unsaved_) return true;
    if (!modified()) return false;
    Marks here = session_.marks;
    here.selection = saved_.selection;
    return here != saved_;
}

std::size_t Document::unsaved_changes() const {
    if (!modified()) return 0;
    const std::size_t away = std::max(position_, saved_position_) - std::min(position_, saved_position_);
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
