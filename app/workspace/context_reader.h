// ContextReader: reads what is shown beside the tree (app/assets/context_shapes.h) on a worker, one file after the
// other, as a session names them. For one thread, its owner's.
#pragma once

#include "app/assets/assets.h"
#include "core/base/worker.h"

#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ramus::app {

class ContextReader {
public:
    explicit ContextReader(std::function<void()> wake) : worker_(std::move(wake)) {}

    // Puts what has been read among the assets, and starts the next that is visible of `context`. True when something
    // came.
    bool update(const std::vector<ContextItem>& context, Assets& assets);
    // Why something of the session could not be read, once.
    [[nodiscard]] std::optional<Error> take_error();

    void cancel(); // what the session names is not tried again until retry()
    void retry() { given_up_.clear(); }
    [[nodiscard]] bool gave_up(const ContextSource& source) const { return given_up_.contains(source); }
    void forget(); // all that is on its way or was said: it belongs to the tree before

    // Until an update() has found nothing more to do: between one file and the next the worker is idle.
    [[nodiscard]] bool busy() const { return working_; }
    [[nodiscard]] const std::string& title() const { return worker_.title(); }
    [[nodiscard]] float progress() const { return worker_.progress(); }

private:
    struct Read {
        ContextSource source;
        Loaded<ContextShape> shape;
    };
    void start(const ContextSource& source);

    std::deque<Read> read_;
    std::deque<Error> errors_;
    std::set<ContextSource> given_up_;
    ContextSource current_;
    bool came_ = false, working_ = false;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
