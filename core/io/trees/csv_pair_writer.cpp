#include "core/io/output_file.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/csv_pair.h"
#include "core/io/trees/node_graph.h"

#include <glm/geometric.hpp>

namespace ramus::io {

namespace {

// Quoted if necessary. An apostrophe, which CsvRows removes, protects a name that looks like a formula.
std::string csv_text(const std::string& text) {
    const bool formula = begins_formula(text);
    if (!formula && text.find_first_of(",;\t\"\r\n") == std::string::npos && text == trimmed(text)) return text;
    std::string quoted = formula ? "\"'" : "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + "\"";
}

// Writes numbers, each after a separator.
void write_cells(OutputFile& output, std::initializer_list<double> values) {
    for (const double value : values) {
        output.write(";");
        output.write_number(value);
    }
}

// Write names, and values, each after a separator. An unknown value is an empty cell.
void write_names(OutputFile& output, const tree::DataArrays& arrays) {
    for (const tree::DataArray& array : arrays) output.write(";" + csv_text(name_in_file(array.name, kTakenByNodes)));
}
void write_data_cells(OutputFile& output, const tree::DataArrays& arrays, std::size_t row) {
    for (const tree::DataArray& array : arrays) {
        output.write(";");
        if (tree::is_known(array.values[row])) output.write_number(array.values[row]);
    }
}

void write_nodes(OutputFile& output, const tree::VesselTree& tree) {
    std::vector<int> system(tree.points.size(), 0), degree(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches)
        for (std::size_t i = 0; i < branch.points.size(); ++i) {
            system[branch.points[i]] = branch.system;
            degree[branch.points[i]] += i == 0 || i + 1 == branch.points.size() ? 1 : 2;
        }
    std::vector<bool> is_root(tree.points.size(), false);
    for (const std::uint32_t root : tree.roots) is_root[root] = true;
    output.write("id;pos_x;pos_y;pos_z;degree;radius;" + std::string(kRootColumn));
    if (!tree.labels.empty()) output.write(";" + std::string(kLabelColumn));
    if (!tree.systems.empty()) output.write(";" + std::string(kSystemColumn) + ";" + std::string(kColourColumn));
    write_names(output, tree.point_data);
    output.write("\n");
    for (std::size_t p = 0; p < tree.points.size(); ++p) {
        const tree::Point& at = tree.points[p];
        output.write_number(p);
        write_cells(output, {at.position.x, at.position.y, at.position.z});
        output.write(";" + std::to_string(degree[p]));
        write_cells(output, {at.radius});
        output.write(is_root[p] ? ";1" : ";0");
        if (!tree.labels.empty()) output.write(";" + std::to_string(tree.labels[p]));
        if (!tree.systems.empty()) {
            const tree::System& of = tree.systems[static_cast<std::size_t>(system[p])];
            output.write(";" + csv_text(of.name) + ";" + colour_text(of.colour));
        }
        write_data_cells(output, tree.point_data, p);
        output.write("\n");
    }
}

void write_edges(OutputFile& output, const tree::VesselTree& tree) {
    output.write("id;node1id;node2id;length;avgRadiusAvg;branch");
    write_names(output, tree.branch_data);
    output.write("\n");
    std::size_t id = 0;
    for (std::size_t b = 0; b < tree.branches.size(); ++b) {
        const std::vector<std::uint32_t>& points = tree.branches[b].points;
        for (std::size_t i = 1; i < points.size(); ++i, ++id) {
            const tree::Point &from = tree.points[points[i - 1]], &to = tree.points[points[i]];
            output.write(std::to_string(id) + ";" + std::to_string(points[i - 1]) + ";" + std::to_string(points[i]));
            write_cells(output, {glm::distance(from.position, to.position), 0.5 * (from.radius + to.radius)});
            output.write(";");
            output.write(std::to_string(b));
            write_data_cells(output, tree.branch_data, b);
            output.write("\n");
        }
    }
}

} // namespace

Result<void> write_csv_pair(const tree::VesselTree& tree, const std::filesystem::path& file,
                            const std::vector<std::string>& /*comments*/) {
    const bool named_edges = lower_case(file.filename().string()).find("edges") != std::string::npos;
    const std::filesystem::path other = partner_names(file, !named_edges).front();
    RAMUS_TRY(nodes, OutputFile::create(named_edges ? other : file));
    RAMUS_TRY(edges, OutputFile::create(named_edges ? file : other));
    write_nodes(nodes, tree);
    write_edges(edges, tree);
    return commit_both(nodes, edges);
}

} // namespace ramus::io
