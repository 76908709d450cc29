// DepthRequest: reads the depths of a picture back into a DepthMap at half resolution, asynchronously.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/drawn.h"
#include "render/renderer/targets.h"
#include "render/scene/depth_map.h"

#include <optional>
#include <vector>

namespace ramus::render {

// The same from depths in memory, rows from below and `stride` numbers apart.
[[nodiscard]] DepthMap depth_map_of(const Frame& frame, const float* depths, glm::ivec2 size, std::ptrdiff_t stride);

class DepthRequest {
public:
    // Requests the depths; replaces an older request. `view`: of what was drawn into `from`. Throws
    // OutOfGraphicsMemory.
    void ask(const Frame& frame, const ViewSetup& view, const ResolvedTarget& from);
    void answer(DepthMap map); // answers the request without reading back
    void drop() { wanted_.reset(); }
    // Returns the answer once, when it has arrived; waits at most `seconds`.
    [[nodiscard]] std::optional<DepthMap> poll(double seconds = 0.0);

private:
    glm::ivec2 made_for_{0};
    Texture texture_;
    Framebuffer framebuffer_;
    Buffer buffer_;
    std::optional<Fence> fence_;     // none: the answer has arrived
    std::optional<DepthMap> wanted_; // the request; none: no request
    std::vector<ScanPlane> planes_;  // to be added to the answer
};

} // namespace ramus::render
