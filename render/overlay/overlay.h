// Paints the small pictures (sprites) over the tree: orientation cube and letters, scale bar, legend, labels of lines,
// caption. Painted without GL, so that the window and headless commands get the same bytes.
#pragma once

#include "render/image/image.h"
#include "render/image/text.h"
#include "render/overlay/orientation_cube.h"
#include "render/overlay/scale_bar.h"
#include "render/scene/camera.h"
#include "render/scene/frame.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

struct Sprite {
    Image image;
    glm::ivec2 corner{0}; // top left, in pixels of the picture
};

// The parts of a frame that determine its sprites. While they are equal, sprites need not be painted again.
struct SpriteSource {
    Camera camera;
    glm::ivec2 size{0};
    float pixel_ratio = 0.0F;
    Overlays overlays;
    std::vector<MarkLabel> labels;
    explicit SpriteSource(const Frame& frame)
        : camera(frame.camera), size(frame.size), pixel_ratio(frame.pixel_ratio), overlays(frame.overlays),
          labels(frame.labels) {}
    bool operator==(const SpriteSource&) const = default;
};

class OverlayPainter {
public:
    // The sprites of a frame; none if the picture is too small to read them. Caches the cube of the last view: painting
    // it takes longest, and other sprites change while the pointer moves.
    [[nodiscard]] std::vector<Sprite> paint(const SpriteSource& frame);
    // The heading at the top middle (Latin-1), as large and wide as the picture allows.
    [[nodiscard]] Image heading(const std::string& text, const SpriteSource& frame) const;
    // The frame's scale bar. None if it is switched off, if no length holds, or if the picture is too small.
    [[nodiscard]] static std::optional<ScaleBar> scale_bar(const SpriteSource& frame);
    // Bottom of the caption in pixels from the top; 0 without a caption.
    [[nodiscard]] int caption_bottom(const SpriteSource& frame) const;

private:
    struct Space;
    using Sprites = std::vector<Sprite>;
    [[nodiscard]] std::optional<Sprite> caption(const SpriteSource& frame, const Space& space) const;
    void add_cube(const Space& space, const SpriteSource& frame, Sprites& sprites);
    static std::optional<ScaleBar> scale_bar(const Space& space, const SpriteSource& frame);
    static void add_scale_bar(Space& space, const SpriteSource& frame, Sprites& sprites);
    void add_words(Space& space, const SpriteSource& frame, Sprites& sprites) const;
    void add_letters(const Space& space, const SpriteSource& frame, Sprites& sprites) const;
    void add_legend(const Space& space, const SpriteSource& frame, const Legend& legend, Sprites& sprites) const;
    void add_label(const Space& space, const SpriteSource& frame, const MarkLabel& label, Sprites& sprites) const;

    OrientationCube cube_;
    Camera cube_of_; // camera, axes and image of the last cube
    AxisNames cube_axes_ = side_letters();
    Image cube_image_;
};

} // namespace ramus::render
