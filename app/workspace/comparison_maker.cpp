#include "app/workspace/comparison_maker.h"

#include <algorithm>

namespace ramus::app {

void ComparisonMaker::forget() {
    worker_.cancel();
    surfaces_.clear();
    current_.reset();
    failed_.reset();
    problem_.clear();
}

// The first that is in the picture and not as it shall be.
std::optional<ComparedRequest> ComparisonMaker::missing(const Marks& marks) const {
    for (ComparedRequest& requested : compared_requests(marks)) {
        const bool there = std::ranges::any_of(surfaces_, [&](const auto& one) { return one.request == requested; });
        if (!there && failed_ != requested) return std::move(requested);
    }
    return {};
}

void ComparisonMaker::follow(const std::shared_ptr<const tree::VesselTree>& tree, const Marks& marks,
                             bool something_else_first) {
    const auto next = missing(marks);
    if (!next) {
        worker_.cancel(); // nobody compares with it any more
        current_.reset();
        if (compared_surfaces(marks.comparison).empty()) surfaces_.clear();
        const auto requested = compared_requests(marks);
        if (!failed_ || std::ranges::find(requested, *failed_) == requested.end()) failed_.reset(), problem_.clear();
        return;
    }
    if (something_else_first || (worker_.busy() && current_ == next)) return;
    current_ = next;
    changed_ = true;
    worker_.start("Computing the " + std::string(mesh::row_of(next->kind).noun),
                  [this, request = *next, tree](Job& job, const Worker::Post& post) {
                      const auto made = make_compared(*tree, request, job);
                      if (!job.cancelled()) post([this, made, request] { take(request, made); });
                  });
}

void ComparisonMaker::take(const ComparedRequest& request, const Result<ComparedSurface>& made) {
    changed_ = true;
    current_.reset();
    if (!made) {
        failed_ = request;
        problem_ = made.error().message();
        return;
    }
    if (failed_ && failed_->same_place(request)) failed_.reset(), problem_.clear();
    std::erase_if(surfaces_, [&](const auto& one) { return one.request.same_place(request); });
    surfaces_.push_back(*made);
}

void ComparisonMaker::give_up(std::string why) {
    failed_ = std::exchange(current_, std::nullopt);
    problem_ = std::move(why);
}

void ComparisonMaker::cancel() {
    worker_.cancel();
    give_up("cancelled");
}

std::string ComparisonMaker::take_failure() {
    std::string failure = worker_.take_failure();
    if (!failure.empty()) give_up("the work was given up: " + failure);
    return failure;
}

} // namespace ramus::app
