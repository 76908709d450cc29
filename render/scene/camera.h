// Camera: where the viewer stands, as a plain value in mm (RAS) without a window or GL. "Did the view change?" is a
// comparison of two cameras. Near and far planes are not part of it: the renderer fits them to what it draws.
//
// Pixels have their origin at the top left of a picture of `size`. No function leaves a camera that cannot be drawn:
// the distance to the focal point stays positive, the view-up vector stays away from the line of sight. What the mouse
// makes of a camera is in camera_moves.h. The JSON names are those of a session file.
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
    bool inside = false;  // the eye is inside a vessel, whose wall it sees from within
    bool operator==(const Camera&) const = default;
};

// Right-handed unit axes of the picture: right and up on the screen, forward into it.
struct CameraAxes {
    glm::dvec3 right, up, forward;
};
[[nodiscard]] CameraAxes axes_of(const Camera& camera);

// World to eye (the eye looks along -z) and eye to clip. `near_mm`, `far_mm` along the line of sight.
[[nodiscard]] glm::dmat4 view_matrix(const Camera& camera);
[[nodiscard]] glm::dmat4 projection_matrix(const Camera& camera, glm::ivec2 size, double near_mm, double far_mm);

// Millimetres that one pixel spans in the plane through the focal point.
[[nodiscard]] double mm_per_pixel(const Camera& camera, glm::ivec2 size);

// Pixel (x, y) and depth along the line of sight in mm of a point; nothing when it is not in front of the eye.
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

// The point seen at `pixel`, `depth_mm` along the line of sight away from the eye. Inverse of project().
[[nodiscard]] glm::dvec3 unproject(const Camera& camera, glm::ivec2 size, glm::dvec2 pixel, double depth_mm);

// The six anatomical views. Anterior: the viewer stands in front of the patient and looks back, so the patient's right
// is at the left of the picture and superior is up; posterior, left and right likewise with superior up. Superior and
// inferior have anterior up; inferior (from the feet) is the radiologist's axial picture.
enum class View { kAnterior, kPosterior, kLeft, kRight, kSuperior, kInferior };
inline constexpr std::array kViews{View::kAnterior, View::kPosterior, View::kLeft,
                                   View::kRight,    View::kSuperior,  View::kInferior};
[[nodiscard]] std::string_view name_of(View view); // "anterior", ...
// Where the viewer stands in a picture whose sides nobody knows: "+y" for anterior.
[[nodiscard]] std::string_view axis_name_of(View view);
// "Anterior"; "From +y" where sides are not known. For the head of a picture, a menu.
[[nodiscard]] std::string title_of(View view, bool sides_known);
[[nodiscard]] std::optional<View> view_named(std::string_view name); // by either name

// What a picture calls the directions +x, -x, +y, -y, +z, -z.
using AxisNames = std::array<std::string, 6>;
[[nodiscard]] const AxisNames& side_letters(); // R L A P S I: of what is known to be RAS
[[nodiscard]] const AxisNames& plain_axes();   // +x -x ...: no side of the patient is claimed

// The same camera, if it is not inside a vessel; else one that is not, with the usual opening angle.
[[nodiscard]] Camera outside(Camera camera);

// The camera's direction and view-up become those of `view`; focal point, distance and the rest stay.
[[nodiscard]] Camera looking(const Camera& camera, View view);
// Same direction, but all of `box` is in the picture with a small margin, as large as it goes, perspective or not.
[[nodiscard]] Camera fitted(const Camera& camera, const Box& box, glm::ivec2 size);
// The same as tightly as these points (a mesh's positions) allow, and centred on the picture that they make: the tree
// fills the view. Takes a few milliseconds for a million points.
[[nodiscard]] Camera fitted(const Camera& camera, std::span<const glm::vec3> points, glm::ivec2 size);
// Points that lie farthest along these are all of a mesh that fitted() looks at (PagedMesh::farthest()).
[[nodiscard]] std::array<glm::dvec3, 10> fitting_directions(const Camera& camera, glm::ivec2 size);
// A fresh camera: looking() and fitted() in one.
[[nodiscard]] Camera camera_for(std::span<const glm::vec3> points, View view, glm::ivec2 size,
                                bool orthographic = false);
[[nodiscard]] Camera camera_for(const Box& box, View view, glm::ivec2 size, bool orthographic = false);

// Switches the projection and keeps the picture's size at the focal point.
[[nodiscard]] Camera with_projection(const Camera& camera, bool orthographic);

// Turns around the focal point by angles in degrees (azimuth moves the viewer to the right, elevation upward).
[[nodiscard]] Camera turned(const Camera& camera, double azimuth_deg, double elevation_deg);
// Comes nearer by `factor` (> 1 magnifies).
[[nodiscard]] Camera zoomed(const Camera& camera, double factor);
// `point` becomes the focal point, direction and distance stay.
[[nodiscard]] Camera centred_on(const Camera& camera, const glm::dvec3& point);

// In between two cameras (0 = from, 1 = to), turning by the shortest way, for animated view changes.
[[nodiscard]] Camera interpolated(const Camera& from, const Camera& to, double t);

// JSON with the session file's names: position, focal_point, view_up, view_angle, orthographic, scale, and inside where
// that is true. Reading takes what is missing from the defaults above, and refuses unknown names, wrong types, numbers
// that are not finite and cameras that cannot be drawn. `where` names the source in messages.
[[nodiscard]] nlohmann::json to_json(const Camera& camera);
[[nodiscard]] Result<Camera> camera_from_json(const nlohmann::json& json, const std::string& where);
[[nodiscard]] Result<Camera> parse_camera(std::string_view text, const std::string& where);

} // namespace ramus::render
