#include "core/io/trees/json_input.h"

#include "core/io/text_numbers.h"

#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr std::size_t kLargestJson = std::size_t{2} << 30;

json parsed(std::string_view text, std::string_view left_out) {
    if (left_out.empty()) return json::parse(text);
    return json::parse(text, [&](int, json::parse_event_t event, const json& value) {
        return event != json::parse_event_t::key || value != left_out;
    });
}

} // namespace

Result<json> parsed_json(std::string_view text, const std::string& name, std::string_view left_out) {
    if (text.size() > kLargestJson)
        return fail("the file is larger than " + std::to_string(kLargestJson >> 20) + " MiB", name,
                    "choose a smaller file");
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return fail("the file is empty", name, "choose another file");
    const auto place = [&](std::size_t at) { return name + ":" + std::to_string(line_at(text, at)); };
    try {
        return parsed(text, left_out);
    } catch (const json::parse_error& error) {
        return fail("this is not valid JSON", place(error.byte == 0 ? 0 : error.byte - 1),
                    "edit the file there, or write it anew with `ramus convert`");
    } catch (const json::out_of_range& error) {
        // "... number overflow parsing '1e999'": the number itself leads to its line.
        const std::string message = error.what();
        const std::size_t open = message.find('\'');
        const std::string number =
            open == std::string::npos ? "" : message.substr(open + 1, message.rfind('\'') - open - 1);
        return fail("the number " + number.substr(0, 40) + " is too large", place(text.find(number)),
                    "correct the number");
    }
}

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

} // namespace ramus::io
