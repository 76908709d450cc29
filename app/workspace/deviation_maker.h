// How far the surface that is shown lies from another one: measured for the window, pictures without one and tests
// alike (core/measure/deviation; S. Oeltze and B. Preim, 2005, Figs. 8 and 9).
#pragma once

#include "app/assets/deviation.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

// Exact distances of all vertices of both; the preview may be null. Fails as making or reading the other surface does,
// and when that lies elsewhere than the tree.
[[nodiscard]] Result<SurfaceDeviation> make_deviation(const DeviationOf& of, int threads, std::size_t memory_bytes,
                                                      const SurfaceDeviation::Paged& mesh,
                                                      const SurfaceDeviation::Paged& preview, Job& job);

// DeviationMaker: follows the surface that is shown, on a worker. For one thread, its owner's.
class DeviationMaker {
public:
    explicit DeviationMaker(std::function<void()> wake) : worker_(std::move(wake)) {}

    void forget(); // all that was of another tree
    void drain() { worker_.drain(); }
    struct Wanted {
        DeviationOf of;
        int threads = 0;
        std::size_t memory_bytes = 0;
        SurfaceDeviation::Paged mesh, preview;
        bool operator==(const Wanted&) const = default;
    };
    // Starts what is missing, unless it is on its way, could not be had, or something else comes first; none: nothing
    // is.
    void follow(const std::optional<Wanted>& missing, bool something_else_first);
    // What was measured, or why it could not be, once.
    [[nodiscard]] std::optional<SurfaceDeviation> take_news() { return std::exchange(news_, std::nullopt); }
    void cancel(); // what is being measured is not tried again
    [[nodiscard]] const Worker& worker() const { return worker_; }
    // Why the last task ended by an exception, once; empty: none did.
    [[nodiscard]] std::string take_failure();

private:
    void give_up(std::string why);

    std::optional<Wanted> current_, failed_; // what is being measured; what could not be
    std::optional<SurfaceDeviation> news_;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
