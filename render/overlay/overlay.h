// The small pictures that lie over the tree: the orientation cube with its letters, the scale bar, the legend, the
// labels of lines, the caption. Painted without GL, so that they are the same bytes in the window and without one, and
// can be tested alone.
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

// All of a frame that its sprites depend on: while it stays, they do, and need not be painted again.
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
    // What `frame` shows over the tree; nothing where the picture is too small to read it. Of the same view the cube is
    // painted once: it takes longest, and other sprites change while a pointer moves.
    [[nodiscard]] std::vector<Sprite> paint(const SpriteSource& frame);
    // Words for the middle of the top (Latin-1), as large and as wide as such a picture has room for.
    [[nodiscard]] Image heading(const std::string& text, const SpriteSource& frame) const;
    // The scale bar that it has; none: none is wanted, no length holds, or the picture is too small.
    [[nodiscard]] static std::optional<ScaleBar> scale_bar(const SpriteSource& frame);
    // Where the caption ends, pixels from the top; 0 where there is none.
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
    void add_legend(const Space& space, const Legend& legend, Sprites& sprites) const;
    void add_label(const Space& space, const SpriteSource& frame, const MarkLabel& label, Sprites& sprites) const;

    OrientationCube cube_;
    Camera cube_of_; // what it was painted of last, and that
    AxisNames cube_axes_ = side_letters();
    Image cube_image_;
};

} // namespace ramus::render
