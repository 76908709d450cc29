#include "core/mesh/surface.h"

#include "core/base/disk_pages.h"
#include "core/base/memory.h"
#include "core/base/run_limited.h"
#include "core/base/stopwatch.h"
#include "core/field/surface_projector.h"
#include "core/mesh/check_kernel.h"
#include "core/mesh/cones.h"
#include "core/mesh/edge_balance.h"
#include "core/mesh/polygonize/feasible.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/systems.h"
#include "core/mesh/tree_field.h"
#include "core/mesh/untangle/untangle.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace ramus::mesh {

namespace {

// As many as 31 bits count; of one system, the polygonizer sees to it.
constexpr std::size_t kMostVertices = std::size_t{1} << 31U;
constexpr float kMade = 0.9F;           // of the time, before a surface is repaired
constexpr double kPreparedBytes = 40.0; // of a segment of a prepared tree, at least

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

// What goes through itself is untangled for files alone.
enum class MadeFor { kPictures, kFile };

// What for, and by whom.
struct Making {
    MadeFor use = MadeFor::kPictures;
    std::shared_ptr<DiskPages> pages = nullptr; // of the disk for what does not fit into memory; may be null
    Team* team = nullptr;                       // that makes it; null: this process alone
    std::optional<PartOf> part = std::nullopt;  // this part alone
    // Of the surface, in this process. Borders of parts are computed twice.
    [[nodiscard]] double share() const {
        constexpr double kWithBorder = 1.5;
        const std::size_t parts = part ? part->count : team != nullptr && !team->leads() ? team->size() : 1;
        return std::min(1.0, kWithBorder / static_cast<double>(parts));
    }
};

class SurfaceMaking {
public:
    SurfaceMaking(const SurfaceOptions& options, const Making& making)
        : options_(options), making_(making), of_mesh_(making.pages) {}

    // What cannot be met is known before contacts are searched. The disk is let go of where memory suffices. Returns
    // the memory of large arrays.
    Result<LargeAllocator<std::byte>> check(const field::Field& sum) {
        const auto memory = [&] { return LargeAllocator<std::byte>(of_mesh_); };
        if (sum.skeleton().present().empty()) return memory();
        PolygonizeOptions chosen = polygonize_options(options_);
        const bricks::Sizing sizing = bricks::make_sizing(sum, chosen.detail, chosen.cell_mm, memory());
        Result<void> in_memory = check_feasible(sum, sizing, chosen, PolygonizeMode::kWhole, making_.share());
        if (in_memory) of_mesh_ = nullptr;
        if (of_mesh_ == nullptr) return in_memory.map(memory);
        chosen.memory_bytes += kPreparedBytes * static_cast<double>(sum.skeleton().segments().size());
        return check_feasible(sum, sizing, chosen, PolygonizeMode::kOnDisk, making_.share()).map(memory);
    }

    // Whether the prepared tree is let go of while the surface is polygonized. It takes as much as its field.
    [[nodiscard]] bool prepares_again() const { return of_mesh_ != nullptr || !is_repaired(); }

    // Adds the surface of one system, whose field ends before repairs. `tree()`: the tree as prepared.
    Result<void> add(field::Field field, std::span<const std::uint8_t> hidden,
                     const std::function<PreparedTree()>& tree, Job& making, Job& repairing) {
        std::vector<TriangleBox> walled;
        RAMUS_TRY(mesh, polygonized(std::move(field), making, walled));
        if (is_repaired()) {
            if (row_of(options_.blend).separates)
                if (auto matched = match(mesh, visible_part(tree(), hidden), walled, repairing); !matched)
                    return matched;
            if (making_.use == MadeFor::kFile && !repairing.cancelled())
                surface_.statistics.untangled.add(untangle(mesh, walled, repairing));
        }
        repairing.report(1.0F);
        if (repairing.cancelled()) return fail("cancelled");
        if (is_repaired() && making_.use == MadeFor::kFile)
            if (auto closed = check_balance(mesh); !closed) return closed;
        if (surface_.mesh.positions.size() + mesh.positions.size() > kMostVertices) return too_many_vertices();
        append(surface_.mesh, std::move(mesh));
        return {};
    }

    [[nodiscard]] Surface take() {
        surface_.disk = of_mesh_;
        return std::move(surface_);
    }

private:
    // The leader repairs what a team has made.
    [[nodiscard]] bool is_repaired() const {
        return !making_.part && (making_.team == nullptr || making_.team->leads());
    }

    Result<TriangleMesh> polygonized(field::Field given, Job& job, std::vector<TriangleBox>& walled) {
        const field::Field field = std::move(given); // ends with this function
        const PolygonizeOptions chosen = polygonize_options(options_, of_mesh_);
        PartStatistics statistics;
        Result<TriangleMesh> mesh = making_.part ? polygonize_part(field, chosen, *making_.part, job, &statistics)
                                    : making_.team != nullptr
                                        ? polygonize_together(field, chosen, *making_.team, job, &statistics, &walled)
                                        : polygonize(field, chosen, job, &statistics, &walled);
        surface_.statistics.evaluations += statistics.evaluations;
        surface_.statistics.part.add(statistics);
        return mesh;
    }

    Result<void> match(TriangleMesh& mesh, const PreparedTree& visible, std::span<const TriangleBox> walled, Job& job) {
        const double memory = polygonize_options(options_, of_mesh_).memory_bytes;
        const MatchedTree matched = match_tree(mesh, visible, walled, memory, job, making_.pages);
        if (making_.pages != nullptr && matched.false_loops.lacked_bytes > 0.0)
            return fail(takes_too_much("looking for loops that the tree does not have",
                                       matched.false_loops.lacked_bytes, memory),
                        {}, "raise --memory, or lower --detail");
        surface_.statistics.matched.add(matched);
        return {};
    }

    const SurfaceOptions& options_;
    const Making& making_;
    std::shared_ptr<DiskPages> of_mesh_;
    Surface surface_;
};

// The fields of the systems, and the tree that they are of.
struct FieldsOfTree {
    std::vector<field::Field> fields;
    PreparedTree tree;
};

Result<FieldsOfTree> fields_of_tree(const tree::VesselTree& source, const SurfaceOptions& options,
                                    std::span<const std::vector<std::uint8_t>> hidden_of, const SumCheck& check) {
    RAMUS_TRY(whole, make_tree_field(source, options, check));
    FieldsOfTree made;
    for (const auto& hidden : hidden_of) made.fields.push_back(whole.field.without(hidden));
    made.tree = std::move(whole.tree);
    return made;
}

Result<Surface> convolution_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                                    std::span<const std::uint8_t> hidden, const Making& how) {
    SurfaceMaking making(options, how);
    const auto hidden_of = hidden_by_system(source, hidden);
    RAMUS_TRY(made, fields_of_tree(source, options, hidden_of, [&](const field::Field& sum) {
                  return making.check(hidden.empty() ? sum : sum.without(hidden));
              }));
    std::vector<field::Field>& fields = made.fields;
    const bool again = making.prepares_again();
    if (again) made.tree = {};
    const auto prepared = [&] { return again ? prepare_tree(source, options) : made.tree; };
    const bool projects = options.rims == field::Rims::kOverlapping;
    for (std::size_t n = 0; n < fields.size(); ++n) {
        const auto share = [&](float of_system) {
            return (static_cast<float>(n) + of_system) / static_cast<float>(fields.size());
        };
        Job polygonizing(job, share(0.0F), share(kMade)), repairing(job, share(kMade), share(1.0F));
        field::Field field = projects ? fields[n] : std::move(fields[n]);
        if (auto added = making.add(std::move(field), hidden_of[n], prepared, polygonizing, repairing); !added)
            return tl::unexpected(added.error());
    }
    Surface surface = making.take();
    if (projects) surface.projector = std::make_shared<const field::SurfaceProjector>(std::move(fields));
    return surface;
}

Result<Surface> make(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                     std::span<const std::uint8_t> hidden, const Making& how) {
    const Stopwatch watch;
    Surface surface;
    if (options.method == Method::kTruncatedCones) {
        RAMUS_TRY(mesh, cones(visible_part(prepare_tree(source, options), hidden), options.detail, job));
        surface.mesh = std::move(mesh);
    } else {
        RAMUS_TRY(made, convolution_surface(source, options, job, hidden, how));
        surface = std::move(made);
    }
    const bool may_be_empty = how.part || (how.team != nullptr && !how.team->leads());
    if (surface.mesh.triangles.empty() && !may_be_empty) return empty_surface(options.cell_mm);
    surface.statistics.seconds = watch.seconds();
    return surface;
}

Result<Surface> make_for_file(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                              std::span<const std::uint8_t> hidden, const std::filesystem::path& target, Making how) {
    if (auto takes = check_kernel(options); !takes) return tl::unexpected(takes.error());
    how.use = MadeFor::kFile;
    if (!target.empty())
        how.pages = std::make_shared<DiskPages>(target, memory_limit(static_cast<double>(options.memory_bytes)));
    return run_limited(options.threads, at_memory_end, [&] { return make(source, options, job, hidden, how); });
}

} // namespace

tl::unexpected<Error> empty_surface(double cell_mm) {
    return fail(cell_mm > 0.0
                    ? "the surface is empty: vessels are thinner than cells, or far shorter than they are thick"
                    : "the surface is empty: vessels are far shorter than they are thick",
                {}, cell_mm > 0.0 ? "lower --cell, or check the unit" : "check positions, radii and the unit");
}

Result<Surface> make_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                             std::span<const std::uint8_t> hidden) {
    if (auto takes = check_kernel(options); !takes) return tl::unexpected(takes.error());
    return run_limited(options.threads, at_memory_end, [&] { return make(source, options, job, hidden, {}); });
}

Result<Surface> make_untangled_surface(const tree::VesselTree& source, const SurfaceOptions& options, Job& job,
                                       std::span<const std::uint8_t> hidden, const std::filesystem::path& target) {
    return make_for_file(source, options, job, hidden, target, {});
}

Result<Surface> make_surface_together(const tree::VesselTree& source, const SurfaceOptions& options, Team& team,
                                      Job& job, std::span<const std::uint8_t> hidden,
                                      const std::filesystem::path& target) {
    return make_for_file(source, options, job, hidden, target, {.team = &team});
}

Result<Surface> make_part_of_surface(const tree::VesselTree& source, const SurfaceOptions& options, const PartOf& part,
                                     Job& job, std::span<const std::uint8_t> hidden,
                                     const std::filesystem::path& target) {
    return make_for_file(source, options, job, hidden, target, {.part = part});
}

} // namespace ramus::mesh
