// What changing a surface costs beside making it: hiding and showing a subtree, pruning, smoothing, another width,
// another detail, on a grown tree or on the one named on the command line.
#include "core/field/vessel_field.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/polygonize/polygonizer.h"
#include "tests/support/grown_tree.h"
#include "tests/support/tree_field.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>

using namespace ramus;

namespace {

double milliseconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

// The subtrees nearest to a share of all branches.
std::vector<std::vector<int>> subtrees_of_share(const tree::VesselTree& tree, double share, std::size_t count) {
    std::vector<std::pair<double, int>> order;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const auto size = static_cast<double>(tree::subtree(tree, static_cast<int>(b)).size());
        order.emplace_back(std::abs(size / static_cast<double>(tree.branches.size()) - share), static_cast<int>(b));
    }
    std::ranges::sort(order);
    std::vector<std::vector<int>> found;
    for (std::size_t n = 0; n < std::min(count, order.size()); ++n)
        found.push_back(tree::subtree(tree, order[n].second));
    return found;
}

struct Row {
    std::vector<double> milliseconds;
    std::size_t written = 0, triangles = 0;
};

void print(const char* name, const Row& row) {
    std::printf("%-34s %9.2f %9.2f %12zu\n", name, median(row.milliseconds),
                *std::ranges::min_element(row.milliseconds), row.written);
}

void measure(const tree::VesselTree& tree, int runs, double share) {
    const mesh::SurfaceOptions usual;
    mesh::PolygonizeOptions options;
    mesh::Polygonizer polygonizer;
    std::vector<std::uint8_t> hidden(tree.branches.size(), 0);
    Job job;
    const auto update = [&](Row& row, const field::Field& field) {
        row.milliseconds.push_back(milliseconds_of([&] { (void)polygonizer.update(field, options, job); }));
        const mesh::SurfaceEdit edit = polygonizer.take_edit();
        row.written = edit.whole ? polygonizer.slots().triangles.size() : 0;
        for (const mesh::SlotRange& range : edit.triangles) row.written += edit.whole ? 0 : range.count;
    };
    std::printf("%-34s %9s %9s %12s\n", "", "median ms", "best ms", "triangles");
    const field::Field all = test::make_field(tree, usual, {});
    Row whole;
    for (int run = 0; run < runs; ++run) {
        polygonizer = mesh::Polygonizer();
        update(whole, all);
    }
    print("the whole surface", whole);
    Row hide, show;
    const auto subtrees = subtrees_of_share(tree, share, static_cast<std::size_t>(runs));
    for (const auto& subtree : subtrees) {
        for (const int b : subtree) hidden[static_cast<std::size_t>(b)] = 1;
        update(hide, all.without(hidden));
        hidden.assign(hidden.size(), 0);
        update(show, all);
    }
    print(("hide a subtree of " + std::to_string(std::lround(100.0 * share)) + " %").c_str(), hide);
    print("show it again", show);
    const auto there_and_back = [&](const char* name, const mesh::SurfaceOptions& changed, int detail) {
        Row there;
        Row back;
        for (int run = 0; run < runs; ++run) {
            const int usual_detail = options.detail;
            options.detail = detail;
            update(there, test::make_field(tree, changed, {}));
            options.detail = usual_detail;
            update(back, all);
        }
        print(name, there);
    };
    mesh::SurfaceOptions changed = usual;
    changed.prune_ratio = 0.3;
    there_and_back("prune at 0.3", changed, options.detail);
    changed = usual;
    changed.smooth_passes = 2;
    there_and_back("smooth once more", changed, options.detail);
    changed = usual;
    changed.width = 4.0;
    there_and_back("another width", changed, options.detail);
    there_and_back("another width, coarse (detail 8)", changed, 8);
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("What changing a surface costs");
    std::string file;
    int branches = 1504;
    int runs = 7;
    double share = 0.05;
    app.add_option("FILE", file, "vessel tree, instead of a grown one");
    app.add_option("--branches", branches, "size of the grown tree")->capture_default_str();
    app.add_option("--runs", runs)->capture_default_str()->check(CLI::PositiveNumber);
    app.add_option("--share", share, "of all branches that are hidden")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    const auto tree = file.empty() ? test::grown_tree(branches) : io::read_tree(file);
    if (!tree) {
        std::fprintf(stderr, "%s\n", tree.error().message().c_str());
        return 1;
    }

    measure(*tree, runs, share);
    return 0;
}
