#include "core/base/bounds.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/amira.h"
#include "core/io/trees/amira_file.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/width_names.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace ramus::io {

namespace {

constexpr std::size_t kMostAmira = std::numeric_limits<std::uint32_t>::max() / 2; // points of each kind

// Further numbers of points, edges or vertices.
struct AmiraData {
    std::string_view of;
    std::size_t array = SparseData::kNoArray;
    std::vector<double> values;
};

// The values of the arrays that a tree needs.
struct AmiraGraph {
    std::vector<double> vertices, corners, inner_counts, points; // three, two, one and three for each
    std::vector<double> widths;
    const AmiraArray* width_array = nullptr;
    std::vector<AmiraData> data;
};

class AmiraReader {
public:
    explicit AmiraReader(const TreeInput& input) : input_(input), name_(input.name) {}

    Result<ImportedTree> read() {
        RAMUS_TRY(file, amira_file(input_.text, name_));
        if (!file.content_type.empty() && file.content_type != "HxSpatialGraph")
            return fail("this Amira file holds a " + shown(file.content_type) + ", not a tree", name_,
                        "a tree needs a HxSpatialGraph");
        RAMUS_TRY(graph, numbers(file));
        if (auto good = choose_widths(file, graph); !good) return tl::unexpected(good.error());
        if (auto good = read_data(file, graph); !good) return tl::unexpected(good.error());
        if (auto good = build(graph); !good) return tl::unexpected(good.error());
        tree::Graph& read = imported_.graph;
        read.point_data = std::move(point_data_).arrays(read.points.size(), imported_);
        read.edge_data = std::move(edge_data_).arrays(read.edges.size(), imported_);
        if (imported_.graph.edges.empty()) return fail("no edge connects two vertices", name_, "choose another file");
        imported_.edges_are_vessels = true;
        if (auto good = set_unit(file.unit); !good) return tl::unexpected(good.error());
        for (const AmiraArray& array : file.arrays)
            if (!array.is_there)
                note(tree::Note::Kind::kSuspect, "file",
                     array.name + " is declared, but not there: the file may be incomplete");
        imported_.place_of = [name = name_, vertices = vertices_, firsts = std::move(firsts_)](std::uint32_t point) {
            if (point < vertices) return name + ": vertex " + std::to_string(point);
            const auto edge = std::ranges::upper_bound(firsts, point) - firsts.begin() - 1;
            return name + ": edge " + std::to_string(edge);
        };
        return std::move(imported_);
    }

private:
    void note(tree::Note::Kind kind, const std::string& topic, const std::string& text) {
        imported_.notes.push_back({kind, topic, text, {}});
    }

    Result<std::vector<double>> needed(const AmiraFile& file, const char* of, const char* array_name,
                                       std::uint64_t components) {
        const AmiraArray* array = file.find(of, array_name);
        if (array == nullptr || !array->is_there)
            return fail("there is no " + std::string(array_name) + " of " + of, name_,
                        array == nullptr ? "a tree needs a SpatialGraph" : "the file is incomplete; get it again");
        if (array->components != components)
            return fail(array->name + " has " + std::to_string(array->components) + " numbers for each " + of, name_,
                        std::to_string(components) + " are needed");
        return amira_numbers(file, *array, input_.text, name_);
    }

    Result<AmiraGraph> numbers(const AmiraFile& file) {
        AmiraGraph graph;
        RAMUS_TRY(vertices, needed(file, "VERTEX", "VertexCoordinates", 3));
        RAMUS_TRY(corners, needed(file, "EDGE", "EdgeConnectivity", 2));
        RAMUS_TRY(inner_counts, needed(file, "EDGE", "NumEdgePoints", 1));
        RAMUS_TRY(points, needed(file, "POINT", "EdgePointCoordinates", 3));
        if (vertices.size() / 3 > kMostAmira || points.size() / 3 > kMostAmira)
            return fail("the file has more points than can be counted", name_, "split it");
        const std::size_t count = vertices.size() / 3;
        for (std::size_t c = 0; c < corners.size(); ++c)
            if (!(corners[c] >= 0.0 && corners[c] < static_cast<double>(count) && corners[c] == std::floor(corners[c])))
                return fail("edge " + std::to_string(c / 2) + " ends at a vertex that is not one of the " +
                                std::to_string(count),
                            name_, "vertices are counted from 0; correct EdgeConnectivity");
        const std::size_t along = points.size() / 3;
        double sum = 0.0;
        for (const double inner : inner_counts) {
            if (!(inner >= 0.0 && inner == std::floor(inner))) sum = HUGE_VAL;
            sum += inner;
        }
        if (sum != static_cast<double>(along))
            return fail("the edges do not have the " + counted(along, "point") + " that the file declares, together",
                        name_, "correct NumEdgePoints");
        return AmiraGraph{
            std::move(vertices), std::move(corners), std::move(inner_counts), std::move(points), {}, nullptr, {}};
    }

    // Looks among the arrays of points first, then of edges, then of vertices.
    Result<void> choose_widths(const AmiraFile& file, AmiraGraph& graph) {
        std::vector<const AmiraArray*> arrays;
        std::vector<std::string> names;
        std::string list;
        for (const char* of : {"POINT", "EDGE", "VERTEX"})
            for (const AmiraArray& array : file.arrays) {
                if (array.of != of || array.components != 1 || array.name == "NumEdgePoints") continue;
                list += (list.empty() ? "" : ", ") + array.name + " (" + of + ")";
                if (array.is_there) arrays.push_back(&array), names.push_back(array.name);
            }
        const auto chosen = choose_width(names, input_.options);
        static const AmiraArray no_widths{};
        graph.width_array = &no_widths;
        if (!chosen && input_.options.radius_mm) return {};
        if (!chosen)
            return fail("no array gives the radius: there is " + (list.empty() ? "none" : list), name_,
                        "call it \"thickness\", as Amira does, or give all points the same radius with --radius MM");
        graph.width_array = arrays[chosen->index];
        imported_.radius_is = chosen->is;
        if (chosen->open) imported_.radius_name = graph.width_array->name;
        RAMUS_TRY(widths, amira_numbers(file, *graph.width_array, input_.text, name_));
        graph.widths = std::move(widths);
        return {};
    }

    // All arrays without another meaning. Arrays of points and of vertices with the same name become one.
    Result<void> read_data(const AmiraFile& file, AmiraGraph& graph) {
        constexpr std::string_view kRead[] = {"VertexCoordinates", "EdgeConnectivity", "NumEdgePoints",
                                              "EdgePointCoordinates"};
        for (const AmiraArray& array : file.arrays) {
            const bool of_edges = array.of == "EDGE";
            if (!array.is_there || &array == graph.width_array ||
                std::ranges::find(kRead, array.name) != std::end(kRead) ||
                (!of_edges && array.of != "POINT" && array.of != "VERTEX"))
                continue;
            if (array.components != 1) {
                imported_.left_out.push_back(array.name);
                continue;
            }
            RAMUS_TRY(values, amira_numbers(file, array, input_.text, name_));
            graph.data.push_back(
                {array.of, (of_edges ? edge_data_ : point_data_).array(array.name), std::move(values)});
        }
        return {};
    }

    // The values at an index of the file become those of a point or an edge of the tree.
    void take_data(const AmiraGraph& graph, std::string_view of, std::size_t from, std::size_t to) {
        for (const AmiraData& data : graph.data)
            if (data.of == of) (of == "EDGE" ? edge_data_ : point_data_).set(data.array, to, data.values[from]);
    }

    Result<void> set_unit(std::string_view unit) {
        if (unit.empty() || unit == "1") return {};
        imported_.unit = length_unit(unit == "\xB5m" ? "um" : unit); // in Latin 1
        if (imported_.unit || input_.options.unit) return {};
        return fail("the unit of its coordinates is " + shown(unit), name_, "say which one it is with --units");
    }

    static glm::dvec3 at(const std::vector<double>& values, std::size_t index) {
        return {values[3 * index], values[3 * index + 1], values[3 * index + 2]};
    }

    // Whether all points of each edge have the same radius.
    static bool constant_along_edges(const AmiraGraph& graph) {
        std::size_t first = 0;
        for (const double count : graph.inner_counts) {
            const auto end = first + static_cast<std::size_t>(count);
            for (std::size_t p = first + 1; p < end; ++p)
                if (graph.widths[p] != graph.widths[first]) return false;
            first = end;
        }
        return true;
    }

    Result<void> build(const AmiraGraph& graph) {
        vertices_ = graph.vertices.size() / 3;
        std::vector<tree::Point>& points = imported_.graph.points;
        Bounds<glm::dvec3> box;
        for (std::size_t v = 0; v < vertices_; ++v) {
            points.push_back({at(graph.vertices, v), graph.width_array->of == "VERTEX" ? graph.widths[v] : 0.0});
            take_data(graph, "VERTEX", v, v);
            box.hold(points.back().position);
        }
        // The precision of numbers in text files.
        near_ = vertices_ > 0 ? 1e-6 * glm::length(box.size()) : 0.0;
        by_edge_ = graph.width_array->of == "EDGE" || (graph.width_array->of == "POINT" && constant_along_edges(graph));
        std::size_t first = 0;
        for (std::size_t e = 0; e < graph.inner_counts.size(); ++e) {
            const auto count = static_cast<std::size_t>(graph.inner_counts[e]);
            add_edge(graph, e, first, count);
            first += count;
        }
        if (apart_ > 0)
            note(tree::Note::Kind::kAssumed, "joining",
                 counted(apart_, "end") + " of edges that lie apart from their vertices were connected with them");
        if (nowhere_ > 0)
            note(tree::Note::Kind::kRepaired, "repeated-points",
                 counted(nowhere_, "edge") + " from a vertex to itself, with no point between, left out");
        return {};
    }

    [[nodiscard]] bool near(const glm::dvec3& a, const glm::dvec3& b) const { return glm::distance(a, b) <= near_; }

    // Points `first` to `first + count` of the file, which begin and end with those of the vertices.
    void add_edge(const AmiraGraph& graph, std::size_t edge, std::size_t first, std::size_t count) {
        tree::Graph& tree = imported_.graph;
        firsts_.push_back(static_cast<std::uint32_t>(tree.points.size()));
        const auto from = static_cast<std::uint32_t>(graph.corners[2 * edge]);
        const auto to = static_cast<std::uint32_t>(graph.corners[2 * edge + 1]);
        const glm::dvec3 begin = tree.points[from].position, end = tree.points[to].position;
        std::vector<std::size_t> along(count);
        for (std::size_t i = 0; i < count; ++i) along[i] = first + i;
        if (count > 1 && near(at(graph.points, along.front()), end) && near(at(graph.points, along.back()), begin) &&
            !near(begin, end))
            std::ranges::reverse(along);
        if (!along.empty()) take_end(graph, along, from, along.front());
        if (!along.empty()) take_end(graph, along, to, along.back());
        if (along.empty() && from == to) {
            ++nowhere_;
            return;
        }
        const double edge_width = graph.width_array->of == "EDGE"                 ? graph.widths[edge]
                                  : graph.width_array->of == "POINT" && count > 0 ? graph.widths[first]
                                                                                  : 0.0;
        std::uint32_t before = from;
        const auto connect = [&](std::uint32_t point) {
            take_data(graph, "EDGE", edge, tree.edges.size());
            tree.edges.emplace_back(before, point);
            if (by_edge_) imported_.edge_radii.push_back(edge_width);
            before = point;
        };
        for (std::size_t i = 0; i < along.size(); ++i) {
            const double share = static_cast<double>(i + 1) / static_cast<double>(along.size() + 1);
            const double width = graph.width_array->of == "POINT"
                                     ? graph.widths[along[i]]
                                     : glm::mix(tree.points[from].radius, tree.points[to].radius, share);
            take_data(graph, "POINT", along[i], tree.points.size());
            tree.points.push_back({at(graph.points, along[i]), width});
            connect(static_cast<std::uint32_t>(tree.points.size() - 1));
        }
        connect(to);
    }

    // The point at this end of an edge is the vertex. It gets the largest width of its edges, because a joint lies
    // inside the widest vessel.
    void take_end(const AmiraGraph& graph, std::vector<std::size_t>& along, std::uint32_t vertex, std::size_t point) {
        tree::Point& joint = imported_.graph.points[vertex];
        if (graph.width_array->of == "POINT") joint.radius = std::max(joint.radius, graph.widths[point]);
        if (near(at(graph.points, point), joint.position)) {
            std::erase(along, point);
            take_data(graph, "POINT", point, vertex);
        } else {
            ++apart_;
        }
    }

    const TreeInput& input_;
    const std::string& name_;
    ImportedTree imported_;
    SparseData point_data_, edge_data_;
    std::size_t vertices_ = 0, apart_ = 0, nowhere_ = 0;
    double near_ = 0.0;
    bool by_edge_ = false;              // the radii are those of edges
    std::vector<std::uint32_t> firsts_; // by edge: the first point after those of the edges before
};

} // namespace

bool is_amira(std::string_view head) {
    if (!head.starts_with('#')) return false;
    const std::string_view first = trimmed(head.substr(1, head.find('\n') - 1));
    return first.starts_with("Amira") || first.starts_with("Avizo");
}

Result<ImportedTree> parse_amira(const TreeInput& input) { return AmiraReader(input).read(); }

} // namespace ramus::io
