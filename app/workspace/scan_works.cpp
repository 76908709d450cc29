#include "app/workspace/scan_works.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace ramus::app {

namespace {

struct ScanWork {
    ScanSource source;
    std::uint64_t memory_bytes;
    bool operator==(const ScanWork& other) const { return source == other.source; }
};

struct RegionWork {
    RegionOf of;
    std::shared_ptr<const ScanFile> scan;
    bool operator==(const RegionWork&) const = default;
};

struct SectionWork {
    FollowedPath followed;
    std::shared_ptr<const render::PagedMesh> mesh;
    bool operator==(const SectionWork& other) const {
        return followed.path == other.followed.path && mesh == other.mesh;
    }
};

} // namespace

std::unique_ptr<BackgroundWork> scan_work(const std::function<void()>& wake) {
    using File = Loaded<ScanFile>;
    return work_of<ScanWork, File>(
        wake,
        {.kind = WorkKind::kScans,
         .title =
             [](const ScanWork& work) {
                 return "Reading " + std::filesystem::path(work.source.file).filename().string();
             },
         .missing =
             [](const WorkView& view, const Assets& assets) {
                 const Marks& marks = view.document.marks();
                 std::vector<ScanWork> missing;
                 for (const Scan& scan : marks.scans)
                     if (scan.visible && !assets.scans.contains(source_of(scan)))
                         missing.push_back({source_of(scan), marks.options.memory_bytes});
                 return missing;
             },
         .make = [](const ScanWork& work, Job& job) -> Result<File> {
             return read_scan(work.source, nullptr, work.memory_bytes, job);
         },
         .put = [](const ScanWork& work, const File& file, Assets& assets) { assets.put(work.source, file); },
         .refused =
             [](const ScanWork& work, const std::string& problem, Assets& assets) {
                 assets.put(work.source, {{}, fail(problem, work.source.file)});
             },
         .trouble = [](const File& file) { return file.value ? std::nullopt : std::optional(file.value.error()); },
         // A scan takes up to gigabytes, and undo reads it again.
         .tidy =
             [](const WorkView& view, Assets& assets) {
                 std::erase_if(assets.scans, [&](const auto& known) {
                     return std::ranges::none_of(view.document.marks().scans,
                                                 [&](const Scan& scan) { return source_of(scan) == known.first; });
                 });
             },
         .finishes = true});
}

// Starts again whenever the region changes; until then slices show the previous one.
std::unique_ptr<BackgroundWork> region_work(const std::function<void()>& wake) {
    return work_of<RegionWork, GrownMask>(
        wake, {.kind = WorkKind::kRegion,
               .title = titled<RegionWork>("Growing a region"),
               .missing = [](const WorkView&, const Assets& assets) -> std::vector<RegionWork> {
                   const ScanRegion& region = assets.region;
                   const auto known = assets.scans.find(region.now().scan);
                   if (!region.exists() || region.is_current() || known == assets.scans.end() || !known->second.value)
                       return {};
                   return {{region.now(), *known->second.value}};
               },
               .make = [](const RegionWork& work, Job& job) -> Result<GrownMask> {
                   return grown_mask(work.of, *work.scan->volume, JobRange(job, 0.0F, 1.0F));
               },
               .put = [](const RegionWork&, const GrownMask& made, Assets& assets) { assets.region.grown = made; },
               .refused =
                   [](const RegionWork& work, const std::string& problem, Assets& assets) {
                       assets.region.grown = {work.of, {}, {}, problem};
                   },
               .tidy =
                   [](const WorkView& view, Assets& assets) {
                       const auto is_its_scan = [&](const Scan& one) {
                           return source_of(one) == assets.region.now().scan;
                       };
                       if (assets.region.exists() && std::ranges::none_of(view.document.marks().scans, is_its_scan))
                           assets.region.forget();
                   }});
}

// Across the vessel that slices follow, once the surface is not provisional.
std::unique_ptr<BackgroundWork> section_work(const std::function<void()>& wake) {
    using Made = std::shared_ptr<const VesselSections>;
    return work_of<SectionWork, Made>(
        wake, {.kind = WorkKind::kSections,
               .title = titled<SectionWork>("Measuring sections"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<SectionWork> {
                   if (!view.of_this_tree || !assets.followed.path || !view.shown.mesh || view.surface_failed)
                       return {};
                   if (assets.sections && assets.sections->fits(assets.followed, view.shown.mesh)) return {};
                   return {{assets.followed, view.shown.mesh}};
               },
               .make = [](const SectionWork& work, Job& job) { return make_sections(work.followed, work.mesh, job); },
               .put = [](const SectionWork&, const Made& made, Assets& assets) { assets.sections = made; },
               .tidy =
                   [](const WorkView&, Assets& assets) {
                       if (!assets.followed.path) assets.sections.reset();
                   },
               .waits = [](const WorkView& view) { return view.surface_busy || !view.surface_final; }});
}

} // namespace ramus::app
