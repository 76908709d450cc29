#include "core/io/volumes/zarr/zarr_image.h"

#include "core/base/printable.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/json_text.h"
#include "core/io/length_unit.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>
#include <vector>

namespace ramus::io {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kZarrWriteAgain = "write it again with the program that made it";
constexpr std::uintmax_t kMostZarrJson = std::uintmax_t{16} << 20;

bool is_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

// The attributes of a group or an array. An empty object: it has none.
Result<json> attributes_of(const fs::path& folder) {
    const fs::path file = folder / ".zattrs";
    if (!is_file(file)) return json::object();
    RAMUS_TRY(text, read_file(file, kMostZarrJson));
    RAMUS_TRY(value, parsed_json(text, file.string()));
    if (!value.is_object()) return fail("is no JSON object", file.string(), kZarrWriteAgain);
    return std::move(value);
}

const json* member(const json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}
const json* list_member(const json& object, const char* key) {
    const json* found = member(object, key);
    return found != nullptr && found->is_array() ? found : nullptr;
}
std::string text_member(const json& object, const char* key) {
    const json* found = member(object, key);
    return found != nullptr && found->is_string() ? found->get<std::string>() : "";
}

// The first image that the attributes of a group describe. Null: none.
const json* multiscale_of(const json& attributes) {
    const json* list = list_member(attributes, "multiscales");
    return list == nullptr || list->empty() || !list->front().is_object() ? nullptr : &list->front();
}

// The paths of the levels.
Result<std::vector<std::string>> level_paths(const json& multiscale, const fs::path& folder) {
    std::vector<std::string> paths;
    const json* levels = list_member(multiscale, "datasets");
    constexpr std::size_t kMostLevels = 100;
    if (levels == nullptr || levels->empty() || levels->size() > kMostLevels)
        return fail("its multiscales list no levels, or more than 100", folder.string(), kZarrWriteAgain);
    for (const json& level : *levels) {
        const fs::path path = text_member(level, "path");
        const bool leads_out = path.empty() || path.is_absolute() ||
                               std::ranges::any_of(path, [](const fs::path& part) { return part == ".."; });
        if (leads_out)
            return fail("the path of a level leads out of the folder: " + shown(path.string()), folder.string(),
                        kZarrWriteAgain);
        paths.push_back(path.string());
    }
    return paths;
}

Result<ZarrArray> array_in(const fs::path& folder) {
    const fs::path file = folder / ".zarray";
    if (!is_file(file)) return fail("there is no array: .zarray is missing", folder.string(), "copy all of the folder");
    RAMUS_TRY(text, read_file(file, kMostZarrJson));
    return zarr_array(text, file.string());
}

double voxels_of(const ZarrArray& array) {
    double voxels = 1.0;
    for (const std::uint64_t count : array.shape) voxels *= static_cast<double>(count);
    return voxels;
}

// Sets folder and array to the finest level, with a note of the others.
Result<std::size_t> take_finest(const json& multiscale, const fs::path& folder, ZarrImage& image) {
    RAMUS_TRY(paths, level_paths(multiscale, folder));
    std::size_t finest = 0;
    for (std::size_t n = 0; n < paths.size(); ++n) {
        auto array = array_in(folder / paths[n]);
        if (!array && n > 0) continue; // coarser levels may be missing
        if (!array) return tl::unexpected(array.error());
        if (n > 0 && voxels_of(*array) <= voxels_of(image.array)) continue;
        image.array = std::move(*array);
        finest = n;
    }
    image.folder = folder / paths[finest];
    if (paths.size() > 1)
        image.claims.notes.push_back("it holds " + std::to_string(paths.size()) + " levels of detail, " +
                                     printable(joined(paths, ", ", [](const std::string& path) { return path; })) +
                                     ": read " + printable(paths[finest]) +
                                     ", the finest; name the folder of another to read that");
    return finest;
}

// The names of the axes: "t", "c", "z", "y", "x", or others.
struct ZarrAxes {
    std::vector<std::string> names, units;
    bool stated = false;
};

ZarrAxes stated_axes(const json* list) {
    ZarrAxes axes;
    axes.stated = list != nullptr;
    if (list == nullptr) return axes;
    for (const json& axis : *list) {
        std::string name = axis.is_string() ? axis.get<std::string>() : text_member(axis, "name");
        const std::string type = text_member(axis, "type");
        if (type == "channel") name = "c";
        if (type == "time") name = "t";
        axes.names.push_back(lower_case(name));
        axes.units.push_back(text_member(axis, "unit"));
    }
    return axes;
}

Result<void> take_axes(ZarrAxes axes, const std::string& name, ZarrImage& image) {
    const std::size_t count = image.array.shape.size();
    if (!axes.stated) {
        const std::string letters = std::string("tczyx").substr(5 - count);
        for (const char letter : letters) axes.names.emplace_back(1, letter);
        axes.units.assign(count, "");
        image.claims.notes.push_back("the file does not name its axes: taken as " +
                                     joined(axes.names, ", ", [](const std::string& axis) { return axis; }));
    }
    const auto refused = [&] {
        return fail("its axes are not x, y and z, channel and time: " +
                        printable(joined(axes.names, ", ", [](const std::string& axis) { return axis; })),
                    name, kZarrWriteAgain);
    };
    if (axes.names.size() != count) return refused();
    image.has_z = false;
    int found = 0;
    for (std::size_t n = 0; n < count; ++n) {
        const std::string& axis = axes.names[n];
        if (std::ranges::count(axes.names, axis) > 1) return refused();
        const std::size_t at = std::string_view("xyz").find(axis);
        if (axis.size() == 1 && at != std::string_view::npos) {
            image.space[at] = n;
            if (at == 2)
                image.has_z = true;
            else
                ++found;
        } else if (axis == "c") {
            image.channel = n;
        } else if (axis == "t") {
            image.time = n;
        } else if (image.array.shape[n] > 1) {
            return refused();
        }
    }
    if (found < 2) return refused();
    for (std::size_t axis = 0; axis < (image.has_z ? 3 : 2); ++axis)
        if (const auto unit = named_unit_mm(axes.units[image.space[axis]]); unit && !image.claims.unit_mm)
            image.claims.unit_mm = unit;
    if (image.channel) image.parts.channels = image.array.shape[*image.channel];
    if (image.time) image.parts.times = image.array.shape[*image.time];
    return {};
}

// A scaling and a shift along each axis of the array.
struct ZarrTransform {
    std::vector<double> scale, shift;
    bool stated = false;
};

// Applies transformations after those before.
void apply_transformations(const json* list, ZarrTransform& transform) {
    if (list == nullptr) return;
    for (const json& step : *list) {
        const std::string type = text_member(step, "type");
        const json* numbers = list_member(step, type == "scale" ? "scale" : "translation");
        if ((type != "scale" && type != "translation") || numbers == nullptr ||
            numbers->size() != transform.scale.size() ||
            std::ranges::any_of(*numbers, [](const json& each) { return !each.is_number(); }))
            continue;
        for (std::size_t n = 0; n < numbers->size(); ++n) {
            const double number = (*numbers)[n].get<double>();
            if (type == "scale") transform.scale[n] *= number, transform.shift[n] *= number;
            if (type == "translation") transform.shift[n] += number;
        }
        transform.stated = transform.stated || type == "scale";
    }
}

void take_transform(const ZarrTransform& transform, const ZarrAxes& axes, ZarrImage& image) {
    if (!transform.stated) return;
    for (std::size_t axis = 0; axis < (image.has_z ? 3 : 2); ++axis) {
        const std::size_t n = image.space[axis];
        const double mm = n < axes.units.size() ? named_unit_mm(axes.units[n]).value_or(1.0) : 1.0;
        if (can_be_spacing(mm * transform.scale[n])) image.claims.spacing[axis] = mm * transform.scale[n];
        image.claims.origin[static_cast<int>(axis)] = mm * transform.shift[n];
    }
}

// Takes what the attributes of a group say about its level number `level`.
Result<void> describe(const json& attributes, const json& multiscale, std::size_t level, const std::string& name,
                      ZarrImage& image) {
    const std::string version = text_member(multiscale, "version");
    image.program = "OME-Zarr" + (version.empty() ? "" : " " + printable(version).substr(0, 10));
    const ZarrAxes axes = stated_axes(list_member(multiscale, "axes"));
    if (auto taken = take_axes(axes, name, image); !taken) return taken;
    ZarrTransform transform;
    transform.scale.assign(image.array.shape.size(), 1.0);
    transform.shift.assign(image.array.shape.size(), 0.0);
    apply_transformations(list_member((*list_member(multiscale, "datasets"))[level], "coordinateTransformations"),
                          transform);
    apply_transformations(list_member(multiscale, "coordinateTransformations"), transform);
    take_transform(transform, axes, image);
    if (const json* omero = member(attributes, "omero"))
        if (const json* channels = list_member(*omero, "channels"))
            for (const json& channel : *channels) image.parts.channel_names.push_back(text_member(channel, "label"));
    return {};
}

// A plain array: of a level of an image in an enclosing folder, or alone.
Result<ZarrImage> image_of_array(const fs::path& folder) {
    ZarrImage image;
    image.folder = folder;
    RAMUS_TRY(array, array_in(folder));
    image.array = std::move(array);
    fs::path group = fs::absolute(folder).lexically_normal();
    if (!group.has_filename()) group = group.parent_path();
    const fs::path self = group;
    constexpr int kMostEnclosing = 3;
    for (int n = 0; n < kMostEnclosing && group.has_relative_path(); ++n) {
        group = group.parent_path();
        RAMUS_TRY(attributes, attributes_of(group));
        const json* multiscale = multiscale_of(attributes);
        if (multiscale == nullptr) continue;
        RAMUS_TRY(paths, level_paths(*multiscale, group));
        for (std::size_t level = 0; level < paths.size(); ++level) {
            if ((group / paths[level]).lexically_normal() != self) continue;
            if (auto good = describe(attributes, *multiscale, level, group.string(), image); !good)
                return tl::unexpected(good.error());
            return image;
        }
    }
    RAMUS_TRY(attributes, attributes_of(folder));
    image.program = "Zarr";
    auto taken = take_axes(stated_axes(list_member(attributes, "_ARRAY_DIMENSIONS")), folder.string(), image);
    if (!taken) return tl::unexpected(taken.error());
    return image;
}

Result<ZarrImage> image_of_group(const fs::path& folder) {
    RAMUS_TRY(attributes, attributes_of(folder));
    const json* multiscale = multiscale_of(attributes);
    if (multiscale != nullptr) {
        ZarrImage image;
        RAMUS_TRY(level, take_finest(*multiscale, folder, image));
        if (auto good = describe(attributes, *multiscale, level, folder.string(), image); !good)
            return tl::unexpected(good.error());
        if (is_file(folder / "labels" / ".zattrs")) {
            RAMUS_TRY(labels, attributes_of(folder / "labels"));
            if (const json* list = list_member(labels, "labels"); list != nullptr && !list->empty())
                image.claims.notes.push_back("it also holds segmentations, in its folder labels: " +
                                             printable(printed_json(*list, -1)).substr(0, 200));
        }
        return image;
    }
    return fail("this group of Zarr holds no image of its own", folder.string(),
                "name the folder of one of its images or arrays");
}

} // namespace

bool is_zarr_folder(const fs::path& folder) {
    return std::ranges::any_of(std::array{".zarray", ".zgroup", "zarr.json"},
                               [&](const char* name) { return is_file(folder / name); });
}

Result<ZarrImage> zarr_image(const fs::path& folder) {
    if (is_file(folder / ".zarray")) return image_of_array(folder);
    if (!is_file(folder / ".zgroup"))
        return fail("this is Zarr of version 3, which is not read", folder.string(),
                    "write it with zarr_format 2 (OME-Zarr 0.4)");
    // bioformats2raw's folders hold numbered images.
    RAMUS_TRY(attributes, attributes_of(folder));
    const fs::path first = folder / "0";
    if (attributes.contains("bioformats2raw.layout") && is_file(first / ".zgroup")) {
        RAMUS_TRY(image, image_of_group(first));
        if (is_file(folder / "1" / ".zgroup"))
            image.claims.notes.emplace_back("it holds several images: read 0; name the folder of another to read that");
        return std::move(image);
    }
    return image_of_group(folder);
}

} // namespace ramus::io
