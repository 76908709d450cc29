// Finds what lies under a pixel, from ids and depths that were read back. Pixels of pictures count from the top left;
// windows are in GL's pixels of the passes, from the lower left.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/drawn.h"
#include "render/renderer/targets.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ramus::render {

// The pixels that a pick reads back; empty if the point is outside the picture.
struct PickWindow {
    glm::dvec2 at{0.0};
    double reach = 0.0;
    int x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};
[[nodiscard]] PickWindow pick_window(float pixel_ratio, const ViewSetup& view, double x, double y);

// The id nearest to `window.at`, within its reach, that no plane hides; if there is no vessel or lesion, the plane at
// `window.at`. `ids` and `depths` (mm): the window's pixels without planes, row by row.
[[nodiscard]] Pick nearest_in(const PickWindow& window, const std::uint32_t* ids, const float* depths,
                              const Camera& camera, const ViewSetup& view, const std::vector<ScanPlane>& planes);

// Copies ids (kTargetIdNormal) or depths (kTargetPickedDepth) of the window to memory, or into the bound pixel pack
// buffer.
void read_pixels(const PickWindow& window, const ResolvedTarget& from, int target, void* to);

// kNoBranch if the id is 0 or belongs to something else.
[[nodiscard]] int branch_of(std::uint32_t id);

// An asynchronous pick.
class PickRequest {
public:
    // Requests a pick; replaces an older request. Throws OutOfGraphicsMemory.
    void ask(const PickWindow& window, const Camera& camera, const std::vector<ScanPlane>& planes,
             const ResolvedTarget& from);
    void answer(const Pick& pick); // answers the request without reading back
    void drop();
    // Returns the answer once, when it has arrived. `view`: the current one; after a change of size there is no answer.
    [[nodiscard]] std::optional<Pick> poll(const ViewSetup& view);

private:
    Buffer buffer_; // ids, then depths
    std::size_t capacity_ = 0;
    std::optional<Fence> fence_;
    PickWindow window_;
    Camera camera_;
    std::vector<ScanPlane> planes_;
    std::optional<Pick> answer_;
};

} // namespace ramus::render
