#include "core/io/trees/json_input.h"

#include <nlohmann/json.hpp>

namespace ramus::io {

using nlohmann::json;

bool begins_json_object(std::string_view head) {
    if (head.starts_with("\xEF\xBB\xBF")) head.remove_prefix(3);
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '{';
}

const json* json_member(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

const json* json_list(const json& object, const char* key) {
    const json* list = json_member(object, key);
    return list != nullptr && list->is_array() ? list : nullptr;
}

std::string json_text(const json& object, const char* key) {
    const json* text = json_member(object, key);
    return text != nullptr && text->is_string() ? text->get<std::string>() : std::string();
}

std::optional<glm::dvec3> json_position(const json* value) {
    if (value == nullptr || !value->is_array() || value->size() != 3) return std::nullopt;
    glm::dvec3 position(0.0);
    for (std::size_t c = 0; c < 3; ++c) {
        if (!(*value)[c].is_number()) return std::nullopt;
        position[static_cast<int>(c)] = (*value)[c].get<double>();
    }
    return position;
}

std::optional<double> json_real(const json* value) {
    return value != nullptr && value->is_number() ? std::optional(value->get<double>()) : std::nullopt;
}

std::uint32_t json_index(const json& value) {
    return value.is_number_unsigned() && value.get<std::uint64_t>() < kNoJsonIndex ? value.get<std::uint32_t>()
                                                                                   : kNoJsonIndex;
}

} // namespace ramus::io
