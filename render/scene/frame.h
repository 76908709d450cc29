// Frame: everything that determines a picture, as a plain comparable value. The window and headless commands fill one
// and give it to the same Renderer. Equal frames give equal pictures; an unchanged frame draws nothing. Large parts are
// shared and never mutated in place, so a Frame is cheap to copy and to compare.
#pragma once

#include "core/tree/branch_state.h"
#include "core/tree/vessel_tree.h"
#include "render/scene/camera.h"
#include "render/scene/centerlines.h"
#include "render/scene/paged_mesh.h"
#include "render/scene/scan_plane.h"
#include "render/scene/scene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ramus::render {

namespace caster {
struct FittedCones;
}

using tree::BranchState;
using tree::kNoBranch;

// sRGB, 0 to 1.
struct Background {
    glm::vec3 top{0.105F, 0.115F, 0.130F};
    glm::vec3 bottom{0.045F, 0.050F, 0.060F};
    bool transparent = false; // alpha 0 where there is nothing
    bool operator==(const Background&) const = default;
};

// Colours in sRGB. The lights are fixed to the viewer's head: a soft key from the upper left, a cool fill from the
// right, a rim.
struct Appearance {
    glm::vec3 vessel{0.80F, 0.285F, 0.235F};
    glm::vec3 highlight{1.00F, 0.74F, 0.20F};
    glm::vec3 selection{0.36F, 0.80F, 1.00F};
    glm::vec3 glass{0.66F, 0.70F, 0.76F};
    float glass_opacity = 1.0F; // 0: only the centerlines inside; 1: a veil; 2: nearly solid
    glm::vec3 centerline{0.93F, 0.95F, 0.98F};
    glm::vec3 lost{0.36F, 0.34F, 0.52F};
    float key = 1.0F;
    float fill = 1.0F;
    float rim = 1.0F;
    float specular = 1.0F;
    float occlusion = 1.0F;   // strength of the ambient occlusion, 0 = off
    float depth_cue = 1.0F;   // how much the far end of the tree fades into the background, 0 = off
    float halos = 0.0F;       // darkness around vessels in front of others, growing with their distance, 0 = off
    float contours = 0.0F;    // darkness where the surface turns away from the eye, 0 = off
    float shadows = 0.0F;     // that vessels cast on others close by, 0 = off
    float chromadepth = 0.0F; // mixes colours of depth, red near to blue far, into those of branches; 0 = off
    bool operator==(const Appearance&) const = default;
};

// The size of a pixel in a perspective picture, and where it holds. In parallel projection it holds everywhere, and
// follows from the camera.
struct Scale {
    enum class At : std::uint8_t {
        kPointer, // at the depth of what is under the pointer
        kPivot,   // at the point that the view turns about
        kMiddle,  // at the visible middle
    };
    At at = At::kMiddle;
    double mm_per_pixel = 0.0;
    double share = 0.0; // largest relative difference of visible lengths; kMiddle only
    bool operator==(const Scale&) const = default;
};

// What is drawn over the tree. Insets (pixels) keep overlays clear of the window's panels.
struct Overlays {
    bool orientation_cube = true;
    bool scale_bar = true;            // if a length holds: see `scale`
    std::optional<Scale> scale;       // for perspective, from render/overlay/scale_bar.h; none: no bar
    bool orientation_letters = false; // names of axes at the edges, R L A P S I as in radiology
    AxisNames axes = side_letters();  // on the cube and at the edges
    bool unit_known = true;           // false: lengths are in unknown units instead of mm
    bool dark_ink = false;            // text and scale bar are dark, for a light background
    std::string caption;              // Latin-1, at the top left; empty: none
    std::string heading;              // Latin-1, at the top middle; empty: none
    Legend legend;
    int inset_left = 0, inset_top = 0, inset_right = 0, inset_bottom = 0;
    bool operator==(const Overlays&) const = default;
};

// kInteractive draws half as many pixels per side and the preview instead of the mesh: several times faster with a
// software rasteriser, unnecessary where full frames are fast enough (DrawStatistics). Draw the same frame with kFull
// when the view rests. Saved pictures are always kFull.
enum class Quality : std::uint8_t { kFull, kInteractive };

struct Frame {
    std::shared_ptr<const PagedMesh> mesh;    // may be null: background and overlays only
    std::shared_ptr<const PagedMesh> preview; // the same surface with fewer triangles, for kInteractive; may be null
    Camera camera;
    glm::ivec2 size{1280, 960};                     // pixels
    float pixel_ratio = 1.0F;                       // overlay sizes: pixels per (1/96 inch) point on a HiDPI display
    std::vector<BranchState> states;                // by branch id; branches without an entry are normal
    std::vector<glm::vec3> colours;                 // sRGB by branch id, for colour-by; default: Appearance::vessel
    std::shared_ptr<const Centerlines> centerlines; // of the surface's branches; null: none
    // Cones for the caster, built in advance from `centerlines` for about this width. Null: built when needed.
    std::shared_ptr<const caster::FittedCones> cones;
    // Drawn over the vessels, as lines with rings of the radius; null: none. Omitted for hidden branches.
    std::shared_ptr<const Centerlines> skeleton;
    float width = 0.0F;          // of the kernel, 1 or more; 0: not a convolution surface
    float beyond_ends = 0.7075F; // how far the surface extends beyond a free end, in radii there
    bool only_mesh = false;      // cones along centerlines do not represent the surface
    bool bends = false;          // normals describe a smooth surface: edges may be bent
    ColourScale scale;           // replaces `colours`
    Lesions lesions;
    std::vector<ContextMesh> context;
    std::vector<ScanPlane> planes;   // at most kMostPlanes (shaders/limits.glsl) are drawn
    std::optional<CutAway> cut_away; // then neither cones nor the caster stand for the surface
    Margins margins;                 // replaces `colours` and `scale` within its bands
    std::vector<LostPart> lost;      // at most one per branch; replaces every other colour
    std::vector<MarkLine> lines;
    std::vector<MarkLabel> labels;
    int hovered = kNoBranch;
    std::vector<int> hovered_dependents; // branch ids, any order: glow like the hovered one, but less
    std::vector<int> selected;           // branch ids, any order
    Background background;
    Appearance appearance;
    Overlays overlays;
    Quality quality = Quality::kFull;
    // The mesh is outdated: the surface for the rest of the frame is not yet ready. A kInteractive picture then shows
    // the centerlines' cones if the caster can draw them, otherwise the mesh.
    bool surface_awaited = false;
    bool operator==(const Frame&) const = default;
};

} // namespace ramus::render
