#include "core/io/binary_numbers.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/tubetk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <map>
#include <optional>
#include <set>

namespace ramus::io {

namespace {

constexpr std::array<std::string_view, 4> kRadiusNames = {"r", "rad", "radius", "s"};
// Columns that are not kept as data: normals and tangents (they follow from the points), colours, numbers.
constexpr std::string_view kGeometryColumns[] = {"x",  "y",  "z",  "v1x", "v1y",   "v1z",  "v2x",   "v2y", "v2z",
                                                 "tx", "ty", "tz", "red", "green", "blue", "alpha", "id"};
constexpr std::size_t kMostLookedAt = 2'000'000'000; // points, a few seconds

struct Tube {
    std::string type = "Tube";
    std::int64_t id = -1, parent = -1, parent_point = -1;
    bool root = false, artery = true;
    int dimensions = 3;
    glm::dvec3 spacing{1.0}, offset{0.0};
    glm::dmat3 matrix{1.0};
    bool compressed = false, binary = false;
    std::endian order = std::endian::little;
    NumberType number = NumberType::kFloat;
    std::vector<std::string> columns;
    std::size_t count = 0;                  // that it declares
    std::uint32_t first_point = 0, end = 0; // in the graph
    std::string place;
};

struct TreField {
    std::string name; // in small letters
    std::string_view value;
};

// "Name = value", also with a colon. None: the line is neither.
std::optional<TreField> tre_field_of(std::string_view line) {
    const std::size_t sign = line.find_first_of("=:");
    if (sign == std::string_view::npos) return std::nullopt;
    return TreField{lower_case(trimmed(line.substr(0, sign))), trimmed(line.substr(sign + 1))};
}

bool is_tre_true(std::string_view value) { return value.starts_with('T') || value.starts_with('t') || value == "1"; }

class TreReader {
public:
    explicit TreReader(const TreeInput& input) : input_(input), words_(input.text, input.name) {}

    Result<ImportedTree> read() {
        bool inside_unknown = false; // inside an object that is no tube
        Tube tube;
        tube.place = input_.name;
        while (words_.left() > 0) {
            const std::size_t number = words_.line_number();
            const std::string_view line = trimmed(words_.line());
            if (line.empty()) continue;
            const std::string place = input_.name + ":" + std::to_string(number);
            const auto field = tre_field_of(line);
            if (field && field->name == "objecttype") {
                inside_unknown = false;
                tube = Tube{};
                tube.type = field->value;
                tube.place = place;
            } else if (inside_unknown) {
                continue;
            } else if (!field) {
                return fail("found " + shown(line) + " where \"Name = value\" should stand", place,
                            "the file is damaged, or NPoints is too small");
            } else if (field->name == "points") {
                inside_unknown = lower_case(tube.type).find("tube") == std::string::npos;
                if (inside_unknown) continue;
                if (auto good = read_points(tube); !good) return tl::unexpected(good.error());
                tubes_.push_back(tube);
            } else if (auto good = set(tube, *field, place); !good) {
                return tl::unexpected(good.error());
            }
        }
        if (tubes_.empty()) return fail("there is no tube in the file", input_.name, "choose another file");
        if (auto good = connect(); !good) return tl::unexpected(good.error());
        if (!input_.options.orientation)
            imported_.assume("axes", "axes lead to left, posterior, superior (LPS), as in all files of ITK");
        imported_.orientation = Orientation::lps();
        make_systems();
        tree::Graph& graph = imported_.graph;
        graph.point_data = std::move(data_).arrays(graph.points.size(), imported_);
        imported_.joining = Joining::kAtCoincidingEnds;
        imported_.place_of = [name = input_.name, places = std::move(places_)](std::uint32_t point) {
            return name +
                   (places[point] > 0 ? ":" + std::to_string(places[point]) : ": point " + std::to_string(point));
        };
        return std::move(imported_);
    }

private:
    [[nodiscard]] Result<std::vector<double>> numbers(const TreField& field, std::size_t least,
                                                      const std::string& place) const {
        std::vector<double> values;
        WordScanner words(field.value, place);
        for (std::string_view word = words.next(); !word.empty() && values.size() < 16; word = words.next()) {
            const auto value = to_real(word);
            if (!value || !std::isfinite(*value))
                return fail(field.name + " " + shown(word) + " is not a number", place, "correct the file");
            values.push_back(*value);
        }
        if (values.size() < least)
            return fail(field.name + " has " + counted(values.size(), "number") + ", " + std::to_string(least) +
                            " are needed",
                        place, "correct the file");
        return values;
    }

    Result<void> set(Tube& tube, const TreField& field, const std::string& place) {
        const std::string& name = field.name;
        const auto whole = [&](std::int64_t& value) -> Result<void> {
            const auto number = to_whole(field.value);
            if (!number) return fail(name + " " + shown(field.value) + " is not a whole number", place, "correct it");
            value = *number;
            return {};
        };
        if (name == "id") return whole(tube.id);
        if (name == "parentid") return whole(tube.parent);
        if (name == "parentpoint") return whole(tube.parent_point);
        if (name == "root") tube.root = is_tre_true(field.value);
        if (name == "artery") tube.artery = is_tre_true(field.value);
        if (name == "binarydata") tube.binary = is_tre_true(field.value);
        if (name == "compresseddata") tube.compressed = is_tre_true(field.value);
        if (name == "binarydatabyteordermsb" || name == "elementbyteordermsb")
            tube.order = is_tre_true(field.value) ? std::endian::big : std::endian::little;
        if (name == "elementtype") tube.number = field.value == "MET_DOUBLE" ? NumberType::kDouble : NumberType::kFloat;
        if (name == "npoints" || name == "ndims") {
            std::int64_t value = 0;
            if (auto good = whole(value); !good) return good;
            if (value < 0 || (name == "ndims" && value != 2 && value != 3))
                return fail(name + " is " + std::to_string(value), place, "tubes have 2 or 3 dimensions");
            if (name == "ndims") tube.dimensions = static_cast<int>(value);
            if (name == "npoints") tube.count = static_cast<std::size_t>(value);
        }
        if (name == "pointdim") {
            tube.columns.clear();
            WordScanner words(field.value, place);
            for (std::string_view word = words.next(); !word.empty(); word = words.next())
                tube.columns.emplace_back(word);
        }
        return set_transform(tube, field, place);
    }

    Result<void> set_transform(Tube& tube, const TreField& field, const std::string& place) {
        const auto sides = static_cast<std::size_t>(tube.dimensions);
        const auto is_one = [&](std::initializer_list<std::string_view> names) {
            return std::ranges::find(names, field.name) != names.end();
        };
        if (is_one({"elementspacing"})) {
            RAMUS_TRY(values, numbers(field, sides, place));
            for (std::size_t d = 0; d < sides; ++d) tube.spacing[static_cast<int>(d)] = values[d];
        } else if (is_one({"offset", "position", "origin"})) {
            RAMUS_TRY(values, numbers(field, sides, place));
            for (std::size_t d = 0; d < sides; ++d) tube.offset[static_cast<int>(d)] = values[d];
        } else if (is_one({"transformmatrix", "rotation", "orientation"})) {
            RAMUS_TRY(values, numbers(field, sides * sides, place));
            for (std::size_t row = 0; row < sides; ++row)
                for (std::size_t column = 0; column < sides; ++column)
                    tube.matrix[static_cast<int>(column)][static_cast<int>(row)] = values[row * sides + column];
        }
        return {};
    }

    // The columns of x, y, z and the radius.
    [[nodiscard]] Result<std::array<std::size_t, 4>> columns_of(const Tube& tube) const {
        const std::string place = words_.place();
        std::array<std::size_t, 4> found{};
        for (int c = 0; c < 4; ++c) {
            const auto is_it = [&](const std::string& column) {
                const std::string lower = lower_case(column);
                return c < 3 ? lower == std::string(1, static_cast<char>('x' + c))
                             : std::ranges::find(kRadiusNames, lower) != kRadiusNames.end();
            };
            const auto at = std::ranges::find_if(tube.columns, is_it);
            const bool may_lack = c == 2 ? tube.dimensions == 2 : c == 3 && input_.options.radius_mm.has_value();
            if (at == tube.columns.end() && !may_lack)
                return fail(std::string("PointDim names no column of ") + (c == 3 ? "radii" : "positions"), place,
                            c == 3 ? "it needs x, y, z and r, or give all points the same radius with --radius MM"
                                   : "it needs x, y, z and r");
            found[static_cast<std::size_t>(c)] = static_cast<std::size_t>(at - tube.columns.begin());
        }
        return found;
    }

    // By column of a tube: its array, or none.
    [[nodiscard]] std::vector<std::size_t> data_columns(const Tube& tube, std::size_t radius) {
        std::vector<std::size_t> arrays;
        for (std::size_t c = 0; c < tube.columns.size(); ++c) {
            const std::string lower = lower_case(tube.columns[c]);
            const bool is_data =
                c != radius && std::ranges::find(kGeometryColumns, lower) == std::end(kGeometryColumns);
            arrays.push_back(is_data ? data_.array(tube.columns[c]) : SparseData::kNoArray);
        }
        return arrays;
    }

    Result<void> read_points(Tube& tube) {
        if (tube.compressed)
            return fail("the points are compressed", words_.place(), "write the file without compression");
        RAMUS_TRY(columns, columns_of(tube));
        const std::vector<std::size_t> arrays = data_columns(tube, columns[3]);
        tube.first_point = static_cast<std::uint32_t>(imported_.graph.points.size());
        std::vector<double> row(tube.columns.size() + 1, 0.0); // one more, for missing columns
        std::string_view bytes;
        const std::size_t size = tube.columns.size() * size_of(tube.number);
        if (tube.binary) {
            if (tube.count > words_.left() / size) return too_short(tube);
            RAMUS_TRY(taken, words_.bytes(tube.count * size));
            bytes = taken;
        }
        for (std::size_t p = 0; p < tube.count; ++p) {
            if (tube.binary) {
                std::ranges::copy(numbers_in(bytes.substr(p * size, size), tube.number, tube.order), row.begin());
            } else {
                for (std::size_t c = 0; c < tube.columns.size(); ++c) {
                    const std::string_view word = words_.next();
                    if (word.empty()) return too_short(tube);
                    const auto value = to_real(word);
                    if (!value && std::ranges::find(columns, c) != columns.end())
                        return fail("the " + tube.columns[c] + " " + shown(word) + " is not a number", words_.place(),
                                    "correct the file, or NPoints if it is too large");
                    row[c] = value.value_or(tree::kUnknownValue);
                }
            }
            for (std::size_t c = 0; c < arrays.size(); ++c) data_.set(arrays[c], imported_.graph.points.size(), row[c]);
            add_point(tube, {row[columns[0]], row[columns[1]], row[columns[2]]}, row[columns[3]]);
        }
        if (!tube.binary && tube.count > 0 && !trimmed(words_.line()).empty())
            return fail("the rows have more columns than the " + std::to_string(tube.columns.size()) +
                            " that PointDim names",
                        tube.place, "correct PointDim");
        tube.end = static_cast<std::uint32_t>(imported_.graph.points.size());
        return {};
    }

    [[nodiscard]] tl::unexpected<Error> too_short(const Tube& tube) const {
        return fail("the file ends before the " + counted(tube.count, "point") + " that this tube declares", tube.place,
                    "the file is incomplete; get it again");
    }

    void add_point(const Tube& tube, const glm::dvec3& in_tube, double radius) {
        tree::Graph& graph = imported_.graph;
        const auto index = static_cast<std::uint32_t>(graph.points.size());
        graph.points.push_back({tube.matrix * (in_tube * tube.spacing) + tube.offset, radius * tube.spacing.x});
        if (index > tube.first_point) graph.edges.emplace_back(index - 1, index);
        places_.push_back(tube.binary ? 0 : words_.line_number());
    }

    // Connects each tube with the point of its parent that it leaves from.
    Result<void> connect() {
        tree::Graph& graph = imported_.graph;
        if (graph.points.size() >= std::numeric_limits<std::uint32_t>::max())
            return fail("the file has more points than can be counted", input_.name, "split it");
        std::map<std::int64_t, const Tube*> by_id;
        std::set<std::int64_t> twins;
        for (const Tube& tube : tubes_)
            if (!by_id.emplace(tube.id, &tube).second) twins.insert(tube.id);
        std::size_t nearest = 0, looked_at = 0;
        for (const Tube& tube : tubes_) {
            if (tube.first_point == tube.end) continue;
            if (tube.root) graph.roots.push_back(tube.first_point);
            const auto found = by_id.find(tube.parent);
            if (tube.parent < 0 || found == by_id.end() || found->second == &tube) continue; // of a group, or none
            if (twins.contains(tube.parent))
                return fail("several tubes have the ID " + std::to_string(tube.parent), tube.place,
                            "give each its own, for this one names it as its parent");
            const Tube& parent = *found->second;
            const std::uint32_t count = parent.end - parent.first_point;
            if (tube.parent_point >= static_cast<std::int64_t>(count))
                return fail("the tube leaves from point " + std::to_string(tube.parent_point) + " of tube " +
                                std::to_string(tube.parent) + ", which has " + counted(count, "point"),
                            tube.place, "correct ParentPoint");
            if (count == 0) continue;
            if (tube.parent_point < 0) ++nearest, looked_at += count;
            if (looked_at > kMostLookedAt)
                return fail("too many tubes name a parent, but no point of it", tube.place, "add ParentPoint to them");
            const std::uint32_t from = tube.parent_point < 0
                                           ? nearest_of(parent, graph.points[tube.first_point].position)
                                           : parent.first_point + static_cast<std::uint32_t>(tube.parent_point);
            connections_.emplace_back(from, tube.first_point);
        }
        // Points at the same place are joined later.
        for (const auto& [from, to] : connections_)
            if (graph.points[from].position != graph.points[to].position) graph.edges.emplace_back(from, to);
        if (nearest > 0)
            imported_.assume("joining", counted(nearest, "tube") +
                                            " that name a parent, but no point of it, begin at its nearest");
        return {};
    }

    [[nodiscard]] std::uint32_t nearest_of(const Tube& parent, const glm::dvec3& to) const {
        std::uint32_t nearest = parent.first_point;
        for (std::uint32_t p = parent.first_point; p < parent.end; ++p)
            if (glm::distance(imported_.graph.points[p].position, to) <
                glm::distance(imported_.graph.points[nearest].position, to))
                nearest = p;
        return nearest;
    }

    // Only if there are both, and neither is the parent of the other.
    void make_systems() {
        if (std::ranges::all_of(tubes_, [&](const Tube& tube) { return tube.artery == tubes_.front().artery; })) return;
        std::vector<int> systems;
        for (const Tube& tube : tubes_) systems.insert(systems.end(), tube.end - tube.first_point, tube.artery ? 0 : 1);
        for (const auto& [from, to] : connections_)
            if (systems[from] != systems[to]) {
                imported_.assume("systems", "arteries and veins are connected with each other and were not told apart");
                return;
            }
        imported_.graph.systems = {{"arteries", {214, 69, 65}}, {"veins", {70, 110, 200}}};
        imported_.graph.point_systems = std::move(systems);
    }

    const TreeInput& input_;
    WordScanner words_;
    std::vector<Tube> tubes_;
    std::vector<tree::Edge> connections_;
    std::vector<std::size_t> places_; // by point: its line, or 0
    SparseData data_;                 // of points
    ImportedTree imported_;
};

} // namespace

bool is_tre(std::string_view head) {
    const std::size_t at = head.find("ObjectType");
    if (at == std::string_view::npos || head.find('<') < at) return false;
    const auto field = tre_field_of(head.substr(at, head.find('\n', at) - at));
    if (!field || field->name != "objecttype") return false;
    const std::string type = lower_case(field->value);
    return type == "scene" || type == "group" || type.find("tube") != std::string::npos;
}

Result<ImportedTree> parse_tre(const TreeInput& input) { return TreReader(input).read(); }

} // namespace ramus::io
