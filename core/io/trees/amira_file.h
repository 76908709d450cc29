// The container format of Amira's files: a header that declares counts (of vertices, edges, points) and arrays, and
// then the data of the arrays.
#pragma once

#include "core/io/binary_numbers.h"
#include "core/io/trees/imported_tree.h"

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

struct AmiraArray {
    std::string of;   // "VERTEX", "EDGE", "POINT"
    std::string name; // "VertexCoordinates"
    NumberType type = NumberType::kFloat;
    std::uint64_t components = 1;
    std::int64_t mark = 0; // that identifies its data: 1 for @1
    std::string codec;     // "HxZip", "HxByteRLE"; empty: not compressed
    std::uint64_t coded_size = 0;
    std::string_view data; // from its first byte to the end of the file
    bool is_there = false; // the file has its data
};

struct AmiraFile {
    bool binary = false;
    std::endian order = std::endian::big;
    std::map<std::string, std::uint64_t> counts; // declared number of VERTEX, EDGE, POINT
    std::string content_type;                    // "HxSpatialGraph"
    std::string unit;                            // of coordinates; empty: not stated
    std::vector<AmiraArray> arrays;

    [[nodiscard]] const AmiraArray* find(std::string_view of, std::string_view name) const; // with data or not
};

// Parses the header and locates each array in `text`, which must outlive the result. Decodes no number yet.
[[nodiscard]] Result<AmiraFile> amira_file(std::string_view text, const std::string& name);

// Decodes an array; the components of an element are adjacent. Fails if the number of values is not as declared.
[[nodiscard]] Result<std::vector<double>> amira_numbers(const AmiraFile& file, const AmiraArray& array,
                                                        std::string_view text, const std::string& name);

} // namespace ramus::io
