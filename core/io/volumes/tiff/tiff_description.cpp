#include "core/io/volumes/tiff/tiff_description.h"

#include "core/base/printable.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/xml_input.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace ramus::io {

namespace {

constexpr std::uint64_t kMostPlanes = std::numeric_limits<std::uint64_t>::max();
constexpr double kInchMm = 25.4, kCmMm = 10.0;

// Distances from the resolution of the first page, which most programs write for printing.
void claim_resolution(const TiffPage& page, SpatialClaims& claims) {
    constexpr std::uint64_t kInch = 2, kCm = 3;
    if (!page.resolution || (page.resolution_unit != kInch && page.resolution_unit != kCm)) return;
    const double unit = page.resolution_unit == kInch ? kInchMm : kCmMm;
    const auto& [x, y] = *page.resolution;
    if (!can_be_spacing(x) || !can_be_spacing(y)) return;
    claims.spacing = {unit / x, unit / y, std::nullopt};
    claims.unit_mm = unit;
    constexpr std::array<double, 7> kPrinted = {72.0, 75.0, 96.0, 100.0, 150.0, 300.0, 600.0};
    if (page.resolution_unit == kInch && std::ranges::find(kPrinted, x) != kPrinted.end())
        claims.suspicions.push_back("its pixels are " + short_number(unit / x) + " mm wide by " + short_number(x) +
                                    " pixels in an inch, which programs write for printing when nobody has measured: "
                                    "--units XxYxZ sets the size of a voxel, in mm");
}

// ImageJ's lines. A line without "=" is skipped.
std::map<std::string, std::string, std::less<>> imagej_fields(std::string_view text) {
    std::map<std::string, std::string, std::less<>> fields;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        if (const std::size_t equals = line.find('='); equals != std::string_view::npos)
            fields.emplace(trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return fields;
}

Result<TiffDescription> imagej_description(const TiffLayout& layout, const std::string& name) {
    const auto fields = imagej_fields(layout.description);
    std::optional<Error> wrong;
    const auto count = [&](std::string_view key) -> std::uint64_t {
        const auto found = fields.find(key);
        if (found == fields.end()) return 0;
        const auto number = to_whole(found->second);
        if (number && *number > 0) return static_cast<std::uint64_t>(*number);
        wrong = Error{"ImageJ's description says " + found->first + "=" + printable(found->second), name,
                      "open it in ImageJ and save it again"};
        return 0;
    };
    TiffDescription found;
    found.program = "ImageJ";
    const std::uint64_t images = count("images");
    found.parts.channels = std::max<std::uint64_t>(count("channels"), 1);
    found.parts.times = std::max<std::uint64_t>(count("frames"), 1);
    found.slices = count("slices");
    if (wrong) return tl::unexpected(*wrong);
    if (found.slices == 0) {
        const std::uint64_t all = std::max<std::uint64_t>({images, layout.pages.size(), 1});
        const std::uint64_t others = found.parts.channels <= all ? found.parts.channels * found.parts.times : all;
        found.slices = std::max<std::uint64_t>(all / std::max<std::uint64_t>(others, 1), 1);
    }
    if (images > 0 && images != found.planes())
        return fail("ImageJ's description says images=" + std::to_string(images) +
                        ", which is not channels x slices x "
                        "frames",
                    name, "open it in ImageJ and save it again");
    const auto number = [&](std::string_view key) -> std::optional<double> {
        const auto at = fields.find(key);
        const auto value = at == fields.end() ? std::nullopt : to_real(at->second);
        return value && can_be_spacing(std::abs(*value)) ? std::optional(std::abs(*value)) : std::nullopt;
    };
    const auto unit = fields.find("unit");
    if (unit != fields.end()) found.claims.unit_mm = microscopy_unit_mm(unit->second);
    const TiffPage& first = layout.pages.front();
    if (unit == fields.end() && first.resolution_unit > 1) {
        claim_resolution(first, found.claims);
    } else if (first.resolution && (unit != fields.end() || *first.resolution != std::array{1.0, 1.0})) {
        const double mm = found.claims.unit_mm.value_or(1.0);
        for (std::size_t axis = 0; axis < 2; ++axis)
            if (const double step = mm / (*first.resolution)[axis]; can_be_spacing(step))
                found.claims.spacing[axis] = step;
    }
    if (const auto step = number("spacing")) found.claims.spacing[2] = found.claims.unit_mm.value_or(1.0) * *step;
    return found;
}

// A name without its prefix: "Pixels" of "OME:Pixels".
std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}
pugi::xml_node child_called(const pugi::xml_node& node, std::string_view name) {
    for (const pugi::xml_node& child : node.children())
        if (local_name(child) == name) return child;
    return {};
}

class OmeReader {
public:
    explicit OmeReader(const std::string& name) : name_(name) {}

    Result<TiffDescription> read(const TiffLayout& layout) {
        XmlInput xml;
        if (auto parsed = xml.parse(layout.description, name_); !parsed)
            return fail("its OME description: " + parsed.error().what, name_, parsed.error().hint);
        const pugi::xml_node image = child_called(xml.root(), "Image"), pixels = child_called(image, "Pixels");
        if (!pixels) return refused("describes no image");
        found_.program = "OME";
        const auto size = [&](const char* key) -> std::uint64_t {
            const auto number = to_whole(pixels.attribute(key).value());
            return number && *number > 0 ? static_cast<std::uint64_t>(*number) : 0;
        };
        found_.parts.channels = size("SizeC");
        found_.parts.times = size("SizeT");
        found_.slices = size("SizeZ");
        const std::string order = pixels.attribute("DimensionOrder").value();
        if (found_.planes() == 0) return refused("has no SizeC, SizeZ and SizeT");
        if (found_.planes() == kMostPlanes) return refused("claims more planes than any file has");
        std::string letters = order.size() == 5 && order.starts_with("XY") ? order.substr(2) : "";
        std::ranges::sort(letters);
        if (letters != "CTZ") return refused("has an order of planes that is not known: " + shown(order));
        found_.order = order.substr(2);
        for (const pugi::xml_node& child : pixels.children()) {
            if (local_name(child) == "Channel")
                found_.parts.channel_names.emplace_back(child.attribute("Name").value());
            if (local_name(child) != "TiffData") continue;
            if (auto added = add_run(child, layout); !added) return tl::unexpected(added.error());
        }
        std::ranges::stable_sort(found_.runs, {}, &TiffDescription::Run::plane);
        claim_sizes(pixels);
        for (pugi::xml_node other = image.next_sibling(); other; other = other.next_sibling())
            if (local_name(other) == "Image") {
                found_.claims.notes.emplace_back("the file holds several images: the first was read");
                break;
            }
        return std::move(found_);
    }

private:
    [[nodiscard]] tl::unexpected<Error> refused(const std::string& why) const {
        return fail("its OME description " + why, name_, "write it again with the program that made it");
    }

    Result<void> add_run(const pugi::xml_node& data, const TiffLayout& layout) {
        const auto number = [&](const char* key, std::uint64_t otherwise) -> std::optional<std::uint64_t> {
            const pugi::xml_attribute attribute = data.attribute(key);
            if (!attribute) return otherwise;
            const auto value = to_whole(attribute.value());
            return value && *value >= 0 ? std::optional(static_cast<std::uint64_t>(*value)) : std::nullopt;
        };
        if (const pugi::xml_node file = child_called(data, "UUID"); file && file.attribute("FileName"))
            files_.insert(file.attribute("FileName").value());
        if (files_.size() > 1)
            return fail("its planes are in several files: " + printable(*files_.begin()) + ", " +
                            printable(*files_.rbegin()),
                        name_, "write them as one file, or as OME-Zarr");
        const auto c = number("FirstC", 0), z = number("FirstZ", 0), t = number("FirstT", 0);
        const auto page = number("IFD", 0);
        const bool there = c && z && t && page && *c < found_.parts.channels && *z < found_.slices &&
                           *t < found_.parts.times && *page < layout.pages.size();
        if (!there) return refused("lists a plane that is not in the file");
        TiffDescription::Run run{found_.plane_at(*c, *z, *t), *page, 0};
        const std::uint64_t most = std::min(found_.planes() - run.plane, layout.pages.size() - run.page);
        const auto count = number("PlaneCount", data.attribute("IFD") ? 1 : most);
        if (!count || *count > most) return refused("lists a plane that is not in the file");
        run.count = *count;
        found_.runs.push_back(run);
        return {};
    }

    void claim_sizes(const pugi::xml_node& pixels) {
        SpatialClaims& claims = found_.claims;
        constexpr std::array<std::array<const char*, 2>, 3> kSizes = {{{"PhysicalSizeX", "PhysicalSizeXUnit"},
                                                                       {"PhysicalSizeY", "PhysicalSizeYUnit"},
                                                                       {"PhysicalSizeZ", "PhysicalSizeZUnit"}}};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto size = to_real(pixels.attribute(kSizes[axis][0]).value());
            if (!size || !can_be_spacing(*size)) continue;
            const pugi::xml_attribute word = pixels.attribute(kSizes[axis][1]);
            const auto unit = microscopy_unit_mm(word ? word.value() : "um"); // the default of the schema
            claims.spacing[axis] = unit.value_or(1.0) * *size;
            if (!claims.unit_mm) claims.unit_mm = unit;
        }
    }

    const std::string& name_;
    TiffDescription found_;
    std::set<std::string> files_;
};

} // namespace

std::uint64_t TiffDescription::planes() const {
    std::uint64_t product = 1;
    for (const std::uint64_t count : {parts.channels, slices, parts.times}) {
        if (count > 0 && product > kMostPlanes / count) return kMostPlanes;
        product *= count;
    }
    return product;
}

std::uint64_t TiffDescription::plane_at(std::uint64_t channel, std::uint64_t slice, std::uint64_t time) const {
    std::uint64_t plane = 0;
    for (auto axis = order.rbegin(); axis != order.rend(); ++axis) {
        if (*axis == 'C') plane = plane * parts.channels + channel;
        if (*axis == 'Z') plane = plane * slices + slice;
        if (*axis == 'T') plane = plane * parts.times + time;
    }
    return plane;
}

Result<TiffDescription> tiff_description(const TiffLayout& layout, const std::string& name) {
    if (layout.description.starts_with("ImageJ=")) return imagej_description(layout, name);
    if (begins_with_element(layout.description, "OME") || begins_with_element(layout.description, "OME:OME"))
        return OmeReader(name).read(layout);
    TiffDescription plain;
    plain.slices = layout.pages.size();
    claim_resolution(layout.pages.front(), plain.claims);
    return plain;
}

} // namespace ramus::io
