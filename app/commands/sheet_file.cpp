#include "app/commands/sheet_file.h"

#include "app/session/error_context.h"
#include "core/io/input_file.h"
#include "core/io/json_text.h"
#include "core/io/text_numbers.h"

#include <cmath>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <vector>

namespace ramus::app {

namespace {

constexpr std::uintmax_t kMostSheetBytes = std::uintmax_t{64} << 20;

// The numbers of a list of `count` numbers; empty if it is none.
std::vector<double> numbers_in(const nlohmann::json& list, std::size_t count) {
    std::vector<double> numbers;
    if (!list.is_array() || list.size() != count) return {};
    for (const nlohmann::json& number : list) {
        if (!number.is_number()) return {};
        numbers.push_back(number.get<double>());
    }
    return numbers;
}

std::vector<double> member(const nlohmann::json& json, const char* name, std::size_t count) {
    const auto found = json.find(name);
    return found == json.end() ? std::vector<double>{} : numbers_in(*found, count);
}

std::optional<glm::dvec3> vector_in(const nlohmann::json& json, const char* name) {
    const std::vector<double> numbers = member(json, name, 3);
    return numbers.empty() ? std::nullopt : std::optional(glm::dvec3(numbers[0], numbers[1], numbers[2]));
}

Result<glm::ivec2> grid_in(const nlohmann::json& json, const char* name, int least, int most) {
    const std::vector<double> numbers = member(json, name, 2);
    for (const double number : numbers)
        if (number != std::floor(number) || number < least || number > most) return fail("");
    if (numbers.empty()) return fail("");
    return glm::ivec2(numbers[0], numbers[1]);
}

Result<SheetFile> sheet_of_grid(const nlohmann::json& json) {
    SheetFile read;
    organ::Sheet& sheet = read.sheet;
    const auto origin = vector_in(json, "origin"), u = vector_in(json, "u"), v = vector_in(json, "v");
    const std::vector<double> step = member(json, "step", 2);
    constexpr int kMostControls = 1000; // along an axis
    const auto size = grid_in(json, "size", 2, kMostControls);
    if (!origin || !u || !v || step.empty() || !size)
        return fail("the sheet has neither a contour nor origin, u, v, step and size of a grid");
    sheet.origin = *origin;
    sheet.u = *u;
    sheet.v = *v;
    sheet.step = {step[0], step[1]};
    sheet.size = *size;
    sheet.heights = member(json, "heights", static_cast<std::size_t>(size->x) * static_cast<std::size_t>(size->y));
    if (auto valid = organ::check_sheet(sheet); !valid) return tl::unexpected(valid.error());
    return read;
}

Result<SheetFile> sheet_of_json(const nlohmann::json& json) {
    if (!json.is_object()) return fail("the file holds no JSON object");
    const auto list = json.find("contour");
    if (list == json.end()) return sheet_of_grid(json);
    organ::SheetFit fit;
    if (json.contains("control_points")) {
        const auto size = grid_in(json, "control_points", 4, 32);
        if (!size) return fail("control_points of the sheet is no list of two whole numbers from 4 to 32");
        fit.size = *size;
    }
    std::vector<glm::dvec3> contour;
    if (list->is_array())
        for (const nlohmann::json& point : *list) {
            const std::vector<double> numbers = numbers_in(point, 3);
            if (numbers.empty()) return fail("a point of the contour is no list of three numbers");
            contour.emplace_back(numbers[0], numbers[1], numbers[2]);
        }
    RAMUS_TRY(sheet, organ::sheet_through(contour, fit));
    return SheetFile{std::move(sheet), true};
}

Result<SheetFile> sheet_of_text(std::string_view text) {
    std::vector<glm::dvec3> contour;
    std::vector<std::string_view> lines, words;
    io::split_words(text, "\r\n", lines);
    for (const std::string_view line : lines) {
        words.clear();
        io::split_words(line.substr(0, line.find('#')), " \t,;", words);
        if (words.empty()) continue;
        glm::dvec3 point(0.0);
        if (words.size() != 3) return fail("the line " + io::shown(line) + " is no point of three numbers");
        for (int axis = 0; axis < 3; ++axis) {
            const auto number = io::to_real(words[static_cast<std::size_t>(axis)]);
            if (!number || !(std::abs(*number) < 1e6))
                return fail("the line " + io::shown(line) + " is no point of three numbers");
            point[axis] = *number;
        }
        contour.push_back(point);
    }
    RAMUS_TRY(sheet, organ::sheet_through(contour));
    return SheetFile{std::move(sheet), true};
}

} // namespace

Result<SheetFile> read_sheet(const std::string& file) {
    RAMUS_TRY(text, io::read_file(file, kMostSheetBytes));
    const std::string_view begin = io::trimmed(text);
    if (begin.empty() || (begin.front() != '{' && begin.front() != '[')) return with_file(sheet_of_text(text), file);
    RAMUS_TRY(json, io::parsed_json(text, file));
    return with_file(sheet_of_json(json), file);
}

} // namespace ramus::app
