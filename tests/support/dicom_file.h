// DICOM files as tests want them, byte by byte after the standard (PS3.5), without the library that reads them: sets of
// elements, explicit or implicit, in either byte order, with sequences of known and of open length.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::test {

enum class DicomSyntax { kExplicit, kImplicit, kBigEndian };
enum class DicomLengths { kKnown, kOpen }; // of sequences

inline std::string_view uid_of(DicomSyntax syntax) {
    constexpr std::array<std::string_view, 3> kUids = {"1.2.840.10008.1.2.1", "1.2.840.10008.1.2",
                                                       "1.2.840.10008.1.2.2"};
    return kUids[static_cast<std::size_t>(syntax)];
}

class DicomElements {
public:
    DicomElements& text(std::uint32_t tag, const char* vr, const std::string& value) {
        elements_[tag] = {vr, value, {}};
        return *this;
    }
    DicomElements& number(std::uint32_t tag, std::uint16_t value) {
        elements_[tag] = {"US", std::string(reinterpret_cast<const char*>(&value), 2), {}};
        return *this;
    }
    // Decimal numbers with all the digits that their 16 letters have room for.
    DicomElements& decimals(std::uint32_t tag, const std::vector<double>& values) {
        std::string joined;
        for (const double value : values) joined += (joined.empty() ? "" : "\\") + decimal(value);
        return text(tag, "DS", joined);
    }
    DicomElements& items(std::uint32_t tag, const std::vector<DicomElements>& sets) {
        elements_[tag] = {"SQ", {}, sets};
        return *this;
    }
    // Numbers of `width` bytes in this machine's order.
    DicomElements& pixels(const std::string& bytes, int width) {
        elements_[0x7fe00010] = {width == 1 ? "OB" : "OW", bytes, {}};
        return *this;
    }
    DicomElements& remove(std::uint32_t tag) {
        elements_.erase(tag);
        return *this;
    }

    [[nodiscard]] std::string bytes(DicomSyntax syntax, DicomLengths lengths) const {
        std::string out;
        for (const auto& [tag, element] : elements_) {
            std::string value = element.value;
            for (const DicomElements& set : element.sets) value += item(set, syntax, lengths);
            const bool sequence = std::string_view(element.vr) == "SQ";
            const bool open = sequence && lengths == DicomLengths::kOpen;
            if (open) value += delimiter(0xe0dd, syntax);
            if (value.size() % 2 != 0) value += std::string_view(element.vr) == "UI" ? '\0' : ' ';
            if (syntax == DicomSyntax::kBigEndian && width_of(element.vr) == 2)
                for (std::size_t n = 0; n + 1 < value.size(); n += 2) std::swap(value[n], value[n + 1]);
            out += begin(tag, element.vr, open ? 0xffffffff : static_cast<std::uint32_t>(value.size()), syntax) + value;
        }
        return out;
    }
    // With preamble and the group that says how the rest is written.
    [[nodiscard]] std::string file(DicomSyntax syntax = DicomSyntax::kExplicit,
                                   DicomLengths lengths = DicomLengths::kKnown) const {
        DicomElements meta;
        meta.text(0x00020002, "UI", elements_.contains(0x00080016) ? elements_.at(0x00080016).value : "1.2");
        meta.text(0x00020003, "UI", elements_.contains(0x00080018) ? elements_.at(0x00080018).value : "1.2");
        meta.text(0x00020010, "UI", std::string(uid_of(syntax)));
        const std::string rest = meta.bytes(DicomSyntax::kExplicit, lengths);
        std::string length(4, '\0');
        const auto size = static_cast<std::uint32_t>(rest.size());
        std::copy_n(reinterpret_cast<const char*>(&size), 4, length.begin());
        return std::string(128, '\0') + "DICM" + begin(0x00020000, "UL", 4, DicomSyntax::kExplicit) + length + rest +
               bytes(syntax, lengths);
    }

    static std::string decimal(double value) {
        for (int digits = 17;; --digits) {
            std::array<char, 40> text{};
            const auto end = std::to_chars(text.begin(), text.end(), value, std::chars_format::general, digits).ptr;
            if (end - text.begin() <= 16) return {text.begin(), end};
        }
    }

private:
    struct Element {
        const char* vr = "";
        std::string value;
        std::vector<DicomElements> sets;
    };

    static int width_of(std::string_view vr) { return vr == "US" || vr == "OW" ? 2 : 1; }
    static std::string whole(std::uint32_t value, int bytes, DicomSyntax syntax) {
        std::string out;
        for (int n = 0; n < bytes; ++n)
            out += static_cast<char>(value >> (8 * (syntax == DicomSyntax::kBigEndian ? bytes - 1 - n : n)));
        return out;
    }
    static std::string begin(std::uint32_t tag, std::string_view vr, std::uint32_t length, DicomSyntax syntax) {
        const std::string name = whole(tag >> 16, 2, syntax) + whole(tag & 0xffff, 2, syntax);
        if (syntax == DicomSyntax::kImplicit || tag >> 16 == 0xfffe) return name + whole(length, 4, syntax);
        if (vr == "SQ" || vr == "OB" || vr == "OW" || vr == "UN")
            return name + std::string(vr) + std::string(2, '\0') + whole(length, 4, syntax);
        return name + std::string(vr) + whole(length, 2, syntax);
    }
    static std::string delimiter(std::uint32_t element, DicomSyntax syntax) {
        return begin(0xfffe0000 | element, "", 0, syntax);
    }
    static std::string item(const DicomElements& set, DicomSyntax syntax, DicomLengths lengths) {
        const std::string inside = set.bytes(syntax, lengths);
        const bool open = lengths == DicomLengths::kOpen;
        return begin(0xfffee000, "", open ? 0xffffffff : static_cast<std::uint32_t>(inside.size()), syntax) + inside +
               (open ? delimiter(0xe00d, syntax) : "");
    }

    std::map<std::uint32_t, Element> elements_;
};

// An image of a CT series, 16 bits signed, as scanners write them.
struct DicomSliceFile {
    glm::ivec2 size{4, 3};                              // columns, rows
    glm::dvec2 spacing{1.0, 1.0};                       // from column to column, from row to row
    std::array<double, 6> directions{1, 0, 0, 0, 1, 0}; // of rows, of columns; LPS
    glm::dvec3 position{0.0};
    int number = 1;
    std::string series = "1.2.3.4";
    std::vector<std::int16_t> values;

    [[nodiscard]] DicomElements elements() const {
        DicomElements set;
        set.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL").text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
        set.text(0x00080018, "UI", series + ".7." + std::to_string(number)).text(0x00080060, "CS", "CT");
        set.text(0x0008103e, "LO", "Thorax").text(0x0020000d, "UI", "1.2.3").text(0x0020000e, "UI", series);
        set.text(0x00200011, "IS", "4").text(0x00200013, "IS", std::to_string(number));
        set.decimals(0x00200032, {position.x, position.y, position.z});
        set.decimals(0x00200037, {directions.begin(), directions.end()});
        set.number(0x00280002, 1).text(0x00280004, "CS", "MONOCHROME2");
        set.number(0x00280010, static_cast<std::uint16_t>(size.y))
            .number(0x00280011, static_cast<std::uint16_t>(size.x));
        set.decimals(0x00280030, {spacing.y, spacing.x});
        set.number(0x00280100, 16).number(0x00280101, 16).number(0x00280102, 15).number(0x00280103, 1);
        set.text(0x00281052, "DS", "-1024").text(0x00281053, "DS", "1");
        std::vector<std::int16_t> all = values;
        all.resize(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
        set.pixels({reinterpret_cast<const char*>(all.data()), 2 * all.size()}, 2);
        return set;
    }
};

} // namespace ramus::test
