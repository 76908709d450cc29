#include "core/mesh/surface.h"

#include "core/base/disk_pages.h"
#include "core/base/memory.h"
#include "core/base/run_limited.h"
#include "core/base/stopwatch.h"
#include "core/field/kernel.h"
#include "core/field/kernel_radii.h"
#include "core/field/surface_projector.h"
#include "core/field/vessel_field.h"
#include "core/mesh/check_kernel.h"
#include "core/mesh/cones.h"
#include "core/mesh/edge_balance.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/systems.h"
#include "core/mesh/untangle/untangle.h"
#include "core/tree/contacts/links.h"
#include "core/tree/curves.h"
#include "core/tree/smooth.h"

#include <algorithm>
#include <memory>
#include <oneapi/tbb/parallel_invoke.h>
#include <optional>

namespace ramus::mesh {

namespace {

// As many as 31 bits count; of one system, the polygonizer sees to it.
constexpr std::size_t kMostVertices = std::size_t{1} << 31U;
constexpr float kMade = 0.9F; // of the time, before a surface is repaired

tl::unexpected<Error> too_many_vertices() {
    return fail("the surface has more vertices than can be counted", {}, "lower --detail, or hide a system");
}

// What the surface may take: the limit is for the process, which has a tree already.
PolygonizeOptions polygonize_options(const SurfaceOptions& options, const std::shared_ptr<DiskPages>& pages = {}) {
    if (pages != nullptr) pages->release_resident(); // they would count
    PolygonizeOptions chosen;
    chosen.disk = pages;
    chosen.detail = options.detail;
    chosen.cell_mm = options.cell_mm;
    chosen.memory_bytes = memory_left(static_cast<double>(options.memory_bytes));
    return chosen;
}

Error at_memory_end() {
    return {"not enough memory for this surface", {}, "lower --detail, raise --cell or prune the tree"};
}

} // namespace

PreparedTree prepare_tree(const tree::VesselTree& source, const SurfaceOptions& options) {
    PreparedTree prepared = tree::prune(source, options.prune_ratio);
    prepared.tree = tree::smooth(std::move(prepared.tree), options.smooth_passes);
    // Truncated cones are the paper's: one for each segment.
    if (options.centerline == tree::Centerline::kLines || options.method == Method::kTruncatedCones) return prepared;
    // Numbers of pieces stay what they are, whatever is pruned.
    const std::vector<tree::CurvePieces> pieces = tree::pieces_of_curves(
        prepared.segment_index.empty() ? prepared.tree : tree::smooth(source, options.smooth_passes));
    return tree::along_curves(std::move(prepared), pieces);
}

PreparedTree visible_part(PreparedTree prepared, std::span<const std::uint8_t> hidden) {
    const auto is_hidden = [&](int branch) {
        const auto index = static_cast<std::size_t>(branch);
        return index < hidden.size() && hidden[index] != 0;
    };
    if (std::ranges::none_of(hidden, [](std::uint8_t h) { return h != 0; })) return prepared;
    std::vector<int> kept_source;
    std::vector<tree::Branch> kept;
    std::size_t ordinal = 0;
    for (const tree::Branch& branch : prepared.tree.branches) {
        // Pruning joins branches of the file into one: the run is cut where hidden ones begin and end.
        tree::Branch run;
        for (std::size_t i = 1; i < branch.points.size(); ++i, ++ordinal) {
            if (is_hidden(prepared.segment_source[ordinal])) {
                if (run.points.size() > 1) kept.push_back(run);
                run.points.clear();
                continue;
            }
            if (run.points.empty()) run.points.push_back(branch.points[i - 1]);
            run.points.push_back(branch.points[i]);
            kept_source.push_back(prepared.segment_source[ordinal]);
        }
        if (run.points.size() > 1) kept.push_back(run);
    }
    prepared.tree.branches = std::move(kept);
    prepared.segment_source = std::move(kept_source);
    return prepared;
}

namespace {

// Of all trees that pruning may leave. Pruning may take the thinnest vessel, or the one that reaches farthest; bounds
// of the tree as it came hold what smoothing makes of any part of it.
field::Frame frame_of_all_parts(const tree::VesselTree& source, SurfaceOptions options, double support_radii) {
    const auto frame_of = [&](int smooth_passes) {
        options.smooth_passes = smooth_passes;
        return field::Skeleton(prepare_tree(source, options), support_radii).frame();
    };
    options.prune_ratio = 0.0;
    const double thinnest = frame_of(options.smooth_passes).thinnest;
    options.centerline = tree::Centerline::kLines; // curves stay within the hull of their points
    field::Frame frame = frame_of(0);
    frame.thinnest = thinnest;
    return frame;
}

field::ConvolutionField plain_sum(const tree::VesselTree& source, const SurfaceOptions& options,
                                  const PreparedTree& prepared) {
    const field::Kernel kernel = kernel_of(options);
    const bool exact = options.radii == Radii::kExact;
    const PreparedTree& ready = exact ? field::with_kernel_radii(prepared, kernel) : prepared;
    if (!(options.prune_ratio > 0.0)) return {field::Skeleton(ready, kernel.support_radii), kernel};
    field::Frame frame = frame_of_all_parts(source, options, kernel.support_radii * (exact ? field::kWidest : 1.0));
    if (exact) frame.thinnest *= field::kNarrowest;
    return {field::Skeleton(ready, kernel.support_radii, frame), kernel};
}

// Of all systems. What cannot be met is known before contacts are looked for, which takes longer the thicker vessels
// are. `pages`, which may be null, are kept where the surface does not fit into memory.
Result<field::VesselField> feasible_field(const tree::VesselTree& source, const SurfaceOptions& options,
                                          const PreparedTree& prepared, std::span<const std::uint8_t> hidden,
                                          std::shared_ptr<DiskPages>& pages) {
    std::optional<field::ConvolutionField> made;
    std::optional<tree::Links> links;
    tbb::parallel_invoke([&] { made = plain_sum(source, options, prepared); },
                         [&] {
                             if (options.blend == Blend::kTree) links.emplace(prepared);
                         });
    const field::ConvolutionField& sum = *made;
    const field::VesselField merged(sum, std::make_shared<const tree::Contacts>());
    const field::VesselField visible = hidden.empty() ? merged : merged.without(hidden);
    if (!visible.skeleton().present().empty()) {
        const PolygonizeOptions chosen = polygonize_options(options);
        if (is_feasible(visible, chosen, PolygonizeMode::kWhole)) pages = nullptr;
        const auto mode = pages != nullptr ? PolygonizeMode::kOnDisk : PolygonizeMode::kWhole;
        if (auto possible = check_feasible(visible, chosen, mode); !possible) return tl::unexpected(possible.error());
    }
    if (options.blend != Blend::kTree) return merged;
    return field::VesselField(
        sum, std::make_shared<const tree::Contacts>(tree::find_contacts(prepared, *links, kernel_of(options).limits)),
        options.rims);
}

// What goes through itself is untangled for files alone.
enum class MadeFor { kPictures, kFile };

// `pages`: of the disk for what does not fit into memory; may be null.
Result<Surface> make(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                     std::span<const std::uint8_t> hidden, MadeFor use, const std::shared_ptr<DiskPages>& pages = {}) {
    const Stopwatch watch;
    Surface surface;
    if (options.method == Method::kTruncatedCones) {
        RAMUS_TRY(mesh, cones(visible_part(prepare_tree(source, options), hidden), options.detail, job));
        surface.mesh = std::move(mesh);
    } else {
        const auto parts = hidden_by_system(source, hidden);
        const PreparedTree prepared = prepare_tree(source, options);
        std::shared_ptr<DiskPages> of_mesh = pages;
        RAMUS_TRY(whole, feasible_field(source, options, prepared, hidden, of_mesh));
        surface.disk = of_mesh;
        std::vector<field::VesselField> fields;
        for (std::size_t n = 0; n < parts.size(); ++n) {
            const std::vector<std::uint8_t>& part = parts[n];
            const auto share = [&](float of_part) {
                return (static_cast<float>(n) + of_part) / static_cast<float>(parts.size());
            };
            Job making(job, share(0.0F), share(kMade)), repairing(job, share(kMade), share(1.0F));
            PolygonizeStatistics statistics;
            std::vector<TriangleBox> walled;
            fields.push_back(whole.without(part));
            RAMUS_TRY(mesh,
                      polygonize(fields.back(), polygonize_options(options, of_mesh), making, &statistics, &walled));
            if (options.blend == Blend::kTree) {
                const double memory = polygonize_options(options, of_mesh).memory_bytes;
                const MatchedTree matched =
                    match_tree(mesh, visible_part(prepared, part), walled, memory, repairing, pages);
                if (pages != nullptr && matched.false_loops.lacked_bytes > 0.0)
                    return fail(takes_too_much("looking for loops that the tree does not have",
                                               matched.false_loops.lacked_bytes, memory),
                                {}, "raise --memory, or lower --detail");
                surface.statistics.matched.add(matched);
            }
            if (use == MadeFor::kFile && !job.cancelled())
                surface.statistics.untangled.add(untangle(mesh, walled, repairing));
            repairing.report(1.0F);
            if (job.cancelled()) return fail("cancelled");
            if (use == MadeFor::kFile)
                if (auto closed = check_balance(mesh); !closed) return tl::unexpected(closed.error());
            if (surface.mesh.positions.size() + mesh.positions.size() > kMostVertices) return too_many_vertices();
            append(surface.mesh, std::move(mesh));
            surface.statistics.evaluations += statistics.evaluations;
        }
        if (options.rims == field::Rims::kOverlapping)
            surface.projector = std::make_shared<const field::SurfaceProjector>(std::move(fields));
    }
    if (surface.mesh.triangles.empty()) return empty_surface(options.cell_mm);
    surface.statistics.seconds = watch.seconds();
    return surface;
}

} // namespace

field::Kernel kernel_of(const SurfaceOptions& options) { return field::make_kernel(options.kernel, options.width); }

field::VesselField make_field(const tree::VesselTree& source, const SurfaceOptions& options,
                              std::span<const std::uint8_t> hidden) {
    const PreparedTree prepared = prepare_tree(source, options);
    auto contacts = std::make_shared<tree::Contacts>();
    if (options.blend == Blend::kTree) *contacts = tree::find_contacts(prepared, kernel_of(options).limits);
    field::VesselField field(plain_sum(source, options, prepared), std::move(contacts), options.rims);
    return hidden.empty() ? field : field.without(hidden);
}

tl::unexpected<Error> empty_surface(double cell_mm) {
    return fail(cell_mm > 0.0
                    ? "the surface is empty: vessels are thinner than cells, or far shorter than they are thick"
                    : "the surface is empty: vessels are far shorter than they are thick",
                {}, cell_mm > 0.0 ? "lower --cell, or check the unit" : "check positions, radii and the unit");
}

Result<Surface> make_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                             std::span<const std::uint8_t> hidden) {
    if (auto takes = check_kernel(options); !takes) return tl::unexpected(takes.error());
    return run_limited(options.threads, at_memory_end,
                       [&] { return make(source, options, job, hidden, MadeFor::kPictures); });
}

Result<Surface> make_untangled_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                                       std::span<const std::uint8_t> hidden, const std::filesystem::path& target) {
    if (auto takes = check_kernel(options); !takes) return tl::unexpected(takes.error());
    std::shared_ptr<DiskPages> pages;
    if (!target.empty())
        pages = std::make_shared<DiskPages>(target, memory_limit(static_cast<double>(options.memory_bytes)));
    return run_limited(options.threads, at_memory_end,
                       [&] { return make(source, options, job, hidden, MadeFor::kFile, pages); });
}

} // namespace ramus::mesh
