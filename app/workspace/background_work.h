// Work behind the window: values that the assets lack and that take longer than a frame. One kind of work is one entry
// of background_works() (app/workspace/background_works.h): what is missing, how it is made on a worker, and where the
// result goes. Everything else is the same for all kinds and stands here: starting, replacing and cancelling work,
// not trying again what could not be had, progress, errors.
//
// Guarantees: a result is put among the assets on the owner's thread only. What could not be made is not tried again as
// long as it is missing in the same form. For one thread, its owner's.
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

// In the order in which the status bar names them.
enum class WorkKind : std::uint8_t {
    kLesions,
    kContext,
    kComparison,
    kDeviation,
    kValidation,
    kContacts,
    kCenterlines,
    kCones
};

// What a kind of work may look at to find out what is missing.
struct WorkView {
    const Document& document;
    SurfaceRequest request;      // the surface that is shown, or about to be
    const ReadySurface& shown;   // the surface that is shown
    bool of_this_tree = false;   // `shown` and the assets are of the document's tree
    bool surface_busy = false;   // a tree or a surface is being made
    bool surface_final = false;  // nothing takes the place of `shown`
    bool surface_failed = false; // `shown` is no more than provisional
    bool tried = false;          // the request is of options that are only tried
    bool contacts_wanted = false, validation_wanted = false, cones_wanted = false;
};

class BackgroundWork {
public:
    BackgroundWork() = default;
    BackgroundWork(const BackgroundWork&) = delete;
    BackgroundWork& operator=(const BackgroundWork&) = delete;
    virtual ~BackgroundWork() = default;

    [[nodiscard]] virtual WorkKind kind() const = 0;
    // Puts among the assets what was made, and starts what is missing. True: the assets changed, or an error came.
    virtual bool follow(const WorkView& view, Assets& assets, std::deque<Error>& errors) = 0;
    // Whether something is being made, or about to be.
    [[nodiscard]] virtual bool awaited(const WorkView& view, const Assets& assets) const = 0;
    virtual void forget() = 0;               // everything: it belonged to another tree
    virtual void cancel(Assets& assets) = 0; // what is being made is not tried again until retry()
    virtual void retry() = 0;
    // Why something cannot be had; empty: everything can.
    [[nodiscard]] virtual std::string problem() const = 0;
    [[nodiscard]] virtual const Worker& worker() const = 0;
    [[nodiscard]] virtual bool quiet() const = 0; // not named, and not counted as busy
};

template <class Wanted, class Made> struct WorkRow {
    WorkKind kind;
    std::function<std::string(const Wanted&)> title;
    // Everything that is missing, the most urgent first.
    std::function<std::vector<Wanted>(const WorkView&, const Assets&)> missing;
    std::function<Result<Made>(const Wanted&, Job&)> make; // on the worker
    // Leaves out what belongs to another tree by now.
    std::function<void(const Wanted&, const Made&, Assets&)> put;
    std::function<void(const Wanted&, const std::string& problem, Assets&)> refused{};
    std::function<std::optional<Error>(const Made&)> trouble{}; // that a person is told of
    std::function<void(const WorkView&, Assets&)> tidy{};       // drops from the assets what nobody looks at any more
    std::function<bool(const WorkView&)> waits{};               // something else comes first
    bool finishes = false;                                      // what is being made is finished though it is stale
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
            worker_.cancel(); // nobody looks at it any more
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
    std::optional<Wanted> current_;    // what is being made
    std::optional<Result<Made>> news_; // what was made of it, not taken yet
    std::vector<Failed> failed_;       // what could not be made, as long as it is missing
    bool changed_ = false;
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
