// DepthRequest: the depths of what a picture shows, read back at half its resolution into a DepthMap, without waiting:
// they are on their way from the card.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/drawn.h"
#include "render/renderer/targets.h"
#include "render/scene/depth_map.h"

#include <optional>

namespace ramus::render {

// At the same places of what is in memory already, rows from below, `stride` numbers each.
[[nodiscard]] DepthMap depth_map_of(const Frame& frame, const float* depths, glm::ivec2 size, std::ptrdiff_t stride);

class DepthRequest {
public:
    // A newer one replaces an older one. `view`: of what was drawn into `from`. Throws OutOfGraphicsMemory.
    void ask(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from);
    void answer(DepthMap map); // known already
    void drop() { wanted_.reset(); }
    // Once: the answer when it is there.
    [[nodiscard]] std::optional<DepthMap> poll(double seconds = 0.0);

private:
    glm::ivec2 made_for_{0};
    Texture texture_;
    Framebuffer framebuffer_;
    Buffer buffer_;
    std::optional<Fence> fence_;     // none: the answer is there
    std::optional<DepthMap> wanted_; // what was asked for
};

} // namespace ramus::render
