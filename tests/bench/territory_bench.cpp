// How right are territories of a tree of which only the thick branches are seen? Grows organs whose supply is known to
// the last leaf, prunes the trees to their N thickest branches (as they are counted then), and compares territories of
// the pruned trees with the truth. Prints a line for each organ, and the means over the organs.
//
//     ramus_bench_territories [--leaves 30000] [--seeds 6] [--voxel 2] [--organ MASK ...] [--noise 0.15]
//                             [--missing 0.25] [--tip-reach 6] [--axis-back 4]
//
// --speed FOLDER: measures the first labelling, a changed cut and the memory for 2.5 million voxels and 18,000
// segments, and writes both for other programs (territory_peers.py), instead.
#include "core/io/volumes/volume_file.h"
#include "core/measure/cuts.h"
#include "core/organ/remnant.h"
#include "core/tree/grow/grow.h"
#include "tests/bench/territory_truth.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <random>
#include <span>
#include <string>
#include <sys/resource.h>
#include <vector>

using namespace ramus;

namespace {

struct Flags {
    int leaves = 30000, seeds = 6;
    double voxel = 2.0, noise = 0.0, missing = 0.0;
    std::vector<std::string> organs;
    std::string speed;
    organ::SupplyOptions supply;
};

struct Means {
    double dice = 0.0, volume_error = 0.0, least = 1.0;
    int count = 0;
    void add(const bench::Score& score) {
        dice += score.dice;
        volume_error += score.volume_error;
        least = std::min(least, score.dice);
        ++count;
    }
};
using Table = std::map<std::array<std::size_t, 3>, Means>; // by visible branches, parts, rule

constexpr std::array kRules{organ::Rule::kTips, organ::Rule::kAxis, organ::Rule::kWall};

void measure_organ(const bench::Truth& truth, const Flags& flags, std::uint64_t seed, Table& table) {
    for (const std::size_t count : {60, 300, 1000}) {
        std::mt19937_64 random(seed);
        const std::vector<char> shown = bench::thickest(truth.tree, count);
        std::vector<char> visible = shown;
        if (flags.missing > 0.0) bench::lose_ends(truth.tree, visible, flags.missing, random);
        const bench::Seen seen = bench::seen_of(truth.tree, visible, flags.noise, random);
        for (const std::size_t parts : {2, 4, 8}) {
            const std::vector<int> heads = bench::heads_of(truth.tree, shown, parts);
            const std::vector<int> groups = bench::groups_of(truth.tree, heads);
            const organ::Grouping grouping = bench::grouping_of(seen, truth.tree, groups, heads.size());
            for (std::size_t n = 0; n < kRules.size(); ++n) {
                organ::SupplyOptions options = flags.supply;
                options.rule = kRules[n];
                Job job;
                const auto supply = organ::supply_of(truth.organ, seen.tree, options, organ::trunk_of(grouping),
                                                     JobRange(job, 0.0F, 1.0F))
                                        .value();
                const bench::Score score =
                    bench::score_of(truth, groups, organ::voxel_groups(supply, grouping), heads.size());
                table[{count, parts, n}].add(score);
                std::printf("%s, %zu visible, %zu parts, %s: %.4f %.4f\n", truth.name.c_str(), count, heads.size(),
                            std::string(organ::name_of(options.rule)).c_str(), score.dice, score.volume_error);
                std::fflush(stdout);
            }
        }
    }
}

void print_means(const Table& table) {
    std::printf("\n| visible branches | parts | rule | Dice | volume error | least Dice of an organ |\n");
    for (const auto& [key, means] : table)
        std::printf("| %zu | %zu | %s | %.3f | %.1f %% | %.3f |\n", key[0], key[1],
                    std::string(organ::name_of(kRules[key[2]])).c_str(), means.dice / means.count,
                    100.0 * means.volume_error / means.count, means.least);
}

double seconds_of(const std::function<void()>& work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double peak_mb() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void write_points(const std::filesystem::path& file, const std::vector<glm::dvec3>& points) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(points.data()),
               static_cast<std::streamsize>(points.size() * sizeof(glm::dvec3)));
}

void measure_speed(const std::filesystem::path& folder) {
    constexpr int kLeaves = 1250; // 18,000 segments of 1 mm
    const bench::Truth truth = bench::grown_liver(kLeaves, 1, 0.85);
    std::size_t segments = 0;
    for (const tree::Branch& branch : truth.tree.branches) segments += branch.points.size() - 1;
    const double before = peak_mb();
    for (const organ::Rule rule : {organ::Rule::kTips, organ::Rule::kAxis}) {
        organ::Supply supply;
        double first = 1e9, cut = 1e9;
        for (int n = 0; n < 3; ++n) {
            Job job;
            first = std::min(
                first, seconds_of([&] {
                    supply = organ::supply_of(truth.organ, truth.tree, {rule}, {}, JobRange(job, 0.0F, 1.0F)).value();
                }));
            const organ::SystemSupply system{organ::Role::kSupplies, supply.branch, supply.at};
            cut =
                std::min(cut, seconds_of([&] {
                             const auto spans = measure::lost_spans(truth.tree, std::vector{measure::Cut{1, 0.1 * n}});
                             (void)organ::remnant_of(std::span(&system, 1), spans, {});
                         }));
        }
        std::printf("ramus, by %s: %zu voxels, %zu segments: %.3f s, a changed cut %.4f s, memory %.0f MB\n",
                    std::string(organ::name_of(rule)).c_str(), truth.organ.count(), segments, first, cut,
                    peak_mb() - before);
    }
    std::vector<glm::dvec3> centres, points;
    truth.organ.for_voxels(
        [&](const glm::ivec3& voxel, std::size_t) { centres.push_back(truth.organ.centre_mm(voxel)); });
    for (const tree::Point& point : truth.tree.points) points.push_back(point.position);
    write_points(folder / "voxels.f64", centres);
    write_points(folder / "points.f64", points);
}

} // namespace

int main(int argc, char** argv) {
    Flags flags;
    CLI::App app("Territories against organs whose supply is known");
    app.add_option("--leaves", flags.leaves);
    app.add_option("--seeds", flags.seeds, "Of the liver that is built in: 1 to this");
    app.add_option("--voxel", flags.voxel, "Of the liver that is built in, mm");
    app.add_option("--organ", flags.organs, "Masks of further organs, each with seed 1");
    app.add_option("--noise", flags.noise, "Of the radii: standard deviation of their logarithms, by branch");
    app.add_option("--missing", flags.missing, "Part of the visible end branches that is lost");
    app.add_option("--tip-reach", flags.supply.tip_reach);
    app.add_option("--axis-back", flags.supply.axis_back);
    app.add_option("--speed", flags.speed, "Folder for the voxels and points");
    CLI11_PARSE(app, argc, argv);
    if (!flags.speed.empty()) {
        measure_speed(flags.speed);
        return 0;
    }
    Table table;
    for (int seed = 1; seed <= flags.seeds; ++seed) {
        const auto number = static_cast<std::uint64_t>(seed);
        measure_organ(bench::grown_liver(flags.leaves, number, flags.voxel), flags, number, table);
    }
    for (const std::string& file : flags.organs) {
        Job job;
        const auto volume = io::read_volume(file, {}, job);
        const auto organ = volume ? organ::organ_of(*volume, {}, JobRange(job, 0.0F, 1.0F))
                                  : Result<organ::Organ>(tl::unexpected(volume.error()));
        if (!organ) {
            std::fprintf(stderr, "%s\n", organ.error().message().c_str());
            return 1;
        }
        const std::string name = std::filesystem::path(file).filename().string();
        measure_organ(bench::grown_in(name, *organ, flags.leaves, 1), flags, 1, table);
    }
    print_means(table);
    return 0;
}
