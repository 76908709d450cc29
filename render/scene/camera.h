// Camera: the viewer's position and direction, as a plain value in mm (RAS) without a window or GL. Near and far planes
// are not part of it: the renderer fits them to what it draws.
//
// Pixels count from the top left of a picture of `size`. Every function returns a camera that can be drawn: the
// distance to the focal point is positive and view-up is not parallel to the line of sight. camera_moves.h has the
// moves of the mouse. JSON names are those of session files.
#pragma once

#include "core/base/error.h"
#include "render/scene/bounds.h"

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ramus::render {

struct Camera {
    glm::dvec3 position{0.0, 500.0, 0.0};
    glm::dvec3 focal_point{0.0};
    glm::dvec3 view_up{0.0, 0.0, 1.0};
    double view_angle = 30.0; // vertical opening angle in degrees, perspective only
    bool orthographic = false;
    double scale = 100.0; // half the height of the picture in mm, orthographic only (VTK's parallel scale)
    bool inside = false;  // the eye is inside a vessel
    bool operator==(const Camera&) const = default;
};

// Right-handed unit axes of the picture: right and up on the screen, forward into it.
struct CameraAxes {
    glm::dvec3 right, up, forward;
};
[[nodiscard]] CameraAxes axes_of(const Camera& camera);

// World to eye space (the eye looks along -z), and eye to clip space. `near_mm`, `far_mm`: along the line of sight.
[[nodiscard]] glm::dmat4 view_matrix(const Camera& camera);
[[nodiscard]] glm::dmat4 projection_matrix(const Camera& camera, glm::ivec2 size, double near_mm, double far_mm);

// Millimetres that one pixel spans in the plane through the focal point.
[[nodiscard]] double mm_per_pixel(const Camera& camera, glm::ivec2 size);

// Projects a point to pixel (x, y) and depth along the line of sight in mm; none if it is not in front of the eye.
[[nodiscard]] std::optional<glm::dvec3> project(const Camera& camera, glm::ivec2 size, const glm::dvec3& point);

// project() for many points of one picture.
class Projector {
public:
    Projector(const Camera& camera, glm::ivec2 size);
    [[nodiscard]] std::optional<glm::dvec3> operator()(const glm::dvec3& point) const;

private:
    CameraAxes axes_;
    glm::dvec3 position_;
    double half_width_px_, half_height_px_;
    double half_height_mm_; // of the picture; in perspective at a depth of 1 mm
    bool orthographic_;
};

// The point at `pixel`, `depth_mm` along the line of sight away from the eye. Inverse of project().
[[nodiscard]] glm::dvec3 unproject(const Camera& camera, glm::ivec2 size, glm::dvec2 pixel, double depth_mm);

// The six anatomical views. Anterior: the viewer stands in front of the patient, so that the patient's right is at the
// left of the picture. Superior is up; in the superior and inferior views anterior is up. The inferior view (from the
// feet) is the radiologist's axial picture.
enum class View { kAnterior, kPosterior, kLeft, kRight, kSuperior, kInferior };
inline constexpr std::array kViews{View::kAnterior, View::kPosterior, View::kLeft,
                                   View::kRight,    View::kSuperior,  View::kInferior};
[[nodiscard]] std::string_view name_of(View view); // "anterior", ...
// The viewer's position if the patient's sides are unknown: "+y" for anterior.
[[nodiscard]] std::string_view axis_name_of(View view);
// "Anterior", or "From +y" if the sides are unknown. For headings and menus.
[[nodiscard]] std::string title_of(View view, bool sides_known);
[[nodiscard]] std::optional<View> view_named(std::string_view name); // by either name

// Labels of the directions +x, -x, +y, -y, +z, -z.
using AxisNames = std::array<std::string, 6>;
[[nodiscard]] const AxisNames& side_letters(); // R L A P S I, if the axes are known to be RAS
[[nodiscard]] const AxisNames& plain_axes();   // +x -x ...: no side of the patient is claimed

// Leaves the vessel: a camera that is not `inside`, with the usual opening angle. Other cameras are unchanged.
[[nodiscard]] Camera outside(Camera camera);

// Takes direction and view-up from `view`; focal point, distance and the rest stay.
[[nodiscard]] Camera looking(const Camera& camera, View view);
// Same direction; all of `box` fills the picture, up to a small margin.
[[nodiscard]] Camera fitted(const Camera& camera, const Box& box, glm::ivec2 size);
// Same direction; these points (a mesh's positions) fill the picture tightly and centred. Takes a few milliseconds for
// a million points.
[[nodiscard]] Camera fitted(const Camera& camera, std::span<const glm::vec3> points, glm::ivec2 size);
// fitted() needs only the points that are farthest along these directions (PagedMesh::farthest()).
[[nodiscard]] std::array<glm::dvec3, 10> fitting_directions(const Camera& camera, glm::ivec2 size);
// A new camera by looking() and fitted().
[[nodiscard]] Camera camera_for(std::span<const glm::vec3> points, View view, glm::ivec2 size,
                                bool orthographic = false);
[[nodiscard]] Camera camera_for(const Box& box, View view, glm::ivec2 size, bool orthographic = false);

// Switches the projection; the size of what is at the focal point stays.
[[nodiscard]] Camera with_projection(const Camera& camera, bool orthographic);

// Rotates about the focal point; angles in degrees (azimuth moves the viewer to the right, elevation upward).
[[nodiscard]] Camera turned(const Camera& camera, double azimuth_deg, double elevation_deg);
// Zooms about the focal point by `factor` (> 1 magnifies).
[[nodiscard]] Camera zoomed(const Camera& camera, double factor);
// `point` becomes the focal point; direction and distance stay.
[[nodiscard]] Camera centred_on(const Camera& camera, const glm::dvec3& point);

// Interpolates two cameras (0 = from, 1 = to) with the shortest rotation, for animated view changes.
[[nodiscard]] Camera interpolated(const Camera& from, const Camera& to, double t);

// JSON with the names of session files: position, focal_point, view_up, view_angle, orthographic, scale, and inside if
// true. Reading uses the defaults above for missing names. It rejects unknown names, wrong types, numbers that are not
// finite and cameras that cannot be drawn. `where` names the source in messages.
[[nodiscard]] nlohmann::json to_json(const Camera& camera);
[[nodiscard]] Result<Camera> camera_from_json(const nlohmann::json& json, const std::string& where);
[[nodiscard]] Result<Camera> parse_camera(std::string_view text, const std::string& where);

} // namespace ramus::render
