#include "core/io/text_numbers.h"
#include "core/io/trees/graphml.h"
#include "core/io/trees/node_graph.h"
#include "core/io/trees/xml_input.h"

#include <algorithm>

namespace ramus::io {

namespace {

// The declaration of a key.
struct GraphmlKey {
    std::string id, name;
    std::string_view fallback; // the value where an element has none
};

std::vector<GraphmlKey> keys_of(const pugi::xml_node& file, std::string_view things) {
    std::vector<GraphmlKey> keys;
    for (const pugi::xml_node& key : file.children("key")) {
        const std::string_view of = key.attribute("for").as_string("all");
        const char* id = key.attribute("id").value();
        if (of == things || of == "all")
            keys.push_back({id, key.attribute("attr.name").as_string(id), key.child_value("default")});
    }
    return keys;
}

std::vector<std::string> names_of(const std::vector<GraphmlKey>& keys) {
    std::vector<std::string> names;
    for (const GraphmlKey& key : keys) names.push_back(key.name);
    return names;
}

// Puts the data of an element into their cells; ignores other data.
template <class Row> class GraphmlRows {
public:
    template <class Columns> GraphmlRows(const std::vector<GraphmlKey>& keys, const Columns& columns) {
        for (std::size_t cell = 0; cell < columns.at.size(); ++cell)
            if (columns.at[cell] < keys.size()) {
                cells_.emplace_back(keys[columns.at[cell]].id, cell);
                empty_[cell] = keys[columns.at[cell]].fallback;
            }
        for (const std::size_t key : columns.data.at) data_.push_back(&keys[key]);
    }
    [[nodiscard]] Row row(const pugi::xml_node& element) const {
        Row row = empty_;
        for (const pugi::xml_node& data : element.children("data")) {
            const std::string_view key = data.attribute("key").value();
            for (const auto& [id, cell] : cells_)
                if (id == key) row[cell] = data.child_value();
        }
        return row;
    }
    [[nodiscard]] std::vector<std::string_view> data(const pugi::xml_node& element) const {
        std::vector<std::string_view> cells;
        for (const GraphmlKey* key : data_) {
            cells.push_back(key->fallback);
            for (const pugi::xml_node& datum : element.children("data"))
                if (key->id == datum.attribute("key").value()) cells.back() = datum.child_value();
        }
        return cells;
    }

private:
    std::vector<const GraphmlKey*> data_;
    std::vector<std::pair<std::string, std::size_t>> cells_;
    Row empty_{};
};

std::string_view graph_datum(const pugi::xml_node& file, const pugi::xml_node& graph, std::string_view name) {
    for (const GraphmlKey& key : keys_of(file, "graph"))
        if (key.name == name)
            for (const pugi::xml_node& data : graph.children("data"))
                if (key.id == data.attribute("key").value()) return data.child_value();
    return {};
}

Result<void> add_graphml_nodes(const XmlInput& xml, const pugi::xml_node& of, const TreeInput& input,
                               NodeGraph& graph) {
    const std::vector<GraphmlKey> keys = keys_of(xml.root(), "node");
    NodeColumns columns = node_columns(names_of(keys), input.options);
    std::size_t& id = columns.at[static_cast<std::size_t>(NodeCell::kId)];
    id = keys.size(); // the id is an attribute and no datum
    if (auto good = graph.begin_nodes(columns, input.name); !good) return good;
    const GraphmlRows<NodeRow> rows(keys, columns);
    for (const pugi::xml_node& node : of.children("node")) {
        NodeRow row = rows.row(node);
        row[static_cast<std::size_t>(NodeCell::kId)] = node.attribute("id").value();
        if (auto good = graph.add_node(row, xml.line(node), rows.data(node)); !good) return good;
    }
    return {};
}

Result<void> add_graphml_edges(const XmlInput& xml, const pugi::xml_node& of, const TreeInput& input,
                               NodeGraph& graph) {
    const std::vector<GraphmlKey> keys = keys_of(xml.root(), "edge");
    EdgeColumns columns = edge_columns(names_of(keys), input.options);
    std::size_t &from = columns.at[static_cast<std::size_t>(EdgeCell::kFrom)],
                &to = columns.at[static_cast<std::size_t>(EdgeCell::kTo)];
    from = to = keys.size();
    if (auto good = graph.begin_edges(columns, input.name); !good) return good;
    const GraphmlRows<EdgeRow> rows(keys, columns);
    for (const pugi::xml_node& edge : of.children("edge")) {
        EdgeRow row = rows.row(edge);
        row[static_cast<std::size_t>(EdgeCell::kFrom)] = edge.attribute("source").value();
        row[static_cast<std::size_t>(EdgeCell::kTo)] = edge.attribute("target").value();
        if (auto good = graph.add_edge(row, xml.line(edge), rows.data(edge)); !good) return good;
    }
    return {};
}

} // namespace

bool is_graphml(std::string_view head) { return begins_with_element(head, "graphml"); }

Result<ImportedTree> parse_graphml(const TreeInput& input) {
    XmlInput xml;
    if (auto good = xml.parse(input.text, input.name); !good) return tl::unexpected(good.error());
    const pugi::xml_node file = xml.root().child("graph");
    if (std::string_view(xml.root().name()) != "graphml" || !file)
        return fail("there is no graph of GraphML in the file", input.name, "choose another file");
    NodeGraph graph(input);
    if (auto good = add_graphml_nodes(xml, file, input, graph); !good) return tl::unexpected(good.error());
    if (auto good = add_graphml_edges(xml, file, input, graph); !good) return tl::unexpected(good.error());
    const std::string_view space = graph_datum(xml.root(), file, kGraphmlSpace);
    std::optional<Orientation> orientation;
    if (space == "RAS") orientation = Orientation::ras();
    if (space == "LPS") orientation = Orientation::lps();
    graph.state(length_unit(trimmed(graph_datum(xml.root(), file, kGraphmlUnits))), orientation);
    return graph.finish();
}

} // namespace ramus::io
