// The hot loops by themselves, on bricks of a grown tree of 1,504 branches: gathering a brick's segments, sampling its
// points, moving points onto the surface, and splitting octree cubes. `per_kernel` is the time for one vector of 16
// points and one segment.
#include "core/field/vessel_field.h"
#include "core/mesh/polygonize/cells/brick_cells.h"
#include "core/mesh/polygonize/octree/octree.h"
#include "tests/support/grown_tree.h"
#include "tests/support/tree_field.h"

#include <benchmark/benchmark.h>
#include <vector>

using namespace ramus;

namespace {

// Every so many bricks of the surface at detail 16, all that one needs to sample them.
struct Scene {
    field::Field field;
    mesh::bricks::Sizing sizing;
    mesh::bricks::Octree octree;
    std::vector<std::size_t> bricks;

    explicit Scene(const tree::VesselTree& tree)
        : field(test::make_field(tree, {.blend = mesh::Blend::kPaper}, {})),
          sizing(mesh::bricks::make_sizing(field, 16, 0.0)) {
        Job job;
        octree = mesh::bricks::build_octree(field, sizing, job);
        constexpr std::size_t kBricks = 1000; // neighbours, as in real work
        const std::size_t middle = octree.bricks.size() / 2;
        for (std::size_t n = middle; n < std::min(middle + kBricks, octree.bricks.size()); ++n) bricks.push_back(n);
    }

    void gather(std::size_t index, field::BrickField& sum) const {
        const mesh::bricks::Brick& brick = octree.bricks[index];
        sum.enter(octree.segments_of(brick), mesh::bricks::grid_axes(octree.lattice, brick));
    }
    [[nodiscard]] std::vector<std::unique_ptr<field::BrickField>> all_gathered() const {
        std::vector<std::unique_ptr<field::BrickField>> sums;
        for (const std::size_t brick : bricks) gather(brick, *sums.emplace_back(field.in_brick()));
        return sums;
    }
};

const Scene& scene() {
    static const Scene made(*test::grown_tree(1504));
    return made;
}

void per_kernel(benchmark::State& state, std::uint64_t kernels) {
    state.counters["per_kernel"] = benchmark::Counter(static_cast<double>(kernels) / field::kGroupPoints,
                                                      benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void gather_segments(benchmark::State& state) {
    const auto sum = scene().field.in_brick();
    for (auto _ : state)
        for (const std::size_t brick : scene().bricks) scene().gather(brick, *sum);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(scene().bricks.size()));
}
BENCHMARK(gather_segments);

void sample_own_points(benchmark::State& state) {
    const auto sums = scene().all_gathered();
    field::GridGroups groups;
    std::uint64_t kernels = 0;
    for (auto _ : state)
        for (const auto& sum : sums) kernels += sum->sample_groups(field::kOwnGroups, groups);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sums.size()));
    per_kernel(state, kernels);
}
BENCHMARK(sample_own_points);

void project_points(benchmark::State& state) {
    const auto sums = scene().all_gathered();
    std::vector<field::Projection> points(sums.size());
    std::size_t most = 0;
    for (std::size_t n = 0; n < sums.size(); ++n) {
        field::GridGroups groups;
        sums[n]->sample_groups(field::kOwnGroups, groups);
        const mesh::bricks::Octree& octree = scene().octree;
        const auto cell = static_cast<float>(octree.lattice.cell_mm(octree.bricks[scene().bricks[n]].level));
        // Grid points near the surface.
        for (std::size_t layer = 0; layer < 4; ++layer)
            for (std::size_t p = 0; p < field::kGroupPoints; ++p) {
                const glm::vec3 at = cell * glm::vec3(p % 4, p / 4, layer);
                const float value = groups.value[layer][p];
                if (value > 0.02F && value < 0.05F) points[n].add(at, at, cell);
            }
        most = std::max(most, points[n].size());
    }
    most += field::kProjectionPadding;
    std::vector<glm::vec3> positions(most), normals(most);
    std::vector<float> radii(most);
    std::vector<std::int32_t> branches(most);
    std::vector<field::Dominance> dominance(most);
    std::uint64_t kernels = 0;
    for (auto _ : state)
        for (std::size_t n = 0; n < sums.size(); ++n)
            kernels += sums[n]->project(
                points[n], {positions.data(), normals.data(), radii.data(), branches.data(), dominance.data()});
    per_kernel(state, kernels);
}
BENCHMARK(project_points);

void build_octree(benchmark::State& state) {
    Job job;
    for (auto _ : state) {
        auto octree = mesh::bricks::build_octree(scene().field, scene().sizing, job);
        benchmark::DoNotOptimize(octree);
    }
}
BENCHMARK(build_octree)->Unit(benchmark::kMillisecond);

} // namespace

BENCHMARK_MAIN();
