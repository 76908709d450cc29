// The container of Amira's files: a header that declares how many things of which kind there are and which arrays they
// have, and the arrays behind it.
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
    std::int64_t mark = 0; // of its data: 1 for @1
    std::string codec;     // "HxZip", "HxByteRLE"; empty: as they are
    std::uint64_t coded_size = 0;
    std::string_view data; // where it begins
    bool is_there = false; // its data
};

struct AmiraFile {
    bool binary = false;
    std::endian order = std::endian::big;
    std::map<std::string, std::uint64_t> counts; // that are declared: of VERTEX, EDGE, POINT
    std::string content_type;                    // "HxSpatialGraph"
    std::string unit;                            // of coordinates; empty: it does not say
    std::vector<AmiraArray> arrays;

    [[nodiscard]] const AmiraArray* find(std::string_view of, std::string_view name) const; // with data or not
};

// Where each array lies in `text`, which must outlive it. No number is read yet.
[[nodiscard]] Result<AmiraFile> amira_file(std::string_view text, const std::string& name);

// As many numbers as are declared: those of one thing side by side. Fails if there are less, or more.
[[nodiscard]] Result<std::vector<double>> amira_numbers(const AmiraFile& file, const AmiraArray& array,
                                                        std::string_view text, const std::string& name);

} // namespace ramus::io
