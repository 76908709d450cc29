#include "core/io/text_numbers.h"
#include "core/io/trees/json_input.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/voreen.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

namespace ramus::io {

namespace {

constexpr const char* kVvgRemedy = "write the file anew with Voreen";

// Voreen writes numbers that JSON does not have. They are replaced by null, on the same line.
std::string vvg_without_infinity(std::string_view text) {
    constexpr std::string_view kNoNumbers[] = {"-Infinity", "Infinity", "-inf", "inf", "NaN", "-nan", "nan"};
    std::string plain;
    plain.reserve(text.size());
    bool quoted = false;
    for (std::size_t at = 0; at < text.size();) {
        const char c = text[at];
        if (quoted && c == '\\' && at + 1 < text.size())
            plain += text[at++];
        else if (c == '"')
            quoted = !quoted;
        else if (!quoted && (c == '-' || c == 'I' || c == 'i' || c == 'N' || c == 'n')) {
            const auto word = std::ranges::find_if(
                kNoNumbers, [&](std::string_view candidate) { return text.substr(at).starts_with(candidate); });
            if (word != std::end(kNoNumbers)) {
                plain += "null";
                at += word->size();
                continue;
            }
        }
        plain += text[at++];
    }
    return plain;
}

// Consumes objects while the file is parsed, so memory holds their numbers and no JSON value for each voxel. The file
// is parsed twice, first for nodes and then for edges, because it may have them in either order.
class VvgReader {
public:
    explicit VvgReader(const TreeInput& input) : name_(input.name) {
        const auto asked = input.options.columns.find("radius");
        radius_name_ = asked == input.options.columns.end() ? "avgDistToSurface" : asked->second;
    }

    Result<ImportedTree> read(std::string_view text) {
        RAMUS_TRY(names, parsed_json(text, name_, [](JsonPath /*list*/) { return JsonElements([](auto&) {}); }));
        const nlohmann::json* member = json_member(names, "graph");
        for (const char* key : {"nodes", "edges"})
            if (json_list(member == nullptr ? names : *member, key) == nullptr)
                return fail("there is no list of " + std::string(key), name_, kVvgRemedy);
        depth_ = member == nullptr ? 0 : 1;
        if (auto good = take(text, &VvgReader::node_taker); !good) return tl::unexpected(good.error());
        nodes_ = edge_first_ = imported_.graph.points.size();
        if (auto good = take(text, &VvgReader::edge_taker); !good) return tl::unexpected(good.error());
        if (imported_.graph.edges.empty()) return fail("no edge connects two nodes", name_, "choose another file");
        if (imported_.graph.points.size() >= std::numeric_limits<std::uint32_t>::max())
            return fail("the file has more points than can be counted", name_, "split it");
        complete_radii();
        tree::Graph& graph = imported_.graph;
        graph.point_data = std::move(point_data_).arrays(graph.points.size(), imported_);
        graph.edge_data = std::move(edge_data_).arrays(graph.edges.size(), imported_);
        imported_.edges_are_vessels = true;
        imported_.place_of = [name = name_, count = nodes_, firsts = firsts_](std::uint32_t point) {
            if (point < count) return name + ": nodes[" + std::to_string(point) + "]";
            const auto edge = static_cast<std::size_t>(std::ranges::upper_bound(firsts, point) - firsts.begin() - 1);
            return name + ": edges[" + std::to_string(edge) + "].skeletonVoxels[" +
                   std::to_string(point - firsts[edge]) + "]";
        };
        return std::move(imported_);
    }

private:
    Result<void> take(std::string_view text, JsonElements (VvgReader::*taker)(JsonPath)) {
        const auto rest = parsed_json(text, name_, [&](JsonPath list) {
            const bool of_graph = list.size() > depth_ && (depth_ == 0 || list.front() == "graph");
            return of_graph ? (this->*taker)(list.subspan(depth_)) : JsonElements([](auto&) {});
        });
        if (!rest) return tl::unexpected(rest.error());
        return wrong_ ? Result<void>(tl::unexpected(*wrong_)) : Result<void>();
    }

    // Does nothing after the first error.
    template <class Read> JsonElements checked(const Read& read) {
        return [this, read](const nlohmann::json& value) {
            if (wrong_) return;
            if (auto good = read(value); !good) wrong_ = good.error();
        };
    }

    // Keeps only the position of the lists of an object: the lists of voxels of nodes are most of a file.
    static bool is_position(JsonPath list) { return list.back() == "pos"; }

    JsonElements node_taker(JsonPath list) {
        if (list.front() == "nodes" && list.size() == 1)
            return checked([this](const nlohmann::json& node) { return read_node(node); });
        return list.front() == "nodes" && is_position(list) ? JsonElements() : [](auto&) {};
    }

    JsonElements edge_taker(JsonPath list) {
        if (list.front() == "edges" && list.size() == 1)
            return checked([this](const nlohmann::json& edge) { return read_edge(edge); });
        if (list.front() == "edges" && list.size() == 3 && list.back() == "skeletonVoxels") {
            imported_.graph.points.resize(edge_first_);
            return checked([this](const nlohmann::json& voxel) { return read_voxel(voxel); });
        }
        return list.front() == "edges" && is_position(list) ? JsonElements() : [](auto&) {};
    }

    // A valid distance, else 0.
    static double vvg_radius(const nlohmann::json* value) {
        const double radius = json_real(value).value_or(0.0);
        return std::isfinite(radius) && radius > 0.0 ? radius : 0.0;
    }

    Result<void> read_node(const nlohmann::json& node) {
        const std::size_t number = imported_.graph.points.size();
        const auto place = [&] { return name_ + ": nodes[" + std::to_string(number) + "]"; };
        const auto id = vvg_id(node, "id");
        if (!id) return fail("the node has no id", place(), kVvgRemedy);
        const auto position = json_position(json_member(node, "pos"));
        if (!position) return fail("pos is not [x, y, z]", place(), kVvgRemedy);
        if (!index_of_.emplace(*id, static_cast<std::uint32_t>(number)).second)
            return fail("the id " + std::to_string(*id) + " is there twice", place(), "give each node its own");
        imported_.graph.points.push_back({*position, vvg_radius(json_member(node, "radius"))});
        return {};
    }

    static std::optional<std::int64_t> vvg_id(const nlohmann::json& object, const char* key) {
        const nlohmann::json* id = json_member(object, key);
        if (id == nullptr || !id->is_number_integer()) return std::nullopt;
        return id->get<std::int64_t>();
    }

    // The other numbers of an object, as data of points or edges.
    void read_data(const nlohmann::json& object, SparseData& data, std::size_t first, std::size_t end) const {
        constexpr std::string_view kNoData[] = {"id", "pos", "radius", "length"}; // read, or follow from the points
        for (const auto& [key, value] : object.items()) {
            if (std::ranges::find(kNoData, key) != std::end(kNoData) || key == radius_name_) continue;
            const auto number = json_real(&value);
            if (!number) continue; // infinite, or a list
            const std::size_t array = data.array(key);
            for (std::size_t index = first; index < end; ++index) data.set(array, index, *number);
        }
    }

    [[nodiscard]] std::string edge_place() const { return name_ + ": edges[" + std::to_string(firsts_.size()) + "]"; }

    Result<void> read_voxel(const nlohmann::json& voxel) {
        const auto position = json_position(json_member(voxel, "pos"));
        if (!position) return fail("a voxel of its skeleton has no pos of [x, y, z]", edge_place(), kVvgRemedy);
        std::vector<tree::Point>& points = imported_.graph.points;
        const std::size_t point = points.size();
        points.push_back({*position, vvg_radius(json_member(voxel, radius_name_.c_str()))});
        read_data(voxel, point_data_, point, point + 1);
        return {};
    }

    // Its voxels have been read.
    Result<void> read_edge(const nlohmann::json& edge) {
        tree::Graph& graph = imported_.graph;
        std::uint32_t ends[2] = {};
        for (int side = 0; side < 2; ++side) {
            const char* key = side == 0 ? "node1" : "node2";
            const auto id = vvg_id(edge, key);
            const auto found = id ? index_of_.find(*id) : index_of_.end();
            if (found == index_of_.end()) return fail(std::string(key) + " names no node", edge_place(), kVvgRemedy);
            ends[side] = found->second;
        }
        firsts_.push_back(static_cast<std::uint32_t>(edge_first_));
        const std::size_t first_link = graph.edges.size();
        std::uint32_t before = ends[0];
        for (; edge_first_ < graph.points.size(); ++edge_first_) {
            graph.edges.emplace_back(before, static_cast<std::uint32_t>(edge_first_));
            before = static_cast<std::uint32_t>(edge_first_);
        }
        const nlohmann::json* whole = json_member(edge, "pathProperties");
        mean_radii_.push_back(whole == nullptr ? 0.0 : vvg_radius(json_member(*whole, "avgRadiusAvg")));
        if (before != ends[1] || ends[0] != ends[1]) graph.edges.emplace_back(before, ends[1]);
        ends_.emplace_back(ends[0], ends[1]);
        if (whole != nullptr && whole->is_object()) read_data(*whole, edge_data_, first_link, graph.edges.size());
        return {};
    }

    // Fills in missing radii: a node gets the largest of the nearest ones along its edges, a voxel an interpolated one
    // from the nearest ones on both sides.
    void complete_radii() {
        std::vector<tree::Point>& points = imported_.graph.points;
        const auto unknown = [](const tree::Point& point) { return point.radius <= 0.0; };
        const auto before = std::ranges::count_if(points, unknown);
        std::vector<double> at_nodes(nodes_, 0.0);
        for (std::size_t e = 0; e < ends_.size(); ++e) {
            const auto [first, last] = voxels_of(e);
            double from = mean_radii_[e], to = mean_radii_[e];
            for (std::uint32_t p = last; p-- > first;)
                if (!unknown(points[p])) from = points[p].radius;
            for (std::uint32_t p = first; p < last; ++p)
                if (!unknown(points[p])) to = points[p].radius;
            at_nodes[ends_[e].first] = std::max(at_nodes[ends_[e].first], from);
            at_nodes[ends_[e].second] = std::max(at_nodes[ends_[e].second], to);
        }
        for (std::size_t n = 0; n < nodes_; ++n)
            if (unknown(points[n])) points[n].radius = at_nodes[n];
        for (std::size_t e = 0; e < ends_.size(); ++e) fill_voxels(e);
        const auto after = std::ranges::count_if(points, unknown);
        if (before > after)
            imported_.assume("radius", counted(static_cast<std::size_t>(before - after), "point") +
                                           " without a distance to the surface took it from the next along the vessel");
    }

    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> voxels_of(std::size_t edge) const {
        return {firsts_[edge], edge + 1 < firsts_.size() ? firsts_[edge + 1]
                                                         : static_cast<std::uint32_t>(imported_.graph.points.size())};
    }

    void fill_voxels(std::size_t edge) {
        std::vector<tree::Point>& points = imported_.graph.points;
        const auto [first, last] = voxels_of(edge);
        std::vector<std::uint32_t> chain{ends_[edge].first};
        for (std::uint32_t p = first; p < last; ++p) chain.push_back(p);
        chain.push_back(ends_[edge].second);
        std::size_t known = 0;
        for (std::size_t next = 1; next < chain.size(); ++next) {
            const tree::Point &a = points[chain[known]], &b = points[chain[next]];
            if (b.radius <= 0.0) continue;
            std::vector<double> along{0.0};
            for (std::size_t i = known + 1; i <= next; ++i)
                along.push_back(along.back() + glm::distance(points[chain[i - 1]].position, points[chain[i]].position));
            for (std::size_t i = known + 1; i < next; ++i) {
                const double share = along.back() > 0.0 ? along[i - known] / along.back() : 0.0;
                points[chain[i]].radius = a.radius > 0.0 ? a.radius + share * (b.radius - a.radius) : b.radius;
            }
            known = next;
        }
        const double last_known = points[chain[known]].radius;
        for (std::size_t i = known + 1; i + 1 < chain.size(); ++i)
            if (last_known > 0.0) points[chain[i]].radius = last_known;
    }

    const std::string& name_;
    std::string radius_name_;
    ImportedTree imported_;
    SparseData point_data_, edge_data_;
    std::size_t depth_ = 0;                  // of keys that lead to the graph
    std::size_t nodes_ = 0, edge_first_ = 0; // points that are nodes, and those before the edge that is read
    std::optional<Error> wrong_;
    std::unordered_map<std::int64_t, std::uint32_t> index_of_;
    std::vector<std::uint32_t> firsts_; // by edge: its first voxel
    std::vector<tree::Edge> ends_;      // by edge: its nodes
    std::vector<double> mean_radii_;    // by edge: where it is known without voxels, else 0
};

} // namespace

bool is_voreen(std::string_view head) {
    const auto has = [&](std::string_view word) { return head.find(word) != std::string_view::npos; };
    return begins_json_object(head) && has("\"nodes\"") &&
           (has("\"graph\"") || has("\"voxels_\"") || has("\"isAtSampleBorder\"") || has("\"skeletonVoxels\""));
}

Result<ImportedTree> parse_voreen(const TreeInput& input) {
    return VvgReader(input).read(vvg_without_infinity(input.text));
}

} // namespace ramus::io
