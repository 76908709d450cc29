#include "core/io/binary_numbers.h"
#include "core/io/output_file.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/vtk.h"

#include <algorithm>
#include <numeric>

namespace ramus::io {

namespace {

class VtpWriter {
public:
    explicit VtpWriter(OutputFile& output) : output_(output) {}

    void begin(const std::vector<std::string>& comments) {
        output_.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"");
        output_.write(std::endian::native == std::endian::big ? "BigEndian" : "LittleEndian");
        output_.write("\" header_type=\"UInt64\">\n");
        for (std::string comment : comments) {
            // The end mark of a comment, and characters that XML forbids.
            std::ranges::replace_if(
                comment, [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; }, ' ');
            for (std::size_t at = comment.find("--"); at != std::string::npos; at = comment.find("--"))
                comment.replace(at, 2, "- -");
            output_.write("<!-- " + comment + " -->\n");
        }
        output_.write("<PolyData>\n");
    }

    template <class T>
    void array(const char* type, std::string_view name, const std::vector<T>& values, int parts = 1) {
        static_assert(std::is_arithmetic_v<T>);
        const std::uint64_t size = values.size() * sizeof(T);
        std::string bytes(reinterpret_cast<const char*>(&size), sizeof(size));
        bytes.append(reinterpret_cast<const char*>(values.data()), size);
        open("DataArray", type, name);
        output_.write(" NumberOfComponents=\"" + std::to_string(parts) + "\"");
        if (whole_) output_.write(" NumberOfTuples=\"" + std::to_string(values.size() / parts) + "\"");
        output_.write(" format=\"binary\">");
        output_.write(base64_encoded(bytes));
        output_.write("</DataArray>\n");
    }

    void texts(std::string_view name, const std::vector<std::string>& texts) {
        output_.write(vtk_text_array(name, texts));
    }

    void element(const char* name, const auto& write_arrays) {
        output_.write(std::string("<").append(name).append(">\n"));
        whole_ = std::string_view(name) == "FieldData";
        write_arrays();
        output_.write(std::string("</").append(name).append(">\n"));
    }

    void write(std::string_view text) { output_.write(text); }

private:
    void open(std::string_view element, std::string_view type, std::string_view name) {
        std::string escaped;
        for (const char c : name)
            escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
        output_.write(std::string("<").append(element).append(" type=\"").append(type).append("\" Name=\""));
        output_.write(escaped.append("\""));
    }

    OutputFile& output_;
    bool whole_ = false; // field data, whose arrays state their lengths
};

// By branch: the first path from a root to a leaf through it.
std::vector<std::int32_t> centerline_ids(const tree::VesselTree& tree) {
    std::vector<std::int32_t> ids(tree.branches.size(), 0);
    std::vector<std::uint32_t> order(tree.branches.size());
    std::iota(order.begin(), order.end(), 0U);
    std::int32_t leaves = 0;
    for (const std::uint32_t b : order)
        if (tree.branches[b].children.empty()) ids[b] = leaves++;
    std::ranges::stable_sort(order, std::ranges::greater{},
                             [&](std::uint32_t b) { return tree.branches[b].generation; });
    for (const std::uint32_t b : order)
        if (const auto& children = tree.branches[b].children; !children.empty()) {
            ids[b] = ids[static_cast<std::size_t>(children.front())];
            for (const int child : children) ids[b] = std::min(ids[b], ids[static_cast<std::size_t>(child)]);
        }
    return ids;
}

template <class Value> std::vector<std::int32_t> by_branch(const tree::VesselTree& tree, const Value& value) {
    std::vector<std::int32_t> values;
    for (const tree::Branch& branch : tree.branches) values.push_back(value(branch));
    return values;
}

// Lower-case names that arrays of data cannot have, because they have a meaning.
constexpr std::string_view kVtkTaken[] = {"maximuminscribedsphereradius", "label", "systemid"};

void write_data_arrays(VtpWriter& vtp, const tree::DataArrays& arrays) {
    for (const tree::DataArray& array : arrays) vtp.array("Float64", name_in_file(array.name, kVtkTaken), array.values);
}

void write_fields(VtpWriter& vtp, const tree::VesselTree& tree, const Orientation& axes) {
    const std::string said = axes_word(axes, tree.claims);
    vtp.texts(kVtkMark, {std::string(tree.claims.unit_word()), said});
    if (tree.claims.has_sides()) vtp.texts(kVtkSpace, {said});
    vtp.array("Int64", kVtkRoots, std::vector<std::int64_t>(tree.roots.begin(), tree.roots.end()));
    std::vector<std::string> names;
    for (const tree::DataArrays* arrays : {&tree.point_data, &tree.branch_data})
        for (const tree::DataArray& array : *arrays) names.push_back(name_in_file(array.name, kVtkTaken));
    if (!names.empty()) vtp.texts(kVtkData, names);
    if (tree.systems.empty()) return;
    names.clear();
    std::vector<std::uint8_t> colours;
    for (const tree::System& system : tree.systems) {
        names.push_back(system.name);
        colours.insert(colours.end(), system.colour.begin(), system.colour.end());
    }
    vtp.texts(kVtkSystemNames, names);
    vtp.array("UInt8", kVtkSystemColours, colours, 3);
}

void write_points(VtpWriter& vtp, const tree::VesselTree& tree) {
    vtp.element("PointData", [&] {
        std::vector<double> radii;
        for (const tree::Point& point : tree.points) radii.push_back(point.radius);
        vtp.array("Float64", "MaximumInscribedSphereRadius", radii);
        if (!tree.labels.empty())
            vtp.array("Int32", kVtkLabels, std::vector<std::int32_t>(tree.labels.begin(), tree.labels.end()));
        write_data_arrays(vtp, tree.point_data);
    });
}

void write_cell_data(VtpWriter& vtp, const tree::VesselTree& tree) {
    vtp.element("CellData", [&] {
        const auto computed = [&](std::string_view name, const std::vector<std::int32_t>& values) {
            if (array_named(tree.branch_data, std::string(name)) == nullptr) vtp.array("Int32", name, values);
        };
        std::vector<std::int32_t> groups(tree.branches.size());
        std::iota(groups.begin(), groups.end(), 0);
        computed(kVtkBranchIds, groups);
        computed("CenterlineIds", centerline_ids(tree));
        computed("TractIds", by_branch(tree, [](const tree::Branch& branch) { return branch.generation; }));
        computed("Blanking", std::vector<std::int32_t>(tree.branches.size(), 0));
        if (!tree.systems.empty())
            vtp.array("Int32", kVtkSystemIds,
                      by_branch(tree, [](const tree::Branch& branch) { return branch.system; }));
        write_data_arrays(vtp, tree.branch_data);
    });
}

void write_geometry(VtpWriter& vtp, const tree::VesselTree& tree, const Orientation& axes) {
    vtp.element("Points", [&] {
        std::vector<double> positions;
        for (const tree::Point& point : tree.points) {
            const glm::dvec3 at = axes.to_file(point.position);
            positions.insert(positions.end(), {at.x, at.y, at.z});
        }
        vtp.array("Float64", "Points", positions, 3);
    });
    vtp.element("Lines", [&] {
        std::vector<std::int64_t> corners, ends;
        for (const tree::Branch& branch : tree.branches) {
            corners.insert(corners.end(), branch.points.begin(), branch.points.end());
            ends.push_back(static_cast<std::int64_t>(corners.size()));
        }
        vtp.array("Int64", "connectivity", corners);
        vtp.array("Int64", "offsets", ends);
    });
}

} // namespace

Result<void> write_vtp(const tree::VesselTree& tree, const std::filesystem::path& file,
                       const std::vector<std::string>& comments, const Orientation& axes) {
    RAMUS_TRY(output, OutputFile::create(file));
    VtpWriter vtp(output);
    vtp.begin(comments);
    vtp.element("FieldData", [&] { write_fields(vtp, tree, axes); });
    vtp.write("<Piece NumberOfPoints=\"" + std::to_string(tree.points.size()) +
              "\" NumberOfVerts=\"0\" NumberOfLines=\"" + std::to_string(tree.branches.size()) +
              "\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n");
    write_points(vtp, tree);
    write_cell_data(vtp, tree);
    write_geometry(vtp, tree, axes);
    vtp.write("</Piece>\n</PolyData>\n</VTKFile>\n");
    return output.commit();
}

} // namespace ramus::io
