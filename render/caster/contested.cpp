// Which cones have glass beside what is opaque: there a place of the surface can be either.
#include "render/caster/caster.h"

#include <algorithm>

namespace ramus::render::caster {

void Caster::find_contested(const std::vector<Layer>& layers) {
    const std::size_t count = segments_.size();
    if (layers == layers_ && rivals_.first.size() == count + 1) return;
    layers_ = layers;
    piece_layers_.assign(count + 1, Layer::kNone);
    for (std::size_t i = 0; i < count; ++i) {
        const auto branch = std::size_t(segments_[i].branch);
        piece_layers_[i] = branch < layers.size() ? layers[branch] : Layer::kOpaque;
    }
    rivals_.first.assign(count + 1, 0);
    rivals_.segments.clear();
    const bool any = near_width_ > 0.0F && std::ranges::find(layers, Layer::kGlass) != layers.end();
    for (std::size_t i = 0; i < count && any; ++i) {
        const Layer other = piece_layers_[i] == Layer::kGlass ? Layer::kOpaque : Layer::kGlass;
        for (std::uint32_t n = near_.first[i]; n < near_.first[i + 1]; ++n)
            if (piece_layers_[near_.segments[n]] == other) rivals_.segments.push_back(near_.segments[n]);
        if (rivals_.segments.size() % 2 != 0) rivals_.segments.push_back(static_cast<std::uint32_t>(count));
        rivals_.first[i + 1] = static_cast<std::uint32_t>(rivals_.segments.size());
    }
}

} // namespace ramus::render::caster
