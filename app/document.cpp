#include "app/document.h"

namespace ramus::app {

void Document::open(std::shared_ptr<const tree::VesselTree> tree, Session session,
                    std::shared_ptr<const TreeFacts> facts) {
    tree_ = std::move(tree);
    facts_ = facts || !tree_ ? std::move(facts) : std::make_shared<const TreeFacts>(facts_of(*tree_));
    session_ = std::move(session);
    plan_.reset();
    saved_ = session_.marks;
    past_.clear();
    future_.clear();
}

const tree::Dependency& Document::dependency() const {
    static const tree::Dependency kNone;
    return facts_ ? facts_->dependency : kNone;
}

std::shared_ptr<const Plan> Document::plan() const {
    if (!tree_ || (plan_ && same_plan(planned_, marks()))) return plan_;
    plan_ = std::make_shared<const Plan>(make_plan(*tree_, *facts_, marks()));
    planned_.lesions = marks().lesions;
    planned_.lesion_meshes = marks().lesion_meshes;
    planned_.cuts = marks().cuts;
    planned_.planning = marks().planning;
    return plan_;
}

void Document::change(Marks next) {
    if (next == session_.marks) return;
    past_.push_back(std::exchange(session_.marks, std::move(next)));
    future_.clear();
    if (past_.size() > kMostSteps) past_.erase(past_.begin());
}

bool Document::undo() {
    if (past_.empty()) return false;
    future_.push_back(std::exchange(session_.marks, std::move(past_.back())));
    past_.pop_back();
    return true;
}

bool Document::redo() {
    if (future_.empty()) return false;
    past_.push_back(std::exchange(session_.marks, std::move(future_.back())));
    future_.pop_back();
    return true;
}

} // namespace ramus::app
