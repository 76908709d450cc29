// Commands of the region of a scan that a person grows (app/assets/region.h). It belongs to the assets, with its own
// steps of undo, since it is no part of the session until it is saved as a mask.
#include "app/assets/region.h"

#include "app/actions/arguments.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/session/numbers.h"
#include "app/tools/tool.h"
#include "core/io/volumes/label_map_file.h"

#include <filesystem>
#include <functional>
#include <limits>
#include <utility>

namespace ramus::app::actions {

namespace {

constexpr double kMostValue = 1e12;
constexpr double kMostCutRadius = 1e4; // mm

using ScanRead = std::shared_ptr<const ScanFile>;

// Runs `then(context, scan, file)`, after the scan is read if it is not.
using WithScan = std::function<Result<void>(ActionContext&, const Scan&, const ScanRead&)>;
Result<Outcome> with_scan(ActionContext& context, const WithScan& then) {
    RAMUS_TRY(scan, scan_to_grow_in(context.document.marks()));
    if (const auto file = context.assets.scan(scan)) return outcome_of(then(context, scan, file));
    const std::uint64_t memory = context.document.marks().options.memory_bytes;
    return Pending{"Reading " + std::filesystem::path(scan.file).filename().string(),
                   [scan = scan, then, assets = context.assets, memory](Job& job) mutable -> Result<Continuation> {
                       const ScanSource source = source_of(scan);
                       RAMUS_TRY(file, load_scan(assets, source, memory, job));
                       return [scan, then, source, file, loaded = assets.scans.at(source)](ActionContext& later) {
                           later.assets.put(source, loaded);
                           return then(later, scan, file);
                       };
                   }};
}

std::optional<glm::dvec3> region_place(const std::string& word) {
    const auto numbers = numbers_in(word, 3, kFarthestMm);
    return numbers ? std::optional(glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

// The region of the scan that is shown; fails if there is none.
Result<RegionOf> region_here(const ActionContext& context) {
    if (context.assets.region.exists()) return context.assets.region.now();
    return fail("there is no region yet", {}, "begin one in a vessel: `region X,Y,Z`, or the tool *Grow region*");
}

Result<Outcome> seed_at(ActionContext& context, const glm::dvec3& place, bool adds) {
    return with_scan(context, [=](ActionContext& then, const Scan& scan, const ScanRead& file) -> Result<void> {
        RAMUS_TRY(voxel, voxel_at(*file->volume, place));
        const RegionOf& now = then.assets.region.now();
        RegionOf region;
        region.scan = source_of(scan);
        if (adds && then.assets.region.exists() && now.scan == region.scan) region = now;
        RAMUS_TRY(next, with_seed(std::move(region), *file->volume, voxel));
        then.assets.region.change(std::move(next));
        return {};
    });
}

Result<Outcome> region(ActionContext& context, Arguments arguments) {
    const auto place = arguments.size() == 1 ? region_place(arguments[0]) : std::nullopt;
    if (!place) return fail("region takes a place in a vessel: X,Y,Z in mm", {}, "region 12,-40,310, say");
    return seed_at(context, *place, false);
}

Result<Outcome> region_add(ActionContext& context, Arguments arguments) {
    const auto place = arguments.size() == 1 ? region_place(arguments[0]) : std::nullopt;
    if (!place) return fail("region-add takes a place in a vessel: X,Y,Z in mm", {}, "region-add 12,-40,310, say");
    return seed_at(context, *place, true);
}

Result<Outcome> region_range(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(now, region_here(context));
    const bool automatic = arguments.size() == 1 && arguments[0] == "auto";
    const auto range = arguments.size() == 1 ? numbers_in(arguments[0], 2, kMostValue) : std::nullopt;
    if (!automatic && (!range || range->front() > range->back()))
        return fail("region-range takes two values, the lower one first, or auto", {}, "region-range 150,400, say");
    if (range) {
        now.low = range->front();
        now.high = range->back();
        now.suggested = false;
        context.assets.region.change(std::move(now));
        return Done{};
    }
    return with_scan(context, [now = now](ActionContext& then, const Scan&, const ScanRead& file) -> Result<void> {
        RegionOf next = now;
        next.seeds.clear();
        next.suggested = true;
        for (const glm::ivec3& seed : now.seeds) {
            RAMUS_TRY(more, with_seed(std::move(next), *file->volume, seed));
            next = std::move(more);
        }
        then.assets.region.change(std::move(next));
        return {};
    });
}

Result<Outcome> region_grow(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(now, region_here(context));
    const bool more = arguments.size() == 1 && arguments[0] == "more";
    if (!more && (arguments.size() != 1 || arguments[0] != "less")) return fail("region-grow takes more or less");
    return with_scan(context,
                     [now = now, more](ActionContext& then, const Scan&, const ScanRead& file) -> Result<void> {
                         then.assets.region.change(more ? widened(now, *file->volume) : narrowed(now, *file->volume));
                         return {};
                     });
}

Result<void> region_cut(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(now, region_here(context));
    const auto place = arguments.empty() ? std::nullopt : region_place(arguments[0]);
    const bool is_disc = arguments.size() == 3;
    const auto normal = is_disc ? region_place(arguments[1]) : std::nullopt;
    const auto radius =
        arguments.size() < 2 || arguments.size() > 3 ? std::nullopt : number_in(arguments.back(), 0.0, kMostCutRadius);
    if (!place || !radius || !(*radius > 0.0) || (is_disc && (!normal || *normal == glm::dvec3(0.0))))
        return fail("region-cut takes a place and a radius in mm, and for a disc the direction across it", {},
                    "region-cut 12,-40,310 3 or region-cut 12,-40,310 0,0,1 8, say");
    now.cuts.push_back({*place, normal, *radius});
    context.assets.region.change(std::move(now));
    return {};
}

Result<void> region_undo(ActionContext& context, Arguments) {
    if (!context.assets.region.can_undo()) return fail("there is no step of a region to take back");
    context.assets.region.undo();
    return {};
}

Result<void> region_off(ActionContext& context, Arguments) {
    context.assets.region.change({});
    return {};
}

Result<void> region_radius(ActionContext& context, Arguments arguments) {
    const auto radius = arguments.size() == 1 ? number_in(arguments[0], 0.0, kMostCutRadius) : std::nullopt;
    if (!radius || !(*radius > 0.0)) return fail("region-radius takes a radius in mm", {}, "region-radius 3, say");
    if (context.tools == nullptr) return fail("there is no tool without a window", {}, "region-cut X,Y,Z R");
    context.tools->tool_settings().cut_radius_mm = *radius;
    return {};
}

// Writes the region, and runs `then(context, file)`. It is grown again without the limit of the preview.
using AfterSaving = std::function<Result<void>(ActionContext&, const std::filesystem::path&)>;
Result<Outcome> save_region(ActionContext& context, const std::filesystem::path& named, const AfterSaving& then) {
    RAMUS_TRY(now, region_here(context));
    const std::filesystem::path file = std::filesystem::absolute(named).lexically_normal();
    if (auto possible = io::check_label_map_output(file); !possible) return tl::unexpected(possible.error());
    return Pending{"Saving " + file.filename().string(),
                   [now = now, assets = context.assets, memory = context.document.marks().options.memory_bytes, file,
                    then](Job& job) mutable -> Result<Continuation> {
                       RAMUS_TRY(scan, load_scan(assets, now.scan, memory, job));
                       const GrownMask& grown = assets.region.grown;
                       const bool is_known = grown.of == now && grown.region && !grown.region->stopped_at_limit;
                       std::shared_ptr<const volume::GrownRegion> region = grown.region;
                       if (!is_known) {
                           constexpr auto kAll = std::numeric_limits<std::uint64_t>::max();
                           RAMUS_TRY(all, grown_region(now, *scan->volume, kAll, JobRange(job, 0.0F, 0.5F)));
                           region = std::make_shared<const volume::GrownRegion>(std::move(all));
                       }
                       const JobRange rest(job, is_known ? 0.0F : 0.5F, 1.0F);
                       if (auto written = write_region(*region, *scan->volume, scan->claims, file, rest); !written)
                           return tl::unexpected(written.error());
                       return [file, then, words = words_of_region(*region, *scan)](ActionContext& later) {
                           const std::string sentence =
                               "Region saved: " + file.string() + ", " + words + "; " + kRegionIsNoSegmentation;
                           if (auto said = has_written(file, sentence)(later); !said) return said;
                           return then(later, file);
                       };
                   },
                   true};
}

Result<std::filesystem::path> region_file(Arguments arguments, std::string_view command) {
    if (arguments.size() == 1 && !arguments[0].empty()) return std::filesystem::path(arguments[0]);
    return fail(std::string(command) + " takes one file", {}, io::label_map_extensions());
}

Result<Outcome> region_save(ActionContext& context, Arguments arguments) {
    if (auto there = region_here(context); !there) return tl::unexpected(there.error());
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kRegion,
                                       fail("region-save needs a FILE here", {}, io::label_map_extensions())));
    RAMUS_TRY(file, region_file(arguments, "region-save"));
    return save_region(context, file, [](ActionContext&, const std::filesystem::path&) -> Result<void> { return {}; });
}

Result<Outcome> region_tree(ActionContext& context, Arguments arguments) {
    if (auto there = region_here(context); !there) return tl::unexpected(there.error());
    if (context.files == nullptr)
        return fail("a tree cannot be opened from here", {}, "region-save FILE, then `ramus skeletonize FILE`");
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kRegionTree,
                                       fail("region-tree needs a FILE here", {}, io::label_map_extensions())));
    RAMUS_TRY(file, region_file(arguments, "region-tree"));
    return save_region(context, file, [](ActionContext& later, const std::filesystem::path& saved) -> Result<void> {
        if (later.files == nullptr) return fail("a tree cannot be opened from here");
        return later.files->open_as_tree(saved, {});
    });
}

bool shows_grey_scan(const Document& document) { return scan_to_grow_in(document.marks()).has_value(); }

Command region_entry(const char* label, const char* name, const char* arguments, const char* help,
                     const CommandAction& action, std::vector<std::string> words) {
    return Command(name, arguments, help, action)
        .in_menu("Slices", label)
        .in_submenu("Region")
        .giving(std::move(words));
}

} // namespace

std::vector<Command> region_commands() {
    std::vector<Command> commands{
        Command("region", "X,Y,Z",
                "Grows a region of similar values from a place in a vessel of the scan: a help to get a mask, not a "
                "segmentation.",
                region),
        Command("region-add", "X,Y,Z", "Grows the region from another place, too.", region_add),
        Command("region-range", "LOW,HIGH|auto",
                "Sets the values that belong to the region; auto: as the places in it suggest.", region_range),
        Command("region-grow", "more|less", "Widens or narrows the range of values of the region.", region_grow),
        region_entry("Grow more", "region-grow", "more|less", "Widens the range of values by a tenth on either side.",
                     region_grow, {"more"}),
        region_entry("Grow less", "region-grow", "more|less", "Narrows the range of values again.", region_grow,
                     {"less"}),
        Command("region-cut", "X,Y,Z [NX,NY,NZ] R",
                "Stops the region at a ball of radius R in mm, or at a disc across the direction N.", region_cut),
        Command("region-radius", "MM", "Sets the radius of the balls that a click cuts the region with.",
                region_radius),
        Command("region-undo", "", "Takes back the last step of the region: a place, a range, or a cut.", region_undo)
            .in_menu("Slices", "Take the last step back")
            .in_submenu("Region"),
        Command("region-save", "[FILE]", "Writes the region as a mask on the grid of the scan.", region_save)
            .in_menu("Slices", "Save as a mask...")
            .in_submenu("Region"),
        Command("region-tree", "[FILE]", "Writes the region as a mask, and opens it as a vessel tree.", region_tree)
            .in_menu("Slices", "Make a tree...")
            .in_submenu("Region"),
        Command("region-off", "", "Removes the region; region-undo brings it back.", region_off)
            .in_menu("Slices", "Remove")
            .in_submenu("Region"),
    };
    for (Command& command : commands) command = std::move(command).when(shows_grey_scan);
    return commands;
}

} // namespace ramus::app::actions
