// Background work: computes, on worker threads, values that the assets lack and that take longer than a frame. Each
// kind of work is an entry of background_works() (app/workspace/background_works.h): what is missing, how to compute
// it, and where the result goes. This file has what all kinds share: starting, replacing and cancelling work,
// remembering failures, progress, errors.
//
// Guarantees: results are stored among the assets only on the owner's thread. Work that failed is not retried as long
// as the same input is missing. All calls must come from the owner's thread.
#pragma once

#include "app/assets/assets.h"
#include "app/workspace/surface_maker.h"
#include "core/base/error.h"
#include "core/base/job.h"
#include "core/base/worker.h"

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

// In the order of priority in the status bar.
enum class WorkKind : std::uint8_t {
    kLesions,
    kContext,
    kScans,
    kRegion,
    kOrgan,
    kSupply,
    kResectionMeshes,
    kOperation,
    kTerritories,
    kComparison,
    kDeviation,
    kValidation,
    kContacts,
    kCenterlines,
    kCones,
    kSections
};

// The inputs by which a kind of work decides what is missing.
struct WorkView {
    const Document& document;
    SurfaceRequest request;      // of the surface that is shown or being made
    const ReadySurface& shown;   // the surface that is shown
    bool of_this_tree = false;   // `shown` and the assets belong to the document's tree
    bool surface_busy = false;   // a tree or a surface is being made
    bool surface_final = false;  // nothing will replace `shown`
    bool surface_failed = false; // `shown` stays provisional
    bool tried = false;          // the request has trial options
    bool contacts_wanted = false, validation_wanted = false, cones_wanted = false;
};

class BackgroundWork {
public:
    BackgroundWork() = default;
    BackgroundWork(const BackgroundWork&) = delete;
    BackgroundWork& operator=(const BackgroundWork&) = delete;
    virtual ~BackgroundWork() = default;

    [[nodiscard]] virtual WorkKind kind() const = 0;
    // Stores finished results and starts missing work. True: the assets changed or an error was added.
    virtual bool follow(const WorkView& view, Assets& assets, std::deque<Error>& errors) = 0;
    // Whether work is running or about to start.
    [[nodiscard]] virtual bool awaited(const WorkView& view, const Assets& assets) const = 0;
    virtual void forget() = 0;               // drops everything, when the tree is replaced
    virtual void cancel(Assets& assets) = 0; // the cancelled work is not repeated until retry()
    virtual void retry() = 0;
    // Why some work failed; empty: none failed.
    [[nodiscard]] virtual std::string problem() const = 0;
    [[nodiscard]] virtual const Worker& worker() const = 0;
    [[nodiscard]] virtual bool quiet() const = 0; // not shown in the status bar, and not counted as busy
};

template <class Wanted, class Made> struct WorkRow {
    WorkKind kind;
    std::function<std::string(const Wanted&)> title;
    // All missing values, the most urgent first.
    std::function<std::vector<Wanted>(const WorkView&, const Assets&)> missing;
    std::function<Result<Made>(const Wanted&, Job&)> make; // on the worker
    // Stores a result; must skip results for another tree.
    std::function<void(const Wanted&, const Made&, Assets&)> put;
    std::function<void(const Wanted&, const std::string& problem, Assets&)> refused{};
    std::function<std::optional<Error>(const Made&)> trouble{}; // an error to show with the result
    std::function<void(const WorkView&, Assets&)> tidy{};       // removes values that are no longer needed
    std::function<bool(const WorkView&)> waits{};               // true: other work comes first
    bool finishes = false;                                      // outdated work is finished instead of cancelled
    bool quiet = false;
};

template <class Wanted, class Made> class WorkOf final : public BackgroundWork {
public:
    WorkOf(const std::function<void()>& wake, WorkRow<Wanted, Made> row) : row_(std::move(row)), worker_(wake) {}

    [[nodiscard]] WorkKind kind() const override { return row_.kind; }

    bool follow(const WorkView& view, Assets& assets, std::deque<Error>& errors) override {
        bool changed = std::exchange(changed_, false);
        worker_.drain();
        if (const std::string failure = worker_.take_failure(); !failure.empty()) {
            errors.push_back({"the work was given up: " + failure, worker_.title(),
                              failure == "std::bad_alloc" ? "there is not enough memory for it" : ""});
            give_up("the work was given up: " + failure, assets);
            changed = true;
        }
        if (const auto news = std::exchange(news_, std::nullopt)) {
            changed = true;
            if (*news) {
                if (auto error = row_.trouble ? row_.trouble(**news) : std::nullopt) errors.push_back(*error);
                row_.put(*current_, **news, assets);
                current_.reset();
            } else {
                give_up(news->error().message(), assets);
            }
        }
        if (row_.tidy) row_.tidy(view, assets);
        start(view, row_.missing(view, assets));
        return changed;
    }

    [[nodiscard]] bool awaited(const WorkView& view, const Assets& assets) const override {
        return worker_.busy() || next_of(row_.missing(view, assets)).has_value();
    }

    void forget() override {
        worker_.cancel();
        current_.reset();
        news_.reset();
        failed_.clear();
    }
    void cancel(Assets& assets) override {
        if (!worker_.busy()) return;
        worker_.cancel();
        give_up("cancelled", assets);
        changed_ = true;
    }
    void retry() override { failed_.clear(); }
    [[nodiscard]] std::string problem() const override { return failed_.empty() ? std::string() : failed_.front().why; }
    [[nodiscard]] const Worker& worker() const override { return worker_; }
    [[nodiscard]] bool quiet() const override { return row_.quiet; }

private:
    struct Failed {
        Wanted wanted;
        std::string why;
    };

    [[nodiscard]] std::optional<Wanted> next_of(const std::vector<Wanted>& missing) const {
        const auto next = std::ranges::find_if(missing, [&](const Wanted& one) {
            return std::ranges::find(failed_, one, &Failed::wanted) == failed_.end();
        });
        return next == missing.end() ? std::nullopt : std::optional(*next);
    }

    void start(const WorkView& view, const std::vector<Wanted>& missing) {
        std::erase_if(failed_,
                      [&](const Failed& one) { return std::ranges::find(missing, one.wanted) == missing.end(); });
        auto next = next_of(missing);
        if (worker_.busy() && !row_.finishes && current_ != next) {
            worker_.cancel(); // no longer needed
            current_.reset();
        }
        if (!next || worker_.busy() || (row_.waits && row_.waits(view))) return;
        current_ = std::move(next);
        worker_.start(row_.title(*current_), [this, wanted = *current_](Job& job, const Worker::Post& post) {
            auto made = row_.make(wanted, job);
            if (!job.cancelled()) post([this, made = std::move(made)] { news_ = made; });
        });
    }

    void give_up(std::string why, Assets& assets) {
        const auto wanted = std::exchange(current_, std::nullopt);
        if (!wanted) return;
        if (row_.refused) row_.refused(*wanted, why, assets);
        failed_.push_back({*wanted, std::move(why)});
    }

    WorkRow<Wanted, Made> row_;
    std::optional<Wanted> current_;    // input of the running work
    std::optional<Result<Made>> news_; // its result, not yet taken
    std::vector<Failed> failed_;       // failures, as long as their input is missing
    bool changed_ = false;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
