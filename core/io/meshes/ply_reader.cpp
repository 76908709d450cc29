#include "core/io/meshes/ply.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

namespace ramus::io {

namespace {

enum class Type { kI8, kU8, kI16, kU16, kI32, kU32, kF32, kF64 };

std::optional<Type> type_named(std::string_view word) {
    constexpr std::array<std::pair<std::string_view, Type>, 16> kNames{{{"char", Type::kI8},
                                                                        {"int8", Type::kI8},
                                                                        {"uchar", Type::kU8},
                                                                        {"uint8", Type::kU8},
                                                                        {"short", Type::kI16},
                                                                        {"int16", Type::kI16},
                                                                        {"ushort", Type::kU16},
                                                                        {"uint16", Type::kU16},
                                                                        {"int", Type::kI32},
                                                                        {"int32", Type::kI32},
                                                                        {"uint", Type::kU32},
                                                                        {"uint32", Type::kU32},
                                                                        {"float", Type::kF32},
                                                                        {"float32", Type::kF32},
                                                                        {"double", Type::kF64},
                                                                        {"float64", Type::kF64}}};
    const auto* found = std::ranges::find(kNames, word, &std::pair<std::string_view, Type>::first);
    return found == kNames.end() ? std::nullopt : std::optional(found->second);
}

struct Property {
    std::string_view name;
    Type type = Type::kF32;
    std::optional<Type> count; // of a list
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

enum class Format { kText, kLittle, kBig };

struct Header {
    Format format = Format::kText;
    std::vector<Element> elements;
};

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    while (true) {
        const std::size_t start = line.find_first_not_of(" \t\r");
        if (start == std::string_view::npos) return words;
        const std::size_t end = std::min(line.find_first_of(" \t\r", start), line.size());
        words.push_back(line.substr(start, end - start));
        line.remove_prefix(end);
    }
}

// Takes the header off `text`; nothing when it is none.
std::optional<Header> take_header(std::string_view& text) {
    Header header;
    bool format = false;
    for (int line_number = 0; !text.empty(); ++line_number) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        const auto words = words_of(text.substr(0, end));
        text.remove_prefix(end + 1);
        if (line_number == 0) {
            if (words.size() != 1 || words[0] != "ply") return {};
        } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
            continue;
        } else if (words[0] == "end_header") {
            return format ? std::optional(header) : std::nullopt;
        } else if (words[0] == "format" && words.size() == 3) {
            format = true;
            if (words[1] == "binary_little_endian")
                header.format = Format::kLittle;
            else if (words[1] == "binary_big_endian")
                header.format = Format::kBig;
            else if (words[1] != "ascii")
                return {};
        } else if (words[0] == "element" && words.size() == 3) {
            Element element{words[1], 0, {}};
            const char* const last = words[2].data() + words[2].size();
            const auto [stop, error] = std::from_chars(words[2].data(), last, element.count);
            if (error != std::errc{} || stop != last) return {};
            header.elements.push_back(element);
        } else if (words[0] == "property" && !header.elements.empty() && (words.size() == 3 || words.size() == 5)) {
            const bool list = words.size() == 5;
            if (list != (words[1] == "list")) return {};
            const auto type = type_named(words[list ? 3 : 1]);
            const auto count = list ? type_named(words[2]) : std::nullopt;
            if (!type || (list && !count)) return {};
            header.elements.back().properties.push_back({words.back(), *type, count});
        } else {
            return {};
        }
    }
    return {};
}

// Numbers one after the other.
class Numbers {
public:
    Numbers(std::string_view text, Format format) : text_(text), format_(format) {}

    std::optional<double> next(Type type) {
        if (format_ == Format::kText) return from_text();
        switch (type) {
        case Type::kI8:
            return from_bytes<std::int8_t>();
        case Type::kU8:
            return from_bytes<std::uint8_t>();
        case Type::kI16:
            return from_bytes<std::int16_t>();
        case Type::kU16:
            return from_bytes<std::uint16_t>();
        case Type::kI32:
            return from_bytes<std::int32_t>();
        case Type::kU32:
            return from_bytes<std::uint32_t>();
        case Type::kF32:
            return from_bytes<float>();
        case Type::kF64:
            return from_bytes<double>();
        }
        return {};
    }
    [[nodiscard]] std::size_t bytes_left() const { return text_.size(); }

private:
    template <class T> std::optional<double> from_bytes() {
        if (text_.size() < sizeof(T)) return {};
        std::array<char, sizeof(T)> bytes{};
        std::memcpy(bytes.data(), text_.data(), sizeof(T));
        text_.remove_prefix(sizeof(T));
        if ((format_ == Format::kBig) != (std::endian::native == std::endian::big)) std::ranges::reverse(bytes);
        return static_cast<double>(std::bit_cast<T>(bytes));
    }
    std::optional<double> from_text() {
        const std::size_t start = text_.find_first_not_of(" \t\r\n");
        if (start == std::string_view::npos) return {};
        text_.remove_prefix(start);
        double number = 0.0;
        const auto [stop, error] = std::from_chars(text_.data(), text_.data() + text_.size(), number);
        if (error != std::errc{}) return {};
        text_.remove_prefix(static_cast<std::size_t>(stop - text_.data()));
        return number;
    }

    std::string_view text_;
    Format format_;
};

} // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name) {
    const auto damaged = [&] { return fail("this is no .ply mesh, or it is damaged", name, "write it again"); };
    const auto header = take_header(text);
    if (!header) return damaged();
    Numbers numbers(text, header->format);
    PolygonSoup soup;
    for (const Element& element : header->elements) {
        if (element.properties.empty()) continue;
        if (element.count > numbers.bytes_left()) return damaged(); // a byte each at least
        const bool vertices = element.name == "vertex", faces = element.name == "face";
        for (std::uint64_t i = 0; i < element.count; ++i) {
            glm::dvec3 place(0.0);
            std::vector<std::uint32_t> polygon;
            for (const Property& property : element.properties) {
                const auto first = numbers.next(property.count ? *property.count : property.type);
                if (!first) return damaged();
                if (!property.count) {
                    if (vertices && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
                        place[property.name[0] - 'x'] = *first;
                    continue;
                }
                if (!(*first >= 0.0 && *first <= static_cast<double>(numbers.bytes_left())) ||
                    *first != std::floor(*first))
                    return damaged();
                const bool wanted = faces && (property.name == "vertex_indices" || property.name == "vertex_index");
                for (auto left = static_cast<std::uint64_t>(*first); left > 0; --left) {
                    const auto number = numbers.next(property.type);
                    if (!number) return damaged();
                    if (!wanted) continue;
                    if (!(*number >= 0.0 && *number < 4294967295.0)) return damaged();
                    polygon.push_back(static_cast<std::uint32_t>(*number));
                }
            }
            if (vertices) soup.positions.push_back(place);
            if (!polygon.empty()) soup.polygons.push_back(std::move(polygon));
        }
    }
    for (const auto& polygon : soup.polygons)
        for (const std::uint32_t v : polygon)
            if (v >= soup.positions.size())
                return fail("a triangle names a vertex that is not there", name, "write the file again");
    return soup;
}

} // namespace ramus::io
