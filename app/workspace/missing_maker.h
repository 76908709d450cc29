// MissingMaker: makes on a worker what assets lack, following what is wanted. What could not be had is not tried again
// while it is what is wanted. For one thread, its owner's.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

template <class Wanted, class Made> class MissingMaker {
public:
    using Make = std::function<Result<Made>(const Wanted&, Job&)>;

    // `title`: what the work is called.
    MissingMaker(std::function<void()> wake, std::string title, Make make)
        : title_(std::move(title)), make_(std::move(make)), worker_(std::move(wake)) {}

    void forget() { // all that was of another tree
        worker_.cancel();
        current_.reset();
        news_.reset();
        retry();
    }
    void drain() { worker_.drain(); }
    // Starts what is missing, unless it is on its way, could not be had, or something else comes first; none: nothing
    // is.
    void follow(const std::optional<Wanted>& missing, bool something_else_first) {
        if (failed_ != missing) retry();
        if (worker_.busy() && current_ != missing) worker_.cancel(); // nobody looks at it any more
        if (!missing) current_.reset();
        if (!missing || something_else_first || failed_ == missing || worker_.busy()) return;
        current_ = missing;
        worker_.start(title_, [this, wanted = *missing](Job& job, const Worker::Post& post) {
            const auto made = make_(wanted, job);
            if (job.cancelled()) return;
            post([this, made] {
                if (!made) return give_up(made.error().message());
                news_ = *made;
                current_.reset();
            });
        });
    }
    // What was made, once.
    [[nodiscard]] std::optional<Made> take_news() { return std::exchange(news_, std::nullopt); }
    // What cannot be had, and why; none and empty: nothing.
    [[nodiscard]] const std::optional<Wanted>& failed() const { return failed_; }
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] bool awaits(const std::optional<Wanted>& missing) const { return missing && failed_ != missing; }
    void cancel() { // what is being made is not tried again
        worker_.cancel();
        give_up("cancelled");
    }
    void retry() { // but for this
        failed_.reset();
        problem_.clear();
    }
    [[nodiscard]] const Worker& worker() const { return worker_; }
    // Why the last task ended by an exception, once; empty: none did.
    [[nodiscard]] std::string take_failure() {
        std::string failure = worker_.take_failure();
        if (!failure.empty()) give_up("the work was given up: " + failure);
        return failure;
    }

private:
    void give_up(std::string why) {
        failed_ = std::exchange(current_, std::nullopt);
        if (failed_) problem_ = std::move(why);
    }

    std::string title_;
    Make make_;
    std::optional<Wanted> current_, failed_; // what is being made; what could not be
    std::optional<Made> news_;
    std::string problem_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
