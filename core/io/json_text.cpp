#include "core/io/json_text.h"

#include "core/io/text_numbers.h"

#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr std::size_t kLargestJson = std::size_t{2} << 30;

json parse_leaving_out(std::string_view text, std::string_view left_out) {
    if (left_out.empty()) return json::parse(text);
    return json::parse(text, [&](int, json::parse_event_t event, const json& value) {
        return event != json::parse_event_t::key || value != left_out;
    });
}

// Where it nests too deep; found before anything is made of it.
std::optional<std::size_t> beyond_deepest(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (quoted && c == '\\')
            ++at;
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '[' || c == '{') && ++depth > kDeepestJson)
            return at;
        else if (!quoted && (c == ']' || c == '}'))
            --depth;
    }
    return std::nullopt;
}

template <class Json> std::string printed(const Json& value, int indent) {
    return value.dump(indent, ' ', false, Json::error_handler_t::replace);
}

} // namespace

std::string printed_json(const json& value, int indent) { return printed(value, indent); }
std::string printed_json(const nlohmann::ordered_json& value, int indent) { return printed(value, indent); }

Result<json> parsed_json(std::string_view text, const std::string& name, std::string_view left_out) {
    if (text.size() > kLargestJson)
        return fail("the file is larger than " + std::to_string(kLargestJson >> 20) + " MiB", name,
                    "choose a smaller file");
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return fail("the file is empty", name, "choose another file");
    if (const auto deep = beyond_deepest(text))
        return fail("lists stand in lists, deeper than " + std::to_string(kDeepestJson) + " levels",
                    name + ":" + std::to_string(line_at(text, *deep)),
                    "no format here does that; check the program that wrote it");
    const auto place = [&](std::size_t at) { return name + ":" + std::to_string(line_at(text, at)); };
    try {
        return parse_leaving_out(text, left_out);
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

} // namespace ramus::io
