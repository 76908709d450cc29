// SlicePainter: draws a SliceView over the section of a Frame, without GL. The window, the command line and reports get
// the same bytes. Keeps the sampled values and the section of the last picture, so that a change of colours, of the
// window or of what is written over the picture takes little time. Not thread-safe.
#pragma once

#include "render/image/image.h"
#include "render/overlay/overlay.h"
#include "render/slice/along_painter.h"
#include "render/slice/frame_section.h"
#include "render/slice/sampled_layers.h"
#include "render/slice/slice_view.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

// The parts of a frame that determine its section; the rest is the default.
[[nodiscard]] Frame section_source(const Frame& frame);
// Whether two frames are equal in these parts.
[[nodiscard]] bool same_section(const Frame& a, const Frame& b);

class SlicePainter {
public:
    // An opaque picture of `view.grid.size` pixels. The frame's camera, size and overlays have no effect.
    [[nodiscard]] Image paint(const Frame& frame, const SliceView& view);

    // The scans and segmentations alone; alpha 0 where there are none.
    [[nodiscard]] Image paint_alone(const SliceView& view);

    // Of the last picture.
    [[nodiscard]] const FrameSection& section() const { return section_; }

private:
    void sample(const SliceView& view);
    void cut(const Frame& frame, const SliceView& view);
    void paint_scans(const SliceView& view, Image& image) const;
    void paint_masks(const SliceView& view, Image& image) const;
    void paint_section(const SliceView& view, Image& image) const;
    static void paint_marks(const SliceView& view, Image& image);
    void paint_sprites(const SliceView& view, Image& image);

    SampledLayers sampled_; // of the same grid and sampling
    slice::PixelGrid sampled_at_;
    slice::Sampling sampled_by_;
    Frame cut_of_; // what determines the section
    slice::Plane cut_at_;
    bool cut_drawn_ = false;
    AlongPainter along_;
    FrameCutter cutter_;
    FrameSection section_;
    OverlayPainter overlays_;
};

} // namespace ramus::render
