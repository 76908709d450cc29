// Document: the session that is open, the tree it is about, and the way back. Every change of what undo covers goes
// through change(), which remembers the value before; the camera and files are not covered. No GL, no window.
#pragma once

#include "app/session.h"

#include <cstdint>
#include <memory>

namespace ramus::app {

class Document {
public:
    // Another tree, or none: history starts anew.
    void open(std::shared_ptr<const tree::VesselTree> tree, Session session);

    [[nodiscard]] const Session& session() const { return session_; }
    [[nodiscard]] const Marks& marks() const { return session_.marks; }
    [[nodiscard]] const std::shared_ptr<const tree::VesselTree>& tree() const { return tree_; }
    [[nodiscard]] int branch_count() const { return tree_ ? static_cast<int>(tree_->branches.size()) : 0; }

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
    Session session_;
    Marks saved_;
    std::vector<Marks> past_, future_;
};

} // namespace ramus::app
