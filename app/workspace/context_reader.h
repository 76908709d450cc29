// ContextReader: reads what a session shows beside the tree (app/assets/shapes.h) into the assets on a worker,
// one file after the other. For one thread, its owner's.
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

    // Puts what has been read among the assets, and starts what comes next of what is visible of `context`. True when
    // something came.
    bool update(const std::vector<ContextItem>& context, Assets& assets);
    // Why something could not be read, once.
    [[nodiscard]] std::optional<Error> take_error();

    void cancel(); // what is being read is not tried again until retry()
    void retry() { given_up_.clear(); }
    [[nodiscard]] bool gave_up(const ContextSource& source) const { return given_up_.contains(source); }
    void forget(); // all that is on its way or was said: it belongs to the tree before

    // Until an update() has found nothing more to do: between one file and the next the worker is idle.
    [[nodiscard]] bool busy() const { return working_; }
    [[nodiscard]] const std::string& title() const { return worker_.title(); }
    [[nodiscard]] float progress() const { return worker_.progress(); }

private:
    void start(const ContextSource& source);

    std::deque<Error> errors_;
    std::set<ContextSource> given_up_;
    ContextSource current_;
    std::optional<Loaded<ContextShape>> read_; // of `current_`, not taken yet
    bool came_ = false, working_ = false;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
