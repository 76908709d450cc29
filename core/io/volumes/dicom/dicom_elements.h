// DicomSet: the values of those elements of a DICOM data set that readers of images need. Missing and invalid values
// are empty or none. dicom_layout.h fills it.
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

    // Whether readers need the element; others are not kept.
    [[nodiscard]] static bool wants(std::uint32_t tag);
    void put(std::uint32_t tag, std::string_view value); // keeps the first value of a tag
    // The items of a sequence, for adding. The reference is valid until the next call.
    std::vector<DicomSet>& sequence(std::uint32_t tag);

    [[nodiscard]] std::string text(std::uint32_t tag) const; // without padding
    [[nodiscard]] std::vector<double> decimals(std::uint32_t tag) const;
    // An unsigned number of two bytes; `place`: its index, if the element has several.
    [[nodiscard]] std::optional<int> number(std::uint32_t tag, std::size_t place = 0) const;
    [[nodiscard]] const std::vector<DicomSet>& items(std::uint32_t tag) const;

private:
    [[nodiscard]] std::string_view value_of(std::uint32_t tag) const;

    bool big_endian_;
    std::vector<std::pair<std::uint32_t, std::string>> values_;
    std::vector<std::pair<std::uint32_t, std::vector<DicomSet>>> sequences_;
};

} // namespace ramus::io
