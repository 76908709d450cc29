// Commands of scans: opening them, and the window in which they are shown. objects.cpp shows, hides, names and removes
// them.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/scene_objects.h"
#include "app/picture/slices.h"
#include "app/session/numbers.h"
#include "app/session/reading_options.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/length_unit.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <filesystem>

namespace ramus::app::actions {

namespace {

constexpr const char* kScanUsage = "scan FILE [--labels|--grey] [--units UNIT] [--channel N] [--time N]";

struct AskedScan {
    Scan scan;
    std::optional<bool> labels; // none: decided by the values
};

Result<AskedScan> asked_scan(const Document& document, Arguments arguments) {
    AskedScan asked;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--labels" || word == "--grey") {
            asked.labels = word == "--labels";
        } else if (word == "--units" && i + 1 < arguments.size()) {
            asked.scan.units = arguments[++i];
            if (!io::length_unit(asked.scan.units))
                return fail("--units takes a unit of length: mm, um, cm or m", {}, kScanUsage);
        } else if ((word == "--channel" || word == "--time") && i + 1 < arguments.size()) {
            const auto number = part_number(arguments[++i]);
            if (!number) return fail(word + " takes a whole number from 1", {}, kScanUsage);
            (word == "--channel" ? asked.scan.part.channel : asked.scan.part.time) = number;
        } else if (word.starts_with("--") || word.empty() || !asked.scan.file.empty()) {
            return fail("scan takes a file and how it is read", {}, kScanUsage);
        } else {
            asked.scan.file = std::filesystem::absolute(word).lexically_normal().string();
        }
    }
    const std::string& file = asked.scan.file;
    if (auto possible = io::check_input(file); !possible && !std::filesystem::is_directory(file))
        return tl::unexpected(possible.error());
    if (!io::is_volume(file)) return fail("this is no scan", file, "scans are " + io::readable_volume_extensions());
    const auto same = [&](const Scan& other) { return source_of(other) == source_of(asked.scan); };
    if (std::ranges::any_of(document.marks().scans, same)) return fail("this scan is shown already", file);
    return asked;
}

// From where the three planes of a scan are seen.
void look_at_planes(ActionContext& context) {
    refresh(context.assets, context.document);
    const auto points = visible_points(context.document.marks(), context.assets);
    context.document.set_camera(camera_of_planes(points, context.picture.picture_size()));
    context.picture.camera_leapt();
}

// Requires the scan to be loaded.
Result<void> add_scan(ActionContext& context, const AskedScan& asked) {
    Scan scan = asked.scan;
    const auto file = context.assets.scan(scan);
    if (!file) return fail("the scan is not there any more", scan.file, "ask for it again");
    scan.checksum = file->checksum;
    scan.labels = asked.labels.value_or(holds_labels(*file->volume, file->labels));
    if (scan.labels && file->labels.size() > kMostShownLabels)
        return fail("it has " + std::to_string(file->labels.size()) + " labels, more than can be told by colour",
                    scan.file, "show it in grey: --grey");
    if (scan.labels) scan.opacity = 0.9;
    const bool first = context.document.marks().scans.empty();
    const bool alone = !has_scene(context.document);
    auto added = edit(context, [&](Marks& marks) { marks.scans.push_back(scan); });
    if (!added) return added;
    context.say(std::filesystem::path(scan.file).filename().string() + ": " +
                words_of_scan(*file, context.document.lengths()));
    SliceViews views = context.document.session().slices;
    // A person who opens a scan wants to see it; a script says which picture it wants.
    if (first && context.window != nullptr && views.layout == SliceLayout::kPicture)
        views.layout = SliceLayout::kSlices;
    // A scan alone has nothing else to show next to its slices.
    if (alone) views.in_picture = {true, true, true, false};
    context.document.set_slices(views);
    if (alone && context.window != nullptr) look_at_planes(context);
    return {};
}

Result<Outcome> scan(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kScan,
                                       fail("scan needs a FILE here", {}, io::readable_volume_extensions())));
    RAMUS_TRY(wanted, asked_scan(context.document, arguments));
    const std::uint64_t memory = context.document.marks().options.memory_bytes;
    return Pending{
        "Reading " + std::filesystem::path(wanted.scan.file).filename().string(),
        [asked = std::move(wanted), assets = context.assets, memory](Job& job) mutable -> Result<Continuation> {
            const ScanSource source = source_of(asked.scan);
            if (auto file = load_scan(assets, source, memory, job); !file) return tl::unexpected(file.error());
            return [asked, source, loaded = assets.scans.at(source)](ActionContext& then) {
                then.assets.put(source, loaded);
                return add_scan(then, asked);
            };
        }};
}

// The number of the scan that a window is for: the last argument, or the first visible scan in grey.
Result<std::size_t> scan_of_window(const Marks& marks, Arguments number) {
    if (!number.empty()) return list_index(number, marks.scans.size(), "scan");
    const Scan* found = marks.grey_scan();
    if (found == nullptr) return fail("there is no scan in grey", {}, "open one with `scan FILE`");
    return static_cast<std::size_t>(found - marks.scans.data());
}

Result<void> window(ActionContext& context, Arguments arguments) {
    const bool automatic = !arguments.empty() && arguments[0] == "auto";
    const auto wanted = arguments.empty() || automatic ? std::nullopt : window_in(arguments[0]);
    if (arguments.empty() || arguments.size() > 2 || (!automatic && !wanted))
        return fail("window takes WIDTH,LEVEL or a name", {},
                    "the names are auto, " + joined(slice::kWindowPresets, ", ", &slice::WindowPreset::name));
    RAMUS_TRY(index, scan_of_window(context.document.marks(), arguments.subspan(1)));
    return edit(context, [&, index = index](Marks& marks) { marks.scans[index].window = wanted; });
}

Result<void> scan_as(ActionContext& context, Arguments arguments) {
    if (arguments.size() != 2 || (arguments[1] != "labels" && arguments[1] != "grey"))
        return fail("scan-as takes the number of a scan, and labels or grey");
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().scans.size(), "scan"));
    return edit(context, [&, index = index](Marks& marks) { marks.scans[index].labels = arguments[1] == "labels"; });
}

bool has_scans(const Document& document) { return !document.marks().scans.empty(); }

} // namespace

std::vector<Command> scan_commands() {
    std::vector<Command> commands{
        Command("scan", "FILE [--labels|--grey] [--units UNIT] [--channel N] [--time N]",
                "Shows slices of a scan, or the labels of a segmentation on them.", scan)
            .in_menu("File", "Scan..."),
        Command("scan-as", "N labels|grey", "Shows scan N as a segmentation or in grey.", scan_as).when(has_scans),
        Command("window", "WIDTH,LEVEL|NAME [N]",
                "Sets the values of scan N (the first in grey) from black to white: by width and level, or by name.",
                window)
            .when(has_scans)};
    const auto add_entry = [&](const std::string& name, const std::string& label) {
        commands.push_back(Command("window", "WIDTH,LEVEL|NAME [N]", "Window and level of the scan.", window)
                               .in_menu("Slices", label)
                               .in_submenu("Window")
                               .giving({name})
                               .when(has_scans));
    };
    add_entry("auto", "Automatic");
    for (const slice::WindowPreset& preset : slice::kWindowPresets)
        add_entry(std::string(preset.name), "CT " + std::string(preset.name));
    return commands;
}

} // namespace ramus::app::actions
