// SampledLayers: the values of scans where a picture has its pixels, kept from picture to picture.
#pragma once

#include "render/slice/slice_view.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace ramus::render {

struct SampledLayer {
    std::shared_ptr<const volume::Volume> scan;
    std::vector<float> values; // NaN outside of the scan
};

class SampledLayers {
public:
    void clear() { layers_.clear(); } // where pixels or sampling have changed
    // Those of `scans` in their order; `sample(scan)` gives the values of one that is not known yet.
    template <class Sample> void take(const std::vector<ScanLayer>& scans, const Sample& sample) {
        std::vector<SampledLayer> layers;
        for (const ScanLayer& layer : scans) {
            const auto known = std::ranges::find(layers_, layer.scan, &SampledLayer::scan);
            layers.push_back(known != layers_.end() ? *known : SampledLayer{layer.scan, sample(*layer.scan)});
        }
        layers_ = std::move(layers);
    }
    [[nodiscard]] const std::vector<SampledLayer>& all() const { return layers_; }

private:
    std::vector<SampledLayer> layers_;
};

} // namespace ramus::render
