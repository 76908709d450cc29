#include "app/workspace/centerlines_maker.h"

namespace ramus::app {

bool CenterlinesMaker::update(Assets& assets, const mesh::SurfaceOptions& options) {
    worker_.drain();
    bool came = false;
    if (auto made = std::exchange(made_, std::nullopt); made && assets.tree == made_of_ && made->fits(options)) {
        assets.centerlines = std::move(*made);
        came = true;
    }
    if (!centerlines_awaited(assets, options)) return came;
    if (assets.tree == tree_ && smooth_passes_ == options.smooth_passes && prune_ratio_ == options.prune_ratio)
        return came;
    tree_ = assets.tree;
    smooth_passes_ = options.smooth_passes;
    prune_ratio_ = options.prune_ratio;
    worker_.start("Making centerlines", [this, tree = tree_, options](Job&, const Worker::Post& post) {
        post([this, tree, made = centerlines_of(*tree, options)] {
            made_ = made;
            made_of_ = tree;
            tree_ = nullptr; // asked for again, they are made again
        });
    });
    return came;
}

void CenterlinesMaker::forget() {
    worker_.cancel();
    made_.reset();
    made_of_ = tree_ = nullptr;
}

} // namespace ramus::app
