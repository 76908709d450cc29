#include "core/io/input_file.h"
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

enum class Format { kText, kLittle, kBig };

// Reads consecutive numbers.
class Numbers {
public:
    Numbers(std::string_view text, Format format) : text_(text), format_(format) {}

    // A number of type T; in a text file, any number.
    template <class T> std::optional<double> next() {
        if (format_ == Format::kText) return from_text();
        if (text_.size() < sizeof(T)) return {};
        std::array<char, sizeof(T)> bytes{};
        std::memcpy(bytes.data(), text_.data(), sizeof(T));
        text_.remove_prefix(sizeof(T));
        if ((format_ == Format::kBig) != (std::endian::native == std::endian::big)) std::ranges::reverse(bytes);
        return static_cast<double>(std::bit_cast<T>(bytes));
    }
    [[nodiscard]] std::size_t bytes_left() const { return text_.size(); }

private:
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

struct Type {
    std::string_view name, other_name;
    std::optional<double> (Numbers::*next)();
};
constexpr std::array<Type, 8> kTypes{{{"char", "int8", &Numbers::next<std::int8_t>},
                                      {"uchar", "uint8", &Numbers::next<std::uint8_t>},
                                      {"short", "int16", &Numbers::next<std::int16_t>},
                                      {"ushort", "uint16", &Numbers::next<std::uint16_t>},
                                      {"int", "int32", &Numbers::next<std::int32_t>},
                                      {"uint", "uint32", &Numbers::next<std::uint32_t>},
                                      {"float", "float32", &Numbers::next<float>},
                                      {"double", "float64", &Numbers::next<double>}}};

const Type* type_named(std::string_view word) {
    const auto* found =
        std::ranges::find_if(kTypes, [&](const Type& t) { return t.name == word || t.other_name == word; });
    return found == kTypes.end() ? nullptr : found;
}

struct Property {
    std::string_view name;
    const Type* type = nullptr;
    const Type* count = nullptr; // of a list
};

struct Element {
    std::string_view name;
    std::uint64_t count = 0;
    std::vector<Property> properties;
};

struct Header {
    Format format = Format::kText;
    std::vector<Element> elements;
    std::optional<Orientation> orientation; // that a comment states
};

// Parses the header and removes it from `text`. None: there is no valid header.
std::optional<Header> take_header(std::string_view& text) {
    Header header;
    bool format = false;
    std::vector<std::string_view> words;
    for (int line_number = 0; !text.empty(); ++line_number) {
        const std::size_t end = text.find('\n');
        if (end == std::string_view::npos) return {};
        const std::string_view line = text.substr(0, end);
        split_words(line, " \t\r", words);
        text.remove_prefix(end + 1);
        if (line_number == 0) {
            if (words.size() != 1 || words[0] != "ply") return {};
        } else if (words.empty() || words[0] == "comment" || words[0] == "obj_info") {
            if (!header.orientation) header.orientation = space_in(line);
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
            const Type* type = type_named(words[list ? 3 : 1]);
            const Type* count = list ? type_named(words[2]) : nullptr;
            if (type == nullptr || (list && count == nullptr)) return {};
            header.elements.back().properties.push_back({words.back(), type, count});
        } else {
            return {};
        }
    }
    return {};
}

} // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

Result<PolygonSoup> parse_ply(std::string_view text, const std::string& name) {
    const auto damaged = [&] { return fail("this is no .ply mesh, or it is damaged", name, "write it again"); };
    const auto header = take_header(text);
    if (!header) return damaged();
    Numbers numbers(text, header->format);
    PolygonSoup soup;
    soup.orientation = header->orientation;
    for (const Element& element : header->elements) {
        if (element.properties.empty()) continue;
        if (element.count > numbers.bytes_left()) return damaged(); // a byte each at least
        const bool vertices = element.name == "vertex", faces = element.name == "face";
        for (std::uint64_t i = 0; i < element.count; ++i) {
            glm::dvec3 place(0.0);
            std::vector<std::uint32_t> polygon;
            for (const Property& property : element.properties) {
                const bool is_list = property.count != nullptr;
                const auto first = (numbers.*(is_list ? property.count : property.type)->next)();
                if (!first) return damaged();
                if (!is_list) {
                    if (vertices && property.name.size() == 1 && property.name[0] >= 'x' && property.name[0] <= 'z')
                        place[property.name[0] - 'x'] = *first;
                    continue;
                }
                if (!(*first >= 0.0 && *first <= static_cast<double>(numbers.bytes_left())) ||
                    *first != std::floor(*first))
                    return damaged();
                const bool wanted = faces && (property.name == "vertex_indices" || property.name == "vertex_index");
                for (auto left = static_cast<std::uint64_t>(*first); left > 0; --left) {
                    const auto number = (numbers.*property.type->next)();
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
