// What a picture shows beside vessels, and what their colours mean: lesions, margins around them, context, cuts,
// lines with labels, a legend. Plain comparable values; positions in mm (RAS), colours in sRGB, texts in Latin-1.
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

// Colours that follow a value from point to point: one along the branches, which needs Frame::centerlines (the
// diameter, the way from the root, or one of their lists of numbers), or the surface's own (PagedMesh::with_values()).
// Values beyond an end have its colour; where none is known, and on a surface without values, Frame::colours are seen.
struct ColourScale {
    enum class Value : std::uint8_t { kNone, kDiameter, kRootDistance, kSurface, kOfLines };
    Value value = Value::kNone;
    float low = 0.0F, high = 1.0F; // mm; of a surface's values, their unit
    bool logarithmic = false;
    std::uint32_t list = 0;      // of kOfLines: which of Centerlines::lists
    std::vector<glm::vec3> ramp; // even steps from low to high
    bool operator==(const ColourScale&) const = default;
};

// Signed distance to closed meshes on a grid, mm, negative inside. Beyond the grid counts as far.
struct DistanceGrid {
    glm::ivec3 size{0};
    glm::dvec3 corner{0.0}; // mm, of the first sample
    double step_mm = 1.0;
    std::vector<float> values; // x fastest

    [[nodiscard]] bool whole() const { // has the samples that it says
        return size.x > 0 && size.y > 0 && size.z > 0 &&
               values.size() == std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z);
    }
};

// The colour of a point of the surface by how far it is from the lesions; beyond the last band that of its branch.
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

// Seen through like clear context, and picked as if they were opaque.
struct Lesions {
    std::vector<glm::dvec4> spheres; // centre and radius
    std::vector<std::shared_ptr<const mesh::TriangleMesh>> meshes;
    std::shared_ptr<const DistanceGrid> distances; // to the meshes; null: none
    bool operator==(const Lesions&) const = default;
};

// A surface beside the tree, in the same coordinates: an organ, a lesion, a bone, another surface of the same vessels.
// It is never picked: through one that is clear vessels are, an opaque one hides them.
struct ContextMesh {
    std::shared_ptr<const mesh::TriangleMesh> mesh;    // with or without normals, closed or open; null: nothing
    std::shared_ptr<const mesh::TriangleMesh> preview; // the same with fewer triangles, for kInteractive; may be null
    glm::vec3 colour{0.8F};
    float opacity = 0.3F;   // where it faces the eye, denser towards its outline; 0: nothing, 1: as solid as vessels
    bool wireframe = false; // its triangles' edges, as lines, in place of the surface
    bool operator==(const ContextMesh&) const = default;
    [[nodiscard]] bool shown() const { return mesh != nullptr && opacity > 0.0F; }
    [[nodiscard]] bool clear() const { return shown() && (opacity < 1.0F || wireframe); }
    [[nodiscard]] bool solid() const { return shown() && !clear(); }
};

inline constexpr float kContextLineWidth = 1.15F;  // points
inline constexpr double kContextLinesNearer = 1.5; // pixels that they come towards the eye, off what they lie on

// The part of a branch that is lost, as fractions of its length from the parent's end. Parts other than the whole need
// Frame::centerlines.
struct LostPart {
    int branch = -1;
    double from = 0.0, to = 1.0;
    [[nodiscard]] bool whole() const { return from <= 0.0 && to >= 1.0; }
    bool operator==(const LostPart&) const = default;
};

// A line over the picture, of constant width in points (1/96 inch). Fainter where vessels hide it.
struct MarkLine {
    std::vector<glm::dvec3> points;
    glm::vec3 colour{1.0F};
    float width = 1.6F;
    // Of something selected: seen only where what is not selected hides it.
    bool of_selection = false;
    double inside_mm = 0.0; // it runs inside vessels: walls that are nearer than this to the line do not hide it
    bool operator==(const MarkLine&) const = default;
};

struct MarkLabel {
    glm::dvec3 at{0.0};
    std::string text;
    bool operator==(const MarkLabel&) const = default;
};

// What the colours say: a bar with ticks, or swatches.
struct Legend {
    struct Tick {
        double at; // of the bar, 0 to 1
        std::string text;
        bool operator==(const Tick&) const = default;
    };
    struct Swatch {
        glm::vec3 colour;
        std::string text;
        bool hatched = false; // as what is lost is drawn
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
