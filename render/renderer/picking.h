// What lies under a pixel, from ids and depths that were read back. Pixels of pictures have their origin at the top
// left, those of windows are GL's, of what passes drew.
#pragma once

#include "render/gl/gl_objects.h"
#include "render/renderer/drawn.h"
#include "render/renderer/targets.h"

#include <cstdint>
#include <optional>

namespace ramus::render {

// The part of what was drawn that a pick looks at; of no size: the pixel is outside.
struct PickWindow {
    glm::dvec2 at{0.0};
    double reach = 0.0;
    int x = 0, y = 0, width = 0, height = 0;
    [[nodiscard]] std::size_t pixels() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};
[[nodiscard]] PickWindow pick_window(float pixel_ratio, const ViewSetup& view, double x, double y);

// The id nearest to the middle of the window, within its reach. Row by row as `window` has them; depths in mm.
[[nodiscard]] Pick nearest_in(const PickWindow& window, const std::uint32_t* ids, const float* depths,
                              const Camera& camera, const ViewSetup& view);

// Copies ids (kTargetIdNormal) or depths (kTargetPickedDepth) of the window: to memory, or into the pixel pack buffer
// that is bound.
void read_pixels(const PickWindow& window, const ResolvedTarget& from, int target, void* to);

// kNoBranch where the id is none, or of something else.
[[nodiscard]] int branch_of(std::uint32_t id);

// A pick that does not wait: its pixels are on their way from the card.
class PickRequest {
public:
    // A newer one replaces an older one. Throws OutOfGraphicsMemory.
    void ask(const PickWindow& window, const Camera& camera, const ResolvedTarget& from);
    void answer(const Pick& pick); // known already
    void drop();
    // Once: the answer when it is there. `view` is that of now: after one of another size there is nothing.
    [[nodiscard]] std::optional<Pick> poll(const ViewSetup& view);

private:
    Buffer buffer_; // ids, then depths
    std::size_t capacity_ = 0;
    std::optional<Fence> fence_;
    PickWindow window_;
    Camera camera_;
    std::optional<Pick> answer_;
};

} // namespace ramus::render
