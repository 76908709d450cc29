#include "core/io/volumes/label_names.h"

#include "core/io/file_format.h"
#include "core/io/input_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <pugixml.hpp>
#include <system_error>

namespace ramus::io {

namespace {

using volume::LabelName;

std::optional<std::int32_t> label_number(std::string_view word) {
    const auto number = to_whole(word);
    const bool fits = number && *number >= std::numeric_limits<std::int32_t>::min() &&
                      *number <= std::numeric_limits<std::int32_t>::max();
    return fits ? std::optional(static_cast<std::int32_t>(*number)) : std::nullopt;
}

// From 0 to `most`.
using Colour = std::array<std::uint8_t, 3>;
std::optional<Colour> colour_in_words(const std::array<std::string_view, 3>& words, double most) {
    Colour colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto part = to_real(words[i]);
        if (!part || !(*part >= 0.0 && *part <= most)) return std::nullopt;
        colour[i] = static_cast<std::uint8_t>(std::lround(255.0 / most * *part));
    }
    return colour;
}

// Label 0 is the background.
std::vector<LabelName> in_order(std::vector<LabelName> names) {
    std::erase_if(names, [](const LabelName& name) { return name.label == 0; });
    std::ranges::stable_sort(names, {}, &LabelName::label);
    const auto same = [](const LabelName& a, const LabelName& b) { return a.label == b.label; };
    names.erase(std::unique(names.begin(), names.end(), same), names.end());
    return names;
}

//    1   255    0    0        1  1  1    "Label 1"
std::optional<LabelName> snap_line(std::string_view line) {
    const std::size_t open = line.find('"'), close = line.rfind('"');
    if (open == std::string_view::npos || close == open || !trimmed(line.substr(close + 1)).empty())
        return std::nullopt;
    std::vector<std::string_view> words;
    split_words(line.substr(0, open), " \t", words);
    if (words.size() != 7) return std::nullopt;
    const auto label = label_number(words[0]);
    const auto colour = colour_in_words({words[1], words[2], words[3]}, 255.0);
    const bool others = std::ranges::all_of(words, [](std::string_view word) { return to_real(word).has_value(); });
    if (!label || !colour || !others) return std::nullopt;
    return LabelName{.label = *label, .name = std::string(line.substr(open + 1, close - open - 1)), .colour = colour};
}

// 1 portal_vein 0 151 206 255: the name has underscores for blanks, or blanks.
std::optional<LabelName> slicer_line(std::string_view line) {
    std::vector<std::string_view> words;
    split_words(line, " \t", words);
    if (words.size() < 6) return std::nullopt;
    const std::size_t last = words.size() - 4;
    const auto label = label_number(words[0]);
    const auto colour = colour_in_words({words[last], words[last + 1], words[last + 2]}, 255.0);
    if (!label || !colour || !to_real(words.back())) return std::nullopt;
    const auto* begin = words[1].data();
    const auto* end = words[last - 1].data() + words[last - 1].size();
    std::string name(begin, end);
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    return LabelName{.label = *label, .name = std::move(name), .colour = colour};
}

std::filesystem::path without_extensions(const std::filesystem::path& mask) {
    std::filesystem::path name = without_gz(mask);
    name.replace_extension();
    if (name.extension() == ".seg") name.replace_extension();
    return name;
}

} // namespace

std::vector<LabelName> label_table_names(std::string_view xml) {
    pugi::xml_document document;
    if (!document.load_buffer(xml.data(), xml.size())) return {};
    const pugi::xml_node table =
        document.find_node([](const pugi::xml_node& node) { return std::string_view(node.name()) == "LabelTable"; });
    std::vector<LabelName> names;
    for (const pugi::xml_node& label : table.children("Label")) {
        const auto number = label_number(label.attribute("Key").value());
        const std::string_view name = trimmed(label.text().get());
        if (!number || name.empty()) continue;
        const auto word = [&](const char* attribute) { return std::string_view(label.attribute(attribute).value()); };
        names.push_back({.label = *number,
                         .name = std::string(name),
                         .colour = colour_in_words({word("Red"), word("Green"), word("Blue")}, 1.0)});
    }
    return in_order(std::move(names));
}

std::optional<std::vector<LabelName>> described_names(std::string_view text) {
    std::vector<LabelName> names;
    std::optional<LabelName> (*parse)(std::string_view) = nullptr;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        if (parse == nullptr) parse = snap_line(line) ? snap_line : slicer_line;
        auto name = parse(line);
        if (!name) return std::nullopt;
        names.push_back(std::move(*name));
    }
    if (parse == nullptr) return std::nullopt;
    return in_order(std::move(names));
}

void take_described_names(const std::filesystem::path& mask, volume::Volume& volume) {
    constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 20;
    if (!volume.label_names.empty() || !holds_whole_numbers(volume)) return;
    const std::filesystem::path stem = without_extensions(mask);
    for (const char* ending :
         {".label", ".labels", "_labels.txt", "_labels.label", "-labels.txt", "-labels.label", "_label.txt",
          "-label.txt", ".ctbl", "_ColorTable.ctbl", "_ColorTable.txt", "-label_ColorTable.ctbl", ".txt"}) {
        const std::filesystem::path file = stem.string() + ending;
        std::error_code error;
        // Not from a pipe, because reading would consume it.
        if (!std::filesystem::is_regular_file(file, error)) continue;
        const auto text = read_file(file, kMostBytes);
        auto names = text ? described_names(*text) : std::nullopt;
        if (!names || names->empty()) continue;
        volume.label_names = std::move(*names);
        volume.notes.push_back("the names of labels are those of " + file.filename().string() + ", next to the mask");
        return;
    }
}

} // namespace ramus::io
