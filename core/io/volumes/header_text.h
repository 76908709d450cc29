// Parses text headers of volumes (NRRD, MetaImage): fields, one a line, with numbers; and opens the file of values that
// a header names.
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

// Parses blank-separated numbers; "nan" and "inf" are numbers. None: a word is no number.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(std::string_view text);
[[nodiscard]] std::optional<std::vector<std::int64_t>> whole_numbers_in(std::string_view text);

// Fields by their names. A field that is given several times has its last value.
struct HeaderText {
    std::string file; // for errors
    std::map<std::string, std::string> fields;

    // The first of these fields that exists. Null: none.
    [[nodiscard]] const std::string* find(std::initializer_list<const char*> names) const;
    // An error about an invalid or missing field.
    [[nodiscard]] tl::unexpected<Error> refused(const std::string& field, const std::string& why) const;
    // The numbers of the first of these fields that exists. None: there is none. Fail on other counts and on text.
    [[nodiscard]] Result<std::optional<std::vector<double>>> numbers(std::initializer_list<const char*> names,
                                                                     std::size_t count) const;
    [[nodiscard]] Result<std::optional<std::int64_t>> whole_number(std::initializer_list<const char*> names) const;
};

// kBinary or kSwapped.
[[nodiscard]] Encoding binary_encoding(bool big_endian);

// The path of a file that the header in `source` names. Fails unless it is a regular file in the header's folder or
// below: a header of unknown origin must not read other files of this machine.
[[nodiscard]] Result<std::filesystem::path> values_path(const ByteSource& source, const std::string& name);
// The bytes of that file, not decompressed.
[[nodiscard]] Result<ByteSource> open_values(const ByteSource& source, const std::string& name);

// Largest header, in bytes. Headers of segmentations are long.
inline constexpr std::size_t kMostHeaderBytes = std::size_t{16} << 20;

} // namespace ramus::io
