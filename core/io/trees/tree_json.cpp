#include "core/io/trees/tree_json.h"

#include "core/io/output_file.h"

#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

using nlohmann::json;

constexpr const char* kFormat = "ramus-tree";
constexpr int kVersion = 1;
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;

// Unwinds to parse_tree_json(), where it becomes the Error it carries; the checks below are many and deep.
struct Refused {
    Error error;
};

class Reader {
public:
    Reader(const json& document, const std::string& name) : document_(document), name_(name) {}

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
        // Every version so far is in mm and RAS; a file that says otherwise would be misread silently.
        if (const std::string units = text("units"); units != "mm")
            refuse("units", "are '" + units + "', not 'mm'", "convert the coordinates to mm");
        if (const std::string orientation = text("orientation"); orientation != "RAS")
            refuse("orientation", "is '" + orientation + "', not 'RAS'", "convert the coordinates to RAS");
    }

    [[nodiscard]] tree::Graph graph() const {
        tree::Graph graph;
        const json& points = array("points");
        if (points.size() > std::numeric_limits<std::uint32_t>::max()) refuse("points", "are too many");
        graph.points.reserve(points.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
            const json& row = points[p];
            const std::string place = element("points", p);
            if (!row.is_array() || row.size() != 4) refuse(place, "is not [x, y, z, radius]");
            std::array<double, 4> values{};
            for (std::size_t c = 0; c < 4; ++c) {
                if (!row[c].is_number()) refuse(element(place, c), "is not a number");
                values[c] = row[c].get<double>();
            }
            graph.points.push_back({{values[0], values[1], values[2]}, values[3]});
        }
        read_labels(graph);
        const json& branches = array("branches");
        for (std::size_t b = 0; b < branches.size(); ++b) {
            const std::string place = element("branches", b);
            const json& row = branches[b];
            if (!row.is_array() || row.size() < 2) refuse(place, "is not a list of at least two point indices");
            for (std::size_t i = 1; i < row.size(); ++i)
                graph.edges.emplace_back(index(row[i - 1], place, i - 1, points.size()),
                                         index(row[i], place, i, points.size()));
        }
        const json& roots = array("roots");
        for (std::size_t r = 0; r < roots.size(); ++r)
            graph.roots.push_back(index(roots[r], "roots", r, points.size()));
        return graph;
    }

    [[nodiscard]] std::string source() const { return document_.contains("source") ? text("source") : std::string(); }

    [[nodiscard]] std::vector<std::string> repairs() const {
        std::vector<std::string> sentences;
        if (!document_.contains("repairs")) return sentences;
        const json& list = array("repairs");
        for (std::size_t i = 0; i < list.size(); ++i) {
            if (!list[i].is_string()) refuse(element("repairs", i), "is not text");
            sentences.push_back(list[i].get<std::string>());
        }
        return sentences;
    }

private:
    [[noreturn]] void refuse(const std::string& place, const std::string& what,
                             const std::string& hint = "edit the file or write it anew with `ramus convert`") const {
        throw Refused{{what, place.empty() ? name_ : name_ + ": " + place, hint}};
    }
    static std::string element(const std::string& list, std::size_t i) { return list + "[" + std::to_string(i) + "]"; }

    [[nodiscard]] const json& member(const std::string& key) const {
        const auto found = document_.find(key);
        if (found == document_.end()) refuse(key, "is missing");
        return *found;
    }
    [[nodiscard]] const json& array(const std::string& key) const {
        const json& value = member(key);
        if (!value.is_array()) refuse(key, "is not a list");
        return value;
    }
    [[nodiscard]] std::string text(const std::string& key) const {
        const json& value = member(key);
        if (!value.is_string()) refuse(key, "is not text");
        return value.get<std::string>();
    }
    [[nodiscard]] std::uint32_t index(const json& value, const std::string& list, std::size_t i,
                                      std::size_t count) const {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= count)
            refuse(element(list, i), "is not the index of one of the " + std::to_string(count) + " points");
        return value.get<std::uint32_t>();
    }
    void read_labels(tree::Graph& graph) const {
        if (!document_.contains("labels")) return;
        const json& labels = array("labels");
        if (labels.size() != graph.points.size())
            refuse("labels",
                   "are " + std::to_string(labels.size()) + " for " + std::to_string(graph.points.size()) + " points");
        graph.labels.reserve(labels.size());
        for (std::size_t p = 0; p < labels.size(); ++p) {
            if (!labels[p].is_number_integer() || labels[p] < std::numeric_limits<int>::min() ||
                labels[p] > std::numeric_limits<int>::max())
                refuse(element("labels", p), "is not a whole number of 32 bits");
            graph.labels.push_back(labels[p].get<int>());
        }
    }

    const json& document_;
    const std::string& name_;
};

std::string line_of(std::string_view text, std::size_t at) {
    const auto before = text.substr(0, std::min(at, text.size()));
    return std::to_string(1 + std::ranges::count(before, '\n'));
}

Result<json> parse(std::string_view text, const std::string& name) {
    if (text.find_first_not_of(" \t\r\n") == std::string_view::npos)
        return fail("the file is empty", name, "choose another file");
    try {
        return json::parse(text);
    } catch (const json::parse_error& error) {
        return fail("this is not valid JSON", name + ":" + line_of(text, error.byte == 0 ? 0 : error.byte - 1),
                    "edit the file there, or write it anew with `ramus convert`");
    } catch (const json::out_of_range& error) {
        // "... number overflow parsing '1e999'": the number itself leads to its line.
        const std::string message = error.what();
        const std::size_t open = message.find('\'');
        const std::string number =
            open == std::string::npos ? "" : message.substr(open + 1, message.rfind('\'') - open - 1);
        return fail("the number " + number.substr(0, 40) + " is too large",
                    name + ":" + line_of(text, text.find(number)), "correct the number");
    }
}

template <class List> void write_list(const List& values, BufferedFile& file) {
    file.write("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) file.write(", ");
        file.write_number(values[i]);
    }
    file.write("]");
}

// A list with a line for each of `values`, which `write_one` writes.
template <class T, class Write>
void write_lines(const std::vector<T>& values, BufferedFile& file, const Write& write_one) {
    file.write("[");
    for (std::size_t i = 0; i < values.size(); ++i) {
        file.write(i > 0 ? ",\n" : "\n");
        write_one(values[i]);
    }
}

// Quoted; names of files may hold bytes that are not UTF-8.
std::string quoted(const std::string& text) { return json(text).dump(-1, ' ', false, json::error_handler_t::replace); }

} // namespace

bool is_tree_json(std::string_view head) {
    const std::size_t first = head.find_first_not_of(" \t\r\n");
    return first != std::string_view::npos && head[first] == '{' &&
           head.find('"' + std::string(kFormat) + '"') != std::string_view::npos;
}

Result<tree::VesselTree> parse_tree_json(std::string_view text, const std::string& name, const ReadOptions& options) {
    if (text.size() > kLargestFile)
        return fail("the file is larger than " + std::to_string(kLargestFile >> 20) + " MiB", name,
                    "choose a smaller file");
    RAMUS_TRY(document, parse(text, name));
    try {
        const Reader reader(document, name);
        reader.check_header();
        std::vector<std::string> repairs = reader.repairs();
        auto tree = tree::build_tree(reader.graph(), options.repair, [&](std::uint32_t point) {
            return name + ": points[" + std::to_string(point) + "]";
        });
        if (!tree) return tree;
        tree->source = reader.source();
        // What was repaired before comes first.
        repairs.insert(repairs.end(), tree->repairs.begin(), tree->repairs.end());
        tree->repairs = std::move(repairs);
        return tree;
    } catch (const Refused& refused) {
        return tl::unexpected(refused.error);
    }
}

Result<void> write_tree_json(const tree::VesselTree& tree, const std::filesystem::path& path,
                             const std::vector<std::string>& /*comments*/) {
    RAMUS_TRY(file, OutputFile::create(path));
    file.write("{\n\"format\": \"" + std::string(kFormat) + "\",\n\"version\": " + std::to_string(kVersion) +
               ",\n\"units\": \"mm\",\n\"orientation\": \"RAS\",\n");
    if (!tree.source.empty()) file.write("\"source\": " + quoted(tree.source) + ",\n");
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
    file.write("\n],\n\"roots\": ");
    write_list(tree.roots, file);
    file.write(",\n\"repairs\": ");
    write_lines(tree.repairs, file, [&](const std::string& sentence) { file.write(quoted(sentence)); });
    file.write("]\n}\n");
    return file.commit();
}

} // namespace ramus::io
