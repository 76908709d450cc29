#include "app/session/reading_options.h"

#include "app/session/mask_reading.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/io/checksum.h"
#include "core/tree/suspicions.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>

namespace ramus::app {

namespace {

using tree::Note;
using tree::Repair;

constexpr std::array kTopics{std::pair{"data", "Data of the file"},
                             std::pair{"units", "Unit of length"},
                             std::pair{"axes", "Orientation"},
                             std::pair{"radius-is", "Radius or diameter"},
                             std::pair{"radius", "Radii of whole vessels"},
                             std::pair{"radii", "Absurd radii"},
                             std::pair{"joining", "Joints"},
                             std::pair{"zero-radii", "Radii of 0"},
                             std::pair{"unmeasured-radii", "Radii not measured"},
                             std::pair{"invented-radii", "Invented radii"},
                             std::pair{"repeated-points", "Repeated points"},
                             std::pair{"lonely-points", "Points on their own"},
                             std::pair{"repeated-trunks", "Repeated trunks"},
                             std::pair{"radius-jumps", "Jumps of the radius"},
                             std::pair{"orphans", "Missing parents"},
                             std::pair{"open-ends", "Ends within other vessels"},
                             std::pair{"loops", "Loops"},
                             std::pair{"pieces", "Pieces"},
                             std::pair{"systems", "Systems"},
                             std::pair{"mask", "Mask"},
                             std::pair{"labels", "Labels"},
                             std::pair{"threshold", "Threshold"},
                             std::pair{"fill-holes", "Holes"},
                             std::pair{"islands", "Islands"}};

} // namespace

std::string repair_names() { return joined(tree::kRepairNames, ",", &std::pair<Repair, const char*>::second); }

std::optional<Repair> repairs_in(const std::string& list) {
    if (list == "usual") return Repair::kUsual;
    if (list == "all") return Repair::kAll;
    if (list == "none") return Repair::kNone;
    Repair chosen = Repair::kNone;
    for (const std::string_view word : parts_of(list)) {
        const auto* const known =
            std::ranges::find_if(tree::kRepairNames, [&](const auto& entry) { return word == entry.second; });
        if (known == std::end(tree::kRepairNames)) return std::nullopt;
        chosen = chosen | known->first;
    }
    return chosen;
}

std::string spelled(Repair repair) {
    if (repair == Repair::kUsual) return "usual";
    if (repair == Repair::kAll) return "all";
    if (repair == Repair::kNone) return "none";
    std::string names;
    for (const auto& [one, name] : tree::kRepairNames)
        if (allows(repair, one)) names.append(names.empty() ? "" : ",").append(name);
    return names;
}

std::string spelled(const io::LengthUnit& unit) {
    if (std::string name = io::name_of(unit); io::length_unit(name) == unit) return name;
    const glm::dvec3& mm = unit.mm;
    return mm.x == mm.y && mm.y == mm.z ? exact_text(mm.x)
                                        : exact_text(mm.x) + "x" + exact_text(mm.y) + "x" + exact_text(mm.z);
}

std::string_view spelled(io::RadiusIs width) { return width == io::RadiusIs::kRadius ? "radius" : "diameter"; }

std::optional<io::RadiusIs> width_in(std::string_view text) {
    for (const io::RadiusIs width : {io::RadiusIs::kRadius, io::RadiusIs::kDiameter})
        if (text == spelled(width)) return width;
    return std::nullopt;
}

std::optional<int> part_number(std::string_view text) {
    const auto number = parsed<int>(text);
    return number && *number >= 1 ? number : std::nullopt;
}

Result<io::ReadOptions> with(io::ReadOptions options, std::string_view key, const std::string& value) {
    const bool reset = value == "auto";
    const auto refused = [&](const std::string& hint) { return fail("\"" + value + "\" is not known", {}, hint); };
    if (key == "units") {
        options.unit = io::length_unit(value);
        if (!options.unit && !reset) return refused("units takes mm, um, cm, m, a size of voxels in mm, or auto");
    } else if (key == "radius-is") {
        options.radius_is = width_in(value);
        if (!options.radius_is && !reset) return refused("radius-is takes radius, diameter or auto");
    } else if (key == "radius") {
        const auto mm = parsed<double>(value);
        if (!reset && !(mm && *mm >= kLeastRadius && *mm <= tree::kMaximumRadius))
            return refused("radius takes a number of mm above 0, or auto");
        options.radius_mm = reset ? std::nullopt : mm;
    } else if (key == "orientation" || key == "axes") {
        options.orientation = io::Orientation::named(value);
        if (!options.orientation && !reset)
            return refused("orientation takes the sides that x, y and z lead to, one of R and L, one of A and P, one "
                           "of S and I in any order, as RAS, LPS or PIR; or auto");
    } else if (key == "repair") {
        const auto repair = reset ? std::optional(Repair::kUsual) : repairs_in(value);
        if (!repair) return refused("repair takes usual, all, none, or some of " + repair_names());
        options.repair = *repair;
    } else if (key == "data") {
        options.data = options.data_checksum = {};
        if (reset) return options;
        const std::filesystem::path table = std::filesystem::absolute(value).lexically_normal();
        RAMUS_TRY(checksum, io::sha256_of(table));
        options.data = table.string();
        options.data_checksum = std::move(checksum);
    } else if (key == "channel" || key == "time") {
        const auto number = part_number(value);
        (key == "channel" ? options.part.channel : options.part.time) = number;
        if (!number && !reset) return refused(std::string(key) + " takes a whole number from 1, or auto");
    } else if (is_mask_option(key)) {
        RAMUS_TRY(mask, with(options.mask, key, value));
        options.mask = std::move(mask);
    } else {
        return fail(std::string(key) + " is no option of reading", {},
                    "units, radius-is, radius, orientation, repair, data; of masks channel, time, labels, isovalue, "
                    "fill-holes, bulge-size, "
                    "islands, root");
    }
    return options;
}

io::ReadOptions over(const io::ReadOptions& said, io::ReadOptions session) {
    if (said.repair != Repair::kUsual) session.repair = said.repair;
    if (said.unit) session.unit = said.unit;
    if (said.part.channel) session.part.channel = said.part.channel;
    if (said.part.time) session.part.time = said.part.time;
    if (said.radius_is) session.radius_is = said.radius_is;
    if (said.radius_mm) session.radius_mm = said.radius_mm;
    if (said.orientation) session.orientation = said.orientation;
    if (!said.data.empty()) session.data = said.data, session.data_checksum = said.data_checksum;
    for (const auto& [what, name] : said.columns) session.columns[what] = name;
    session.mask = over(said.mask, std::move(session.mask));
    return session;
}

std::string topic_label(std::string_view topic) {
    for (const auto& [name, label] : kTopics)
        if (topic == name) return label;
    return topic.empty() ? "Other" : std::string(topic);
}

bool could_mislead(const Note& note, const io::ReadOptions& options) {
    switch (note.kind) {
    case Note::Kind::kSuspect:
        return note.topic == "units" || note.topic == "axes" || note.topic == tree::kInventedRadii;
    case Note::Kind::kAssumed:
        return note.topic == "radius-is" && !options.radius_is;
    case Note::Kind::kRepaired:
        // Holes and islands of a mask are removed on request, cavities because there is no alternative.
        return note.topic != name_of(Repair::kRepeatedPoints) && note.topic != "fill-holes" && note.topic != "islands";
    }
    return false;
}

bool could_mislead(const tree::VesselTree& tree, const io::ReadOptions& options) {
    return std::ranges::any_of(tree.notes, [&](const Note& note) { return could_mislead(note, options); });
}

} // namespace ramus::app
