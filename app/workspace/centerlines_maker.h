// CenterlinesMaker: makes the centerlines of a large tree on a worker when its surface is smoothed or pruned in another
// way (app/assets/centerlines.h): they take longer than a frame may. Until they are there pictures have those before,
// as they have the surface before. For one thread, its owner's.
#pragma once

#include "app/assets/assets.h"
#include "core/base/worker.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ramus::app {

class CenterlinesMaker {
public:
    explicit CenterlinesMaker(std::function<void()> wake) : worker_(std::move(wake)) {}

    // Puts what was made among the assets, and starts what they lack for a surface of these options. True when
    // something came.
    bool update(Assets& assets, const mesh::SurfaceOptions& options);
    // Nothing more of the tree before.
    void forget();

    [[nodiscard]] const Worker& worker() const { return worker_; }
    [[nodiscard]] std::string take_failure() { return worker_.take_failure(); }

private:
    // What is being made, or could not be.
    std::shared_ptr<const tree::VesselTree> tree_;
    int smooth_passes_ = 0;
    double prune_ratio_ = 0.0;
    std::optional<SurfaceCenterlines> made_;          // not taken yet
    std::shared_ptr<const tree::VesselTree> made_of_; // the tree of these
    Worker worker_;                                   // last: its thread ends first
};

} // namespace ramus::app
