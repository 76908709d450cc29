// Sheet: one picture of several frames, in viewports beside each other or one fading into the other, as a plain
// comparable value; and SheetRenderer, which draws it. A sheet of one viewport is that frame's picture, to the bit.
// Each viewport keeps what it drew, so that what changes in one draws nothing in the others, and fading draws no frame
// again.
//
// As of Renderer: GL context, pixels from the top left, here of the sheet.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"
#include "render/overlay/overlay.h"
#include "render/renderer/renderer.h"
#include "render/renderer/targets.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

// How two pictures of one size become one: the second fades in as its share grows, in linear light, 0 to 1; or it lies
// right of a line, and the first left of it.
struct Mix {
    double share = 0.0;
    std::optional<double> line{}; // from the left, of the width, 0 to 1; at either end there is none to be seen
    float line_width = 1.0F;      // pixels
    bool operator==(const Mix&) const = default;
};

// Blend: two pictures mixed. At a share of 0 it is the first, at 1 the second, and beside a line either, to the bit. It
// keeps what it made: equal pictures mixed alike are mixed once.
//
// All calls need the GL context current that was current at make(), the destructor too.
class Blend {
public:
    [[nodiscard]] Result<void> make();

    // `heading` lies in the middle, `top` pixels from the edge; of no size: none. Throws OutOfGraphicsMemory.
    void draw(unsigned first, unsigned second, const Mix& mix, glm::ivec2 size, const Image& heading, int top);

    [[nodiscard]] const PictureTarget& picture() const { return picture_; }

private:
    Fullscreen mix_, overlay_;
    PictureTarget picture_;
};

struct Sheet {
    struct Viewport {
        glm::ivec2 at{0}; // its upper left corner; its size is the frame's
        Frame frame;
        bool has_branches = true; // else what is under a pixel is no branch
        bool operator==(const Viewport&) const = default;
    };
    glm::ivec2 size{1};              // pixels
    std::vector<Viewport> viewports; // one at least; two of the sheet's size where they are mixed
    std::optional<double> blend;     // how much there is of the second, 0 to 1
    std::optional<double> wipe;      // where the line is, of the width: the first lies left of it, the second right
    float line_width = 1.0F;         // of the line, pixels
    std::string heading;             // of two that are mixed: Latin-1, in the middle at the top
    int heading_top = 0;             // pixels above it
    glm::vec3 divider{0.0F};         // sRGB, between viewports; nothing where the background is transparent
    [[nodiscard]] bool mixed() const { return blend || wipe; }
    bool operator==(const Sheet&) const = default;
};

// Of one frame.
[[nodiscard]] Sheet sheet_of(Frame frame);

class SheetRenderer {
public:
    // `first` outlives it. Others are made as sheets need them, and let go.
    explicit SheetRenderer(Renderer& first) : first_(first) {}

    // Statistics are sums over the viewports.
    [[nodiscard]] Result<DrawStatistics> draw(const Sheet& sheet, std::size_t upload_budget = kUploadAll,
                                              double seconds = kUntilDone);
    // The same for pictures that are kept: scale bars of perspective viewports get the scale at the middle of what all
    // of them show. Waits for that.
    [[nodiscard]] Result<DrawStatistics> draw_with_scale(Sheet sheet);
    // The bar of the picture that was drawn last, of any of its viewports; none: it has none. Pixels are the picture's.
    [[nodiscard]] std::optional<ScaleBar> scale_bar() const { return scale_bar_; }
    // As Renderer::refine(), of one viewport after the other; `sheet` is the last one that draw() was given.
    [[nodiscard]] Result<Refined> refine(const Sheet& sheet, double seconds = kUntilDone);
    static void finish(); // waits until all that was drawn is there
    [[nodiscard]] Image read_image();
    void present(unsigned framebuffer, int x = 0, int y = 0); // as Renderer::present()

    // Of every pixel of the sheet whether a surface is there, in either of two pictures that are mixed.
    [[nodiscard]] std::vector<bool> read_covered();

    // As of Renderer. Of a blend what there is more of that has branches; beside a line what is seen.
    [[nodiscard]] Pick pick(glm::dvec2 at);
    // What a person points at who sees a sheet: where its viewports are, without what is drawn there, and
    // Renderer::number() of each.
    struct Seen {
        Sheet outline{};
        std::vector<int> numbers{};
        bool operator==(const Seen&) const = default;
    };
    [[nodiscard]] Seen seen() const; // of the sheet that was drawn last
    // The same as the first in a sheet that was seen, as long as its pictures are there; none: it is not known any
    // more.
    [[nodiscard]] std::optional<Pick> pick(glm::dvec2 at, const Seen& of);
    void request_pick(glm::dvec2 at);
    [[nodiscard]] std::optional<Pick> poll_pick();
    // How far away all is that each viewport shows. False: ask again after the next draw().
    bool request_depths();
    [[nodiscard]] std::optional<std::vector<DepthMap>> poll_depths();
    // The viewport that a pixel lies in; the nearest of them between viewports.
    [[nodiscard]] static std::size_t viewport_at(const Sheet& sheet, glm::dvec2 at);

private:
    [[nodiscard]] Renderer& renderer(std::size_t viewport) { return viewport == 0 ? first_ : *others_[viewport - 1]; }
    void keep(std::size_t viewports); // so many, and lets the others go
    [[nodiscard]] Result<void> blend(const Sheet& sheet);
    [[nodiscard]] static Pick without_branch(const Sheet& outline, std::size_t viewport, Pick pick);

    Renderer& first_;
    std::vector<std::unique_ptr<Renderer>> others_;
    std::optional<Blend> blend_;
    std::optional<OverlayPainter> painter_; // of its heading
    Sheet shown_;                           // of its frames only what tells where they are; each has its renderer
    std::size_t asked_ = 0;                 // the viewport of request_pick()
    std::vector<DepthMap> depths_;          // of viewports, from the first on, that have answered request_depths()
    std::optional<ScaleBar> scale_bar_;
};

} // namespace ramus::render
