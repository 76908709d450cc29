// ComparisonMaker: the surfaces that the session's own is compared with, made on a worker one after the other. For one
// thread, its owner's.
#pragma once

#include "app/workspace/compared_surfaces.h"
#include "core/base/worker.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

class ComparisonMaker {
public:
    explicit ComparisonMaker(std::function<void()> wake) : worker_(std::move(wake)) {}

    void forget(); // all that was of another tree
    void drain() { worker_.drain(); }
    // Starts what is in the picture and not as it shall be, unless something else comes first; lets go of what nobody
    // compares with any more.
    void follow(const std::shared_ptr<const tree::VesselTree>& tree, const Marks& marks, bool something_else_first);

    // As far as they are there: those that are being made are as they were before. One a kind.
    [[nodiscard]] const std::vector<ComparedSurface>& surfaces() const { return surfaces_; }
    // Whether one is being made, or about to be.
    [[nodiscard]] bool awaited(const Marks& marks) const { return worker_.busy() || missing(marks); }
    // Why one cannot be had; empty: all can.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] bool take_changed() { return std::exchange(changed_, false); }

    void cancel(); // what is being made is not tried again
    [[nodiscard]] const Worker& worker() const { return worker_; }
    // Why the last task ended by an exception, once; empty: none did.
    [[nodiscard]] std::string take_failure();

private:
    [[nodiscard]] std::optional<ComparedRequest> missing(const Marks& marks) const;
    void take(const ComparedRequest& request, const Result<ComparedSurface>& made);
    void give_up(std::string why);

    std::vector<ComparedSurface> surfaces_;
    std::optional<ComparedRequest> current_, failed_; // what is being made; what could not be
    std::string problem_;                             // why
    bool changed_ = false;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
