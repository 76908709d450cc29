// Headers of volumes that are text: fields, one a line, and the numbers and words in them; and files of values that a
// header names.
#pragma once

#include "core/base/error.h"
#include "core/io/text_numbers.h"
#include "core/io/volumes/byte_source.h"
#include "core/io/volumes/voxel_data.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Numbers with blanks between; nothing if one of the words is none. "nan" and "inf" are numbers.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(std::string_view text);
[[nodiscard]] std::optional<std::vector<std::int64_t>> whole_numbers_in(std::string_view text);

// Fields by their names. Those that are given several times have their last value.
struct HeaderText {
    std::string file; // for errors
    std::map<std::string, std::string> fields;

    // The first of these fields that is there; null: none is.
    [[nodiscard]] const std::string* find(std::initializer_list<const char*> names) const;
    // What errors say of a field that is there and makes no sense, or is missing.
    [[nodiscard]] tl::unexpected<Error> refused(const std::string& field, const std::string& why) const;
    // Of a field that is there, or nothing.
    [[nodiscard]] Result<std::optional<std::vector<double>>> numbers(std::initializer_list<const char*> names,
                                                                     std::size_t count) const;
    [[nodiscard]] Result<std::optional<std::int64_t>> whole_number(std::initializer_list<const char*> names) const;
};

// kBinary or kSwapped.
[[nodiscard]] Encoding binary_encoding(bool big_endian);

// Where a file lies that the header in `source` names: a regular file in its folder or below, or an error.
[[nodiscard]] Result<std::filesystem::path> values_path(const ByteSource& source, const std::string& name);
// The bytes of that file, as they are.
[[nodiscard]] Result<ByteSource> open_values(const ByteSource& source, const std::string& name);

// Most that a header may take; those of segmentations tell much of every segment.
inline constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 20;

} // namespace ramus::io
