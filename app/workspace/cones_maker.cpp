#include "app/workspace/cones_maker.h"

namespace ramus::app {

bool ConesMaker::update(Assets& assets, const mesh::SurfaceOptions& options) {
    worker_.drain();
    bool came = false;
    if (const Cones made = std::exchange(made_, nullptr); made && made->lines == assets.centerlines.lines) {
        assets.centerlines.cones = made;
        came = true;
    }
    const SurfaceCenterlines& now = assets.centerlines;
    const DrawnWidth width = drawn_width(options, options.method);
    if (!now.fits(options) || !drawn_along_lines(options, options.method) || now.cones_fit(width)) return came;
    if (lines_ == now.lines && width_ == width) return came;
    lines_ = now.lines;
    width_ = width;
    worker_.start("Fitting cones", [this, lines = lines_, width](Job&, const Worker::Post& post) {
        post([this, made = render::caster::fitted_cones(lines, width.width, width.beyond_ends)] { made_ = made; });
    });
    return came;
}

void ConesMaker::forget() {
    worker_.cancel();
    made_ = nullptr;
    lines_ = nullptr;
}

} // namespace ramus::app
