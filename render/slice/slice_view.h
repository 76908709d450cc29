// SliceView: a slice of a scan with what a Frame shows, cut by the slice's plane: everything that determines its
// picture, next to the frame. A plain comparable value; large parts are shared. SlicePainter draws it.
#pragma once

#include "core/slice/pixel_grid.h"
#include "core/slice/sample.h"
#include "core/slice/window.h"
#include "core/volume/volume.h"
#include "render/scene/frame.h"
#include "render/slice/along_view.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::render {

// A scan in grey, over those before it.
struct ScanLayer {
    std::shared_ptr<const volume::Volume> scan;
    slice::Window window;
    float opacity = 1.0F;
    bool operator==(const ScanLayer&) const = default;
};

// A segmentation over the scan: the area of each label is tinted, and its border drawn along pixels.
struct MaskLayer {
    struct Label {
        std::int32_t label;
        glm::vec3 colour; // sRGB
        bool operator==(const Label&) const = default;
    };
    std::shared_ptr<const volume::Volume> mask;
    std::vector<Label> labels;        // ascending; labels that are not listed are not shown
    float fill = 0.3F, border = 0.9F; // opacities
    bool operator==(const MaskLayer&) const = default;
};

// The other slices that pass through a place of this one, as lines with a gap at the place.
struct Crosshair {
    glm::dvec3 at{0.0};
    glm::vec3 row{1.0F}, column{1.0F}; // colours of the lines along rows and along columns
    bool operator==(const Crosshair&) const = default;
};

// A line over the slice, such as that of a measurement: its foot on the plane.
struct SliceMark {
    std::vector<glm::dvec3> points; // mm
    glm::vec3 colour{1.0F};         // sRGB
    float width = 1.6F;             // points
    float opacity = 1.0F;
    bool operator==(const SliceMark&) const = default;
};

struct SliceView {
    slice::PixelGrid grid; // the pixels of the picture
    std::vector<ScanLayer> scans;
    slice::Sampling sampling;
    std::vector<MaskLayer> masks;
    bool outlines = true; // of vessels, context and lesions
    bool axes = true;     // dots where centerlines cross the plane
    std::optional<Crosshair> crosshair;
    glm::vec3 background{0.0F};
    std::optional<glm::vec3> mark; // a bar of this colour at the upper edge names the slice
    std::vector<SliceMark> marks;
    std::optional<AlongView>
        along; // shows a vessel along its axis instead of the grid, which is used for the scale bar
    std::vector<MarkLabel> labels;
    Overlays overlays;
    float pixel_ratio = 1.0F;
    bool operator==(const SliceView&) const = default;
};

// A parallel camera that looks at the slice: its picture of `grid.size` pixels has the pixels of the grid.
[[nodiscard]] Camera camera_of(const slice::PixelGrid& grid);

} // namespace ramus::render
