#include "core/io/volumes/zarr/zarr_array.h"

#include "core/io/json_text.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr const char* kZarrAgain = "write it again, in Zarr's format 2";

tl::unexpected<Error> zarr_refused(const std::string& what, const std::string& name) {
    return fail("its " + what, name, kZarrAgain);
}

std::string short_json(const json& value) { return shown(printed_json(value, -1)); }

// A list of whole numbers from 1 on.
std::optional<std::vector<std::uint64_t>> counts_in(const json& object, const char* key) {
    const auto found = object.find(key);
    if (found == object.end() || !found->is_array()) return std::nullopt;
    std::vector<std::uint64_t> counts;
    for (const json& each : *found) {
        if (!each.is_number_unsigned() || each.get<std::uint64_t>() < 1) return std::nullopt;
        counts.push_back(each.get<std::uint64_t>());
    }
    return counts;
}

struct ZarrType {
    std::string_view name;
    VoxelType type;
};
constexpr std::array<ZarrType, 11> kZarrTypes = {{{"b1", VoxelType::kUint8},
                                                  {"u1", VoxelType::kUint8},
                                                  {"i1", VoxelType::kInt8},
                                                  {"u2", VoxelType::kUint16},
                                                  {"i2", VoxelType::kInt16},
                                                  {"u4", VoxelType::kUint32},
                                                  {"i4", VoxelType::kInt32},
                                                  {"u8", VoxelType::kUint64},
                                                  {"i8", VoxelType::kInt64},
                                                  {"f4", VoxelType::kFloat32},
                                                  {"f8", VoxelType::kFloat64}}};

Result<void> take_type(const json& object, ZarrArray& array, const std::string& name) {
    const auto found = object.find("dtype");
    const std::string text = found != object.end() && found->is_string() ? found->get<std::string>() : "";
    const auto* known = kZarrTypes.end();
    if (text.size() == 3 && std::string_view("<>|").find(text[0]) != std::string_view::npos)
        known = std::ranges::find(kZarrTypes, std::string_view(text).substr(1), &ZarrType::name);
    if (known == kZarrTypes.end())
        return zarr_refused("type of numbers (dtype) is not read: " +
                                (found == object.end() ? std::string("it is missing") : short_json(*found)),
                            name);
    array.type = known->type;
    array.swapped = text[0] == '>' ? std::endian::native == std::endian::little
                                   : text[0] == '<' && std::endian::native == std::endian::big;
    return {};
}

Result<void> take_compressor(const json& object, ZarrArray& array, const std::string& name) {
    const auto filters = object.find("filters");
    if (filters != object.end() && !filters->is_null() && !(filters->is_array() && filters->empty()))
        return zarr_refused("numbers went through filters, which are not read: " + short_json(*filters), name);
    const auto found = object.find("compressor");
    if (found == object.end() || found->is_null()) return {};
    const std::string id = found->is_object() ? found->value("id", json()).dump() : "";
    if (id == "\"zlib\"" || id == "\"gzip\"")
        array.compressor = ZarrCompressor::kDeflate;
    else if (id == "\"blosc\"")
        array.compressor = ZarrCompressor::kBlosc;
    else
        return fail("its compressor is not read: " + short_json(*found), name,
                    "write it again without compressor, or with zlib, gzip or blosc");
    return {};
}

template <class Number> std::string bytes_of_number(double value) {
    const auto number = static_cast<Number>(value);
    std::string bytes(sizeof(number), '\0');
    std::memcpy(bytes.data(), &number, sizeof(number));
    return bytes;
}

// The bytes of a number of this type. Empty: it does not fit.
std::string bytes_of_fill(VoxelType type, double value) {
    if (type == VoxelType::kFloat32) return bytes_of_number<float>(value);
    if (type == VoxelType::kFloat64) return bytes_of_number<double>(value);
    const bool is_signed =
        type == VoxelType::kInt8 || type == VoxelType::kInt16 || type == VoxelType::kInt32 || type == VoxelType::kInt64;
    const double values = std::exp2(8.0 * static_cast<double>(bytes_of(type)) - (is_signed ? 1.0 : 0.0));
    if (!(value >= (is_signed ? -values : 0.0)) || value >= values || value != std::floor(value)) return {};
    const std::string bytes =
        value < 0.0 ? bytes_of_number<std::int64_t>(value) : bytes_of_number<std::uint64_t>(value);
    const std::size_t each = bytes_of(type);
    return std::endian::native == std::endian::little ? bytes.substr(0, each) : bytes.substr(bytes.size() - each);
}

Result<void> take_fill(const json& object, ZarrArray& array, const std::string& name) {
    const auto found = object.find("fill_value");
    double value = 0.0;
    if (found != object.end() && found->is_boolean()) value = found->get<bool>() ? 1.0 : 0.0;
    if (found != object.end() && found->is_number()) value = found->get<double>();
    if (found != object.end() && found->is_string()) {
        const std::string text = found->get<std::string>();
        if (text != "NaN" && text != "Infinity" && text != "-Infinity")
            return zarr_refused("fill_value is no number: " + short_json(*found), name);
        value = text == "NaN" ? std::numeric_limits<double>::quiet_NaN()
                              : (text[0] == '-' ? -1.0 : 1.0) * std::numeric_limits<double>::infinity();
    }
    if (found != object.end() && (found->is_array() || found->is_object()))
        return zarr_refused("fill_value is no number: " + short_json(*found), name);
    array.fill = bytes_of_fill(array.type, value);
    if (array.fill.empty()) return zarr_refused("fill_value is no number of its type: " + short_json(*found), name);
    return {};
}

} // namespace

std::uint64_t ZarrArray::chunk_bytes() const {
    std::uint64_t bytes = bytes_of(type);
    for (const std::uint64_t count : chunks) {
        constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
        if (count > kLargest / bytes) return kLargest;
        bytes *= count;
    }
    return bytes;
}

std::uint64_t ZarrArray::chunks_along(std::size_t axis) const {
    return shape[axis] / chunks[axis] + (shape[axis] % chunks[axis] > 0 ? 1 : 0);
}

Result<ZarrArray> zarr_array(std::string_view text, const std::string& name) {
    RAMUS_TRY(object, parsed_json(text, name));
    if (!object.is_object()) return zarr_refused("description of the array is no JSON object", name);
    if (const auto version = object.find("zarr_format"); version == object.end() || *version != 2)
        return fail("its version of Zarr is not read" +
                        (version == object.end() ? std::string() : ": " + short_json(*version)),
                    name, "write it again with zarr_format 2");
    ZarrArray array;
    const auto shape = counts_in(object, "shape"), chunks = counts_in(object, "chunks");
    if (!shape || !chunks || shape->size() != chunks->size())
        return zarr_refused("shape or chunks are no lists of equally many whole numbers from 1 on", name);
    if (shape->size() < 2 || shape->size() > 5)
        return fail("it has " + std::to_string(shape->size()) + " axes", name, "name an array of 2 to 5 axes");
    array.shape = *shape;
    array.chunks = *chunks;
    if (auto taken = take_type(object, array, name); !taken) return tl::unexpected(taken.error());
    if (auto taken = take_compressor(object, array, name); !taken) return tl::unexpected(taken.error());
    if (auto taken = take_fill(object, array, name); !taken) return tl::unexpected(taken.error());
    const auto order = object.find("order");
    if (order == object.end() || (*order != "C" && *order != "F"))
        return zarr_refused("order is neither C nor F", name);
    array.first_fastest = *order == "F";
    if (const auto separator = object.find("dimension_separator"); separator != object.end()) {
        if (*separator != "." && *separator != "/") return zarr_refused("dimension_separator is neither . nor /", name);
        array.separator = separator->get<std::string>().front();
        array.states_separator = true;
    }
    return array;
}

std::filesystem::path zarr_chunk_name(const std::vector<std::uint64_t>& chunk, char separator) {
    std::string name;
    for (const std::uint64_t number : chunk)
        name += (name.empty() ? "" : std::string(1, separator)) + std::to_string(number);
    return name;
}

} // namespace ramus::io
