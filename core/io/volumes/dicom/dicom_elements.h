// The elements of a DICOM data set that readers of images need, as dicom_layout.h finds them, with their values. What
// is not there or makes no sense is empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::io {

class DicomSet {
public:
    explicit DicomSet(bool big_endian = false) : big_endian_(big_endian) {}

    // Only elements that anybody asks for are worth keeping.
    [[nodiscard]] static bool wants(std::uint32_t tag);
    void put(std::uint32_t tag, std::string_view value); // the first counts
    // The items of a sequence, to be added; until the next call.
    std::vector<DicomSet>& sequence(std::uint32_t tag);

    [[nodiscard]] std::string text(std::uint32_t tag) const; // without padding
    [[nodiscard]] std::vector<double> decimals(std::uint32_t tag) const;
    // Of two bytes, unsigned; `place`: which one of several.
    [[nodiscard]] std::optional<int> number(std::uint32_t tag, std::size_t place = 0) const;
    [[nodiscard]] const std::vector<DicomSet>& items(std::uint32_t tag) const;

private:
    [[nodiscard]] std::string_view value_of(std::uint32_t tag) const;

    bool big_endian_;
    std::vector<std::pair<std::uint32_t, std::string>> values_;
    std::vector<std::pair<std::uint32_t, std::vector<DicomSet>>> sequences_;
};

} // namespace ramus::io
