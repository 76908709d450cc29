#include "core/volume/skeletonize/skeletonize.h"

#include "core/base/disk_pages.h"
#include "core/base/memory.h"
#include "core/base/run_limited.h"
#include "core/tree/build_tree.h"
#include "core/tree/note_summary.h"
#include "core/volume/skeletonize/centerline.h"
#include "core/volume/skeletonize/cut_ends.h"
#include "core/volume/skeletonize/distance_transform.h"
#include "core/volume/skeletonize/prune.h"
#include "core/volume/skeletonize/thin.h"
#include "core/volume/skeletonize/tips.h"
#include "core/volume/skeletonize/topology.h"
#include "core/volume/skeletonize/voxel_graph.h"
#include "core/volume/sparse_mask.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <oneapi/tbb/task_group.h>
#include <utility>

namespace ramus::volume {

namespace {

using tree::Note;

// Colours of systems in sRGB, in the order of the systems: vein, artery, others.
constexpr std::array<std::array<std::uint8_t, 3>, 8> kColours = {{{86, 134, 212},
                                                                  {212, 92, 84},
                                                                  {224, 176, 76},
                                                                  {104, 178, 120},
                                                                  {168, 122, 200},
                                                                  {92, 186, 196},
                                                                  {214, 132, 176},
                                                                  {150, 150, 120}}};

// After the last colour, the colours repeat darker, then paler, so that 24 systems have different colours.
std::array<std::uint8_t, 3> colour_of_system(std::size_t system) {
    auto colour = kColours[system % kColours.size()];
    const std::size_t round = system / kColours.size() % 3;
    for (std::uint8_t& part : colour)
        part = static_cast<std::uint8_t>(round == 1 ? part * 5 / 9 : round == 2 ? 255 - (255 - part) * 4 / 9 : part);
    return colour;
}

// Peak memory of the arrays by voxel, of those by stored word of bits, and of those by row of the volume.
constexpr double kBytesPerVoxel = 48.0, kBytesPerWord = 8.0 * 4 + 4.0, kBytesPerRow = 24.0;
// Of what is left, for the other arrays where those by voxel are on the disk, whose pages need some memory too.
constexpr double kShareBesideDisk = 0.5;

// The memory for the arrays by voxel: that of the process, or the disk where they take more than is left. Fails if the
// other arrays take more.
Result<LargeAllocator<std::byte>> memory_for(const SparseMask& mask, std::uint64_t voxels,
                                             const SkeletonizeOptions& options) {
    const double by_voxel = kBytesPerVoxel * static_cast<double>(voxels);
    const double others = kBytesPerWord * static_cast<double>(mask.places()) +
                          kBytesPerRow * static_cast<double>(mask.size().y) * mask.size().z;
    const double left = memory_left(options.memory_bytes);
    if (by_voxel + others <= left) return LargeAllocator<std::byte>();
    if (const double least = std::max(DiskPages::kLeastLeft, others / kShareBesideDisk); least > left)
        return fail(takes_too_much("the skeleton of " + std::to_string(voxels) + " voxels", least, left), {},
                    "crop the volume, or raise --memory");
    return LargeAllocator<std::byte>(std::make_shared<DiskPages>("", memory_limit(options.memory_bytes)));
}

// Memory of a piece or a loop in the tree, with its notes. Measured on masks of noise.
constexpr double kBytesPerPiece = 1400.0;

Result<void> check_memory(const Topology& topology, const SkeletonizeOptions& options) {
    const double bytes = kBytesPerPiece * static_cast<double>(topology.pieces + topology.tunnels);
    const double left = memory_left(options.memory_bytes);
    if (bytes > left)
        return fail(takes_too_much("a tree of " + std::to_string(topology.pieces) + " pieces and " +
                                       std::to_string(topology.tunnels) + " loops",
                                   bytes, left),
                    {}, "leave out small pieces with --islands MM, or raise --memory");
    return {};
}

// Memory of a voxel of the skeleton in the graph, the centerlines and the tree. Measured on lines of single voxels.
constexpr double kBytesPerLineVoxel = 200.0;

Result<void> check_memory(const SparseMask& skeleton, const SkeletonizeOptions& options) {
    const std::uint64_t voxels = skeleton.count();
    const double bytes = kBytesPerLineVoxel * static_cast<double>(voxels);
    const double left = memory_left(options.memory_bytes);
    if (bytes > left)
        return fail(takes_too_much("a tree with centerlines of " + std::to_string(voxels) + " voxels", bytes, left), {},
                    "crop the volume, or raise --memory");
    return {};
}

glm::dvec3 in_patient(const glm::dvec3& along_axes, const glm::dmat4& to_patient) {
    return glm::dvec3(to_patient * glm::dvec4(along_axes / spacing_mm(to_patient), 1.0));
}

void break_cycles_of(VoxelGraph& graph, const glm::dmat4& to_patient, std::vector<Note>& notes) {
    for (const BrokenCycle& cycle : break_cycles(graph))
        notes.push_back({Note::Kind::kRepaired, "fill-holes", "a loop was closed at its thinnest place",
                         in_patient(cycle.at, to_patient)});
}

// The points and edges of one mask, in mm, RAS. Empty: cancelled.
Result<tree::Graph> graph_of_mask(SparseMask mask, const LargeAllocator<std::byte>& memory,
                                  const glm::dmat4& to_patient, const SkeletonizeOptions& options,
                                  std::vector<Note>& notes, const JobRange& job) {
    const glm::dvec3 spacing = spacing_mm(to_patient);
    const glm::ivec3 size = mask.size();
    const VoxelSet set(mask, spacing, memory);
    mask = SparseMask(glm::ivec3(0)); // the set has its own
    job.report(0.1F);
    // find_tips() uses mostly one thread; the others compute the distances meanwhile.
    LargeArray<float> distances;
    tbb::task_group measuring;
    measuring.run([&] { distances = distances_to_outside(set); });
    const auto measured = [&]() -> const LargeArray<float>& {
        measuring.wait();
        return distances;
    };
    const std::vector<VoxelSet::Address> tips = find_tips(set, measured, options.bulge_size, job.part(0.1F, 0.5F));
    (void)measured();
    if (job.cancelled()) return tree::Graph();
    const Thinned thinned = thin(set, distances, tips, job.part(0.5F, 0.85F));
    if (job.cancelled()) return tree::Graph();
    if (auto fits = check_memory(thinned.skeleton, options); !fits) return tl::unexpected(fits.error());
    VoxelGraph graph = graph_of(thinned.skeleton, set, distances);
    if (options.fill_holes) break_cycles_of(graph, to_patient, notes);
    prune_bulges(graph, options.bulge_size, spacing);
    tree::Graph lines = centerlines_of(graph, set, BranchVoxels(set, thinned, graph), job.part(0.85F, 1.0F));
    const std::vector<VolumeCut> cuts = extend_to_border(lines, set, size);
    for (tree::Point& point : lines.points) point.position = in_patient(point.position, to_patient);
    // Transforms normals of planes, also if the axes shear.
    const glm::dmat3 of_normals = glm::transpose(glm::inverse(glm::dmat3(to_patient)));
    for (const VolumeCut& cut : cuts)
        notes.push_back({Note::Kind::kAssumed, std::string(tree::kCutEnds),
                         "the vessel ends at the border of the volume: what lies beyond is not in the file",
                         lines.points[cut.point].position, glm::normalize(of_normals * cut.outward)});
    return lines;
}

void append(tree::Graph& all, const tree::Graph& more, int system) {
    const auto first = static_cast<std::uint32_t>(all.points.size());
    all.points.insert(all.points.end(), more.points.begin(), more.points.end());
    for (const auto& [a, b] : more.edges) all.edges.emplace_back(first + a, first + b);
    all.point_systems.resize(all.points.size(), system);
}

// Makes the end that is nearest to `wanted` the root.
void choose_root(tree::Graph& graph, const glm::dvec3& wanted) {
    std::vector<int> degree(graph.points.size(), 0);
    for (const auto& [a, b] : graph.edges) ++degree[a], ++degree[b];
    double nearest = HUGE_VAL;
    for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
        const double away = glm::distance(graph.points[p].position, wanted);
        if (degree[p] != 1 || away >= nearest) continue;
        nearest = away;
        graph.roots.assign(1, p);
    }
}

struct Masks {
    tree::Graph graph;
    SkeletonizeFigures figures;
    std::vector<Note> notes;
};

Result<void> add_mask(Masks& masks, SparseMask mask, int system, const glm::dmat4& to_patient,
                      const SkeletonizeOptions& options, const JobRange& job) {
    RAMUS_TRY(memory, memory_for(mask, mask.count(), options));
    SkeletonizeFigures& figures = masks.figures;
    if (options.islands_mm > 0.0)
        figures.islands_dropped += drop_islands(mask, spacing_mm(to_patient), options.islands_mm);
    figures.cavities_filled += fill_cavities(mask);
    const Topology topology = topology_of(mask);
    if (auto fits = check_memory(topology, options); !fits) return fits;
    figures.pieces += topology.pieces, figures.tunnels += topology.tunnels;
    figures.voxels += mask.count();
    if (topology.pieces == 0)
        return fail("no piece is longer than " + std::to_string(options.islands_mm) + " mm", {}, "lower --islands");
    RAMUS_TRY(graph, graph_of_mask(std::move(mask), memory, to_patient, options, masks.notes, job));
    append(masks.graph, graph, system);
    return job.cancelled() ? fail("cancelled") : Result<void>();
}

Result<tree::VesselTree> tree_of(Masks masks, const glm::dmat4& to_patient, const SkeletonizeOptions& options,
                                 SkeletonizeFigures* figures) {
    if (figures != nullptr) *figures = masks.figures;
    if (options.root) choose_root(masks.graph, *options.root);
    // Without joining open ends: pieces of the mask stay pieces.
    constexpr auto kRepair = tree::without(tree::Repair::kUsual, tree::Repair::kOpenEnds);
    auto tree = tree::build_tree(std::move(masks.graph), kRepair, [](std::uint32_t point) {
        return "point " + std::to_string(point) + " of the skeleton";
    });
    if (!tree) return tree;
    tree->voxels = tree::Voxels{glm::dmat3(to_patient), false};
    std::vector<Note>& notes = masks.notes;
    const auto tell = [&](std::uint64_t count, const char* topic, const std::string& one, const std::string& several) {
        if (count > 0)
            notes.push_back(
                {Note::Kind::kRepaired, topic, std::to_string(count) + " " + (count == 1 ? one : several), {}});
    };
    tell(masks.figures.cavities_filled, "fill-holes", "cavity was filled", "cavities were filled");
    tell(masks.figures.islands_dropped, "islands", "island was left out", "islands were left out");
    tree->notes.insert(tree->notes.begin(), notes.begin(), notes.end());
    tree::drop_repeated(tree->notes);
    return tree;
}

Error at_memory_end() { return {"not enough memory for this skeleton", {}, "crop the volume"}; }

} // namespace

Result<tree::VesselTree> skeletonize(BitMask mask, const glm::dmat4& to_patient, const SkeletonizeOptions& options,
                                     Job& job, SkeletonizeFigures* figures) {
    return run_limited(0, at_memory_end, [&]() -> Result<tree::VesselTree> {
        Masks masks;
        SparseMask sparse(mask);
        mask = BitMask(glm::ivec3(0));
        if (auto added = add_mask(masks, std::move(sparse), 0, to_patient, options, JobRange(job, 0.0F, 1.0F)); !added)
            return tl::unexpected(added.error());
        masks.graph.point_systems.clear();
        return tree_of(std::move(masks), to_patient, options, figures);
    });
}

Result<tree::VesselTree> skeletonize(Volume&& volume, std::span<const SystemMask> systems,
                                     const SkeletonizeOptions& options, Job& job, SkeletonizeFigures* figures) {
    return run_limited(0, at_memory_end, [&]() -> Result<tree::VesselTree> {
        Masks masks;
        const auto share = 1.0F / static_cast<float>(systems.size());
        for (std::size_t s = 0; s < systems.size(); ++s) {
            const JobRange part(job, share * static_cast<float>(s), share * static_cast<float>(s + 1));
            RAMUS_TRY(mask, inside_sparsely(volume, {systems[s].labels, systems[s].isovalue}, part.part(0.0F, 0.2F)));
            if (s + 1 == systems.size()) volume.voxels = {};
            if (auto added = add_mask(masks, std::move(mask), static_cast<int>(s), volume.to_patient, options,
                                      part.part(0.2F, 1.0F));
                !added)
                return tl::unexpected(added.error());
        }
        if (systems.size() > 1 || !systems[0].name.empty())
            for (std::size_t s = 0; s < systems.size(); ++s)
                masks.graph.systems.push_back({systems[s].name, systems[s].colour.value_or(colour_of_system(s))});
        else
            masks.graph.point_systems.clear();
        return tree_of(std::move(masks), volume.to_patient, options, figures);
    });
}

} // namespace ramus::volume
