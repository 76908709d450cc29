#include "core/io/trees/tree_json.h"

#include "core/io/output_file.h"
#include "core/io/trees/json_input.h"
#include "core/io/trees/tree_json_lists.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "ramus-tree";
constexpr int kVersion = 2; // 1 has no systems, and of the notes the repairs alone, as sentences

class Reader : private TreeJsonValues {
public:
    explicit Reader(const std::string& name) : TreeJsonValues(name) {}

    Result<void> parse(std::string_view text, const std::string& name) {
        RAMUS_TRY(document, parsed_json(text, name, [this](JsonPath list) { return lists_.taker_of(list); }));
        document_ = std::move(document);
        return {};
    }

    void check_header() const {
        if (!document_.is_object()) refuse("", "is not a ramus tree: it holds no JSON object");
        const auto format = document_.find("format");
        if (format == document_.end() || *format != kFormat)
            refuse("", "is not a ramus tree: \"format\": \"" + std::string(kFormat) + "\" is missing",
                   "use a file that `ramus convert` wrote");
        const json& version = member("version");
        if (!version.is_number_integer() || version < 1) refuse("version", "is not a whole number from 1");
        if (version > kVersion)
            refuse("version", "is " + version.dump() + ", and this ramus reads up to " + std::to_string(kVersion),
                   "use a newer ramus");
        // All versions are in mm and RAS, or unknown. Another value would be misread silently.
        if (const std::string units = text("units"); units != "mm" && units != tree::kNotSaid)
            refuse("units", "are '" + units + "', not 'mm'", "convert the coordinates to mm");
        if (const std::string orientation = text("orientation"); orientation != "RAS" && orientation != tree::kNotSaid)
            refuse("orientation", "is '" + orientation + "', not 'RAS'", "convert the coordinates to RAS");
    }

    // Called once. Errors of lists are reported after those of the header: in a newer version the lists may be valid.
    [[nodiscard]] tree::Graph graph() {
        if (lists_.wrong) throw RefusedTreeJson{*lists_.wrong};
        for (const char* key : {"points", "branches", "roots"}) check_list(key);
        tree::Graph graph;
        graph.points = std::move(lists_.points);
        read_labels(graph);
        graph.point_data = data("point_data", lists_.point_data, graph.points.size(), "points");
        std::vector<std::size_t> edge_branches;
        for (std::size_t b = 0; b < lists_.branches(); ++b) {
            const std::span<const std::uint32_t> row = lists_.branch(b);
            const std::string place = element("branches", b);
            for (std::size_t i = 1; i < row.size(); ++i)
                graph.edges.emplace_back(index(row[i - 1], place, i - 1, graph.points.size()),
                                         index(row[i], place, i, graph.points.size()));
            edge_branches.resize(graph.edges.size(), b);
        }
        graph.edge_data = picked(data("branch_data", lists_.branch_data, lists_.branches(), "branches"), edge_branches);
        read_systems(graph);
        for (std::size_t r = 0; r < lists_.roots.size(); ++r)
            graph.roots.push_back(index(lists_.roots[r], "roots", r, graph.points.size()));
        return graph;
    }

    [[nodiscard]] std::string unit_word() const { return text("units"); }
    [[nodiscard]] std::string axes_word() const { return text("orientation"); }
    [[nodiscard]] std::string source() const { return document_.contains("source") ? text("source") : std::string(); }

    [[nodiscard]] std::optional<glm::dmat3> voxel() const {
        const std::string key = "voxel_mm";
        if (!document_.contains(key)) return std::nullopt;
        check_list(key);
        const json& edges = document_[key];
        if (edges.size() != 3) refuse(key, "is not a list of three edges");
        glm::dmat3 voxel(0.0);
        for (std::size_t edge = 0; edge < 3; ++edge) {
            const std::array<double, 3> at = numbers<3>(edges[edge], element(key, edge), "[x, y, z]");
            voxel[static_cast<int>(edge)] = {at[0], at[1], at[2]};
        }
        if (!tree::is_a_voxel(voxel)) refuse(key, "are no edges of a voxel: they lie in one plane");
        return voxel;
    }

    // Called once.
    [[nodiscard]] std::vector<tree::Note> notes() {
        const bool old = document_.contains("repairs");
        if (old || document_.contains("notes")) check_list(old ? "repairs" : "notes");
        return std::move(old ? lists_.repairs : lists_.notes);
    }

private:
    [[nodiscard]] const json& member(const std::string& key) const {
        const auto found = document_.find(key);
        if (found == document_.end()) refuse(key, "is missing");
        return *found;
    }
    void check_list(const std::string& key) const {
        if (!member(key).is_array()) refuse(key, "is not a list");
    }
    [[nodiscard]] std::string text(const std::string& key) const { return string(member(key), key); }
    [[nodiscard]] std::uint32_t index(std::uint32_t value, const std::string& list, std::size_t i,
                                      std::size_t count) const {
        if (value >= count)
            refuse(element(list, i), "is not the index of one of the " + std::to_string(count) + " points");
        return value;
    }
    [[nodiscard]] tree::DataArrays data(const std::string& key, std::map<std::string, std::vector<double>>& read,
                                        std::size_t count, const char* things) const {
        tree::DataArrays arrays;
        if (!document_.contains(key)) return arrays;
        const json& members = member(key);
        if (!members.is_object()) refuse(key, "is not an object");
        if (members.size() > tree::kMostArrays)
            refuse(key, "has more than " + std::to_string(tree::kMostArrays) + " arrays");
        for (const auto& [name, list] : members.items()) {
            const std::string place = key + "." + name;
            if (!list.is_array()) refuse(place, "is not a list");
            std::vector<double>& values = read[name];
            if (values.size() != count)
                refuse(place,
                       "has " + std::to_string(values.size()) + " values for " + std::to_string(count) + " " + things);
            arrays.push_back({name, std::move(values)});
        }
        return arrays;
    }
    void read_systems(tree::Graph& graph) const {
        if (!document_.contains("systems")) return;
        check_list("systems");
        const json& systems = document_["systems"];
        for (std::size_t i = 0; i < systems.size(); ++i) {
            const std::string place = element("systems", i);
            if (!systems[i].is_object()) refuse(place, "is not an object");
            const auto colour =
                numbers<3>(systems[i].value("colour", json()), place + ".colour", "[red, green, blue] from 0 to 255");
            tree::System system{string(systems[i].value("name", json()), place + ".name"), {}};
            for (std::size_t c = 0; c < 3; ++c) {
                if (!(colour[c] >= 0.0 && colour[c] <= 255.0)) refuse(place + ".colour", "is not from 0 to 255");
                system.colour[c] = static_cast<std::uint8_t>(colour[c]);
            }
            graph.systems.push_back(std::move(system));
        }
        if (graph.systems.empty()) return;
        check_list("branch_systems");
        if (lists_.branch_systems.size() != lists_.branches())
            refuse("branch_systems", "has " + std::to_string(lists_.branch_systems.size()) + " entries for " +
                                         std::to_string(lists_.branches()) + " branches");
        graph.point_systems.assign(graph.points.size(), 0);
        for (std::size_t b = 0; b < lists_.branches(); ++b) {
            const std::uint32_t system = lists_.branch_systems[b];
            if (system >= graph.systems.size()) refuse(element("branch_systems", b), "is not the index of a system");
            for (const std::uint32_t point : lists_.branch(b)) graph.point_systems[point] = static_cast<int>(system);
        }
    }
    void read_labels(tree::Graph& graph) {
        if (!document_.contains("labels")) return;
        check_list("labels");
        if (lists_.labels.size() != graph.points.size())
            refuse("labels", "are " + std::to_string(lists_.labels.size()) + " for " +
                                 std::to_string(graph.points.size()) + " points");
        graph.labels = std::move(lists_.labels);
    }

    json document_;
    TreeJsonLists lists_{*this};
};

template <class List> void write_list(const List& values, BufferedFile& file) {
    file.write("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) file.write(", ");
        file.write_number(values[i]);
    }
    file.write("]");
}

// Writes a list with a line for each of `values`; write_one(value) writes the line.
template <class T, class Write>
void write_lines(const std::vector<T>& values, BufferedFile& file, const Write& write_one) {
    file.write("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
        file.write(i > 0 ? ",\n" : "\n");
        write_one(values[i]);
    }
}

// Quoted. Names of files may contain bytes that are not UTF-8.
std::string quoted(const std::string& text) { return json(text).dump(-1, ' ', false, json::error_handler_t::replace); }

void write_note(const tree::Note& note, BufferedFile& file) {
    for (const auto& [kind, name] : kNoteKinds)
        if (kind == note.kind) file.write("{\"kind\": \"" + std::string(name) + "\", ");
    file.write("\"topic\": " + quoted(note.topic) + ", \"text\": " + quoted(note.text));
    if (note.at) {
        file.write(", \"at\": ");
        write_list(std::array{note.at->x, note.at->y, note.at->z}, file);
    }
    if (note.outward) {
        file.write(", \"outward\": ");
        write_list(std::array{note.outward->x, note.outward->y, note.outward->z}, file);
    }
    file.write("}");
}

void write_voxel(const glm::dmat3& edges_mm, BufferedFile& file) {
    file.write("\"voxel_mm\": [");
    for (int edge = 0; edge < 3; ++edge) {
        if (edge > 0) file.write(", ");
        write_list(std::array{edges_mm[edge].x, edges_mm[edge].y, edges_mm[edge].z}, file);
    }
    file.write("],\n");
}

void write_data(const char* key, const tree::DataArrays& arrays, BufferedFile& file) {
    if (arrays.empty()) return;
    file.write("\"" + std::string(key) + "\": ");
    bool first = true;
    for (const tree::DataArray& array : arrays) {
        file.write((first ? "{" : ",\n") + quoted(array.name) + ": [");
        first = false;
        for (std::size_t i = 0; i < array.values.size(); ++i) {
            if (i > 0) file.write(", ");
            if (tree::is_known(array.values[i]))
                file.write_number(array.values[i]);
            else
                file.write("null");
        }
        file.write("]");
    }
    file.write("},\n");
}

void write_systems(const tree::VesselTree& tree, BufferedFile& file) {
    file.write("\"systems\": ");
    write_lines(tree.systems, file, [&](const tree::System& system) {
        file.write("{\"name\": " + quoted(system.name) + ", \"colour\": ");
        write_list(std::array<int, 3>{system.colour[0], system.colour[1], system.colour[2]}, file);
        file.write("}");
    });
    file.write("],\n\"branch_systems\": ");
    std::vector<int> of_branches;
    for (const tree::Branch& branch : tree.branches) of_branches.push_back(branch.system);
    write_list(of_branches, file);
    file.write(",\n");
}

} // namespace

bool is_tree_json(std::string_view head) {
    return begins_json_object(head) && head.find('"' + std::string(kFormat) + '"') != std::string_view::npos;
}

Result<ImportedTree> parse_tree_json(const TreeInput& input) {
    const std::string& name = input.name;
    try {
        Reader reader(name);
        if (auto parsed = reader.parse(input.text, name); !parsed) return tl::unexpected(parsed.error());
        reader.check_header();
        ImportedTree imported;
        imported.graph = reader.graph();
        imported.take_as_written(reader.unit_word(), reader.axes_word());
        imported.notes = reader.notes();
        imported.source = reader.source();
        imported.voxel = reader.voxel();
        imported.place_of = [name](std::uint32_t point) { return name + ": points[" + std::to_string(point) + "]"; };
        return imported;
    } catch (const RefusedTreeJson& refused) {
        return tl::unexpected(refused.error);
    }
}

Result<void> write_tree_json(const tree::VesselTree& tree, const std::filesystem::path& path,
                             const std::vector<std::string>& /*comments*/) {
    RAMUS_TRY(file, OutputFile::create(path));
    file.write("{\n\"format\": \"" + std::string(kFormat) + "\",\n\"version\": " + std::to_string(kVersion) +
               ",\n\"units\": \"" + std::string(tree.claims.unit_word()) + "\",\n\"orientation\": \"" +
               std::string(tree.claims.axes_word()) + "\",\n");
    if (!tree.source.empty()) file.write("\"source\": " + quoted(tree.source) + ",\n");
    if (tree.voxels && !tree.voxels->estimated) write_voxel(tree.voxels->edges_mm, file);
    file.write("\"points\": ");
    write_lines(tree.points, file, [&](const tree::Point& point) {
        const glm::dvec3& p = point.position;
        write_list(std::array{p.x, p.y, p.z, point.radius}, file);
    });
    file.write("\n],\n");
    if (!tree.labels.empty()) {
        file.write("\"labels\": ");
        write_list(tree.labels, file);
        file.write(",\n");
    }
    file.write("\"branches\": ");
    write_lines(tree.branches, file, [&](const tree::Branch& branch) { write_list(branch.points, file); });
    file.write("\n],\n");
    write_data("point_data", tree.point_data, file);
    write_data("branch_data", tree.branch_data, file);
    if (!tree.systems.empty()) write_systems(tree, file);
    file.write("\"roots\": ");
    write_list(tree.roots, file);
    file.write(",\n\"notes\": ");
    write_lines(tree.notes, file, [&](const tree::Note& note) { write_note(note, file); });
    file.write("]\n}\n");
    return file.commit();
}

} // namespace ramus::io
