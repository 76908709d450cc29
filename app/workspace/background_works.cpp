#include "app/workspace/background_works.h"

#include "app/assets/territories.h"
#include "app/workspace/deviation_maker.h"
#include "app/workspace/validation_maker.h"

#include <filesystem>
#include <utility>

namespace ramus::app {

namespace {

using Tree = std::shared_ptr<const tree::VesselTree>;

template <class Wanted> std::function<std::string(const Wanted&)> titled(std::string title) {
    return [title = std::move(title)](const Wanted&) { return title; };
}

template <class Wanted, class Made>
std::unique_ptr<BackgroundWork> work_of(const std::function<void()>& wake, WorkRow<Wanted, Made> row) {
    return std::make_unique<WorkOf<Wanted, Made>>(wake, std::move(row));
}

bool after_surface(const WorkView& view) { return view.surface_busy; }

// Reads meshes of lesions and measures the distances to them, on a copy of the assets. Cannot be cancelled.
struct LesionWork {
    PlannedMarks of;
    Marks marks;
    Assets assets;
    bool operator==(const LesionWork& other) const {
        return of == other.of && assets.tree == other.assets.tree && marks.lesions == other.marks.lesions;
    }
};

std::unique_ptr<BackgroundWork> lesion_work(const std::function<void()>& wake) {
    return work_of<LesionWork, Assets>(
        wake, {.kind = WorkKind::kLesions,
               .title = titled<LesionWork>("Measuring distances"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<LesionWork> {
                   const Marks& marks = view.document.marks();
                   if (!lesions_awaited(assets, marks, GridIs::kMadeAhead)) return {};
                   return {{planned(marks), marks, assets}};
               },
               .make = [](const LesionWork& work, Job&) -> Result<Assets> {
                   Assets copy = work.assets;
                   complete_lesions(copy, work.marks, GridIs::kMadeAhead);
                   return copy;
               },
               .put = [](const LesionWork&, const Assets& copy, Assets& assets) { merge(assets, copy); },
               .finishes = true});
}

std::unique_ptr<BackgroundWork> context_work(const std::function<void()>& wake) {
    using Shape = Loaded<ContextShape>;
    return work_of<ContextSource, Shape>(
        wake,
        {.kind = WorkKind::kContext,
         .title =
             [](const ContextSource& source) {
                 return "Reading " + std::filesystem::path(source.file).filename().string();
             },
         .missing =
             [](const WorkView& view, const Assets& assets) {
                 std::vector<ContextSource> missing;
                 for (const ContextItem& item : view.document.marks().context)
                     if (item.visible && !assets.context_shapes.contains(source_of(item)))
                         missing.push_back(source_of(item));
                 return missing;
             },
         .make = [](const ContextSource& source, Job& job) -> Result<Shape> {
             return read_context_shape(source, nullptr, job);
         },
         .put = [](const ContextSource& source, const Shape& shape, Assets& assets) { assets.put(source, shape); },
         .refused =
             [](const ContextSource& source, const std::string& problem, Assets& assets) {
                 assets.put(source, {{}, fail(problem, source.file)});
             },
         .trouble = [](const Shape& shape) { return shape.value ? std::nullopt : std::optional(shape.value.error()); },
         .finishes = true});
}

struct ScanWork {
    ScanSource source;
    std::uint64_t memory_bytes;
    bool operator==(const ScanWork& other) const { return source == other.source; }
};

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

struct RegionWork {
    RegionOf of;
    std::shared_ptr<const ScanFile> scan;
    bool operator==(const RegionWork&) const = default;
};

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

std::unique_ptr<BackgroundWork> organ_work(const std::function<void()>& wake) {
    using Mask = Loaded<OrganMask>;
    const auto put = [](const OrganSource& source, const Mask& mask, Assets& assets) { assets.organ = {source, mask}; };
    return work_of<OrganSource, Mask>(
        wake,
        {.kind = WorkKind::kOrgan,
         .title = titled<OrganSource>("Reading the organ"),
         .missing = [](const WorkView& view, const Assets& assets) -> std::vector<OrganSource> {
             const auto source = wanted_organ(view.document.marks());
             if (!source || assets.organ.source == *source) return {};
             return {*source};
         },
         .make = [](const OrganSource& source, Job& job) -> Result<Mask> { return read_organ(source, nullptr, job); },
         .put = put,
         .refused =
             [put](const OrganSource& source, const std::string& problem, Assets& assets) {
                 put(source, {{}, fail(problem, source.file)}, assets);
             },
         .trouble = [](const Mask& mask) { return mask.value ? std::nullopt : std::optional(mask.value.error()); },
         .tidy =
             [](const WorkView& view, Assets& assets) {
                 if (!view.document.marks().organ.any()) assets.organ = {};
             },
         .finishes = true});
}

std::unique_ptr<BackgroundWork> supply_work(const std::function<void()>& wake) {
    using Of = OrganSupply::Of;
    return work_of<Of, std::shared_ptr<const OrganSupply>>(
        wake, {.kind = WorkKind::kSupply,
               .title = titled<Of>("Dividing the organ"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<Of> {
                   const auto of = wanted_supply(assets.organ, view.document.marks(), view.document.tree());
                   if (!of || (assets.organ.supply && assets.organ.supply->of == *of)) return {};
                   return {*of};
               },
               .make = [](const Of& of, Job& job) -> Result<std::shared_ptr<const OrganSupply>> {
                   RAMUS_TRY(supply, supply_of(of, JobRange(job, 0.0F, 1.0F)));
                   return std::make_shared<const OrganSupply>(std::move(supply));
               },
               .put = [](const Of&, const auto& supply, Assets& assets) { assets.organ.supply = supply; }});
}

std::unique_ptr<BackgroundWork> resection_mesh_work(const std::function<void()>& wake) {
    const auto put = [](const ResectionMeshOf& of, const ResectionMesh& read, Assets& assets) {
        assets.organ.meshes.insert_or_assign(of.file, read);
    };
    return work_of<ResectionMeshOf, ResectionMesh>(
        wake, {.kind = WorkKind::kResectionMeshes,
               .title = titled<ResectionMeshOf>("Reading a resection"),
               .missing = [](const WorkView& view,
                             const Assets& assets) { return wanted_meshes(assets.organ, view.document.marks()); },
               .make = [](const ResectionMeshOf& of, Job& job) -> Result<ResectionMesh> {
                   return read_resection_mesh(of, JobRange(job, 0.0F, 1.0F));
               },
               .put = put,
               .refused =
                   [put](const ResectionMeshOf& of, const std::string& problem, Assets& assets) {
                       put(of, {of.mask, fail(problem, of.file)}, assets);
                   },
               .trouble =
                   [](const ResectionMesh& read) {
                       return read.surface ? std::nullopt : std::optional(read.surface.error());
                   }});
}

std::unique_ptr<BackgroundWork> operation_work(const std::function<void()>& wake) {
    using Made = std::shared_ptr<const Operation>;
    return work_of<OperationWork, Made>(
        wake, {.kind = WorkKind::kOperation,
               .title = titled<OperationWork>("Measuring what remains"),
               .missing = [](const WorkView& view,
                             const Assets& assets) { return wanted_operations(assets, view.document.marks()); },
               .make = [](const OperationWork& work, Job& job) -> Result<Made> {
                   RAMUS_TRY(operation, make_operation(work, JobRange(job, 0.0F, 1.0F)));
                   return std::make_shared<const Operation>(std::move(operation));
               },
               .put = [](const OperationWork& work, const Made& made,
                         Assets& assets) { put_operation(assets, work.plan, made); },
               .tidy = [](const WorkView& view, Assets& assets) { tidy_operations(assets, view.document.marks()); },
               .finishes = true,
               .quiet = true});
}

std::unique_ptr<BackgroundWork> territory_work(const std::function<void()>& wake) {
    using Made = std::shared_ptr<const OrganTerritories>;
    return work_of<TerritoryWork, Made>(
        wake,
        {.kind = WorkKind::kTerritories,
         .title = titled<TerritoryWork>("Finding territories"),
         .missing = [](const WorkView& view,
                       const Assets& assets) { return wanted_territories(assets, view.document.marks()); },
         .make = [](const TerritoryWork& work, Job& job) -> Result<Made> {
             RAMUS_TRY(territories, make_territories(work.of, JobRange(job, 0.0F, 1.0F)));
             return std::make_shared<const OrganTerritories>(std::move(territories));
         },
         .put = [](const TerritoryWork& work, const Made& made,
                   Assets& assets) { put_territories(assets.organ, work, made); },
         .refused = [](const TerritoryWork& work, const std::string&,
                       Assets& assets) { put_territories(assets.organ, work, nullptr); },
         .tidy = [](const WorkView& view, Assets& assets) { tidy_territories(assets.organ, view.document.marks()); },
         .waits = after_surface});
}

struct ComparisonWork {
    Tree tree;
    ComparedRequest request;
    bool operator==(const ComparisonWork&) const = default;
};

std::unique_ptr<BackgroundWork> comparison_work(const std::function<void()>& wake,
                                                std::vector<ComparedSurface>& compared) {
    return work_of<ComparisonWork, ComparedSurface>(
        wake,
        {.kind = WorkKind::kComparison,
         .title =
             [](const ComparisonWork& work) { return "Computing the " + std::string(row_of(work.request.kind).noun); },
         .missing =
             [&compared](const WorkView& view, const Assets&) {
                 std::vector<ComparisonWork> missing;
                 if (!view.document.tree()) return missing;
                 for (ComparedRequest& request : compared_requests(view.document.marks()))
                     if (std::ranges::find(compared, request, &ComparedSurface::request) == compared.end())
                         missing.push_back({view.document.tree(), std::move(request)});
                 return missing;
             },
         .make = [](const ComparisonWork& work, Job& job) { return make_compared(*work.tree, work.request, job); },
         .put =
             [&compared](const ComparisonWork& work, const ComparedSurface& made, Assets&) {
                 std::erase_if(compared, [&](const auto& one) { return one.request.same_place(work.request); });
                 compared.push_back(made);
             },
         .tidy =
             [&compared](const WorkView& view, Assets&) {
                 if (compared_surfaces(view.document.marks().comparison).empty()) compared.clear();
             },
         .waits = after_surface});
}

// For the shown surface, once it is not provisional.
std::vector<DeviationWork> missing_deviation(const WorkView& view, const Assets& assets) {
    const Marks& marks = view.document.marks();
    if (!view.of_this_tree || marks.colour_by != ColourBy::kDeviation || !view.shown.mesh || view.surface_failed)
        return {};
    const mesh::SurfaceOptions& options = view.request.options;
    DeviationOf of = deviation_of(view.document.tree(), marks, options);
    const SurfaceDeviation& have = assets.deviation;
    if (have.of == of && !have.trouble.empty()) return {};
    if (have.fits(of, view.shown.mesh) && (have.preview == view.shown.preview || !view.shown.preview)) return {};
    return {{std::move(of), options.threads, options.memory_bytes, view.shown.mesh, view.shown.preview}};
}

std::unique_ptr<BackgroundWork> deviation_work(const std::function<void()>& wake) {
    return work_of<DeviationWork, SurfaceDeviation>(
        wake,
        {.kind = WorkKind::kDeviation,
         .title = titled<DeviationWork>("Measuring the deviation"),
         .missing = missing_deviation,
         .make =
             [](const DeviationWork& work, Job& job) {
                 return make_deviation(work.of, work.threads, work.memory_bytes, work.mesh, work.preview, job);
             },
         .put = [](const DeviationWork&, const SurfaceDeviation& made, Assets& assets) { assets.deviation = made; },
         .refused =
             [](const DeviationWork& work, const std::string& problem, Assets& assets) {
                 assets.deviation = {};
                 assets.deviation.of = work.of;
                 assets.deviation.trouble = problem;
             },
         .tidy =
             [](const WorkView& view, Assets& assets) {
                 if (view.document.marks().colour_by != ColourBy::kDeviation) assets.deviation = {};
             },
         .waits = [](const WorkView& view) { return view.surface_busy || !view.surface_final; }});
}

// After the shown surface is complete; makes the surface again with all branches.
std::unique_ptr<BackgroundWork> validation_work(const std::function<void()>& wake) {
    return work_of<ValidationOf, TreeValidation>(
        wake, {.kind = WorkKind::kValidation,
               .title = titled<ValidationOf>("Validating the surface"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<ValidationOf> {
                   if (!view.validation_wanted || !view.of_this_tree || view.tried) return {};
                   ValidationOf of = validation_of(view.document.tree(), view.document.marks());
                   if (assets.validation.fits(of)) return {};
                   return {std::move(of)};
               },
               .make = make_validation,
               .put = [](const ValidationOf&, const TreeValidation& made, Assets& assets) { assets.validation = made; },
               .waits = after_surface});
}

struct ContactWork {
    Tree tree;
    mesh::SurfaceOptions options;
    bool operator==(const ContactWork&) const = default;
};

bool contacts_are_wanted(const WorkView& view) { return view.contacts_wanted || view.document.marks().contact_marks; }

// When nothing else is to do, and at once if wanted; for large trees only if wanted.
std::unique_ptr<BackgroundWork> contact_work(const std::function<void()>& wake) {
    constexpr std::size_t kMostUnasked = 1'000'000; // points of the tree
    return work_of<ContactWork, TreeContacts>(
        wake, {.kind = WorkKind::kContacts,
               .title = titled<ContactWork>("Looking for contacts"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<ContactWork> {
                   const mesh::SurfaceOptions& options = view.request.options;
                   if (!view.of_this_tree || assets.contacts.fits(options)) return {};
                   if (!contacts_are_wanted(view) && view.document.tree()->points.size() > kMostUnasked) return {};
                   return {{view.document.tree(), options}};
               },
               .make = [](const ContactWork& work, Job&) -> Result<TreeContacts> {
                   return contacts_of(*work.tree, work.options);
               },
               .put =
                   [](const ContactWork& work, const TreeContacts& found, Assets& assets) {
                       if (assets.tree == work.tree) assets.contacts = found;
                   },
               .waits = [](const WorkView& view) { return view.surface_busy && !contacts_are_wanted(view); },
               .finishes = true,
               .quiet = true});
}

struct CenterlineWork {
    Tree tree;
    mesh::SurfaceOptions options;
    bool operator==(const CenterlineWork& other) const {
        return tree == other.tree && options.smooth_passes == other.options.smooth_passes &&
               options.prune_ratio == other.options.prune_ratio;
    }
};

// For large trees. Until they are ready, pictures use the previous ones, as for the surface.
std::unique_ptr<BackgroundWork> centerline_work(const std::function<void()>& wake) {
    return work_of<CenterlineWork, SurfaceCenterlines>(
        wake, {.kind = WorkKind::kCenterlines,
               .title = titled<CenterlineWork>("Making centerlines"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<CenterlineWork> {
                   if (!centerlines_awaited(assets, view.request.options)) return {};
                   return {{assets.tree, view.request.options}};
               },
               .make = [](const CenterlineWork& work, Job&) -> Result<SurfaceCenterlines> {
                   return centerlines_of(*work.tree, work.options);
               },
               .put =
                   [](const CenterlineWork& work, const SurfaceCenterlines& made, Assets& assets) {
                       if (assets.tree == work.tree) assets.centerlines = made;
                   },
               .quiet = true});
}

struct ConesWork {
    std::shared_ptr<const render::Centerlines> lines;
    DrawnWidth width;
    bool operator==(const ConesWork&) const = default;
};

// Cones for the caster (render/caster/fitted_cones.h). Until they are ready, pictures use the previous ones if they
// belong to the same centerlines.
std::unique_ptr<BackgroundWork> cones_work(const std::function<void()>& wake) {
    using Cones = std::shared_ptr<const render::caster::FittedCones>;
    return work_of<ConesWork, Cones>(
        wake, {.kind = WorkKind::kCones,
               .title = titled<ConesWork>("Fitting cones"),
               .missing = [](const WorkView& view, const Assets& assets) -> std::vector<ConesWork> {
                   const mesh::SurfaceOptions& options = view.request.options;
                   const SurfaceCenterlines& now = assets.centerlines;
                   const DrawnWidth width = drawn_width(options, options.method);
                   if (!view.cones_wanted || assets.tree != view.document.tree() || !now.fits(options) ||
                       !drawn_along_lines(options, options.method) || now.cones_fit(width))
                       return {};
                   return {{now.lines, width}};
               },
               .make = [](const ConesWork& work, Job&) -> Result<Cones> {
                   return render::caster::fitted_cones(work.lines, work.width.width, work.width.beyond_ends);
               },
               .put =
                   [](const ConesWork& work, const Cones& made, Assets& assets) {
                       if (assets.centerlines.lines == work.lines) assets.centerlines.cones = made;
                   },
               .quiet = true});
}

struct SectionWork {
    FollowedPath followed;
    std::shared_ptr<const render::PagedMesh> mesh;
    bool operator==(const SectionWork& other) const {
        return followed.path == other.followed.path && mesh == other.mesh;
    }
};

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

} // namespace

std::vector<std::unique_ptr<BackgroundWork>> background_works(const std::function<void()>& wake,
                                                              std::vector<ComparedSurface>& compared) {
    std::vector<std::unique_ptr<BackgroundWork>> works;
    works.push_back(lesion_work(wake));
    works.push_back(context_work(wake));
    works.push_back(scan_work(wake));
    works.push_back(region_work(wake));
    works.push_back(organ_work(wake));
    works.push_back(supply_work(wake));
    works.push_back(resection_mesh_work(wake));
    works.push_back(operation_work(wake));
    works.push_back(territory_work(wake));
    works.push_back(comparison_work(wake, compared));
    works.push_back(deviation_work(wake));
    works.push_back(validation_work(wake));
    works.push_back(contact_work(wake));
    works.push_back(centerline_work(wake));
    works.push_back(cones_work(wake));
    works.push_back(section_work(wake));
    return works;
}

} // namespace ramus::app
