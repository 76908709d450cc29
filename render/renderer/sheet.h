// Sheet: a picture of several frames and slices, in adjacent viewports, or of two mixed frames, as a comparable value.
// SheetRenderer draws it. A
// sheet with one viewport equals that frame's picture, bit by bit. Each viewport keeps its picture, so a change in one
// draws nothing in the others, and fading draws no frame again.
//
// GL context and pixels as for Renderer; pixels are those of the sheet.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"
#include "render/overlay/overlay.h"
#include "render/renderer/renderer.h"
#include "render/renderer/slice_screen.h"
#include "render/renderer/targets.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

// How to mix two pictures of equal size: fade, where the second has a weight in linear light; or wipe, where a vertical
// line separates the first picture on its left from the second on its right.
struct Mix {
    double share = 0.0;           // weight of the second, 0 to 1
    std::optional<double> line{}; // position from the left as a fraction of the width; invisible at 0 and 1
    float line_width = 1.0F;      // pixels
    bool operator==(const Mix&) const = default;
};

// Blend: draws two mixed pictures. At a share of 0 or 1, and on either side of the line, the result equals a picture
// bit by bit. Caches the last result.
//
// All calls, including the destructor, need the GL context that was current at make().
class Blend {
public:
    [[nodiscard]] Result<void> make();

    // `heading`: drawn centred, `top` pixels from the edge; empty: none. Throws OutOfGraphicsMemory.
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
        bool has_branches = true; // false: picks find no branch here
        // Shows the section of the frame instead; its grid has the frame's size. Not in mixed sheets.
        std::optional<SliceView> slice{};
        bool operator==(const Viewport&) const = default;
    };
    glm::ivec2 size{1};              // pixels
    std::vector<Viewport> viewports; // at least one; exactly two of the sheet's size if mixed
    std::optional<double> blend;     // weight of the second, 0 to 1
    std::optional<double> wipe;      // line as a fraction of the width: first left of it, second right
    float line_width = 1.0F;         // of the line, pixels
    std::string heading;             // of mixed sheets: Latin-1, at the top middle
    int heading_top = 0;             // pixels above it
    glm::vec3 divider{0.0F};         // sRGB, between viewports; not drawn on transparent backgrounds
    [[nodiscard]] bool mixed() const { return blend || wipe; }
    bool operator==(const Sheet&) const = default;
};

// A sheet with one viewport.
[[nodiscard]] Sheet sheet_of(Frame frame);

class SheetRenderer {
public:
    // `first` must outlive the object. Further renderers are created and released as sheets need them.
    explicit SheetRenderer(Renderer& first) : first_(first) {}

    // See Renderer::draw(); statistics are summed over the viewports.
    [[nodiscard]] Result<DrawStatistics> draw(const Sheet& sheet, std::size_t upload_budget = kUploadAll,
                                              double seconds = kUntilDone);
    // For pictures to save: scale bars of perspective viewports get the scale at the middle of what all viewports show.
    // Waits for the depths.
    [[nodiscard]] Result<DrawStatistics> draw_with_scale(Sheet sheet);
    // A scale bar of the last sheet, from any of its viewports; none if it has none. Pixels are the picture's.
    [[nodiscard]] std::optional<ScaleBar> scale_bar() const { return scale_bar_; }
    // See Renderer::refine(); refines one viewport after the other. `sheet`: the last argument of draw().
    [[nodiscard]] Result<Refined> refine(const Sheet& sheet, double seconds = kUntilDone);
    static void finish(); // waits until OpenGL has drawn everything
    [[nodiscard]] Image read_image();
    void present(unsigned framebuffer, int x = 0, int y = 0); // see Renderer::present()

    // For every pixel of the sheet: whether it shows a surface, in either picture if mixed.
    [[nodiscard]] std::vector<bool> read_covered();

    // See Renderer. In a fade, picks in the picture with the larger weight; in a wipe, in the visible one.
    [[nodiscard]] Pick pick(glm::dvec2 at);
    // Identifies a sheet that a person saw: the layout of its viewports, without their contents, and each
    // Renderer::number().
    struct Seen {
        Sheet outline{};
        std::vector<int> numbers{};
        bool operator==(const Seen&) const = default;
    };
    [[nodiscard]] Seen seen() const; // of the last sheet drawn
    // Picks in a sheet that was seen earlier, as long as its pictures exist; otherwise none.
    [[nodiscard]] std::optional<Pick> pick(glm::dvec2 at, const Seen& of);
    void request_pick(glm::dvec2 at);
    [[nodiscard]] std::optional<Pick> poll_pick();
    // Requests the depths of each viewport. False: ask again after the next draw().
    bool request_depths();
    [[nodiscard]] std::optional<std::vector<DepthMap>> poll_depths();
    // The viewport at a pixel; between viewports the nearest.
    [[nodiscard]] static std::size_t viewport_at(const Sheet& sheet, glm::dvec2 at);

private:
    // What draws a viewport: a screen for a slice, else a renderer. By the numbers of slices and frames before it.
    [[nodiscard]] static std::size_t place_of(const Sheet& sheet, std::size_t viewport);
    [[nodiscard]] Renderer& renderer(const Sheet& sheet, std::size_t viewport) {
        const std::size_t place = place_of(sheet, viewport);
        return place == 0 ? first_ : *others_[place - 1];
    }
    [[nodiscard]] SliceScreen& screen(const Sheet& sheet, std::size_t viewport) {
        return screens_[place_of(sheet, viewport)];
    }
    void keep(const Sheet& sheet); // releases further renderers and screens
    void draw_slices(const Sheet& sheet, DrawStatistics& sum);
    [[nodiscard]] Result<void> blend(const Sheet& sheet);
    [[nodiscard]] static Pick without_branch(const Sheet& outline, std::size_t viewport, Pick pick);

    Renderer& first_;
    std::vector<std::unique_ptr<Renderer>> others_;
    std::vector<SliceScreen> screens_;
    std::optional<Blend> blend_;
    std::optional<OverlayPainter> painter_; // for the heading
    Sheet shown_;                           // the last sheet; frames reduced to their layout
    std::size_t asked_ = 0;                 // the viewport of request_pick()
    std::vector<DepthMap> depths_;          // of the viewports that have answered request_depths(), in order
    std::optional<Pick> slice_pick_;        // the answer to request_pick() in a slice
    std::optional<ScaleBar> scale_bar_;
};

} // namespace ramus::render
