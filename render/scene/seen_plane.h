// Planes of a scan as pixels see them. Where a ray meets a plane is a ratio of functions that are linear in the pixel;
// they are computed here once in double precision, for shaders, the caster, picks and depth maps. Nothing here needs
// GL.
//
// Where a vessel ends exactly at a plane, or two planes coincide, rounding must not decide which is seen: each plane is
// moved away from the eye by a fraction of a pixel, later planes by a little more.
#pragma once

#include "render/scene/camera.h"
#include "render/scene/depth_map.h"
#include "render/scene/frame.h"
#include "render/scene/uniform_blocks.h"

#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

namespace ramus::render {

struct Image;

// Null if the plane has no picture, or one without or with too few pixels, of which nothing is drawn.
[[nodiscard]] const Image* picture_of(const ScanPlane& plane);

// How pixels look at the scene. Pixels count from the lower left, as in GL.
struct Sight {
    glm::dvec2 centre{0.0};  // the pixel on the view axis
    double mm_a_pixel = 1.0; // in perspective at a depth of 1 mm
    bool flat = false;       // orthographic
};
[[nodiscard]] Sight sight_of(const Camera& camera, glm::ivec2 size);

// A plane for one view. The rows are applied to (x, y, 1) of a pixel.
struct SeenPlane {
    glm::dvec3 across{0.0}, down{0.0}; // position along the edges, 0 to 1, times `inverse`
    glm::dvec3 inverse{0.0};           // in perspective 1 / depth, negative behind the eye; otherwise 1
    glm::dvec3 depth{0.0};             // mm along the line of sight; for orthographic views only
    bool flat = false;

    // `to_eye`: from mm to eye space, depth as +z. A plane that is seen exactly from its edge is nowhere: all rows are
    // 0.
    [[nodiscard]] static SeenPlane of(const ScanPlane& plane, const glm::dmat4& to_eye, const Sight& sight);
    // The depth at a pixel, if the rectangle covers it and its picture is not transparent there.
    [[nodiscard]] std::optional<double> depth_at(glm::dvec2 pixel, const Image& picture) const;
};

// The nearest plane at a pixel.
struct PlaneHit {
    int plane = kNoPlane;
    double depth_mm = 0.0;
};
class SeenPlanes {
public:
    // The planes' pictures must outlive the object.
    SeenPlanes(const std::vector<ScanPlane>& planes, const Camera& camera, glm::ivec2 size);
    [[nodiscard]] PlaneHit at(glm::dvec2 pixel) const; // from the lower left
    [[nodiscard]] bool empty() const { return seen_.empty(); }

private:
    std::vector<SeenPlane> seen_;
    std::vector<const Image*> pictures_; // null: nothing is drawn inside the outline
};

// Puts the planes among the depths of the map, whose camera and size they are seen with.
void add_planes(const std::vector<ScanPlane>& planes, DepthMap& map);

// What shaders/caps.glsl needs, if the eye is on the side that is removed.
[[nodiscard]] std::optional<glm::vec4> cap_values_of(const CutAway& cut, const Camera& camera, const ViewBlock& view);

// The block of shaders/look/slices.glsl. `pixels_a_point`: for outlines.
[[nodiscard]] PlanesBlock planes_block(const std::vector<ScanPlane>& planes, const glm::dmat4& to_eye,
                                       const ViewBlock& view, float pixels_a_point);

} // namespace ramus::render
