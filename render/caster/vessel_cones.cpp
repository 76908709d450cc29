#include "render/caster/vessel_cones.h"

#include <algorithm>

namespace ramus::render::caster {

// Cones of another width are a good approximation, and the owner will provide the right ones soon.
void VesselCones::follow(const Frame& frame, const std::shared_ptr<const FittedCones>& known) {
    const auto before = fitted_;
    const auto fits = [&](const FittedCones& cones) {
        return cones.lines == frame.centerlines && (cones.width > 0.0F) == (frame.width > 0.0F);
    };
    const auto exact = [&](const std::shared_ptr<const FittedCones>& cones) {
        return cones && fits(*cones) && cones->width == frame.width && cones->beyond_ends == frame.beyond_ends;
    };
    if (frame.cones && fits(*frame.cones))
        fitted_ = frame.cones;
    else if (exact(known))
        fitted_ = known;
    else if (!exact(fitted_))
        fitted_ = fitted_cones(frame.centerlines, frame.width, frame.beyond_ends);
    if (fitted_ == before) return;
    layers_.clear();
    other_layer_.first.clear();
}

// Where layers are mixed, a surface point can belong to either.
void VesselCones::find_mixed_layers(const std::vector<Layer>& layers) {
    const FittedCones& fitted = *fitted_;
    const Neighbours& neighbours = fitted.neighbours;
    const std::size_t count = fitted.segments.size();
    if (layers == layers_ && other_layer_.first.size() == count + 1) return;
    layers_ = layers;
    segment_layers_.assign(count + 1, Layer::kNone);
    for (std::size_t i = 0; i < count; ++i) {
        const auto branch = std::size_t(fitted.segments[i].branch);
        segment_layers_[i] = branch < layers.size() ? layers[branch] : Layer::kOpaque;
    }
    other_layer_.first.assign(count + 1, 0);
    other_layer_.segments.clear();
    const bool any = fitted.neighbours_width > 0.0F && std::ranges::find(layers, Layer::kGlass) != layers.end();
    for (std::size_t i = 0; i < count && any; ++i) {
        const Layer other = segment_layers_[i] == Layer::kGlass ? Layer::kOpaque : Layer::kGlass;
        for (std::uint32_t n = neighbours.first[i]; n < neighbours.first[i + 1]; ++n)
            if (segment_layers_[neighbours.segments[n]] == other)
                other_layer_.segments.push_back(neighbours.segments[n]);
        if (other_layer_.segments.size() % 2 != 0) other_layer_.segments.push_back(static_cast<std::uint32_t>(count));
        other_layer_.first[i + 1] = static_cast<std::uint32_t>(other_layer_.segments.size());
    }
}

} // namespace ramus::render::caster
