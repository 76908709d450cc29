// What pairs of CSV files promise: either of both is opened, and both are written or none.
#include "core/io/output_file.h"
#include "core/io/trees/csv_pair.h"
#include "core/io/trees/csv_rows.h"
#include "tests/support/grown_tree.h"
#include "tests/support/round_trip.h"
#include "tests/support/shared_data.h"
#include "tests/support/tree_bytes.h"

#include <doctest/doctest.h>
#include <fstream>
#include <iterator>

using namespace ramus;
namespace fs = std::filesystem;

namespace {

constexpr const char* kCsvNodes = "id;pos_x;pos_y;pos_z;degree;isAtSampleBorder\n"
                                  "0;0.5;0;0.25;1;1\n1;0.5;0;8;3;0\n2;3.5;0;12;1;0\n3;-3;0;12;1;0\n";
constexpr const char* kCsvEdges = "id;node1id;node2id;length;minRadiusAvg;avgRadiusAvg;avgRadiusStd\n"
                                  "0;0;1;7.75;1;2;0.1\n1;1;2;5;1;1.5;0.1\n2;3;1;5;1;1;0.1\n";

// What opening the first of two files gives.
Result<tree::VesselTree> opened(const std::string& first, const std::string& first_text, const std::string& second,
                                const std::string& second_text, const io::ReadOptions& options = {}) {
    const TemporaryFolder folder;
    folder.write(second, second_text);
    return io::read_tree(folder.write(first, first_text), options);
}

void check_csv_fork(const Result<tree::VesselTree>& tree) {
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 4);
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    CHECK(tree->points[2].position == glm::dvec3(3.5, 0, 12));
    CHECK(tree->points[0].radius == 2.0);
    CHECK(tree->points[2].radius == 1.5);
    CHECK(tree->points[3].radius == 1.0);
}

std::string csv_error(const std::string& nodes, const std::string& edges) {
    const auto tree = opened("a_nodes.csv", nodes, "a_edges.csv", edges);
    REQUIRE_FALSE(tree.has_value());
    CHECK_FALSE(tree.error().hint.empty());
    const std::string message = tree.error().message();
    return message.substr(message.rfind('/', message.find(".csv")) + 1);
}

std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

} // namespace

TEST_CASE("whichever table of a pair is opened, the other one is found beside it") {
    for (const auto& pair :
         std::vector<std::pair<std::string, std::string>>{{"liver_vertices.csv", "liver_edges.csv"},
                                                          {"nodes.csv", "edges.csv"},
                                                          {"Nodes_7.csv", "Edges_7.csv"},
                                                          {"LIVER-NODES.CSV", "LIVER-EDGES.CSV"},
                                                          {"graph_nodes_processed.csv", "graph_edges_processed.csv"},
                                                          {"liver.csv", "liver_edges.csv"}}) {
        const auto& nodes = pair.first;
        const auto& edges = pair.second;
        CAPTURE(nodes);
        check_csv_fork(opened(nodes, kCsvNodes, edges, kCsvEdges));
        check_csv_fork(opened(edges, kCsvEdges, nodes, kCsvNodes));
    }
}

TEST_CASE("cells are parted by commas or tabs, too, quoted, with any line ends and a mark of UTF-8") {
    const auto with = [](std::string text, const std::string& separator) {
        for (std::size_t at = text.find(';'); at != std::string::npos; at = text.find(';', at + 1))
            text.replace(at, 1, separator);
        return text;
    };
    check_csv_fork(opened("nodes.csv", with(kCsvNodes, ","), "edges.csv", with(kCsvEdges, "\t")));
    std::string windows = "\xEF\xBB\xBF";
    for (const char c : std::string(kCsvNodes)) windows += c == '\n' ? "\r\n" : std::string(1, c);
    check_csv_fork(opened("nodes.csv", windows, "edges.csv", std::string(kCsvEdges) + "\n\n"));
    const std::string quoted =
        test::replaced(test::replaced(kCsvNodes, "pos_x", "\"pos_x\""), "0.5;0;8", "\"0.5\";0 ; 8");
    check_csv_fork(opened("nodes.csv", quoted, "edges.csv", kCsvEdges));
}

TEST_CASE("rows come out of a table as they were put in") {
    io::CsvRows rows("a,\"b \"\"c\"\", d\"\n\n1,\"x\ny\"\r\n,", "t.csv");
    std::vector<std::string_view> cells;
    REQUIRE(rows.next(cells).value());
    CHECK(cells == std::vector<std::string_view>{"a", "b \"c\", d"});
    REQUIRE(rows.next(cells).value());
    CHECK(rows.line() == 3);
    CHECK(cells == std::vector<std::string_view>{"1", "x\ny"});
    REQUIRE(rows.next(cells).value());
    CHECK(rows.line() == 5);
    CHECK(cells == std::vector<std::string_view>{"", ""});
    CHECK_FALSE(rows.next(cells).value());
}

TEST_CASE("a person's names of columns hold in both tables") {
    const std::string nodes = "n,a,b,c\nA,0.5,0,0.25\nB,0.5,0,8\nC,3.5,0,12\nD,-3,0,12\n";
    const std::string edges = "p,q,wide\nA,B,2\nB,C,1.5\nD,B,1\n";
    io::ReadOptions options;
    options.columns = {{"id", "n"}, {"x", "a"}, {"y", "b"}, {"z", "c"}, {"from", "p"}, {"to", "q"}, {"radius", "wide"}};
    check_csv_fork(opened("nodes.csv", nodes, "edges.csv", edges, options));
    CHECK(opened("nodes.csv", nodes, "edges.csv", edges).error().what.find("first line") != std::string::npos);
}

TEST_CASE("whole positions are suspected to be voxels") {
    std::string nodes = "id;pos_x;pos_y;pos_z\n", edges = "node1id;node2id;radius\n";
    for (int n = 0; n < 40; ++n) {
        nodes += std::to_string(n) + ";" + std::to_string(3 * n) + ".0;1;2.5\n";
        if (n > 0) edges += std::to_string(n - 1) + ";" + std::to_string(n) + ";1\n";
    }
    const auto tree = opened("nodes.csv", nodes, "edges.csv", edges);
    REQUIRE(tree.has_value());
    CHECK(test::says(*tree, "as those of voxels are"));
    io::ReadOptions options;
    options.unit = io::length_unit("0.5");
    const auto told = opened("nodes.csv", nodes, "edges.csv", edges, options);
    REQUIRE(told.has_value());
    CHECK_FALSE(test::says(*told, "as those of voxels are"));
    CHECK(told->points[1].position == glm::dvec3(1.5, 0.5, 1.25));
}

TEST_CASE("pairs that are wrong are refused with their file and line") {
    using test::replaced;
    CHECK(csv_error(replaced(kCsvNodes, "1;0.5", "1;half"), kCsvEdges).find("a_nodes.csv:3: x 'half'") == 0);
    CHECK(csv_error(replaced(kCsvNodes, "1;0.5", "1;0,5"), kCsvEdges).find("decimal point") != std::string::npos);
    CHECK(csv_error(replaced(kCsvNodes, "\n1;", "\n0;"), kCsvEdges).find("a_nodes.csv:3: the node '0' is there") == 0);
    CHECK(csv_error(kCsvNodes, replaced(kCsvEdges, "1;1;2", "1;1;9")).find("a_edges.csv:3: the edge names") == 0);
    CHECK(csv_error(kCsvNodes, replaced(kCsvEdges, ";1.5;", ";-2;")).find("a_edges.csv:3: the radius") == 0);
    CHECK(csv_error(kCsvNodes, replaced(kCsvEdges, "5;1;1.5;0.1", "5;1")).find("a_edges.csv:3: the row has 5 cells") ==
          0);
    CHECK(csv_error(kCsvNodes, kCsvNodes).find("a_edges.csv: no columns name the two nodes") == 0);
    CHECK(csv_error(kCsvNodes, "").find("a_edges.csv: the file is empty") == 0);
    CHECK(csv_error("id;pos_x;pos_y;pos_z\n", kCsvEdges).find("which is not there") != std::string::npos);
    CHECK(csv_error(kCsvNodes, "node1id;node2id\n0;1\n").find("gives the radius") != std::string::npos);
    CHECK(csv_error(kCsvNodes, "node1id;node2id;radius\n").find("no edges") != std::string::npos);
    CHECK(csv_error("a;b\n1;2\n", kCsvEdges).find("a_nodes.csv: the first line names neither") == 0);
    CHECK(csv_error(replaced(kCsvNodes, "2;3.5", "2;\"3.5"), kCsvEdges).find("does not end") != std::string::npos);
    const TemporaryFolder folder;
    const auto alone = io::read_tree(folder.write("liver_vertices.csv", kCsvNodes));
    REQUIRE_FALSE(alone.has_value());
    CHECK(alone.error().message().find("put it beside this one as liver_edges.csv") != std::string::npos);
    CHECK(test::refusal(kCsvEdges, "edges.csv").find("stands in another file") != std::string::npos);
}

TEST_CASE("a grown tree comes back from a CSV pair to the bit, and so do networks with loops") {
    tree::VesselTree tree = test::grown(300);
    for (std::size_t p = 0; p < tree.points.size(); ++p) tree.labels.push_back(static_cast<int>(p % 7) - 1);
    for (const char* name : {".csv", "_vertices.csv", "_edges.csv"}) {
        CAPTURE(name);
        const tree::VesselTree read = test::through_a_file(tree, name);
        test::check_same_network(read, tree);
        CHECK(read.labels == tree.labels);
        CHECK(sentences(read, tree::Note::Kind::kRepaired).empty());
    }
    const tree::VesselTree rings = test::rings_and_crossings();
    test::check_same_network(test::through_a_file(rings, ".csv"), rings);
}

TEST_CASE("names of systems may hold what parts cells") {
    tree::Graph graph;
    graph.points = {{{0, 0, 0}, 2}, {{0, 0, 9}, 1}};
    graph.edges = {{0, 1}};
    graph.systems = {{"a; \"b\"\nc", {10, 20, 255}}};
    graph.point_systems = {0, 0};
    const auto tree = tree::build_tree(graph, tree::Repair::kUsual, [](std::uint32_t) { return std::string("g"); });
    REQUIRE(tree.has_value());
    CHECK(test::through_a_file(*tree, ".csv").systems == tree->systems);
}

TEST_CASE("a pair is written as a whole, or nothing is") {
    const TemporaryFolder folder;
    const tree::VesselTree tree = test::grown(20);
    // No file can stand where the second shall.
    fs::create_directory(folder.path() / "tree_edges.csv");
    CHECK_FALSE(io::write_tree(tree, folder.path() / "tree.csv").has_value());
    CHECK(folder.names() == std::vector<std::string>{"tree_edges.csv"});
    // The same, found out only when both are written: the first is new, or an older one is there.
    for (const bool is_there : {false, true}) {
        CAPTURE(is_there);
        const TemporaryFolder other;
        if (is_there) other.write("a", "old");
        auto first = io::OutputFile::create(other.path() / "a"), second = io::OutputFile::create(other.path() / "b");
        REQUIRE(first.has_value());
        REQUIRE(second.has_value());
        first->write("new");
        second->write("new");
        fs::create_directory(other.path() / "b");
        CHECK_FALSE(commit_both(*first, *second).has_value());
        CHECK(other.names() == (is_there ? std::vector<std::string>{"a", "b"} : std::vector<std::string>{"b"}));
        if (is_there) CHECK(other.text("a") == "old");
    }
    const TemporaryFolder good;
    good.write("tree.csv", "old");
    REQUIRE(io::write_tree(tree, good.path() / "tree.csv"));
    CHECK(good.names() == std::vector<std::string>{"tree.csv", "tree_edges.csv"});
    CHECK(good.text("tree.csv") != "old");
}

TEST_CASE("a real pair of which one is cut short gives a clear error, or a tree") {
    const auto nodes = test::shared_file("formats", "vesselvio_vertices.csv");
    const auto edges = test::shared_file("formats", "vesselvio_edges.csv");
    if (!nodes || !edges) return;
    const std::string whole[] = {bytes_of(*nodes), bytes_of(*edges)};
    for (const bool of_edges : {false, true})
        for (std::size_t part = 0; part < 20; ++part) {
            CAPTURE(of_edges);
            CAPTURE(part);
            const std::string cut = whole[of_edges].substr(0, whole[of_edges].size() * part / 20);
            const auto tree =
                opened("a_edges.csv", of_edges ? cut : whole[1], "a_nodes.csv", of_edges ? whole[0] : cut);
            if (tree) {
                CHECK(of_edges); // at the end of a row, no file of edges says how many there are
                continue;
            }
            CHECK(tree.error().where.find(of_edges ? "a_edges.csv" : "a_") != std::string::npos);
            CHECK_FALSE(tree.error().hint.empty());
        }
}
