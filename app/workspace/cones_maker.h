// ConesMaker: makes on a worker what the processor draws while the view moves (render/caster/fitted_cones.h), as soon
// as the surface has other centerlines or another width. Until it is there pictures take what was there before, where
// that is of the same centerlines. For one thread, its owner's.
#pragma once

#include "app/assets/assets.h"
#include "core/base/worker.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace ramus::app {

class ConesMaker {
public:
    explicit ConesMaker(std::function<void()> wake) : worker_(std::move(wake)) {}

    // Puts what was made among the assets, and starts what they lack for a surface of these options. True when
    // something came. Assets whose centerlines are of other options are left as they are.
    bool update(Assets& assets, const mesh::SurfaceOptions& options);
    // Nothing more of the tree before.
    void forget();

    [[nodiscard]] const Worker& worker() const { return worker_; }
    [[nodiscard]] std::string take_failure() { return worker_.take_failure(); }

private:
    using Cones = std::shared_ptr<const render::caster::FittedCones>;
    std::shared_ptr<const render::Centerlines> lines_; // that are being fitted, or could not be
    DrawnWidth width_;
    Cones made_;    // not taken yet
    Worker worker_; // last: its thread ends first
};

} // namespace ramus::app
