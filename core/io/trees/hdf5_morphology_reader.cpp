#include "core/io/text_numbers.h"
#include "core/io/trees/hdf5_morphology.h"
#include "core/io/trees/hdf5_tables.h"

#include <cmath>
#include <limits>

namespace ramus::io {

namespace {

struct Section {
    std::uint32_t begin = 0, end = 0; // points
    int type = 0;
};

Result<std::vector<Section>> sections_of(const Hdf5Table& structure, std::size_t points, const std::string& name) {
    std::vector<Section> sections;
    for (std::size_t s = 0; s < structure.rows; ++s) {
        const std::string where = name + ": row " + std::to_string(s) + " of /structure";
        const double begin = structure.at(s, 0);
        const double end = s + 1 < structure.rows ? structure.at(s + 1, 0) : static_cast<double>(points);
        if (!(begin >= 0.0 && begin <= end && end <= static_cast<double>(points)) || begin != std::floor(begin) ||
            end != std::floor(end))
            return fail("the section does not begin and end among the " + counted(points, "point"), where,
                        "the file is damaged; get it again");
        const double type = structure.columns > 1 ? structure.at(s, 1) : 0.0;
        sections.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end),
                            std::abs(type) < 1e9 ? static_cast<int>(type) : 0});
    }
    return sections;
}

// Connects the last point of the parent with the first of the child. tree_of() joins points at the same position.
Result<void> connect_sections(double parent, double child, const std::vector<Section>& sections,
                              const std::string& where, tree::Graph& graph) {
    for (const double section : {parent, child})
        if (!(section >= 0.0 && section < static_cast<double>(sections.size())) || section != std::floor(section))
            return fail("there is no section " + std::to_string(section) + ", only " +
                            counted(sections.size(), "section"),
                        where, "the file is damaged; get it again");
    const Section &from = sections[static_cast<std::size_t>(parent)], &to = sections[static_cast<std::size_t>(child)];
    if (from.begin == from.end || to.begin == to.end)
        return fail("a section that is connected has no points", where, "the file is damaged; get it again");
    if (graph.points[from.end - 1].position != graph.points[to.begin].position)
        graph.edges.emplace_back(from.end - 1, to.begin);
    return {};
}

Result<void> connect_all_sections(const Hdf5Table& structure, const Hdf5Table& connectivity,
                                  const std::vector<Section>& sections, const std::string& name, tree::Graph& graph) {
    for (std::size_t c = 0; c < connectivity.rows; ++c)
        if (auto good = connect_sections(connectivity.at(c, 0), connectivity.at(c, 1), sections,
                                         name + ": row " + std::to_string(c) + " of /connectivity", graph);
            !good)
            return good;
    if (connectivity.present || structure.columns < 3) return {};
    for (std::size_t s = 0; s < structure.rows; ++s)
        if (const double parent = structure.at(s, 2); !(parent < 0.0))
            if (auto good = connect_sections(parent, static_cast<double>(s), sections,
                                             name + ": row " + std::to_string(s) + " of /structure", graph);
                !good)
                return good;
    return {};
}

} // namespace

bool is_hdf5(std::string_view head) { return head.starts_with("\x89HDF\r\n\x1a\n"); }

Result<ImportedTree> parse_hdf5_morphology(const TreeInput& input) {
    const std::string& name = input.name;
    RAMUS_TRY(tables, read_hdf5_tables(input.text, {"points", "structure", "connectivity"}, name));
    const Hdf5Table &points = tables[0], &structure = tables[1], &connectivity = tables[2];
    for (const auto& [table, what, columns] : {std::tuple(&points, "/points", 4U), {&structure, "/structure", 1U}}) {
        if (!table->present)
            return fail(std::string("there is no dataset ") + what, name,
                        "HDF5 trees have /points, /structure and /connectivity");
        if (table->columns < columns || table->rows == 0)
            return fail(std::string(what) + " has " + counted(table->rows, "row") + " of " +
                            counted(table->columns, "column"),
                        name, "/points holds x, y, z and the diameter, /structure the first point of each section");
    }
    if (connectivity.present && connectivity.rows > 0 && connectivity.columns < 2)
        return fail("/connectivity has a single column", name, "it holds parent and child");
    if (points.rows >= std::numeric_limits<std::uint32_t>::max())
        return fail("the file has more points than can be counted", name, "split it");
    ImportedTree imported;
    tree::Graph& graph = imported.graph;
    for (std::size_t p = 0; p < points.rows; ++p)
        graph.points.push_back({{points.at(p, 0), points.at(p, 1), points.at(p, 2)}, points.at(p, 3)});
    RAMUS_TRY(sections, sections_of(structure, points.rows, name));
    if (structure.columns > 1) graph.labels.assign(points.rows, 0);
    for (const Section& section : sections)
        for (std::uint32_t p = section.begin; p < section.end; ++p) {
            if (p > section.begin) graph.edges.emplace_back(p - 1, p);
            if (!graph.labels.empty()) graph.labels[p] = section.type;
        }
    if (auto good = connect_all_sections(structure, connectivity, sections, name, graph); !good)
        return tl::unexpected(good.error());
    imported.radius_is = RadiusIs::kDiameter;
    imported.joining = Joining::kAtCoincidingEnds;
    imported.place_of = [name](std::uint32_t point) { return name + ": point " + std::to_string(point); };
    return imported;
}

} // namespace ramus::io
