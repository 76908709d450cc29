#include "core/io/output_file.h"
#include "core/io/trees/graphml.h"
#include "core/io/trees/node_graph.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace ramus::io {

namespace {

// Escapes text for an element or an attribute. Characters that XML forbids become blanks.
std::string xml_text(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        if (c == '<')
            safe += "&lt;";
        else if (c == '>')
            safe += "&gt;";
        else if (c == '&')
            safe += "&amp;";
        else if (c == '"')
            safe += "&quot;";
        else
            safe += (c >= '\0' && c < ' ') || c == '\x7f' ? ' ' : c;
    }
    return safe;
}

class GraphmlWriter {
public:
    GraphmlWriter(OutputFile& output, const tree::VesselTree& tree) : output_(output), tree_(tree) {}

    void head(const std::vector<std::string>& comments) {
        output_.write("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        for (std::string comment : comments) {
            comment = xml_text(comment);
            for (std::size_t at = comment.find("--"); at != std::string::npos; at = comment.find("--"))
                comment.replace(at, 2, "- -");
            output_.write("<!-- " + comment + " -->\n");
        }
        output_.write("<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n");
        for (const std::string_view name : {kGraphmlUnits, kGraphmlSpace}) key("graph", "g_", name, "string");
        for (const std::string_view name : {"X", "Y", "Z", "radius"}) key("node", "v_", name, "double");
        key("node", "v_", kRootColumn, "boolean");
        if (!tree_.labels.empty()) key("node", "v_", kLabelColumn, "int");
        if (!tree_.systems.empty())
            for (const std::string_view name : {kSystemColumn, kColourColumn}) key("node", "v_", name, "string");
        for (const std::string_view name : {"radius_avg", "length"}) key("edge", "e_", name, "double");
        key("edge", "e_", "branch", "int");
        for (const tree::DataArray& array : tree_.point_data) key("node", "v_", data_name(array), "double");
        for (const tree::DataArray& array : tree_.branch_data) key("edge", "e_", data_name(array), "double");
        output_.write("<graph id=\"tree\" edgedefault=\"directed\">\n");
        text("g_", kGraphmlUnits, std::string(tree_.claims.unit_word()));
        text("g_", kGraphmlSpace, std::string(tree_.claims.axes_word()));
    }

    void nodes() {
        std::vector<int> system(tree_.points.size(), 0);
        for (const tree::Branch& branch : tree_.branches)
            for (const std::uint32_t p : branch.points) system[p] = branch.system;
        std::vector<bool> is_root(tree_.points.size(), false);
        for (const std::uint32_t root : tree_.roots) is_root[root] = true;
        for (std::size_t p = 0; p < tree_.points.size(); ++p) {
            const tree::Point& at = tree_.points[p];
            output_.write("<node id=\"n" + std::to_string(p) + "\">");
            number("v_", "X", at.position.x);
            number("v_", "Y", at.position.y);
            number("v_", "Z", at.position.z);
            number("v_", "radius", at.radius);
            if (is_root[p]) text("v_", kRootColumn, "true");
            if (!tree_.labels.empty()) number("v_", kLabelColumn, tree_.labels[p]);
            if (!tree_.systems.empty()) {
                const tree::System& of = tree_.systems[static_cast<std::size_t>(system[p])];
                text("v_", kSystemColumn, of.name);
                text("v_", kColourColumn, colour_text(of.colour));
            }
            data("v_", tree_.point_data, p);
            output_.write("</node>\n");
        }
    }

    void edges() {
        for (std::size_t b = 0; b < tree_.branches.size(); ++b) {
            const std::vector<std::uint32_t>& points = tree_.branches[b].points;
            for (std::size_t i = 1; i < points.size(); ++i) {
                const tree::Point &from = tree_.points[points[i - 1]], &to = tree_.points[points[i]];
                output_.write("<edge source=\"n" + std::to_string(points[i - 1]) + "\" target=\"n" +
                              std::to_string(points[i]) + "\">");
                number("e_", "radius_avg", 0.5 * (from.radius + to.radius));
                number("e_", "length", glm::distance(from.position, to.position));
                number("e_", "branch", b);
                data("e_", tree_.branch_data, b);
                output_.write("</edge>\n");
            }
        }
        output_.write("</graph>\n</graphml>\n");
    }

private:
    static std::string data_name(const tree::DataArray& array) {
        return xml_text(name_in_file(array.name, kTakenByNodes));
    }
    // An unknown value has no element.
    void data(std::string_view prefix, const tree::DataArrays& arrays, std::size_t of) {
        for (const tree::DataArray& array : arrays)
            if (tree::is_known(array.values[of])) number(prefix, data_name(array), array.values[of]);
    }
    void key(std::string_view of, std::string_view prefix, std::string_view name, std::string_view type) {
        for (const std::string_view part :
             {std::string_view("<key id=\""), prefix, name, std::string_view("\" for=\""), of,
              std::string_view("\" attr.name=\""), name, std::string_view("\" attr.type=\""), type})
            output_.write(part);
        output_.write("\"/>\n");
    }
    void open(std::string_view prefix, std::string_view name) {
        for (const std::string_view part : {std::string_view("<data key=\""), prefix, name, std::string_view("\">")})
            output_.write(part);
    }
    template <class T> void number(std::string_view prefix, std::string_view name, T value) {
        open(prefix, name);
        output_.write_number(value);
        output_.write("</data>");
    }
    void text(std::string_view prefix, std::string_view name, std::string_view value) {
        open(prefix, name);
        output_.write(xml_text(value));
        output_.write("</data>");
    }

    OutputFile& output_;
    const tree::VesselTree& tree_;
};

} // namespace

Result<void> write_graphml(const tree::VesselTree& tree, const std::filesystem::path& file,
                           const std::vector<std::string>& comments) {
    RAMUS_TRY(output, OutputFile::create(file));
    GraphmlWriter writer(output, tree);
    writer.head(comments);
    writer.nodes();
    writer.edges();
    return output.commit();
}

} // namespace ramus::io
