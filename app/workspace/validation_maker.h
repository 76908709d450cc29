// Holds the surface of the session's options against its tree (app/assets/validation.h), for the window and for
// commands without one alike.
#pragma once

#include "app/assets/validation.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

// Makes the surface, the cones and the mask's isosurface where there is a mask, and looks. A mask that cannot be had is
// told in the result. Fails as mesh::make_surface() and validate::validate() do.
[[nodiscard]] Result<TreeValidation> make_validation(const ValidationOf& of, Job& job);

// ValidationMaker: on a worker. For one thread, its owner's.
class ValidationMaker {
public:
    explicit ValidationMaker(std::function<void()> wake) : worker_(std::move(wake)) {}

    void forget(); // all that was of another tree
    void drain() { worker_.drain(); }
    // Starts what is missing, unless it is on its way, could not be had, or something else comes first; none: nothing
    // is.
    void follow(const std::optional<ValidationOf>& missing, bool something_else_first);
    // What was found, once.
    [[nodiscard]] std::optional<TreeValidation> take_news() { return std::exchange(news_, std::nullopt); }
    // Why what is missing cannot be had; empty: it can.
    [[nodiscard]] const std::string& problem() const { return problem_; }
    [[nodiscard]] bool awaits(const std::optional<ValidationOf>& missing) const {
        return missing && failed_ != missing;
    }
    void cancel(); // what is being made is not tried again
    void retry();  // but for this
    [[nodiscard]] const Worker& worker() const { return worker_; }
    // Why the last task ended by an exception, once; empty: none did.
    [[nodiscard]] std::string take_failure();

private:
    void give_up(std::string why);

    std::optional<ValidationOf> current_, failed_; // what is being made; what could not be
    std::optional<TreeValidation> news_;
    std::string problem_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
