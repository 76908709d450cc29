#include "app/assets/assets.h"

#include "core/base/sort_unique.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

template <class Map, class Key> auto* found(Map& map, const Key& key) {
    const auto at = map.find(key);
    return at == map.end() ? nullptr : &at->second;
}

bool grid_needed(const Marks& marks, GridIs grid) {
    return !marks.planning.bands_mm.empty() && (grid == GridIs::kMadeAhead || marks.colour_by == ColourBy::kLesion);
}

void refresh_centerlines(Assets& assets, const mesh::SurfaceOptions& options) {
    if (!assets.tree)
        assets.centerlines = {};
    else if (!assets.centerlines.fits(options) && !centerlines_awaited(assets, options))
        assets.centerlines = centerlines_of(*assets.tree, options);
}

void refresh_measurements(Assets& assets, const Document& document) {
    const Marks& marks = document.marks();
    const std::string unit = document.lengths().unit();
    LesionShapes lesions = lesion_shapes(assets, marks);
    if (assets.measurements && assets.measurements->of == marks.measurements &&
        assets.measurements->lesions == lesions && assets.measurements->unit == unit)
        return;
    Measurements measurements{marks.measurements, unit, std::move(lesions), {}, {}};
    const auto tree = measured_tree(document);
    for (const Measurement& measurement : marks.measurements) {
        measurements.places.emplace(measurement.id, measurements.found.size());
        measurements.found.push_back(measured(*tree, measurement, measurements.lesions));
    }
    assets.measurements = std::make_shared<const Measurements>(std::move(measurements));
}

void refresh_tree(Assets& assets, const Document& document) {
    if (assets.tree == document.tree()) return;
    assets.tree = document.tree();
    assets.facts = document.facts();
    assets.lesion_distances = {};
    assets.plan.reset();
    assets.measurements.reset();
    assets.centerlines = {};
    assets.contacts = {};
    assets.deviation = {};
}

void refresh_outline(Assets& assets, const Session& session) {
    const Marks& marks = session.marks;
    if (!assets.tree || marks.selection.empty()) return assets.outline.reset();
    SelectionOutline::Of of{assets.tree, assets.centerlines.lines, session.camera, marks.states, marks.selection};
    if (!assets.outline || assets.outline->of != of)
        assets.outline = std::make_shared<const SelectionOutline>(selection_outline(std::move(of)));
}

// The step of the first scan that is shown.
double step_along(const Assets& assets, const Marks& marks) {
    for (const Scan& scan : marks.scans)
        if (const auto file = scan.visible && !scan.labels ? assets.scan(scan) : nullptr)
            return fine_step_mm(*file->volume);
    return 0.0;
}

void refresh_followed(Assets& assets, const Session& session) {
    const auto& along = session.slices.along;
    if (!assets.tree || !along) {
        assets.followed = {};
        return;
    }
    FollowedPath::Of of{assets.tree, along->way, step_along(assets, session.marks)};
    if (assets.followed.of == of) return;
    auto path = path_along(*of.tree, of.way, of.step_mm);
    assets.followed = {std::move(of), nullptr, {}};
    if (path)
        assets.followed.path = std::make_shared<const slice::VesselPath>(std::move(*path));
    else
        assets.followed.problem = path.error().message();
}

} // namespace

const Result<Measured>* Assets::measured(int id) const {
    if (!measurements) return nullptr;
    const auto place = measurements->places.find(id);
    return place == measurements->places.end() ? nullptr : &measurements->found[place->second];
}

std::shared_ptr<const LesionMesh> Assets::lesion_mesh(const Lesion& lesion) const {
    const auto* loaded = lesion.is_mesh() ? found(lesion_files, source_of(lesion)) : nullptr;
    if (loaded == nullptr || !loaded->value) return nullptr;
    const auto& parts = (*loaded->value)->parts;
    const std::size_t part = lesion.of_mask() ? static_cast<std::size_t>(lesion.part) - 1 : 0;
    return part < parts.size() ? parts[part] : nullptr;
}

std::shared_ptr<const ContextShape> Assets::context_shape(const ContextSource& source) const {
    const auto* loaded = found(context_shapes, source);
    return loaded != nullptr && loaded->value ? *loaded->value : nullptr;
}

std::optional<Error> Assets::trouble(const ContextSource& source) const {
    const auto* loaded = found(context_shapes, source);
    return loaded != nullptr && !loaded->value ? std::optional(loaded->value.error()) : std::nullopt;
}

std::optional<Error> Assets::trouble(const Lesion& lesion) const {
    const auto* loaded = lesion.is_mesh() ? found(lesion_files, source_of(lesion)) : nullptr;
    if (loaded == nullptr || lesion_mesh(lesion)) return {};
    if (!loaded->value) return loaded->value.error();
    return Error{"the mask has no part " + std::to_string(lesion.part) + ", but " +
                     std::to_string((*loaded->value)->parts.size()),
                 lesion.file, "remove the lesion, and read the mask again"};
}

std::shared_ptr<const ScanFile> Assets::scan(const Scan& scan) const {
    const auto* loaded = found(scans, source_of(scan));
    return loaded != nullptr && loaded->value && !trouble(scan) ? *loaded->value : nullptr;
}

std::optional<Error> Assets::trouble(const Scan& scan) const {
    const auto* loaded = found(scans, source_of(scan));
    if (loaded == nullptr) return {};
    if (!loaded->value) return loaded->value.error();
    if (scan.checksum.empty() || scan.checksum == (*loaded->value)->checksum) return {};
    return Error{"the scan has changed since the session was saved", scan.file,
                 "remove it from the session, and open it again"};
}

tree::Claims Assets::claims_of(const SceneObjects& objects) const {
    tree::Claims claims;
    for (const ContextItem& item : objects.context)
        if (const auto shape = item.visible ? context_shape(source_of(item)) : nullptr)
            claims = claims.with(shape->claims);
    for (const Scan& scan : objects.scans)
        if (const auto file = scan.visible ? this->scan(scan) : nullptr) claims = claims.with(file->claims);
    return claims;
}

render::Box Assets::box_of(const std::vector<ContextItem>& context) const {
    render::Box box;
    for (const ContextItem& item : context) {
        const auto shape = item.visible && item.opacity > 0.0 ? context_shape(source_of(item)) : nullptr;
        if (!shape || shape->box.empty()) continue;
        box.include(shape->box.lower);
        box.include(shape->box.upper);
    }
    return box;
}

void Assets::put(const LesionSource& source, Loaded<LesionFile> loaded) {
    lesion_files.insert_or_assign(source, std::move(loaded));
    plan.reset();
}

void Assets::put(const ContextSource& source, Loaded<ContextShape> loaded) {
    context_shapes.insert_or_assign(source, std::move(loaded));
}

void Assets::put(const ScanSource& source, Loaded<ScanFile> loaded) {
    scans.insert_or_assign(source, std::move(loaded));
}

void refresh(Assets& assets, const Document& document) { refresh(assets, document, document.marks().options); }

void refresh(Assets& assets, const Document& document, const mesh::SurfaceOptions& options) {
    refresh_tree(assets, document);
    if (assets.tree) (void)refresh_plan(assets, document);
    refresh_measurements(assets, document);
    refresh_centerlines(assets, options);
    refresh_outline(assets, document.session());
    refresh_followed(assets, document.session());
}

bool centerlines_awaited(const Assets& assets, const mesh::SurfaceOptions& options) {
    constexpr std::size_t kLarge = 20'000; // segments: they take a fiftieth of a second
    if (!assets.centerlines_follow || !assets.tree) return false;
    return !assets.centerlines.fits(options) && assets.tree->segment_count() > kLarge;
}

void complete_centerlines(Assets& assets, const mesh::SurfaceOptions& options) {
    if (centerlines_awaited(assets, options)) assets.centerlines = centerlines_of(*assets.tree, options);
}

const Plan& refresh_plan(Assets& assets, const Document& document) {
    refresh_tree(assets, document);
    const Marks& marks = document.marks();
    if (assets.plan && assets.plan->of == planned(marks)) return *assets.plan;
    assets.plan = std::make_shared<const Plan>(make_plan(assets, marks));
    // Measured for spheres only; other changes reuse the distances.
    const double touch_mm = marks.planning.touch_mm;
    if (const Plan& plan = *assets.plan; !plan.measuring && !assets.lesion_distances.fits(plan.lesions, touch_mm))
        assets.lesion_distances = {plan.lesions, touch_mm, plan.lesion_distances_mm, plan.measured_vessels};
    return *assets.plan;
}

namespace {

bool is_other(const Loaded<LesionFile>* before, const Loaded<LesionFile>& now) {
    return before == nullptr || before->stamp != now.stamp ||
           (before->value && now.value && *before->value != *now.value);
}

// Each file once.
std::vector<LesionSource> lesion_sources(const Marks& marks) {
    std::vector<LesionSource> sources;
    for (const Lesion& lesion : lesion_meshes(marks)) sources.push_back(source_of(lesion));
    sort_unique(sources);
    return sources;
}

bool lesions_are_read(const Assets& assets, const Marks& marks) {
    return std::ranges::all_of(lesion_meshes(marks),
                               [&](const Lesion& lesion) { return assets.lesion_files.contains(source_of(lesion)); });
}

} // namespace

bool lesions_awaited(const Assets& assets, const Marks& marks, GridIs grid) {
    if (!assets.tree || lesion_files(marks).empty()) return false;
    if (!lesions_are_read(assets, marks)) return true;
    const measure::Lesions lesions = loaded_lesions(assets, marks);
    if (lesions.meshes.empty()) return false;
    return !assets.lesion_distances.fits(lesions, marks.planning.touch_mm) ||
           (grid_needed(marks, grid) && !assets.lesion_grid.fits(lesions, widest_margin_mm(marks.planning)));
}

void complete_lesions(Assets& assets, const Marks& marks, GridIs grid) {
    Job job;
    for (const LesionSource& source : lesion_sources(marks)) (void)load_lesion(assets, source, job);
    measure::Lesions lesions = loaded_lesions(assets, marks);
    if (!assets.tree || lesions.meshes.empty()) return;
    const double reach = widest_margin_mm(marks.planning);
    if (grid_needed(marks, grid) && !assets.lesion_grid.fits(lesions, reach))
        assets.lesion_grid = distance_grid(lesions, reach);
    if (assets.lesion_distances.fits(lesions, marks.planning.touch_mm)) return;
    assets.lesion_distances = measure_lesions(*assets.tree, std::move(lesions), marks.planning.touch_mm);
    assets.plan.reset();
}

void complete_lesions(Assets& assets, const Document& document) {
    refresh_tree(assets, document);
    constexpr GridIs kGrid = GridIs::kMadeWhenShown;
    if (lesions_awaited(assets, document.marks(), kGrid)) complete_lesions(assets, document.marks(), kGrid);
    refresh(assets, document);
}

Result<std::shared_ptr<const LesionFile>> load_lesion(Assets& assets, const LesionSource& source, Job& job) {
    const Loaded<LesionFile>* before = found(assets.lesion_files, source);
    Loaded<LesionFile> loaded = read_lesion_file(source, before, job);
    if (!job.cancelled() && is_other(before, loaded)) assets.put(source, loaded);
    return loaded.value;
}

Result<std::shared_ptr<const ContextShape>> load_context_shape(Assets& assets, const ContextSource& source, Job& job) {
    Loaded<ContextShape> loaded = read_context_shape(source, found(assets.context_shapes, source), job);
    if (!job.cancelled()) assets.put(source, loaded);
    return loaded.value;
}

Result<void> load_context(Assets& assets, const Marks& marks, Job& job) {
    for (const ContextItem& item : marks.context) {
        if (!item.visible) continue;
        if (const auto shape = load_context_shape(assets, source_of(item), job); !shape)
            return tl::unexpected(shape.error());
    }
    return {};
}

Result<std::shared_ptr<const ScanFile>> load_scan(Assets& assets, const ScanSource& source, std::uint64_t memory_bytes,
                                                  Job& job) {
    Loaded<ScanFile> loaded = read_scan(source, found(assets.scans, source), memory_bytes, job);
    if (!job.cancelled()) assets.put(source, loaded);
    return loaded.value;
}

Result<void> load_scans(Assets& assets, const Marks& marks, Job& job) {
    for (const Scan& scan : marks.scans) {
        if (!scan.visible) continue;
        if (const auto file = load_scan(assets, source_of(scan), marks.options.memory_bytes, job); !file)
            return tl::unexpected(file.error());
        if (const auto trouble = assets.trouble(scan)) return tl::unexpected(*trouble);
    }
    return {};
}

bool contacts_awaited(const Assets& assets, const mesh::SurfaceOptions& options) {
    return assets.tree && !assets.contacts.fits(options);
}

void complete_contacts(Assets& assets, const Document& document) {
    refresh_tree(assets, document);
    const mesh::SurfaceOptions& options = document.marks().options;
    if (contacts_awaited(assets, options)) assets.contacts = contacts_of(*assets.tree, options);
}

void complete_region(Assets& assets, Job& job) {
    ScanRegion& region = assets.region;
    const auto* const loaded = region.is_current() ? nullptr : found(assets.scans, region.now().scan);
    if (loaded == nullptr || !loaded->value) return;
    auto grown = grown_mask(region.now(), *(*loaded->value)->volume, JobRange(job, 0.0F, 1.0F));
    if (grown) region.grown = std::move(*grown);
}

Result<void> complete(Assets& assets, const Document& document, Job& job) {
    complete_lesions(assets, document);
    if (document.marks().contact_marks) complete_contacts(assets, document);
    const Marks& marks = document.marks();
    if (auto organ = complete_organ(assets, marks, job); !organ) return organ;
    if (auto scans = load_scans(assets, marks, job); !scans) return scans;
    complete_region(assets, job);
    return load_context(assets, marks, job);
}

void merge(Assets& assets, const Assets& from) {
    for (const auto& [source, loaded] : from.lesion_files)
        if (is_other(found(assets.lesion_files, source), loaded)) assets.put(source, loaded);
    for (const auto& [source, loaded] : from.context_shapes)
        if (const auto* mine = found(assets.context_shapes, source); mine == nullptr || mine->stamp != loaded.stamp)
            assets.put(source, loaded);
    for (const auto& [source, loaded] : from.scans)
        if (const auto* mine = found(assets.scans, source); mine == nullptr || mine->stamp != loaded.stamp)
            assets.put(source, loaded);
    assets.lesion_grid = from.lesion_grid;
    if (assets.tree == from.tree) assets.lesion_distances = from.lesion_distances;
    assets.plan.reset();
}

void keep_loaded(Assets& assets, Assets before, const Marks& marks) {
    std::erase_if(before.context_shapes, [&](const auto& known) {
        return std::ranges::none_of(marks.context,
                                    [&](const ContextItem& item) { return source_of(item) == known.first; });
    });
    std::erase_if(before.scans, [&](const auto& known) {
        return std::ranges::none_of(marks.scans, [&](const Scan& scan) { return source_of(scan) == known.first; });
    });
    assets.scans.merge(before.scans);
    if (before.organ.source == marks.organ.source)
        assets.organ.source = before.organ.source, assets.organ.mask = before.organ.mask;
    assets.lesion_files.merge(before.lesion_files);
    assets.context_shapes.merge(before.context_shapes);
}

} // namespace ramus::app
