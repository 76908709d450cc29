// Frame: everything that determines a picture, as a plain comparable value. The window and the headless commands fill
// one and hand it to the same Renderer; equal frames give equal pictures, and nothing is drawn while nothing changes.
// Large parts are shared and never mutated in place, so a Frame is cheap to copy and to compare.
#pragma once

#include "core/tree/vessel_tree.h"
#include "render/scene/camera.h"
#include "render/scene/centerlines.h"
#include "render/scene/paged_mesh.h"
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

enum class BranchState : std::uint8_t {
    kNormal,
    kHighlighted, // in the highlight colour, and everything normal goes calm
    kDefocused,   // grey glass: what lies behind shows through, and is picked through it
    kHidden,      // not drawn, not picked
};

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
    glm::vec3 lesion{0.80F, 0.78F, 0.26F};
    glm::vec3 lost{0.36F, 0.34F, 0.52F};
    float key = 1.0F;
    float fill = 1.0F;
    float rim = 1.0F;
    float specular = 1.0F;
    float occlusion = 1.0F; // strength of the ambient occlusion, 0 = off
    float depth_cue = 1.0F; // how much the far end of the tree sinks into the background, 0 = off
    float halos = 0.0F;     // darkness around vessels that pass before others, the more the farther those are, 0 = off
    float contours = 0.0F;  // darkness where the surface turns away, 0 = off
    float shadows = 0.0F;   // that vessels throw on others close by, 0 = off
    float chromadepth = 0.0F; // how much near is red and far is blue instead of the branches' colours, 0 = off
    bool operator==(const Appearance&) const = default;
};

// How long a pixel is in a perspective picture, and where that holds. In parallel projection it holds everywhere, and
// the camera says it.
struct Scale {
    enum class At : std::uint8_t {
        kPointer, // what lies under it
        kPivot,   // what the view is being turned about
        kMiddle,  // of what is visible
    };
    At at = At::kMiddle;
    double mm_per_pixel = 0.0;
    double share = 0.0; // by which lengths of what is visible differ from that at most; kMiddle only
    bool operator==(const Scale&) const = default;
};

// What is drawn over the tree. Insets keep the overlays clear of the window's panels (pixels).
struct Overlays {
    bool orientation_cube = true;
    bool scale_bar = true;            // where a length holds: see `scale`
    std::optional<Scale> scale;       // of a perspective picture; none: no bar. render/overlay/scale_bar.h finds it
    bool orientation_letters = false; // the names of axes at the edges, R L A P S I as in radiology
    AxisNames axes = side_letters();  // on the cube and at the edges
    bool unit_known = true;           // that lengths are mm; else they are units
    bool dark_ink = false;            // words and scale bar are dark, for a light background
    std::string caption;              // Latin-1, at the top left; empty: none
    std::string heading;              // Latin-1, in the middle at the top; empty: none
    Legend legend;
    int inset_left = 0, inset_top = 0, inset_right = 0, inset_bottom = 0;
    bool operator==(const Overlays&) const = default;
};

// kInteractive draws half as many pixels a side, and the preview instead of the mesh: several times faster with a
// software rasteriser, needless where full frames come fast enough (DrawStatistics and a clock tell). Draw the same
// frame with kFull as soon as the view rests. Pictures that are kept are always kFull.
enum class Quality : std::uint8_t { kFull, kInteractive };

struct Frame {
    std::shared_ptr<const PagedMesh> mesh;    // may be null: background and overlays only
    std::shared_ptr<const PagedMesh> preview; // the same surface with fewer triangles, for kInteractive; may be null
    Camera camera;
    glm::ivec2 size{1280, 960};      // pixels
    float pixel_ratio = 1.0F;        // overlay sizes: pixels per (1/96 inch) point on a HiDPI display
    std::vector<BranchState> states; // by branch id; branches beyond its end are normal
    std::vector<glm::vec3> colours; // sRGB by branch id, for colour-by; branches beyond its end have Appearance::vessel
    std::shared_ptr<const Centerlines> centerlines; // of the surface's branches; null: none
    // What the processor draws instead of the mesh, made ahead; of these centerlines, and of about the width. Null: it
    // is made when it is needed.
    std::shared_ptr<const caster::FittedCones> cones;
    // Drawn over the vessels, as lines with rings of the radius; null: none. Hidden branches have none.
    std::shared_ptr<const Centerlines> skeleton;
    float width = 0.0F;          // of the kernel of the convolution surface, 1 or more; 0: it is no such surface
    float beyond_ends = 0.7075F; // how far the surface goes on beyond a free end, in radii there
    bool only_mesh = false;      // what the surface is like can be told by the mesh alone, not along centerlines
    bool bends = false;          // the mesh's surface bends between its vertices as their normals say
    ColourScale scale;           // instead of colours
    Lesions lesions;
    std::vector<ContextMesh> context;
    Margins margins;            // instead of colours where a band reaches, and of the scale
    std::vector<LostPart> lost; // one a branch at most; in place of every other colour
    std::vector<MarkLine> lines;
    std::vector<MarkLabel> labels;
    int hovered = kNoBranch;
    std::vector<int> hovered_dependents; // branch ids, any order: they glow with the hovered one, less than it
    std::vector<int> selected;           // branch ids, any order
    Background background;
    Appearance appearance;
    Overlays overlays;
    Quality quality = Quality::kFull;
    // The mesh is that of before: what the rest of the frame says has no surface yet. A kInteractive picture then shows
    // it as far as centerlines tell, where the processor draws and is able to; the mesh otherwise.
    bool surface_awaited = false;
    bool operator==(const Frame&) const = default;
};

} // namespace ramus::render
