// The same small tree in every way that VTK's files can be written, by an encoder of the test's own, and what must not
// be believed of such files. tests/cli/test_trees_with_vtk.py does the same with files that VTK itself wrote.
#include "tests/support/peak_memory.h"
#include "tests/support/tree_bytes.h"

#include <algorithm>
#include <doctest/doctest.h>
#include <zlib.h>

using namespace ramus;

namespace {

// A vessel that parts in two. All numbers are exact in single precision.
const std::vector<double> kPositions = {0, 0, 0, 0, 0, 10, 0.25, 0, 20, -5, 0, 30, 5, 0.5, 30};
const std::vector<double> kRadii = {2, 1.5, 1.25, 0.75, 0.625};
const std::vector<int> kCorners = {0, 1, 2, 2, 3, 2, 4}, kEnds = {3, 5, 7};

std::string base64(const std::string& bytes) {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k) text += i + k > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * k) & 63U];
    }
    return text;
}

struct Style {
    const char* name;
    bool appended = false, base64 = true, compressed = false, wide = false;
    std::endian order = std::endian::little;
};

const std::vector<Style> kStyles = {
    {.name = "base64 in place"},
    {.name = "compressed in place", .compressed = true},
    {.name = "appended raw", .appended = true, .base64 = false},
    {.name = "appended raw, wide headers", .appended = true, .base64 = false, .wide = true},
    {.name = "appended base64, big-endian", .appended = true, .order = std::endian::big},
    {.name = "appended raw, compressed", .appended = true, .base64 = false, .compressed = true},
    {.name = "appended base64, compressed, wide, big-endian",
     .appended = true,
     .compressed = true,
     .wide = true,
     .order = std::endian::big},
};

class XmlFile {
public:
    explicit XmlFile(const Style& style) : style_(style) {}

    template <class T, class From>
    std::string array(const char* type, const char* name, const std::vector<From>& values, int components = 1) {
        std::string element = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                              "\" NumberOfComponents=\"" + std::to_string(components) + "\" ";
        const std::string bytes = encoded(test::packed<T>(values, style_.order));
        if (!style_.appended) return element + "format=\"binary\">\n " + bytes + "\n</DataArray>";
        element += "format=\"appended\" offset=\"" + std::to_string(appended_.size()) + "\"/>";
        appended_ += bytes;
        return element;
    }

    [[nodiscard]] std::string text(const std::string& type, const std::string& body) const {
        std::string all = "<?xml version=\"1.0\"?>\n<VTKFile type=\"" + type + "\" version=\"1.0\" byte_order=\"" +
                          (style_.order == std::endian::big ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
                          (style_.wide ? "UInt64\"" : "UInt32\"") +
                          (style_.compressed ? " compressor=\"vtkZLibDataCompressor\"" : "") + ">\n<" + type + ">\n" +
                          body + "\n</" + type + ">\n";
        if (style_.appended)
            all += std::string("<AppendedData encoding=\"") + (style_.base64 ? "base64" : "raw") + "\">\n _" +
                   appended_ + "\n</AppendedData>\n";
        return all + "</VTKFile>\n";
    }

private:
    [[nodiscard]] std::string header(const std::vector<std::uint64_t>& values) const {
        return style_.wide ? test::packed<std::uint64_t>(values, style_.order)
                           : test::packed<std::uint32_t>(values, style_.order);
    }

    // In blocks of 16 bytes, so that there are several and a short last one.
    [[nodiscard]] std::string encoded(const std::string& bytes) const {
        if (!style_.compressed) {
            const std::string all = header({bytes.size()}) + bytes;
            return style_.base64 ? base64(all) : all;
        }
        std::vector<std::uint64_t> sizes = {(bytes.size() + 15) / 16, 16, bytes.size() % 16};
        std::string blocks;
        for (std::size_t at = 0; at < bytes.size(); at += 16) {
            const std::string part = bytes.substr(at, 16);
            std::vector<Bytef> small(compressBound(part.size()));
            uLongf size = small.size();
            REQUIRE(compress(small.data(), &size, reinterpret_cast<const Bytef*>(part.data()), part.size()) == Z_OK);
            blocks.append(reinterpret_cast<const char*>(small.data()), size);
            sizes.push_back(size);
        }
        return style_.base64 ? base64(header(sizes)) + base64(blocks) : header(sizes) + blocks;
    }

    const Style& style_;
    std::string appended_;
};

std::string vtp(const Style& style) {
    XmlFile file(style);
    const std::string body = "<Piece NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"3\" NumberOfStrips=\"0\" "
                             "NumberOfPolys=\"0\">\n<PointData>" +
                             file.array<float>("Float32", "Other", std::vector<double>(15, 1.0), 3) +
                             file.array<float>("Float32", "MaximumInscribedSphereRadius", kRadii) +
                             "</PointData>\n<Points>" + file.array<double>("Float64", "Points", kPositions, 3) +
                             "</Points>\n<Lines>" + file.array<std::int64_t>("Int64", "connectivity", kCorners) +
                             file.array<std::int32_t>("Int32", "offsets", kEnds) + "</Lines></Piece>";
    return file.text("PolyData", body);
}

std::string vtu(const Style& style) {
    XmlFile file(style);
    const std::string body =
        "<Piece NumberOfPoints=\"5\" NumberOfCells=\"4\">\n<PointData>" +
        file.array<double>("Float64", "radius", kRadii) + "</PointData>\n<Points>" +
        file.array<float>("Float32", "Points", kPositions, 3) + "</Points>\n<Cells>" +
        file.array<std::int32_t>("Int32", "connectivity", std::vector<int>{0, 1, 2, 2, 3, 0, 2, 4}) +
        file.array<std::int32_t>("Int32", "offsets", std::vector<int>{3, 5, 6, 8}) +
        file.array<std::uint8_t>("UInt8", "types", std::vector<int>{4, 3, 1, 3}) + "</Cells></Piece>";
    return file.text("UnstructuredGrid", body);
}

void check_fork(const Result<tree::VesselTree>& tree) {
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    REQUIRE(tree->points.size() == 5);
    REQUIRE(tree->branches.size() == 3);
    CHECK(tree->branches[1].parent == 0);
    CHECK(tree->branches[2].parent == 0);
    for (std::size_t p = 0; p < 5; ++p) {
        const tree::Point& point = tree->points[p];
        CHECK(point.position == glm::dvec3(kPositions[3 * p], kPositions[3 * p + 1], kPositions[3 * p + 2]));
        CHECK(point.radius == kRadii[p]);
    }
}

const std::string kPointLines = "POINTS 5 float\n0 0 0 0 0 10 0.25 0 20 -5 0 30 5 0.5 30\n";

std::string legacy(const std::string& version, const std::string& lines, const std::string& data) {
    return "# vtk DataFile Version " + version + "\nmade by a test\nASCII\nDATASET POLYDATA\n" + kPointLines + lines +
           data;
}

const std::string kLegacyRadii = "POINT_DATA 5\nFIELD FieldData 2\nOther%20One 1 5 int\n1 2 3 4 5\n"
                                 "Radius 1 5 double\n2 1.5 1.25 0.75 0.625\n";

} // namespace

TEST_CASE("VTK's XML files read alike however their numbers are written") {
    for (const Style& style : kStyles) {
        CAPTURE(style.name);
        check_fork(io::parse_tree(vtp(style), "y.vtp"));
        check_fork(io::parse_tree(vtu(style), "y.vtu"));
        check_fork(io::parse_tree(vtu(style), "misnamed.txt")); // the content tells
    }
}

TEST_CASE("VTK's XML files read in text, of several pieces, with radii of cells") {
    const auto piece = [](const std::string& points, const std::string& ends, const std::string& cells, int count,
                          const std::string& radii) {
        return "<Piece NumberOfPoints=\"" + std::to_string(count) +
               "\" NumberOfLines=\"1\"><Points><DataArray "
               "type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">" +
               points + "</DataArray></Points><Lines><DataArray Name=\"connectivity\" format=\"ascii\">" + cells +
               "</DataArray><DataArray Name=\"offsets\" format=\"ascii\">" + ends +
               "</DataArray></Lines><CellData><DataArray Name=\"Diameter\" format=\"ascii\">" + radii +
               "</DataArray></CellData></Piece>";
    };
    const std::string text = "<?xml version='1.0'?><VTKFile type='PolyData'><PolyData>" +
                             piece("0 0 0  0 0 10  0 0 20", "3", "0 1 2", 3, "4") +
                             piece("0 0 20  0 5 30", "2", "0 1", 2, "2") +
                             piece("0 0 20  0 -5 30", "2", "0 1", 2, "3") + "</PolyData></VTKFile>";
    const auto tree = io::parse_tree(text, "pieces.vtp");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    CHECK(tree->points.size() == 5); // the pieces meet in one
    CHECK(tree->branches.size() == 3);
    CHECK(std::ranges::max(tree->points, {}, &tree::Point::radius).radius == 2.0);
    CHECK(std::ranges::min(tree->points, {}, &tree::Point::radius).radius == 1.0);
}

TEST_CASE("legacy VTK files read in both layouts of cells") {
    check_fork(io::parse_tree(legacy("3.0", "LINES 3 10\n3 0 1 2\n2 2 3\n2 2 4\n", kLegacyRadii), "y.vtk"));
    check_fork(io::parse_tree(legacy("5.1",
                                     "METADATA\nINFORMATION 1\nNAME A LOCATION B\nDATA 1 0\n\nLINES 4 7\nOFFSETS "
                                     "vtktypeint64\n0 3 5 7\nCONNECTIVITY vtktypeint64\n0 1 2 2 3 2 4\n",
                                     kLegacyRadii),
                              "y.vtk"));
    const std::string scalars = "POINT_DATA 5\nSCALARS Flow float 3\nLOOKUP_TABLE default\n1 1 1 1 1 1 1 1 1 1 1 1 1 1 "
                                "1\nSCALARS radii float\nLOOKUP_TABLE default\n2 1.5 1.25 0.75 0.625\n";
    check_fork(
        io::parse_tree(legacy("2.0", "VERTICES 1 2\n1 0\nLINES 3 10\n3 0 1 2\n2 2 3\n2 2 4\n", scalars), "y.vtk"));
    check_fork(io::parse_tree("# vtk DataFile Version 4.2\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n" + kPointLines +
                                  "CELLS 4 12\n3 0 1 2\n2 2 3\n1 0\n2 2 4\nCELL_TYPES 4\n4 3 1 3\n" + kLegacyRadii,
                              "y.vtk"));
}

TEST_CASE("legacy VTK files read in binary") {
    constexpr std::endian kBig = std::endian::big; // always
    const std::string head = "# vtk DataFile Version 4.2\nt\nBINARY\nDATASET POLYDATA\nPOINTS 5 double\n" +
                             test::packed<double>(kPositions, kBig) + "\n";
    const std::string radii = "\nPOINT_DATA 5\nFIELD FieldData 2\nname 1 5 string\n" +
                              std::string("\xC1"
                                          "a\xC1"
                                          "b\xC0\xC0\xC0") +
                              "\nradius 1 5 float\n" + test::packed<float>(kRadii, kBig) + "\n";
    check_fork(io::parse_tree(head + "LINES 3 10\n" +
                                  test::packed<std::int32_t>(std::vector<int>{3, 0, 1, 2, 2, 2, 3, 2, 2, 4}, kBig) +
                                  radii,
                              "y.vtk"));
    check_fork(io::parse_tree(head + "LINES 4 7\nOFFSETS vtktypeint64\n" +
                                  test::packed<std::int64_t>(std::vector<int>{0, 3, 5, 7}, kBig) +
                                  "\nCONNECTIVITY vtktypeint64\n" + test::packed<std::int64_t>(kCorners, kBig) + radii,
                              "y.vtk"));
}

TEST_CASE("the array of widths is found by its name, or named by a person") {
    const std::string lines = "LINES 3 10\n3 0 1 2\n2 2 3\n2 2 4\n";
    const std::string two =
        "POINT_DATA 5\nFIELD f 2\nwall 1 5 double\n2 2 2 2 2\nDiameter 1 5 double\n4 3 2.5 1.5 1.25\n";
    check_fork(io::parse_tree(legacy("3.0", lines, two), "y.vtk"));
    io::ReadOptions options;
    options.columns["radius"] = "wall";
    const auto asked = io::parse_tree(legacy("3.0", lines, two), "y.vtk", options);
    REQUIRE(asked.has_value());
    CHECK(asked->points[4].radius == 2.0);
    options.columns["radius"] = "Wandstärke";
    const auto wrong = io::parse_tree(legacy("3.0", lines, two), "y.vtk", options);
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().what.find("Wandstärke") != std::string::npos);
    CHECK(test::refusal(legacy("3.0", lines, "POINT_DATA 5\nSCALARS flow float\nLOOKUP_TABLE default\n1 1 1 1 1\n"),
                        "y.vtk")
              .find("flow (points)") != std::string::npos);
}

TEST_CASE("files of 3D Slicer say where their axes lead") {
    const std::string lines = "LINES 3 10\n3 0 1 2\n2 2 3\n2 2 4\n", plain = legacy("4.2", lines, kLegacyRadii);
    const auto turned = io::parse_tree(test::replaced(plain, "made by a test", "3D Slicer output. SPACE=LPS"), "s.vtk");
    REQUIRE(turned.has_value());
    CHECK(turned->points[4].position == glm::dvec3(-5, -0.5, 30));
    const auto straight =
        io::parse_tree(test::replaced(plain, "made by a test", "3D Slicer output. SPACE=RAS"), "s.vtk");
    check_fork(straight);
    const auto says_axes = [](const tree::VesselTree& tree) {
        return std::ranges::any_of(tree.notes, [](const tree::Note& note) { return note.topic == "axes"; });
    };
    CHECK(says_axes(*io::parse_tree(plain, "s.vtk")));
    CHECK_FALSE(says_axes(*turned));
    CHECK_FALSE(says_axes(*straight));
}

TEST_CASE("trunks that centerlines repeat are one vessel, and that is told") {
    // Two centerlines from one inlet, ten points of trunk each, a tenth of the radius apart; then they part.
    std::string points, radii, first, second;
    for (int line = 0; line < 2; ++line)
        for (int i = 0; i < 15; ++i) {
            const double side = line == 0 ? -1.0 : 1.0;
            points += std::to_string(i == 0 ? 0.0 : side * (i < 10 ? 0.1 : 4.0 * (i - 9))) + " 0 " +
                      std::to_string(3 * i + (i < 10 && line == 1 && i > 0 ? 0.5 : 0.0)) + "\n";
            radii += "2 ";
            (line == 0 ? first : second) += " " + std::to_string(15 * line + i);
        }
    const std::string text =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 30 double\n" + points + "LINES 2 32\n15" +
        first + "\n15" + second +
        "\nCELL_DATA 2\nSCALARS CenterlineIds int\nLOOKUP_TABLE default\n0 1\nPOINT_DATA 30\nFIELD "
        "f 1\nMaximumInscribedSphereRadius 1 30 double\n" +
        radii + "\n";
    const auto tree = io::parse_tree(text, "raw.vtk");
    REQUIRE_MESSAGE(tree.has_value(), (tree ? std::string() : tree.error().message()));
    CHECK(tree->branches.size() == 3);
    CHECK(tree->roots.size() == 1);
    const auto repairs = sentences(*tree, tree::Note::Kind::kRepaired);
    CHECK(
        std::ranges::any_of(repairs, [](const std::string& said) { return said.find("trunk") != std::string::npos; }));
    io::ReadOptions as_it_is;
    as_it_is.repair = tree::Repair::kRepeatedPoints;
    const auto both = io::parse_tree(text, "raw.vtk", as_it_is);
    REQUIRE(both.has_value());
    CHECK(both->segment_count() == 28); // none is left out
}

TEST_CASE("what VTK files claim is believed as far as there are bytes for it") {
    const test::PeakMemory memory;
    const Style plain{.name = "base64"}, raw{.name = "raw", .appended = true, .base64 = false};
    const std::string billion = "1000000000";
    for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
             {"NumberOfPoints=\"5\"", "NumberOfPoints=\"" + billion + "\""},
             {"NumberOfLines=\"3\"", "NumberOfLines=\"" + billion + "\""}})
        CHECK(test::refusal(test::replaced(vtp(plain), from, to), "lie.vtp").find("declares " + billion) !=
              std::string::npos);
    test::refusal(test::replaced(vtu(plain), "NumberOfCells=\"4\"", "NumberOfCells=\"" + billion + "\""), "lie.vtu");
    for (const Style& style : kStyles) { // the size of the data themselves
        CAPTURE(style.name);
        std::string text = vtp(style);
        const std::size_t data = style.appended ? text.find(" _") + 2 : text.find("binary\">\n ") + 10;
        for (std::size_t i = 0; i < 12; ++i) text[data + i] = style.base64 ? '/' : '\xFF';
        const auto tree = io::parse_tree(text, "lie.vtp");
        if (!tree) CHECK(tree.error().where.starts_with("lie.vtp"));
    }
    const std::string lines = "LINES 3 10\n3 0 1 2\n2 2 3\n2 2 4\n", good = legacy("3.0", lines, kLegacyRadii);
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"POINTS 5", "POINTS 1000000000"},
                                                          {"LINES 3", "LINES 1000000000"},
                                                          {"3 10", "3 1000000000"},
                                                          {"POINT_DATA 5", "POINT_DATA -1"},
                                                          {"Radius 1 5", "Radius 1 1000000000"},
                                                          {"2 2 4", "2 2 5"},
                                                          {"2 2 4", "2 2 -1"},
                                                          {"3 0 1 2", "9 0 1 2"},
                                                          {"ASCII", "KLINGON"}})
        test::refusal(test::replaced(good, from, to), "lie.vtk");
    test::refusal(test::replaced(vtp(raw), "offset=\"0\"", "offset=\"99999999999\""), "lie.vtp");
    CHECK(memory.grown_mib() < 30.0);
}

TEST_CASE("VTK files that hold no tree are told from those that do") {
    CHECK(
        test::refusal("# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_POINTS\n", "v.vtk").find("POLYDATA") !=
        std::string::npos);
    CHECK(test::refusal("# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 float\n0 0 0 1 0 0 0 1 0\n"
                        "POLYGONS 1 4\n3 0 1 2\n",
                        "s.vtk")
              .find("surface mesh") != std::string::npos);
    CHECK(test::refusal("<VTKFile type=\"ImageData\"><ImageData/></VTKFile>", "i.vtp").find("ImageData") !=
          std::string::npos);
    CHECK(test::refusal("<VTKFile type=\"PolyData\"><PolyData>", "cut.vtp").find("XML") != std::string::npos);
}
