#include "core/io/json_text.h"
#include "render/scene/camera.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

namespace ramus::render {

namespace {

const char* const kHint = "a camera is {\"position\": [x, y, z], \"focal_point\": [x, y, z], \"view_up\": [x, y, z], "
                          "\"view_angle\": degrees, \"orthographic\": true|false, \"scale\": mm}";

nlohmann::json value_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
nlohmann::json value_of(double number) { return number; }
nlohmann::json value_of(bool flag) { return flag; }

tl::unexpected<Error> refuse(const std::string& what, const std::string& where) {
    return fail("camera: " + what, where, kHint);
}

using Json = nlohmann::json;

Result<void> read(const Json& json, const std::string& name, const std::string& where, double& to) {
    if (!json.is_number()) return refuse(name + " is not a number", where);
    to = json.get<double>();
    if (!std::isfinite(to) || std::abs(to) > 1e12) return refuse(name + " is out of range", where);
    return {};
}

Result<void> read(const Json& json, const std::string& name, const std::string& where, glm::dvec3& to) {
    if (!json.is_array() || json.size() != 3) return refuse(name + " is not a list of three numbers", where);
    for (int i = 0; i < 3; ++i)
        if (auto done = read(json[static_cast<std::size_t>(i)], name, where, to[i]); !done) return done;
    return {};
}

Result<void> read(const Json& json, const std::string& name, const std::string& where, bool& to) {
    if (!json.is_boolean()) return refuse(name + " is not true or false", where);
    to = json.get<bool>();
    return {};
}

// Calls call(name, member) for every member of a camera.
template <class Of, class Call> void for_members(Of& camera, const Call& call) {
    call("position", camera.position);
    call("focal_point", camera.focal_point);
    call("view_up", camera.view_up);
    call("view_angle", camera.view_angle);
    call("orthographic", camera.orthographic);
    call("scale", camera.scale);
    call("inside", camera.inside);
}

} // namespace

nlohmann::json to_json(const Camera& camera) {
    nlohmann::json json;
    for_members(camera, [&](const char* name, const auto& member) { json[name] = value_of(member); });
    if (!camera.inside) json.erase("inside"); // unknown to older readers
    return json;
}

Result<Camera> camera_from_json(const nlohmann::json& json, const std::string& where) {
    if (!json.is_object()) return refuse("not an object", where);
    Camera camera;
    for (const auto& item : json.items()) {
        Result<void> done = refuse("unknown name \"" + item.key() + "\"", where);
        for_members(camera, [&](const char* name, auto& member) {
            if (item.key() == name) done = read(item.value(), name, where, member);
        });
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
    const auto json = io::parsed_json(text, where);
    if (!json) return refuse("not JSON", where);
    return camera_from_json(*json, where);
}

} // namespace ramus::render
