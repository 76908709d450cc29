#include "core/base/words.h"
#include "core/io/binary_numbers.h"
#include "core/io/text_numbers.h"
#include "core/io/vtk/vtk_dataset.h"
#include "core/tree/data_array.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>

namespace ramus::io {

namespace {

constexpr std::string_view kLegacyMark = "# vtk DataFile Version";

// The number type of a name in the file, except "bit" and "string".
std::optional<NumberType> legacy_type(std::string_view name) {
    constexpr std::pair<std::string_view, NumberType> kTypes[] = {
        {"char", NumberType::kInt8},
        {"signed_char", NumberType::kInt8},
        {"unsigned_char", NumberType::kUInt8},
        {"short", NumberType::kInt16},
        {"unsigned_short", NumberType::kUInt16},
        {"int", NumberType::kInt32},
        {"unsigned_int", NumberType::kUInt32},
        {"long", NumberType::kInt64},
        {"unsigned_long", NumberType::kUInt64},
        {"vtktypeint64", NumberType::kInt64},
        {"vtktypeuint64", NumberType::kUInt64},
        {"vtkidtype", NumberType::kInt32}, // its type in files, whatever it is in memory
        {"float", NumberType::kFloat},
        {"double", NumberType::kDouble}};
    return paired(kTypes, lower_case(name));
}

// Decodes a name: it has %20 for a blank.
std::string legacy_name(std::string_view encoded) {
    std::string name;
    for (std::size_t i = 0; i < encoded.size(); ++i) {
        const auto digit = [&](std::size_t at) {
            const char c = at < encoded.size() ? encoded[at] : '?';
            return c >= '0' && c <= '9'   ? c - '0'
                   : c >= 'A' && c <= 'F' ? c - 'A' + 10
                   : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                          : -1;
        };
        if (encoded[i] == '%' && digit(i + 1) >= 0 && digit(i + 2) >= 0)
            name += static_cast<char>(16 * digit(i + 1) + digit(i + 2)), i += 2;
        else
            name += encoded[i];
    }
    return name;
}

class VtkLegacyReader {
public:
    explicit VtkLegacyReader(const VtkInput& input) : input_(input), words_(input.text, input.name) {}

    Result<VtkDataset> read() {
        static_cast<void>(words_.line()); // the version: the content shows the differences
        if (const auto space = space_in(words_.line()))
            data_.arrays.push_back({std::string(kVtkSpace), VtkOf::kWhole, 1, {}, {space->letters()}});
        const std::string encoding = lower_case(words_.next());
        binary_ = encoding == "binary";
        if (!binary_ && encoding != "ascii")
            return fail("the third line is " + shown(encoding) + ", neither ASCII nor BINARY", words_.place(),
                        "this is no legacy VTK file");
        while (true) {
            const std::string keyword = lower_case(words_.next());
            if (keyword.empty()) break;
            if (auto good = read_section(keyword); !good) return tl::unexpected(good.error());
        }
        if (auto good = add_cells(); !good) return tl::unexpected(good.error());
        return std::move(data_);
    }

private:
    Result<void> read_section(const std::string& keyword) {
        if (keyword == "dataset") {
            type_ = lower_case(words_.next());
            if (type_ == "polydata" || type_ == "unstructured_grid") return {};
            return fail("VTK data of type " + shown(type_) + " hold neither lines nor faces", words_.place(),
                        "they stand in POLYDATA or UNSTRUCTURED_GRID");
        }
        if (keyword == "points") return read_points();
        if (keyword == "vertices") return read_cells(vertices_);
        if (keyword == "lines") return read_cells(lines_);
        if (keyword == "polygons" || keyword == "polys") return read_cells(faces_);
        if (keyword == "triangle_strips") return read_cells(strips_);
        if (keyword == "cells") return read_cells(cells_);
        if (keyword == "cell_types") return read_types();
        if (keyword == "point_data" || keyword == "cell_data") {
            of_ = keyword == "point_data" ? VtkOf::kPoints : VtkOf::kCells;
            // Arrays are checked one by one: a file may announce data and have none.
            RAMUS_TRY(count, words_.whole("the number of values"));
            if (count < 0) return fail("the number of values is negative", words_.place(), "correct the file");
            things_ = static_cast<std::size_t>(count);
            return {};
        }
        if (keyword == "metadata") { // until an empty line
            static_cast<void>(words_.line());
            while (words_.left() > 0 && !trimmed(words_.line()).empty()) {
            }
            return {};
        }
        return read_attribute(keyword);
    }

    // Reads data of points or cells by keyword. The arguments differ between keywords.
    Result<void> read_attribute(const std::string& keyword) {
        if (keyword == "field") return read_fields();
        if (keyword == "lookup_table") {
            static_cast<void>(words_.next());
            RAMUS_TRY(count, words_.count("the size of the table"));
            return skip(4 * count, NumberType::kUInt8);
        }
        const std::string name = legacy_name(words_.next());
        if (keyword == "color_scalars") {
            RAMUS_TRY(components, words_.count("the number of components"));
            return skip(components * things_, NumberType::kUInt8);
        }
        if (keyword == "texture_coordinates") {
            RAMUS_TRY(dimensions, words_.count("the number of components"));
            return read_array(name, of_, dimensions, things_);
        }
        if (keyword == "scalars") return read_scalars(name);
        if (keyword == "vectors" || keyword == "normals") return read_array(name, of_, 3, things_);
        if (keyword == "tensors") return read_array(name, of_, 9, things_);
        if (keyword == "tensors6") return read_array(name, of_, 6, things_);
        if (keyword == "global_ids" || keyword == "pedigree_ids") return read_array(name, of_, 1, things_);
        return fail("the keyword " + shown(keyword) + " is unknown", words_.place(),
                    "the file is damaged; get it again");
    }

    Result<void> read_scalars(const std::string& name) {
        const std::string type(words_.next());
        std::size_t components = 1;
        if (to_whole(words_.peek())) {
            RAMUS_TRY(count, words_.count("the number of components"));
            components = count;
        }
        if (lower_case(words_.peek()) == "lookup_table")
            static_cast<void>(words_.next()), static_cast<void>(words_.next());
        return read_array(name, of_, components, things_, type);
    }

    Result<void> read_fields() {
        static_cast<void>(words_.next());
        RAMUS_TRY(arrays, words_.count("the number of arrays"));
        for (std::size_t a = 0; a < arrays; ++a) {
            std::string name = legacy_name(words_.next());
            if (lower_case(name) == "metadata") { // of the array before
                if (auto good = read_section("metadata"); !good) return good;
                name = legacy_name(words_.next());
            }
            RAMUS_TRY(components, words_.count("the number of components"));
            RAMUS_TRY(tuples, words_.count("the number of tuples"));
            // Arrays of the whole set come before those of points and cells.
            if (auto good = read_array(name, of_, components, tuples); !good) return good;
        }
        return {};
    }

    Result<void> read_array(const std::string& name, VtkOf of, std::size_t components, std::size_t tuples,
                            std::string type = {}) {
        if (type.empty()) type = words_.next();
        const std::size_t count = components * tuples; // each at most the size of the file
        if (tuples != 0 && count / tuples != components)
            return fail("an array claims a size that it cannot have", words_.place(), "the file is damaged");
        VtkArray array{name, of, components, {}, {}};
        if (lower_case(type) == "string") {
            if (auto good = skip_texts(count); !good) return good;
        } else if (lower_case(type) == "bit") {
            if (auto good = binary_ ? skip((count + 7) / 8, NumberType::kUInt8) : skip(count, NumberType::kUInt8);
                !good)
                return good;
        } else {
            const auto number = legacy_type(type);
            if (!number) return fail("the type " + shown(type) + " is unknown", words_.place(), "the file is damaged");
            const bool is_needed = input_.needs(name);
            if (of == VtkOf::kWhole || components != 1 || (!is_needed && !input_.has_room(data_))) {
                if (auto good = skip(count, *number); !good) return good;
                if (of != VtkOf::kWhole && input_.has_room(data_)) data_.left_out.push_back(name);
            } else if (!is_needed) {
                if (auto good = read_data(array, count, *number); !good) return good;
            } else {
                RAMUS_TRY(values, numbers(count, *number, "a value of " + name));
                array.values = std::move(values);
                if (tuples != (of == VtkOf::kPoints ? data_.points.size() : tuples))
                    return fail("the array " + shown(name) + " has " + counted(tuples, "value") + " for " +
                                    counted(data_.points.size(), "point"),
                                words_.place(), "the file is damaged; get it again");
            }
        }
        data_.arrays.push_back(std::move(array));
        return {};
    }

    Result<std::vector<double>> numbers(std::size_t count, NumberType type, const std::string& what) {
        if (binary_) {
            RAMUS_TRY(bytes, binary(count, type));
            return numbers_in(bytes, type, std::endian::big);
        }
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) {
            RAMUS_TRY(value, words_.real(what));
            values.push_back(value);
        }
        return values;
    }

    // Reads an array that is not needed. Does not fail on its content: words that are no numbers become unknown.
    Result<void> read_data(VtkArray& array, std::size_t count, NumberType type) {
        if (binary_) {
            RAMUS_TRY(values, numbers(count, type, {}));
            array.values = std::move(values);
        }
        for (std::size_t i = 0; !binary_ && i < count; ++i) {
            const std::string_view word = words_.next();
            if (word.empty())
                return fail("the file ends within an array", words_.place(), "the file is incomplete; get it again");
            array.values.push_back(to_real(word).value_or(tree::kUnknownValue));
        }
        if (array.of == VtkOf::kPoints && count != data_.points.size()) {
            array.values.clear();
            data_.left_out.push_back(array.name);
        }
        return {};
    }

    Result<std::vector<std::int64_t>> whole_numbers(std::size_t count, NumberType type, const std::string& what) {
        if (binary_) {
            RAMUS_TRY(bytes, binary(count, type));
            return whole_numbers_in(bytes, type, std::endian::big);
        }
        std::vector<std::int64_t> values;
        for (std::size_t i = 0; i < count; ++i) {
            RAMUS_TRY(value, words_.whole(what));
            values.push_back(value);
        }
        return values;
    }

    // From the next line on.
    Result<std::string_view> binary(std::size_t count, NumberType type) {
        if (count == 0) return std::string_view{};
        static_cast<void>(words_.line());
        if (count > words_.left()) return words_.bytes(count);
        return words_.bytes(count * size_of(type));
    }

    Result<void> skip(std::size_t count, NumberType type) {
        if (binary_) {
            RAMUS_TRY(bytes, binary(count, type));
            static_cast<void>(bytes);
            return {};
        }
        for (std::size_t i = 0; i < count; ++i)
            if (words_.next().empty())
                return fail("the file ends within an array", words_.place(), "the file is incomplete; get it again");
        return {};
    }

    // Texts, one a line; in binary files each after its length, in 6 to 62 bits according to the first two bits.
    Result<void> skip_texts(std::size_t count) {
        static_cast<void>(words_.line());
        for (std::size_t i = 0; i < count; ++i) {
            if (!binary_) {
                static_cast<void>(words_.line());
                continue;
            }
            RAMUS_TRY(first, words_.bytes(1));
            const auto head = static_cast<unsigned char>(first[0]);
            std::uint64_t length = head & 63U;
            RAMUS_TRY(more, words_.bytes((std::size_t{1} << (3 - (head >> 6))) - 1));
            for (const char c : more) length = length << 8 | static_cast<unsigned char>(c);
            RAMUS_TRY(text, words_.bytes(length));
            static_cast<void>(text);
        }
        return {};
    }

    Result<void> read_points() {
        RAMUS_TRY(count, words_.count("the number of points"));
        const std::string_view name = words_.next();
        const auto type = legacy_type(name);
        if (!type) return fail("the type " + shown(name) + " is unknown", words_.place(), "the file is damaged");
        if (count >= std::numeric_limits<std::uint32_t>::max() / 3)
            return fail("the file has more points than can be counted", words_.place(), "split it");
        RAMUS_TRY(values, numbers(3 * count, *type, "a coordinate"));
        data_.points.clear();
        for (std::size_t p = 0; p < count; ++p)
            data_.points.emplace_back(values[3 * p], values[3 * p + 1], values[3 * p + 2]);
        return {};
    }

    struct Cells {
        std::vector<std::int64_t> corners, ends;
        std::string place;
    };

    // Since version 5.1 as offsets and connectivity, before as the number of points of each cell and the points.
    Result<void> read_cells(Cells& cells) {
        RAMUS_TRY(first, words_.count("the number of cells"));
        RAMUS_TRY(second, words_.count("the size of the cells"));
        cells = {};
        cells.place = words_.place();
        if (lower_case(words_.peek()) == "offsets") return read_offsets(cells, first, second);
        RAMUS_TRY(values, whole_numbers(second, NumberType::kInt32, "the index of a point"));
        std::size_t at = 0;
        for (std::size_t c = 0; c < first; ++c) {
            const std::int64_t size = at < values.size() ? values[at++] : -1;
            if (size < 0 || static_cast<std::uint64_t>(size) > values.size() - at)
                return fail("cell " + std::to_string(c) + " does not fit the size that the file declares", cells.place,
                            "the file is damaged; get it again");
            cells.corners.insert(cells.corners.end(), values.begin() + static_cast<std::ptrdiff_t>(at),
                                 values.begin() + static_cast<std::ptrdiff_t>(at) + size);
            at += static_cast<std::size_t>(size);
            cells.ends.push_back(static_cast<std::int64_t>(cells.corners.size()));
        }
        return {};
    }

    Result<void> read_offsets(Cells& cells, std::size_t offsets, std::size_t corners) {
        for (const bool connectivity : {false, true}) {
            const char* wanted = connectivity ? "connectivity" : "offsets";
            const std::string_view keyword = words_.next(), name = words_.next();
            const auto type = legacy_type(name);
            if (lower_case(keyword) != wanted || !type)
                return fail("found " + shown(keyword) + " where " + wanted + " should stand", words_.place(),
                            "the file is damaged; get it again");
            RAMUS_TRY(values, whole_numbers(connectivity ? corners : offsets, *type, std::string("one of ") + wanted));
            (connectivity ? cells.corners : cells.ends) = std::move(values);
        }
        std::int64_t before = 0;
        for (const std::int64_t end : cells.ends) {
            if (end < before || static_cast<std::uint64_t>(end) > cells.corners.size())
                return fail("the offsets of the cells do not fit their connectivity", words_.place(),
                            "the file is damaged; get it again");
            before = end;
        }
        if (!cells.ends.empty()) cells.ends.erase(cells.ends.begin()); // the first begins at 0
        return {};
    }

    Result<void> read_types() {
        RAMUS_TRY(count, words_.count("the number of cells"));
        RAMUS_TRY(values, whole_numbers(count, NumberType::kInt32, "the type of a cell"));
        types_ = std::move(values);
        return {};
    }

    template <class KindOf> Result<void> add(const Cells& cells, const KindOf& kind_of) {
        std::int64_t begin = 0;
        std::vector<std::int64_t> cell;
        for (std::size_t c = 0; c < cells.ends.size(); ++c) {
            cell.assign(cells.corners.begin() + begin, cells.corners.begin() + cells.ends[c]);
            begin = cells.ends[c];
            if (auto good = data_.add_cell(kind_of(c), cell, 0, input_.faces, cells.place); !good) return good;
        }
        return {};
    }

    // In VTK's order of cells, which cell arrays follow.
    Result<void> add_cells() {
        using Cell = VtkDataset::Cell;
        if (auto good = add(vertices_, [](std::size_t) { return Cell::kVertex; }); !good) return good;
        if (auto good = add(lines_, [](std::size_t) { return Cell::kLine; }); !good) return good;
        if (auto good = add(faces_, [](std::size_t) { return Cell::kFace; }); !good) return good;
        if (auto good = add(strips_, [](std::size_t) { return Cell::kStrip; }); !good) return good;
        if (types_.size() != cells_.ends.size())
            return fail("there are " + counted(cells_.ends.size(), "cell") + ", but types of " +
                            std::to_string(types_.size()),
                        words_.place(), "the file is incomplete or damaged; get it again");
        if (auto good = add(cells_, [&](std::size_t c) { return vtk_cell(static_cast<int>(types_[c] & 0xFF)); }); !good)
            return good;
        for (VtkArray& array : data_.arrays) {
            if (array.of != VtkOf::kCells || array.values.empty() || array.values.size() == data_.cells) continue;
            if (input_.needs(array.name))
                return fail("the array " + shown(array.name) + " has " + counted(array.values.size(), "value") +
                                " for " + counted(data_.cells, "cell"),
                            input_.name, "the file is damaged; get it again");
            array.values.clear();
            data_.left_out.push_back(array.name);
        }
        return {};
    }

    const VtkInput& input_;
    WordScanner words_;
    VtkDataset data_;
    bool binary_ = false;
    std::string type_;
    Cells vertices_, lines_, faces_, strips_, cells_;
    std::vector<std::int64_t> types_;
    VtkOf of_ = VtkOf::kWhole;
    std::size_t things_ = 0;
};

} // namespace

bool is_vtk_legacy(std::string_view head) { return head.starts_with(kLegacyMark); }

Result<VtkDataset> read_vtk_legacy(const VtkInput& input) { return VtkLegacyReader(input).read(); }

} // namespace ramus::io
