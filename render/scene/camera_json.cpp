#include "render/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace ramus::render {

namespace {

const char* const kHint = "a camera is {\"position\": [x, y, z], \"focal_point\": [x, y, z], \"view_up\": [x, y, z], "
                          "\"view_angle\": degrees, \"orthographic\": true|false, \"scale\": mm}";

nlohmann::json to_array(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

tl::unexpected<Error> refuse(const std::string& what, const std::string& where) {
    return fail("camera: " + what, where, kHint);
}

Result<double> number_from(const nlohmann::json& json, const std::string& name, const std::string& where) {
    if (!json.is_number()) return refuse(name + " is not a number", where);
    const double value = json.get<double>();
    if (!std::isfinite(value) || std::abs(value) > 1e12) return refuse(name + " is out of range", where);
    return value;
}

Result<glm::dvec3> vector_from(const nlohmann::json& json, const std::string& name, const std::string& where) {
    if (!json.is_array() || json.size() != 3) return refuse(name + " is not a list of three numbers", where);
    glm::dvec3 result;
    for (int i = 0; i < 3; ++i) {
        RAMUS_TRY(value, number_from(json[static_cast<std::size_t>(i)], name, where));
        result[i] = value;
    }
    return result;
}

} // namespace

nlohmann::json to_json(const Camera& camera) {
    return {{"position", to_array(camera.position)}, {"focal_point", to_array(camera.focal_point)},
            {"view_up", to_array(camera.view_up)},   {"view_angle", camera.view_angle},
            {"orthographic", camera.orthographic},   {"scale", camera.scale}};
}

Result<Camera> camera_from_json(const nlohmann::json& json, const std::string& where) {
    if (!json.is_object()) return refuse("not an object", where);
    Camera camera;
    for (const auto& item : json.items()) {
        const std::string& name = item.key();
        const nlohmann::json& value = item.value();
        Result<void> done{};
        const auto take = [&](auto& field, auto read) {
            if (auto v = read(value, name, where))
                field = *v;
            else
                done = tl::unexpected(v.error());
        };
        if (name == "position")
            take(camera.position, vector_from);
        else if (name == "focal_point")
            take(camera.focal_point, vector_from);
        else if (name == "view_up")
            take(camera.view_up, vector_from);
        else if (name == "view_angle")
            take(camera.view_angle, number_from);
        else if (name == "scale")
            take(camera.scale, number_from);
        else if (name == "orthographic") {
            if (!value.is_boolean()) return refuse("orthographic is not true or false", where);
            camera.orthographic = value.get<bool>();
        } else
            return refuse("unknown name \"" + name + "\"", where);
        if (!done) return tl::unexpected(done.error());
    }
    const glm::dvec3 sight = camera.focal_point - camera.position;
    const double distance = glm::length(sight), up = glm::length(camera.view_up);
    if (distance < 1e-6) return refuse("position and focal_point are the same point", where);
    if (up <= 0.0 || glm::length(glm::cross(sight / distance, camera.view_up / up)) < 1e-6)
        return refuse("view_up lies along the line of sight", where);
    if (camera.view_angle < 0.1 || camera.view_angle > 170.0)
        return refuse("view_angle is not between 0.1 and 170 degrees", where);
    if (camera.scale < 1e-6) return refuse("scale is not positive", where);
    return camera;
}

Result<Camera> parse_camera(std::string_view text, const std::string& where) {
    const auto json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) return refuse("not JSON", where);
    return camera_from_json(json, where);
}

} // namespace ramus::render
