#include "tests/support/peak_memory.h"
#include "tests/support/round_trip.h"
#include "tests/support/tree_bytes.h"

#include <cmath>
#include <doctest/doctest.h>
#include <zlib.h>

using namespace ramus;

namespace {

// A stem of three points and two straight branches from its end, the widths of points.
const std::vector<double> kAmVertices = {0, 0, 0, 0, 0, 10, 3, 0, 14, -3, 0, 14};
const std::vector<double> kAmCorners = {0, 1, 1, 2, 1, 3}, kAmCounts = {3, 2, 2};
const std::vector<double> kAmAlong = {0, 0, 0, 0, 1, 5, 0, 0, 10, 0, 0, 10, 3, 0, 14, 0, 0, 10, -3, 0, 14};
const std::vector<double> kAmThickness = {2, 1.5, 1, 1, 0.5, 0.75, 0.25};

const std::string kAmDefinitions = "\ndefine VERTEX 4\ndefine EDGE 3\ndefine POINT 7\n\n";
const std::string kAmParameters =
    "Parameters {\n    Units {\n        Coordinates \"\xC2\xB5m\"\n    }\n"
    "    SpatialGraphUnitsPoint {\n        thickness {\n            Unit -1,\n"
    "            Dimension -1\n        }\n    }\n    ContentType \"HxSpatialGraph\"\n}\n\n";
const std::string kAmArrays = "VERTEX { float[3] VertexCoordinates } @1\nEDGE { int[2] EdgeConnectivity } @2\n"
                              "EDGE { int NumEdgePoints } @3\nPOINT { float[3] EdgePointCoordinates } @4\n"
                              "POINT { float thickness } @5\nPOINT { float Flow } @6\n\n# Data section follows\n";

std::string am_rows(const std::vector<double>& values, std::size_t in_a_row) {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i)
        text += std::to_string(values[i]) + ((i + 1) % in_a_row == 0 ? "\n" : " ");
    return text;
}

std::string am_text(const std::vector<double>& thickness = kAmThickness) {
    return "# AmiraMesh 3D ASCII 2.0\n" + kAmDefinitions + kAmParameters + kAmArrays + "\n@1\n" +
           am_rows(kAmVertices, 3) + "\n@2\n" + am_rows(kAmCorners, 2) + "\n@3\n" + am_rows(kAmCounts, 1) + "\n@4\n" +
           am_rows(kAmAlong, 3) + "\n@5\n" + am_rows(thickness, 1) + "\n@6\n" + am_rows(kAmThickness, 1);
}

using AmEncode = std::string (*)(const std::string&);

std::string am_binary(std::endian order, const std::string& codec = {}, AmEncode encode = nullptr) {
    std::string header = std::string("# AmiraMesh BINARY") +
                         (order == std::endian::little ? "-LITTLE-ENDIAN 2.1\n" : " 2.0\n") + kAmDefinitions +
                         kAmParameters + kAmArrays;
    std::string data;
    const auto put = [&](int mark, std::string bytes) {
        const std::string name = "@" + std::to_string(mark);
        if (encode != nullptr) {
            bytes = encode(bytes);
            header = test::replaced(header, "} " + name,
                                    "} " + name + "(" + codec + "," + std::to_string(bytes.size()) + ")");
        }
        data += "\n" + name + "\n" + bytes;
    };
    // In an order of their own.
    put(5, test::packed<float>(kAmThickness, order));
    put(1, test::packed<float>(kAmVertices, order));
    put(2, test::packed<std::int32_t>(kAmCorners, order));
    put(6, test::packed<float>(kAmThickness, order));
    put(3, test::packed<std::int32_t>(kAmCounts, order));
    put(4, test::packed<float>(kAmAlong, order));
    return header + data + "\n";
}

std::string am_zip(const std::string& bytes) {
    std::string small(compressBound(bytes.size()), '\0');
    uLongf size = small.size();
    REQUIRE(compress(reinterpret_cast<Bytef*>(small.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
                     bytes.size()) == Z_OK);
    small.resize(size);
    return small;
}

// Each other stretch as a run of equal bytes, where there are some, else as it stands.
std::string am_runs(const std::string& bytes) {
    std::string runs;
    for (std::size_t at = 0; at < bytes.size();) {
        std::size_t end = at + 1;
        while (end < bytes.size() && bytes[end] == bytes[at] && end - at < 127) ++end;
        if (end - at > 1) {
            runs += static_cast<char>(end - at), runs += bytes[at];
        } else {
            while (end + 1 < bytes.size() && bytes[end] != bytes[end + 1] && end - at < 127) ++end;
            runs += static_cast<char>(128 + (end - at)), runs += bytes.substr(at, end - at);
        }
        at = end;
    }
    return runs;
}

void check_am_graph(const Result<tree::VesselTree>& tree) {
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 5); // the ends of edges are those of the vertices
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots == std::vector<std::uint32_t>{0});
    constexpr double kUm = 1e-3;
    CHECK(tree->points[0].radius == doctest::Approx(2 * kUm));
    CHECK(tree->points[1].radius == doctest::Approx(1 * kUm)); // the widest there
    CHECK(tree->points[2].radius == doctest::Approx(0.5 * kUm));
    CHECK(tree->points[3].position.x == doctest::Approx(-3 * kUm));
    CHECK(tree->points[4].position.y == doctest::Approx(1 * kUm));
    CHECK(tree->points[4].radius == doctest::Approx(1.5 * kUm));
    CHECK(test::says(*tree, "\"thickness\" is taken as the radius"));
    CHECK_FALSE(test::says(*tree, "names no unit"));
}

std::string am_refused(const std::string& text) { return test::refusal(text, "t.am"); }

} // namespace

TEST_CASE("a SpatialGraph reads as text and as binary of either byte order, plain or compressed") {
    check_am_graph(io::parse_tree(am_text(), "by its content"));
    for (const std::endian order : {std::endian::little, std::endian::big}) {
        check_am_graph(io::parse_tree(am_binary(order), "t.am"));
        check_am_graph(io::parse_tree(am_binary(order, "HxZip", am_zip), "t.am"));
        check_am_graph(io::parse_tree(am_binary(order, "HxByteRLE", am_runs), "t.am"));
        CHECK(am_refused(am_binary(order, "HxOwn", am_zip)).find("compressed by 'HxOwn'") != std::string::npos);
        std::string damaged = am_binary(order, "HxZip", am_zip);
        damaged[damaged.find("\n@4\n") + 12] ^= 0x55;
        CHECK_FALSE(io::parse_tree(damaged, "t.am").has_value());
    }
}

TEST_CASE("widths of edges, of vertices, and diameters") {
    // One width for each edge, as its points repeat it: each stands at the far end.
    const auto constant = io::parse_tree(am_text({4, 4, 4, 3, 3, 2, 2}), "t.am");
    REQUIRE(constant.has_value());
    CHECK(constant->points[1].radius == doctest::Approx(4e-3));
    CHECK(constant->points[4].radius == doctest::Approx(4e-3));
    CHECK(constant->points[2].radius == doctest::Approx(3e-3));
    CHECK(constant->points[3].radius == doctest::Approx(2e-3));
    const std::string plain = test::replaced(am_text(), am_rows(kAmThickness, 1), "4 3 2\n");
    const auto of_edges =
        io::parse_tree(test::replaced(plain, "POINT { float thickness }", "EDGE { float Radius }"), "t.am");
    REQUIRE_MESSAGE(of_edges.has_value(), (of_edges ? std::string() : of_edges.error().message()));
    CHECK(of_edges->points == constant->points);
    const std::string at_vertices = test::replaced(am_text(), am_rows(kAmThickness, 1), "4 3 2 1\n");
    const auto of_vertices =
        io::parse_tree(test::replaced(at_vertices, "POINT { float thickness }", "VERTEX { float diameter }"), "t.am");
    REQUIRE_MESSAGE(of_vertices.has_value(), (of_vertices ? std::string() : of_vertices.error().message()));
    CHECK(of_vertices->points[0].radius == doctest::Approx(2e-3));
    CHECK(of_vertices->points[4].radius == doctest::Approx(1.75e-3)); // half way
    io::ReadOptions options;
    options.radius_is = io::RadiusIs::kDiameter;
    CHECK(io::parse_tree(am_text(), "t.am", options)->points[0].radius == doctest::Approx(1e-3));
    options = {};
    options.columns["radius"] = "Flow";
    CHECK(io::parse_tree(am_text(), "t.am", options).has_value());
    options.columns["radius"] = "Colour";
    CHECK(io::parse_tree(am_text(), "t.am", options).error().what.find("Flow (POINT)") != std::string::npos);
}

TEST_CASE("edges that are listed backward, or stop short of their vertices, are told and connected") {
    std::string text = am_text();
    const std::string stem = am_rows({0, 0, 0, 0, 1, 5, 0, 0, 10}, 3);
    text = test::replaced(text, stem, am_rows({0, 0, 10, 0, 1, 5, 0, 0, 0}, 3));
    const auto backward = io::parse_tree(text, "t.am");
    REQUIRE(backward.has_value());
    CHECK(tree::length_mm(*backward, backward->branches[0]) ==
          doctest::Approx(2e-3 * std::sqrt(26.0))); // and not 5 to and fro
    const auto apart = io::parse_tree(test::replaced(am_text(), am_rows({0, 0, 10, 0, 0, 10, 3, 0, 14}, 3),
                                                     am_rows({0, 0, 10, 0, 0, 11, 3, 0, 13}, 3)),
                                      "t.am");
    REQUIRE(apart.has_value());
    CHECK(apart->points.size() == 7);
    CHECK(apart->branches.size() == 3);
    CHECK(test::says(*apart, "2 ends of edges that lie apart"));
}

TEST_CASE("vessels that run straight between the same two vertices stay apart") {
    const auto ring = io::parse_tree(
        "# Avizo 3D ASCII 3.0\ndefine VERTEX 2\ndefine EDGE 3\ndefine POINT 6\n"
        "VERTEX { float[3] VertexCoordinates } = @1\nEDGE { int[2] EdgeConnectivity } = @2\n"
        "EDGE { int NumEdgePoints } = @3\nPOINT { double[3] EdgePointCoordinates } = @4\nEDGE { float Radius } = @5\n"
        "@1\n0 0 0 0 0 8\n@2\n0 1 1 0 0 1\n@3\n2 2 2\n@4\n0 0 0 0 0 8 0 0 8 0 0 0 0 0 0 0 0 8\n@5\n3 2 1\n",
        "t.am");
    REQUIRE_MESSAGE(ring.has_value(), (ring ? std::string() : ring.error().message()));
    CHECK(ring->branches.size() == 3);
    CHECK(ring->loop_count == 2);
    REQUIRE(ring->points.size() == 4);
    CHECK(ring->points[2] == tree::Point{{0, 0, 4}, 2.0});
    CHECK(ring->points[3] == tree::Point{{0, 0, 4}, 1.0});
    CHECK(test::says(*ring, "2 vessels run straight between the same two points"));
}

TEST_CASE("what is wrong with a SpatialGraph is told, and what it declares takes no memory") {
    const test::PeakMemory memory;
    const auto with = [&](const std::string& from, const std::string& to) {
        return am_refused(test::replaced(am_text(), from, to));
    };
    const auto has = [](const std::string& text, const char* words) { return text.find(words) != std::string::npos; };
    for (const char* what : {"define POINT 7", "define VERTEX 4", "define EDGE 3"}) {
        const std::string huge = std::string(what).substr(0, std::string(what).size() - 1) + "1000000000";
        CHECK(has(with(what, huge), "are declared"));
        for (const std::endian order : {std::endian::little, std::endian::big})
            for (const AmEncode encode : {AmEncode{nullptr}, AmEncode{am_zip}})
                static_cast<void>(am_refused(test::replaced(am_binary(order, "HxZip", encode), what, huge)));
    }
    CHECK(has(with(am_rows({1, 2}, 2), ""), "EdgeConnectivity (@2) has 4 numbers, 3 EDGE of 2 are declared"));
    CHECK(has(with(am_rows({1, 2}, 2), am_rows({1, 2, 3}, 3)), "has more numbers"));
    CHECK(has(with(am_rows({1, 2}, 2), am_rows({1, 4}, 2)), "edge 1 ends at a vertex that is not one of the 4"));
    CHECK(has(with("\n@3\n3", "\n@3\n4"), "do not have the 7 points"));
    CHECK(has(with("\n@3\n3.0", "\n@3\nx"), "'x00000' in NumEdgePoints is not a number"));
    CHECK(has(with("\n@6\n", "\n@7\n"), "'@7' is the mark of no array"));
    CHECK(has(with("\n@6\n", "\n@5\n"), "@5 is there twice"));
    CHECK(has(with("define EDGE 3", ""), "the number of EDGE is not defined"));
    CHECK(has(with("VertexCoordinates", "Coordinates"), "no VertexCoordinates"));
    CHECK(has(with("float[3] VertexCoordinates", "float[2] VertexCoordinates"), "has 2 numbers for each VERTEX"));
    CHECK(has(with("float[3] VertexCoordinates", "complex[3] VertexCoordinates"), "of type 'complex'"));
    CHECK(has(with("thickness } @5", "colour } @5"), "no array gives the radius: there is colour (POINT), Flow"));
    CHECK(has(with("HxSpatialGraph", "HxUniformScalarField"), "holds a 'HxUniformScalarField'"));
    CHECK(has(with("\xC2\xB5m", "furlong"), "'furlong'"));
    std::string many;
    for (int a = 0; a < 2000; ++a) many += "POINT { int A" + std::to_string(a) + " } @" + std::to_string(a + 7) + "\n";
    CHECK(has(with("# Data section", many + "# Data section"), "more than 1000 arrays"));
    CHECK(memory.grown_mib() < 30.0);
    // A declared array that is not there, though nothing needs it, is told.
    const std::string whole = am_text();
    const auto cut = io::parse_tree(whole.substr(0, whole.rfind("\n@6")), "t.am");
    REQUIRE_MESSAGE(cut.has_value(), (cut ? std::string() : cut.error().message()));
    CHECK(test::says(*cut, "Flow is declared, but not there"));
}
