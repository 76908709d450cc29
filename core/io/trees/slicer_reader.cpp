#include "core/io/text_numbers.h"
#include "core/io/trees/json_input.h"
#include "core/io/trees/slicer.h"
#include "core/io/trees/slicer_curves.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/width_names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

constexpr const char* kMrkRemedy = "save the curves anew in 3D Slicer";

class MarkupsReader {
public:
    MarkupsReader(const TreeInput& input, const nlohmann::json& document, MarkupsLists lists)
        : input_(input), name_(input.name), document_(document), lists_(std::move(lists)) {}

    Result<ImportedTree> read() {
        if (json_list(document_, "markups") == nullptr) return fail("there is no list of markups", name_, kMrkRemedy);
        choose_measurement();
        for (MarkupsCurve& curve : lists_.curves) {
            place_ = name_ + ": markups[" + std::to_string(curve.number) + "]";
            if (auto good = read_curve(curve); !good) return tl::unexpected(good.error());
            curve = {};
        }
        if (imported_.graph.edges.empty())
            return fail("there are " + counted(lists_.markups, "markup") + ", but no curve of two points", name_,
                        "a tree needs curves: in 3D Slicer, Extract Centerline makes them");
        if (!has_radii_ && !input_.options.radius_mm)
            return fail("no curve has a measurement of its radius", name_,
                        "a measurement \"Radius\" with controlPointValues is needed (Extract Centerline writes it), or "
                        "give all points the same radius with --radius MM");
        imported_.joining = Joining::kAtCoincidingEnds;
        imported_.place_of = [name = name_, firsts = firsts_, numbers = numbers_](std::uint32_t point) {
            const auto curve = static_cast<std::size_t>(std::ranges::upper_bound(firsts, point) - firsts.begin() - 1);
            return name + ": markups[" + std::to_string(numbers[curve]) + "], point " +
                   std::to_string(point - firsts[curve]);
        };
        say_what_went();
        tree::Graph& graph = imported_.graph;
        graph.point_data = std::move(data_).arrays(graph.points.size(), imported_);
        const nlohmann::json* own = json_member(document_, "ramus");
        if (own != nullptr && json_text(*own, "orientation") == tree::kNotSaid) imported_.orientation.reset();
        if (own != nullptr && !take_own(*own))
            imported_.assume("joining",
                             "the curves are not as ramus wrote them: they are joined where their ends meet");
        return std::move(imported_);
    }

private:
    void say_what_went() {
        if (lists_.others > 0)
            imported_.assume("lines", counted(lists_.others, "markup") + " beside the curves left out");
        if (undefined_ > 0)
            imported_.assume("points", counted(undefined_, "control point") + " without a place left out");
        if (bare_ > 0) imported_.assume("radius", counted(bare_, "curve") + " without a measurement of the radius");
    }

    // One name for all curves.
    void choose_measurement() {
        std::vector<std::string> names;
        for (const MarkupsCurve& curve : lists_.curves)
            for (const MarkupsMeasurement& measurement : curve.measurements)
                if (std::ranges::find(names, measurement.name) == names.end() && names.size() < 100)
                    names.push_back(measurement.name);
        const auto chosen = choose_width(names, input_.options);
        if (!chosen) return;
        measurement_ = names[chosen->index];
        imported_.radius_is = chosen->is;
        if (chosen->open) imported_.radius_name = measurement_;
    }

    Result<void> read_curve(const MarkupsCurve& curve) {
        if (!curve.has_points) return fail("the curve has no list of controlPoints", place_, kMrkRemedy);
        if (auto good = read_unit(curve.unit); !good) return good;
        RAMUS_TRY(orientation, axes_of(curve));
        if (!imported_.orientation) imported_.orientation = orientation;
        const bool turned = *imported_.orientation != orientation;
        const std::size_t count = curve.points.size();
        if (curve.bad_point)
            return fail("the position is not [x, y, z]", place_ + ", point " + std::to_string(*curve.bad_point),
                        kMrkRemedy);
        RAMUS_TRY(radii, radii_of(curve));
        tree::Graph& graph = imported_.graph;
        const auto first = static_cast<std::uint32_t>(graph.points.size());
        if (graph.points.size() + count >= std::numeric_limits<std::uint32_t>::max())
            return fail("the file has more points than can be counted", name_, "split it");
        firsts_.push_back(first), numbers_.push_back(curve.number);
        for (std::size_t p = 0; p < count; ++p) {
            if (!curve.points[p]) {
                ++undefined_;
                continue;
            }
            glm::dvec3 position = *curve.points[p];
            if (turned) position.x = -position.x, position.y = -position.y;
            const auto point = static_cast<std::uint32_t>(graph.points.size());
            graph.points.push_back({position, radii[p]});
            if (point > first) graph.edges.emplace_back(point - 1, point);
        }
        read_data(curve, first);
        const auto last = static_cast<std::uint32_t>(graph.points.size());
        if (curve.closed && last - first > 2) graph.edges.emplace_back(last - 1, first);
        return {};
    }

    Result<void> read_unit(const std::string& text) {
        const auto unit = length_unit(text.empty() ? "mm" : text);
        if (!unit && !input_.options.unit)
            return fail("its coordinateUnits " + shown(text) + " are not known", place_,
                        "say which they are with --units");
        if (unit && imported_.unit && *unit != *imported_.unit)
            return fail("its coordinates are in " + name_of(*unit) + ", those of other curves in " +
                            name_of(*imported_.unit),
                        place_, "write all curves in mm");
        if (unit && (!text.empty() || imported_.unit)) imported_.unit = unit;
        return {};
    }

    [[nodiscard]] Result<Orientation> axes_of(const MarkupsCurve& curve) const {
        if (!curve.axes) return Orientation::lps();
        const std::string& text = *curve.axes;
        if (text == "LPS" || text == "1") return Orientation::lps();
        if (text == "RAS" || text == "0") return Orientation::ras();
        return fail("its coordinateSystem is " + shown(text), place_, "LPS and RAS are read");
    }

    // A radius for each control point; 0: unknown.
    Result<std::vector<double>> radii_of(const MarkupsCurve& curve) {
        const auto found = std::ranges::find(curve.measurements, measurement_, &MarkupsMeasurement::name);
        if (measurement_.empty() || found == curve.measurements.end()) {
            ++bare_;
            return std::vector<double>(curve.points.size(), 0.0);
        }
        if (found->values.size() != curve.points.size())
            return fail("the measurement " + shown(measurement_) + " has " + counted(found->values.size(), "value") +
                            " for " + counted(curve.points.size(), "control point"),
                        place_, "measure the curve anew, or remove the measurement");
        has_radii_ = true;
        std::vector<double> radii = found->values;
        for (double& radius : radii)
            if (!tree::is_known(radius)) radius = 0.0;
        return radii;
    }

    // Takes other measurements as data of points, if all points of the curve have a position.
    void read_data(const MarkupsCurve& curve, std::size_t first) {
        const std::size_t count = curve.points.size();
        if (imported_.graph.points.size() != first + count) return;
        for (const MarkupsMeasurement& measurement : curve.measurements) {
            if (measurement.values.size() != count || measurement.name == measurement_) continue;
            const std::size_t array = data_.array(measurement.name);
            for (std::size_t p = 0; p < count; ++p) data_.set(array, first + p, measurement.values[p]);
        }
    }

    // Takes the member "ramus". False, without any change, if it does not fit the curves.
    bool take_own(const nlohmann::json& own) {
        const std::vector<std::int64_t>& stands = lists_.own.points; // by point that was read: the tree's
        const std::vector<std::size_t>& ends = lists_.own.ends;
        if (json_list(own, "curves") == nullptr || !lists_.own.good) return false;
        if (lists_.others + undefined_ + bare_ > 0 || ends.size() != firsts_.size()) return false;
        const tree::Graph& read = imported_.graph;
        for (const std::int64_t point : stands)
            if (static_cast<std::size_t>(point) >= read.points.size()) return false;
        if (stands.size() != read.points.size()) return false;
        for (std::size_t c = 0; c < firsts_.size(); ++c)
            if ((c == 0 ? 0 : ends[c - 1]) != firsts_[c]) return false;
        std::size_t count = 0;
        for (const std::int64_t index : stands) count = std::max(count, static_cast<std::size_t>(index) + 1);
        tree::Graph graph;
        graph.points.resize(count);
        std::vector<std::uint32_t> first_of(count, std::numeric_limits<std::uint32_t>::max());
        for (std::uint32_t p = 0; p < stands.size(); ++p) {
            std::uint32_t& first = first_of[static_cast<std::size_t>(stands[p])];
            if (first != std::numeric_limits<std::uint32_t>::max() && read.points[first] != read.points[p])
                return false; // the point was moved
            first = std::min(first, p);
            graph.points[static_cast<std::size_t>(stands[p])] = read.points[p];
        }
        for (const std::uint32_t first : first_of)
            if (first == std::numeric_limits<std::uint32_t>::max()) return false;
        for (const auto& [a, b] : read.edges)
            graph.edges.emplace_back(static_cast<std::uint32_t>(stands[a]), static_cast<std::uint32_t>(stands[b]));
        graph.point_data = tree::picked(read.point_data, first_of);
        if (!take_own_facts(own, stands, graph)) return false;
        imported_.graph = std::move(graph);
        imported_.joining = Joining::kByIndex;
        imported_.place_of = [place = std::move(imported_.place_of), first_of](std::uint32_t p) {
            return place(first_of[p]);
        };
        return true;
    }

    // Roots, labels, systems.
    bool take_own_facts(const nlohmann::json& own, const std::vector<std::int64_t>& stands, tree::Graph& graph) const {
        const auto below = [](const nlohmann::json& value, std::size_t limit) {
            return value.is_number_unsigned() && value.get<std::uint64_t>() < limit;
        };
        for (const std::uint32_t root : lists_.own.roots)
            if (root >= graph.points.size()) return false;
        graph.roots = lists_.own.roots;
        if (json_list(own, "labels") != nullptr) {
            if (lists_.own.labels.size() != graph.points.size()) return false;
            graph.labels = lists_.own.labels;
        }
        const nlohmann::json* systems = json_list(own, "systems");
        if (systems == nullptr) return true;
        const std::vector<std::uint32_t>& of_curves = lists_.own.systems_of_curves;
        if (systems->empty() || of_curves.size() != firsts_.size()) return false;
        for (const nlohmann::json& entry : *systems) {
            tree::System system{json_text(entry, "name"), {}};
            const nlohmann::json* colour = json_list(entry, "colour");
            for (std::size_t c = 0; c < 3 && colour != nullptr && colour->size() == 3; ++c)
                if (below((*colour)[c], 256)) system.colour[c] = (*colour)[c].get<std::uint8_t>();
            graph.systems.push_back(std::move(system));
        }
        graph.point_systems.assign(graph.points.size(), 0);
        for (std::size_t c = 0; c < firsts_.size(); ++c) {
            if (of_curves[c] >= graph.systems.size()) return false;
            const std::size_t end = c + 1 < firsts_.size() ? firsts_[c + 1] : stands.size();
            for (std::size_t p = firsts_[c]; p < end; ++p)
                graph.point_systems[static_cast<std::size_t>(stands[p])] = static_cast<int>(of_curves[c]);
        }
        return true;
    }

    const TreeInput& input_;
    const std::string& name_;
    const nlohmann::json& document_;
    MarkupsLists lists_;
    std::string place_, measurement_; // the curve that is read; the name of its radii
    std::vector<std::uint32_t> firsts_;
    std::vector<std::size_t> numbers_; // by curve: its first point, and its place among all markups
    std::size_t undefined_ = 0, bare_ = 0;
    bool has_radii_ = false;
    SparseData data_; // of points
    ImportedTree imported_;
};

} // namespace

bool is_markups(std::string_view head) {
    const auto has = [&](std::string_view word) { return head.find(word) != std::string_view::npos; };
    return begins_json_object(head) && (has("markups-schema") || (has("\"markups\"") && has("\"controlPoints\"")));
}

Result<ImportedTree> parse_markups(const TreeInput& input) {
    MarkupsLists lists;
    RAMUS_TRY(document, parsed_json(input.text, input.name, [&](JsonPath list) { return lists.taker_of(list); }));
    return MarkupsReader(input, document, std::move(lists)).read();
}

} // namespace ramus::io
