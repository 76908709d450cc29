#include "app/document.h"

namespace ramus::app {

void Document::open(std::shared_ptr<const tree::VesselTree> tree, Session session) {
    tree_ = std::move(tree);
    session_ = std::move(session);
    saved_ = session_.marks;
    past_.clear();
    future_.clear();
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
