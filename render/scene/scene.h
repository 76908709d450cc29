// Parts of a frame other than vessels, and the meaning of colours: lesions, margins, context, cuts, lines with labels,
// legend. Plain comparable values; positions in mm (RAS), colours in sRGB, text in Latin-1.
#pragma once

#include "core/mesh/triangle_mesh.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

namespace ramus::render {

// Colours by a value that varies from point to point: along branches, which needs Frame::centerlines (diameter,
// distance from the root, or one of their lists), or on the surface (PagedMesh::with_values()). Values outside the
// range get the colour of the nearer end. Without a value, and on a surface without values, Frame::colours apply.
struct ColourScale {
    enum class Value : std::uint8_t { kNone, kDiameter, kRootDistance, kSurface, kOfLines };
    Value value = Value::kNone;
    float low = 0.0F, high = 1.0F; // mm, or the unit of the values
    bool logarithmic = false;
    std::uint32_t list = 0;      // kOfLines: index into Centerlines::lists
    std::vector<glm::vec3> ramp; // even steps from low to high
    bool operator==(const ColourScale&) const = default;
};

// Signed distance to closed meshes on a grid, mm, negative inside. Points outside the grid count as far away.
struct DistanceGrid {
    glm::ivec3 size{0};
    glm::dvec3 corner{0.0}; // position of the first sample, mm
    double step_mm = 1.0;
    std::vector<float> values; // x fastest

    [[nodiscard]] bool whole() const { // `values` matches `size`
        return size.x > 0 && size.y > 0 && size.z > 0 &&
               values.size() == std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
    }
};

// Colours surface points by their distance from the lesions; beyond the last band a point has its branch's colour.
struct Margins {
    static constexpr std::size_t kMost = 16;
    struct Band {
        float within_mm;
        glm::vec3 colour;
        bool operator==(const Band&) const = default;
    };
    std::vector<Band> bands; // ascending; empty: no bands. At most kMost are shown.
    bool operator==(const Margins&) const = default;
};

// Colour, and opacity where the surface faces the eye.
struct ShapeLook {
    glm::vec3 colour{0.80F, 0.78F, 0.26F};
    float opacity = 0.6F; // 0: not drawn. Tuned by eye for lesions: solid, with vessels inside visible
    bool operator==(const ShapeLook&) const = default;
};

// Drawn transparent like context, but picked as if opaque.
struct Lesions {
    std::vector<glm::dvec4> spheres; // centre and radius
    std::vector<std::shared_ptr<const mesh::TriangleMesh>> meshes;
    std::vector<ShapeLook> looks; // of the spheres, then of the meshes; the default where there is none
    std::shared_ptr<const DistanceGrid> distances; // to `meshes`; null: none
    bool operator==(const Lesions&) const = default;
    [[nodiscard]] std::size_t count() const { return spheres.size() + meshes.size(); }
    [[nodiscard]] ShapeLook look(std::size_t lesion) const {
        return lesion < looks.size() ? looks[lesion] : ShapeLook{};
    }
};

// A surface next to the tree, in the same coordinates: an organ, a lesion, a bone, another surface of the same vessels.
// It is never picked: vessels are picked through transparent ones and hidden by opaque ones.
struct ContextMesh {
    std::shared_ptr<const mesh::TriangleMesh> mesh;    // with or without normals, closed or open; null: nothing
    std::shared_ptr<const mesh::TriangleMesh> preview; // the same with fewer triangles, for kInteractive; may be null
    glm::vec3 colour{0.8F};
    float opacity = 0.3F;          // where it faces the eye, higher towards its outline; 0: invisible, 1: opaque
    bool wireframe = false;        // draws the edges of triangles instead of the surface
    bool filled_on_slices = false; // slices tint its inside, as for territories
    bool operator==(const ContextMesh&) const = default;
    [[nodiscard]] bool shown() const { return mesh != nullptr && opacity > 0.0F; }
    [[nodiscard]] bool clear() const { return shown() && (opacity < 1.0F || wireframe); }
    [[nodiscard]] bool solid() const { return shown() && !clear(); }
};

// Removes everything on one side of a plane: vessels, glass, lesions, context, and lines of skeletons; not planes of a
// scan, marks and labels. Closed opaque surfaces get flat caps in their own colours. Glass is left open.
struct CutAway {
    glm::dvec3 point{0.0};            // mm, on the plane
    glm::dvec3 normal{0.0, 0.0, 1.0}; // of unit length; what it points to is removed
    bool operator==(const CutAway&) const = default;
};

inline constexpr float kContextLineWidth = 1.15F;  // points
inline constexpr double kContextLinesNearer = 1.5; // pixels by which lines are moved towards the eye, off their surface

// The part of a branch that a cut loses, as fractions of its length from the parent's end. Parts other than the whole
// need Frame::centerlines.
struct LostPart {
    int branch = -1;
    double from = 0.0, to = 1.0;
    [[nodiscard]] bool whole() const { return from <= 0.0 && to >= 1.0; }
    bool operator==(const LostPart&) const = default;
};

// A line over the picture, of constant width in points (1/96 inch); fainter where vessels hide it.
struct MarkLine {
    std::vector<glm::dvec3> points;
    glm::vec3 colour{1.0F};
    float width = 1.6F;
    // Outlines a selected object: drawn only where something that is not selected hides it.
    bool of_selection = false;
    double inside_mm = 0.0; // for lines inside vessels: walls nearer than this do not hide the line
    bool operator==(const MarkLine&) const = default;
};

struct MarkLabel {
    glm::dvec3 at{0.0};
    std::string text;
    bool operator==(const MarkLabel&) const = default;
};

// Explains the colours: a bar with ticks, or swatches.
struct Legend {
    struct Tick {
        double at; // position on the bar, 0 to 1
        std::string text;
        bool operator==(const Tick&) const = default;
    };
    struct Swatch {
        glm::vec3 colour;
        std::string text;
        bool hatched = false; // hatched as lost parts are drawn
        bool operator==(const Swatch&) const = default;
    };
    std::string title;    // "Diameter (mm)"; empty: no legend
    std::string subtitle; // under it; empty: none
    std::vector<glm::vec3> bar;
    std::vector<Tick> ticks;
    std::vector<Swatch> swatches;
    bool operator==(const Legend&) const = default;
};

} // namespace ramus::render
