// Checked reading of JSON values. Functions throw Refusal, which one place catches: a Result for every member would
// obscure the format. Internal to the code that reads and writes ramus' own JSON (sessions, settings, studies).
#pragma once

#include "app/session/colour_by.h"
#include "app/session/session.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app::session_json {

using nlohmann::json;

// Describes what is wrong with a file.
struct Refusal {
    std::string what;
};

inline void expect_only(const json& object, const std::string& name, const std::vector<std::string_view>& known) {
    if (!object.is_object()) throw Refusal{name + " is not an object"};
    for (const auto& [key, value] : object.items())
        if (std::find(known.begin(), known.end(), key) == known.end())
            throw Refusal{"unknown name \"" + key + "\" in " + name};
}

inline double number(const json& value, const std::string& name, double least, double most) {
    if (!value.is_number() || !std::isfinite(value.get<double>())) throw Refusal{name + " is not a number"};
    const auto found = value.get<double>();
    if (found < least || found > most) throw Refusal{name + " " + value.dump() + " is out of range"};
    return found;
}

inline int integer(const json& value, const std::string& name, int least, int most) {
    if (!value.is_number_integer()) throw Refusal{name + " is not a whole number"};
    return static_cast<int>(number(value, name, least, most));
}

inline std::string text(const json& value, const std::string& name) {
    if (!value.is_string()) throw Refusal{name + " is not a text"};
    return value.get<std::string>();
}

// Reads a word that named(word) recognises.
template <class Named>
auto word(const json& value, const std::string& name, const std::string& what, const Named& named) {
    const std::string wanted = text(value, name);
    const auto found = named(wanted);
    if (!found) throw Refusal{"unknown " + what + " \"" + wanted + "\""};
    return *found;
}

// The list of this name; empty if it is missing.
inline json list_in(const json& object, const std::string& name) {
    if (!object.contains(name)) return json::array();
    if (!object[name].is_array()) throw Refusal{name + " is not a list"};
    return object[name];
}

inline bool truth(const json& value, const std::string& name) {
    if (!value.is_boolean()) throw Refusal{name + " is not true or false"};
    return value.get<bool>();
}

inline constexpr int kMostBranches = 100'000'000;

inline std::vector<int> ids(const json& value, const std::string& name) {
    if (!value.is_array()) throw Refusal{name + " is not a list"};
    std::vector<int> found;
    for (const json& id : value) found.push_back(integer(id, "branch id in " + name, 0, kMostBranches));
    return canonical(std::move(found));
}

inline Rgb colour_from(const json& value, const std::string& name) {
    const std::string wanted = text(value, name);
    const auto found = colour_in(wanted);
    if (!found) throw Refusal{"\"" + wanted + "\" is not a colour: #RRGGBB"};
    return *found;
}

// The keys common to all objects of the scene; defaults are omitted.
template <SceneObject T> void write_object(json& value, const T& object) {
    const T usual{};
    if (!object.name.empty()) value["name"] = object.name;
    if (!object.visible) value["visible"] = false;
    if (object.colour != usual.colour) value["colour"] = colour_text(object.colour);
    if constexpr (SurfaceObject<T>)
        if (object.opacity != usual.opacity) value["opacity"] = object.opacity;
}

// Reads them; `own`: the further keys that the kind has.
template <SceneObject T> void read_object(const json& value, T& object, std::vector<std::string_view> own) {
    own.insert(own.end(), {"name", "visible", "colour"});
    if constexpr (SurfaceObject<T>) own.emplace_back("opacity");
    expect_only(value, std::string(T::kNoun), own);
    if (value.contains("name")) object.name = text(value["name"], "name");
    if (value.contains("visible")) object.visible = truth(value["visible"], "visible");
    if (value.contains("colour")) object.colour = colour_from(value["colour"], "colour");
    if constexpr (SurfaceObject<T>)
        if (value.contains("opacity")) object.opacity = number(value["opacity"], "opacity", 0.0, 1.0);
}

// Returns `value`, or an object with `value` under `key` if there are further keys to write.
inline json with_object_keys(json value, const char* key, const SceneObject auto& object) {
    json whole = json::object();
    write_object(whole, object);
    if (whole.empty()) return value;
    whole[key] = std::move(value);
    return whole;
}

} // namespace ramus::app::session_json
