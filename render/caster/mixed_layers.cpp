// Which cones have glass beside what is opaque: there a point of the surface can be either.
#include "render/caster/caster.h"

#include <algorithm>

namespace ramus::render::caster {

void Caster::find_mixed_layers(const std::vector<Layer>& layers) {
    const std::size_t count = segments_.size();
    if (layers == layers_ && other_layer_.first.size() == count + 1) return;
    layers_ = layers;
    segment_layers_.assign(count + 1, Layer::kNone);
    for (std::size_t i = 0; i < count; ++i) {
        const auto branch = std::size_t(segments_[i].branch);
        segment_layers_[i] = branch < layers.size() ? layers[branch] : Layer::kOpaque;
    }
    other_layer_.first.assign(count + 1, 0);
    other_layer_.segments.clear();
    const bool any = neighbours_width_ > 0.0F && std::ranges::find(layers, Layer::kGlass) != layers.end();
    for (std::size_t i = 0; i < count && any; ++i) {
        const Layer other = segment_layers_[i] == Layer::kGlass ? Layer::kOpaque : Layer::kGlass;
        for (std::uint32_t n = neighbours_.first[i]; n < neighbours_.first[i + 1]; ++n)
            if (segment_layers_[neighbours_.segments[n]] == other)
                other_layer_.segments.push_back(neighbours_.segments[n]);
        if (other_layer_.segments.size() % 2 != 0) other_layer_.segments.push_back(static_cast<std::uint32_t>(count));
        other_layer_.first[i + 1] = static_cast<std::uint32_t>(other_layer_.segments.size());
    }
}

} // namespace ramus::render::caster
