// The true counts of the real files were made by an independent program, as far as its table has them; the others by
// VTK's own readers. Each row reads one file as a person would and compares all of them.
#include "core/io/trees/tree_file.h"
#include "tests/support/peak_memory.h"
#include "tests/support/shared_data.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <fstream>

using namespace ramus;

namespace {

struct Counts {
    std::size_t nodes, segments, branches, branchings, components;
    int loops;
    double thinnest_mm, thickest_mm, length_mm; // 0: not known
    std::size_t repairs = 0;
};

struct Row {
    std::string file;
    io::ReadOptions options;
    Counts counts;
};

io::ReadOptions in_unit(const char* unit) {
    io::ReadOptions options;
    options.unit = io::length_unit(unit);
    return options;
}

io::ReadOptions diameters_in(const char* unit) {
    io::ReadOptions options = in_unit(unit);
    options.radius_is = io::RadiusIs::kDiameter;
    return options;
}

const std::vector<Row>& rows() {
    static const std::vector<Row> table = {
        {"airways_human.vtu", {}, {12065, 12064, 165, 82, 1, 0, 0.206, 8.19, 1849.3}},
        // 15 points of radius 0 take that of their neighbours. Points are joined where they coincide exactly: four of
        // the joined ones lie within half a nanometre of the next and stay, as they were traced.
        {"tumour_tapmeier.vtp", in_unit("um"), {807, 806, 77, 36, 5, 4, 0.0, 0.02873, 3.60325, 15}},
        {"carotid_centerline.vtp", {}, {428, 427, 3, 1, 1, 0, 0.430, 3.26, 97.87, 1}},
        {"aorta_0066_centerline.vtp", in_unit("cm"), {2396, 2395, 9, 4, 1, 0, 0.558, 3.718, 138.02}},
        {"coronary_227A.vtk", {}, {739, 738, 7, 3, 1, 0, 0.5, 2.50, 396.63}},
        {"penetrating_artery.vtk", in_unit("um"), {1274, 1273, 1, 0, 1, 0, 0.0104, 0.0141, 1.25526}},
        {"penetrating_artery_diameters_on_points.vtk",
         in_unit("um"),
         {1274, 1273, 1, 0, 1, 0, 0.0105, 0.0141, 1.25526}},
        // The fourth column is a diameter, 0.70 to 11.79.
        {"cortex_slab.h5", in_unit("um"), {53113, 52727, 3033, 1318, 500, 114, 0.00035, 0.005897, 53.842}},
        {"cortex_sample.vmv", in_unit("um"), {643, 637, 26, 10, 7, 1, 0.001, 0.00212, 0.779585}},
        // The program that made it of a tree left out what connects each branch with its parent: 108 segments. One
        // radius is 0.
        {"brain_BG0002.vmv", {}, {3514, 3405, 109, 0, 109, 0, 0.0, 2.17, 7245.17, 1}},
        // Diameters. Seven of the 546 edges connect the same two vertices as another, and get a point in the middle.
        {"mesentery.am", diameters_in("um"), {388 + 7, 546 + 7, 546, 352, 1, 159, 0.001575, 0.0296, 134.9794}},
        {"opencco_3D.xml", {}, {1990, 1989, 1989, 994, 1, 0, 0.0638368, 1.67255, 6466.9544}},
        {"vascusynth.xml", {}, {400, 399, 399, 199, 1, 0, 0.00786162, 0.0865237, 3138.2603}},
        // 22 of the nodes lie inside a vessel. The same tree, whichever of both tables is opened.
        {"vesselvio_vertices.csv", {}, {3197, 3249, 3227, 1627, 1, 53, 1.0, 8.80404, 70568.8734}},
        {"vesselvio_edges.csv", {}, {3197, 3249, 3227, 1627, 1, 53, 1.0, 8.80404, 70568.8734}},
    };
    return table;
}

} // namespace

TEST_CASE("real files of other programs have their true counts") {
    for (const Row& row : rows()) {
        CAPTURE(row.file);
        const auto path = test::shared_file("formats", row.file);
        if (!path) continue;
        io::ReadOptions as_it_is = row.options;
        as_it_is.repair = tree::without(as_it_is.repair, tree::Repair::kOpenEnds);
        const auto tree = io::read_tree(*path, as_it_is);
        REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
        const Counts& expected = row.counts;
        CHECK(tree->points.size() == expected.nodes);
        CHECK(tree->segment_count() == expected.segments);
        CHECK(tree->branches.size() == expected.branches);
        CHECK(tree->roots.size() == expected.components);
        CHECK(tree->loop_count == expected.loops);
        std::vector<int> degree(tree->points.size(), 0);
        double length = 0.0;
        for (const auto& branch : tree->branches) {
            ++degree[branch.points.front()], ++degree[branch.points.back()];
            length += tree::length_mm(*tree, branch);
        }
        CHECK(std::ranges::count_if(degree, [](int d) { return d > 2; }) == static_cast<long>(expected.branchings));
        const auto [least, most] = std::ranges::minmax(tree->points, {}, &tree::Point::radius);
        if (expected.thinnest_mm > 0.0) CHECK(least.radius == doctest::Approx(expected.thinnest_mm).epsilon(5e-3));
        if (expected.thickest_mm > 0.0) CHECK(most.radius == doctest::Approx(expected.thickest_mm).epsilon(5e-3));
        if (expected.length_mm > 0.0) CHECK(length == doctest::Approx(expected.length_mm).epsilon(1e-4));
        CHECK(sentences(*tree, tree::Note::Kind::kRepaired).size() == expected.repairs);
    }
}

TEST_CASE("real files that are cut short give a clear error, or a tree, and take no memory") {
    for (const Row& row : rows()) {
        CAPTURE(row.file);
        const auto path = test::shared_file("formats", row.file);
        if (!path) continue;
        std::ifstream file(*path, std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(file), {}};
        const test::PeakMemory memory;
        for (std::size_t part = 0; part < 20; ++part) {
            CAPTURE(part);
            // In steps, and right behind the first bytes, where headers end.
            const std::size_t size = part < 16 ? whole.size() * part / 16 : std::size_t{1} << (part - 9);
            const auto tree = io::parse_tree(std::string_view(whole).substr(0, size), row.file, row.options);
            if (tree) continue;
            CHECK(tree.error().where.starts_with(row.file));
            CHECK_FALSE(tree.error().what.empty());
            CHECK_FALSE(tree.error().hint.empty());
        }
        CHECK(memory.grown_mib() < 30.0 + 40.0 * static_cast<double>(whole.size()) / 1048576.0);
    }
}

TEST_CASE("real SWC files that are cut short give a clear error, or a tree" * doctest::test_suite("slow")) {
    for (const auto& path : test::shared_trees()) {
        const std::string name = path.filename().string();
        CAPTURE(name);
        std::ifstream file(path, std::ios::binary);
        const std::string whole{std::istreambuf_iterator<char>(file), {}};
        for (std::size_t part = 0; part < 20; ++part) {
            CAPTURE(part);
            const auto tree = io::parse_tree(std::string_view(whole).substr(0, whole.size() * part / 20), name);
            if (tree) continue;
            CHECK(tree.error().where.starts_with(name));
            CHECK_FALSE(tree.error().what.empty());
            CHECK_FALSE(tree.error().hint.empty());
        }
    }
}

TEST_CASE("a real file that lists one row less than it declares is refused with its place") {
    const auto path = test::shared_file("formats", "mesentery_one_row_short.am");
    if (!path) return;
    const auto tree = io::read_tree(*path);
    REQUIRE_FALSE(tree.has_value());
    CHECK(tree.error().what == "EdgeConnectivity (@2) has 1090 numbers, 546 EDGE of 2 are declared");
    CHECK(tree.error().where.ends_with("mesentery_one_row_short.am:412"));
}

TEST_CASE("centimetres and diameters of real files are told and taken as asked for") {
    const auto suspicions = [](const std::string& file) {
        const auto path = test::shared_file("formats", file);
        std::string all;
        if (!path) return all;
        const auto tree = io::read_tree(*path);
        REQUIRE(tree.has_value());
        for (const std::string& text : sentences(*tree, tree::Note::Kind::kSuspect)) all += text + "\n";
        return all;
    };
    if (const std::string said = suspicions("aorta_0066_centerline.vtp"); !said.empty()) {
        CHECK(said.find("BranchId, BifurcationId") != std::string::npos);
        CHECK(said.find("SimVascular") != std::string::npos);
        CHECK(said.find("--units cm") != std::string::npos);
        CHECK(suspicions("tumour_tapmeier.vtp").find("--units um") != std::string::npos);
        CHECK(suspicions("coronary_227A.vtk").find("--units") == std::string::npos);
    }
}
