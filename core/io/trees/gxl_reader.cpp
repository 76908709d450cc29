#include "core/io/text_numbers.h"
#include "core/io/trees/gxl.h"
#include "core/io/trees/node_graph.h"
#include "core/io/trees/xml_input.h"

#include <algorithm>

namespace ramus::io {

namespace {

pugi::xml_node gxl_attribute(const pugi::xml_node& of, std::string_view name) {
    for (const pugi::xml_node& attribute : of.children("attr"))
        if (trimmed(attribute.attribute("name").value()) == name) return attribute;
    return {};
}

// The text of <float>, <int> or <double>, or of the attribute itself.
std::string_view gxl_value(const pugi::xml_node& attribute) {
    for (const pugi::xml_node& value : attribute.children())
        if (value.type() == pugi::node_element) return value.child_value();
    return attribute.child_value();
}

// An end of an edge is an attribute, in some files an element.
std::string_view gxl_end(const pugi::xml_node& edge, const char* name) {
    const pugi::xml_attribute attribute = edge.attribute(name);
    return attribute ? attribute.value() : edge.child_value(name);
}

// The attributes of edges other than the radius, as columns of data.
std::vector<std::string> gxl_data_names(const pugi::xml_node& file, std::string_view radius) {
    std::vector<std::string> names;
    for (const pugi::xml_node& edge : file.children("edge"))
        for (const pugi::xml_node& attribute : edge.children("attr")) {
            const std::string name(trimmed(attribute.attribute("name").value()));
            if (name.empty() || name == radius || names.size() == tree::kMostArrays) continue;
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
        }
    return names;
}

Result<void> add_gxl_node(const pugi::xml_node& node, const XmlInput& xml, NodeGraph& graph) {
    NodeRow row{};
    row[static_cast<std::size_t>(NodeCell::kId)] = node.attribute("id").value();
    const pugi::xml_node position = gxl_attribute(node, "position");
    std::size_t count = 0;
    for (const pugi::xml_node& value : position.child("tup").children()) {
        if (value.type() != pugi::node_element) continue;
        if (count < 3) row[static_cast<std::size_t>(NodeCell::kX) + count] = value.child_value();
        ++count;
    }
    if (count != 2 && count != 3)
        return fail("the position of node " + shown(node.attribute("id").value()) + " has " + counted(count, "number"),
                    xml.place(position ? position : node), "it needs two or three");
    if (count == 2) row[static_cast<std::size_t>(NodeCell::kZ)] = "0";
    return graph.add_node(row, xml.line(node));
}

} // namespace

bool is_gxl(std::string_view head) { return begins_with_element(head, "gxl"); }

Result<ImportedTree> parse_gxl(const TreeInput& input) {
    XmlInput xml;
    if (auto good = xml.parse(input.text, input.name); !good) return tl::unexpected(good.error());
    const pugi::xml_node file = xml.root().child("graph");
    if (std::string_view(xml.root().name()) != "gxl" || !file)
        return fail("there is no graph of GXL in the file", input.name, "VascuSynth and OpenCCO write <gxl><graph>");
    NodeGraph graph(input);
    NodeColumns nodes = node_columns({"id", "x", "y", "z"}, {});
    if (auto good = graph.begin_nodes(nodes, input.name); !good) return tl::unexpected(good.error());
    for (const pugi::xml_node& node : file.children("node"))
        if (auto good = add_gxl_node(node, xml, graph); !good) return tl::unexpected(good.error());
    const auto asked = input.options.columns.find("radius");
    const std::string radius = asked != input.options.columns.end() ? asked->second : "radius";
    EdgeColumns columns = edge_columns({"from", "to", "radius"}, {});
    columns.data.names = gxl_data_names(file, radius);
    if (auto good = graph.begin_edges(columns, input.name); !good) return tl::unexpected(good.error());
    std::vector<std::string_view> data(columns.data.names.size());
    for (const pugi::xml_node& edge : file.children("edge")) {
        for (std::size_t d = 0; d < data.size(); ++d) data[d] = gxl_value(gxl_attribute(edge, columns.data.names[d]));
        const EdgeRow row{gxl_end(edge, "from"), gxl_end(edge, "to"), gxl_value(gxl_attribute(edge, radius))};
        if (auto good = graph.add_edge(row, xml.line(edge), data); !good) return tl::unexpected(good.error());
    }
    graph.take_roots_from_directions();
    return graph.finish();
}

} // namespace ramus::io
