#include "render/glass_meetings.h"

#include <algorithm>

namespace ramus::render {

GlassMeetings::GlassMeetings(std::vector<Layer> layers, std::size_t count, const GpuLines& lines) {
    layers.resize(std::max(count, layers.size()), Layer::kOpaque);
    const auto meetings = lines.meetings(layers);
    away = meeting = layers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        (meetings[i].empty() ? meeting : away)[i] = Layer::kNone;
        spans.push_back({static_cast<std::uint32_t>(company.size()), static_cast<std::uint32_t>(meetings[i].size())});
        for (const int other : meetings[i])
            company.push_back({static_cast<std::uint32_t>(other),
                               layers[static_cast<std::size_t>(other)] == Layer::kGlass ? 1U : 0U});
    }
    if (company.empty()) meeting.clear();
}

std::vector<Layer> GlassMeetings::meeting_as(Layer layer) const {
    std::vector<Layer> same = meeting;
    for (Layer& one : same)
        if (one != Layer::kNone) one = layer;
    return same;
}

} // namespace ramus::render
