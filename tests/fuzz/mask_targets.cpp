// The skeletonizer on small masks. Eight bytes say how large the mask is, how large its voxels are and what is asked
// for; the bits of the others are its voxels, over and over until it is full.
#include "core/volume/skeletonize/skeletonize.h"
#include "core/volume/skeletonize/topology.h"
#include "tests/fuzz/target.h"
#include "tests/support/mask.h"
#include "tests/support/voxel_topology.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace ramus::fuzz {

namespace {

constexpr std::size_t kHead = 8;

struct SmallMask {
    volume::BitMask mask;
    glm::dvec3 spacing;
    volume::SkeletonizeOptions options;
};

SmallMask small_mask(std::string_view bytes) {
    const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(bytes[n]); };
    const glm::ivec3 size(1 + byte(0) % 24, 1 + byte(1) % 24, 1 + byte(2) % 24);
    const glm::dvec3 spacing(0.1 + byte(3) / 64.0, 0.1 + byte(4) / 64.0, 0.1 + byte(5) / 64.0);
    volume::SkeletonizeOptions options;
    options.bulge_size = byte(6) / 64.0;
    options.fill_holes = (byte(7) & 1U) != 0;
    if ((byte(7) & 2U) != 0) options.islands_mm = (byte(7) >> 4U) * 0.5;
    if ((byte(7) & 4U) != 0) options.root = spacing * glm::dvec3(size) * static_cast<double>(byte(7) >> 4U) / 16.0;
    const std::string_view bits = bytes.substr(kHead);
    const auto is_inside = [&](const glm::ivec3& at) {
        const auto n = static_cast<std::size_t>(at.x + size.x * (at.y + size.y * at.z));
        return ((static_cast<unsigned char>(bits[n / 8 % bits.size()]) >> (n % 8)) & 1U) != 0;
    };
    return {test::mask_of(size, is_inside), spacing, options};
}

// Of small masks counted the slow way. A cavity is filled before tunnels are counted: what runs around it, or through
// what lies in it, is none any more.
volume::Topology counted_topology(const volume::BitMask& mask) {
    constexpr int kMost = 600;
    volume::SparseMask filled(mask);
    volume::fill_cavities(filled);
    if (mask.size().x * mask.size().y * mask.size().z > kMost) {
        volume::Topology counted = volume::topology_of(filled);
        counted.cavities = volume::topology_of(mask).cavities;
        return counted;
    }
    const test::VoxelTopology counted = test::voxel_topology(test::bits_of(filled));
    must(counted.cavities == 0, "a cavity was not filled");
    const long tunnels = counted.pieces - counted.euler;
    must(tunnels >= 0, "there are less than no tunnels");
    return {static_cast<std::uint64_t>(counted.pieces), static_cast<std::uint64_t>(tunnels),
            static_cast<std::uint64_t>(test::voxel_topology(mask).cavities)};
}

void skeletonize_bytes(std::string_view bytes) {
    if (bytes.size() <= kHead) return;
    const auto [mask, spacing, options] = small_mask(bytes);
    if (mask.count() == 0) return;
    Job job;
    volume::SkeletonizeFigures figures;
    const auto tree = volume::skeletonize(mask, test::voxels_of(spacing), options, job, &figures);
    if (!tree) {
        must(options.islands_mm > 0.0, "a mask has no tree: " + tree.error().message());
        return must(!tree.error().hint.empty(), "an error has no remedy: " + tree.error().message());
    }
    check_tree(*tree);
    volume::SparseMask kept(mask);
    if (options.islands_mm > 0.0) volume::drop_islands(kept, spacing, options.islands_mm);
    const volume::Topology topology = counted_topology(test::bits_of(kept));
    must(figures.cavities_filled == topology.cavities && figures.pieces == topology.pieces &&
             figures.tunnels == topology.tunnels,
         "the topology of a mask is counted otherwise");
    must(tree->roots.size() == topology.pieces, "a tree has other pieces than its mask");
    const auto loops = static_cast<std::uint64_t>(tree->loop_count);
    must(options.fill_holes ? loops == 0 : loops == topology.tunnels, "a tree has other loops than its mask");
    // An end goes straight on for up to five radii and tapers to 0.3 of one, wherever that leads in a mask of noise.
    constexpr double kEnd = 5.0 / 0.3;
    const glm::dvec3 far = spacing * glm::dvec3(mask.size());
    for (const tree::Point& point : tree->points)
        must(glm::all(glm::greaterThanEqual(point.position, -spacing - kEnd * point.radius)) &&
                 glm::all(glm::lessThanEqual(point.position, far + kEnd * point.radius)),
             "a point lies far beside the mask");
}

} // namespace

std::vector<Target> mask_targets() { return {{"mask", skeletonize_bytes}}; }

} // namespace ramus::fuzz
