#include "core/io/text_numbers.h"
#include "core/io/trees/json_input.h"
#include "core/io/trees/slicer.h"
#include "core/io/trees/tree_data.h"
#include "core/io/trees/width_names.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

constexpr const char* kMrkRemedy = "save the curves anew in 3D Slicer";

// The code of a unit: "mm", or its first word where it is coded: ["mm", "UCUM", "millimeter"].
std::string mrk_unit(const nlohmann::json& object, const char* key) {
    const nlohmann::json* list = json_list(object, key);
    if (list != nullptr && !list->empty() && list->front().is_string()) return list->front().get<std::string>();
    return json_text(object, key);
}

class MarkupsReader {
public:
    MarkupsReader(const TreeInput& input, const nlohmann::json& document)
        : input_(input), name_(input.name), document_(document) {}

    Result<ImportedTree> read() {
        const nlohmann::json* markups = json_list(document_, "markups");
        if (markups == nullptr) return fail("there is no list of markups", name_, kMrkRemedy);
        choose_measurement(*markups);
        for (std::size_t m = 0; m < markups->size(); ++m) {
            place_ = name_ + ": markups[" + std::to_string(m) + "]";
            const std::string type = json_text((*markups)[m], "type");
            if (type != "Curve" && type != "ClosedCurve" && type != "Line")
                ++others_;
            else if (auto good = read_curve((*markups)[m], m, type == "ClosedCurve"); !good)
                return tl::unexpected(good.error());
        }
        if (imported_.graph.edges.empty())
            return fail("there are " + counted(markups->size(), "markup") + ", but no curve of two points", name_,
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
        if (others_ > 0) imported_.assume("lines", counted(others_, "markup") + " beside the curves left out");
        if (undefined_ > 0)
            imported_.assume("points", counted(undefined_, "control point") + " without a place left out");
        if (bare_ > 0) imported_.assume("radius", counted(bare_, "curve") + " without a measurement of the radius");
    }

    // One name for all curves.
    void choose_measurement(const nlohmann::json& markups) {
        std::vector<std::string> names;
        for (const nlohmann::json& markup : markups)
            if (const nlohmann::json* measurements = json_list(markup, "measurements"))
                for (const nlohmann::json& measurement : *measurements)
                    if (std::string name = json_text(measurement, "name");
                        json_list(measurement, "controlPointValues") != nullptr &&
                        std::ranges::find(names, name) == names.end() && names.size() < 100)
                        names.push_back(std::move(name));
        const auto chosen = choose_width(names, input_.options);
        if (!chosen) return;
        measurement_ = names[chosen->index];
        imported_.radius_is = chosen->is;
        if (chosen->open) imported_.radius_name = measurement_;
    }

    Result<void> read_curve(const nlohmann::json& curve, std::size_t number, bool closed) {
        const nlohmann::json* rows = json_list(curve, "controlPoints");
        if (rows == nullptr) return fail("the curve has no list of controlPoints", place_, kMrkRemedy);
        if (auto good = read_unit(curve); !good) return good;
        RAMUS_TRY(orientation, axes_of(curve));
        if (!imported_.orientation) imported_.orientation = orientation;
        const bool turned = *imported_.orientation != orientation;
        RAMUS_TRY(radii, radii_of(curve, rows->size()));
        tree::Graph& graph = imported_.graph;
        const auto first = static_cast<std::uint32_t>(graph.points.size());
        if (graph.points.size() + rows->size() >= std::numeric_limits<std::uint32_t>::max())
            return fail("the file has more points than can be counted", name_, "split it");
        firsts_.push_back(first), numbers_.push_back(number);
        for (std::size_t p = 0; p < rows->size(); ++p) {
            const nlohmann::json& row = (*rows)[p];
            const std::string status = json_text(row, "positionStatus");
            if (!status.empty() && status != "defined") {
                ++undefined_;
                continue;
            }
            auto position = json_position(json_member(row, "position"));
            if (!position)
                return fail("the position is not [x, y, z]", place_ + ", point " + std::to_string(p), kMrkRemedy);
            if (turned) position->x = -position->x, position->y = -position->y;
            const auto point = static_cast<std::uint32_t>(graph.points.size());
            graph.points.push_back({*position, radii[p]});
            if (point > first) graph.edges.emplace_back(point - 1, point);
        }
        read_data(curve, first, rows->size());
        const auto last = static_cast<std::uint32_t>(graph.points.size());
        if (closed && last - first > 2) graph.edges.emplace_back(last - 1, first);
        return {};
    }

    Result<void> read_unit(const nlohmann::json& curve) {
        const std::string text = mrk_unit(curve, "coordinateUnits");
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

    [[nodiscard]] Result<Orientation> axes_of(const nlohmann::json& curve) const {
        const nlohmann::json* value = json_member(curve, "coordinateSystem");
        if (value == nullptr) return Orientation::lps();
        const std::string text = value->is_string() ? value->get<std::string>() : value->dump();
        if (text == "LPS" || text == "1") return Orientation::lps();
        if (text == "RAS" || text == "0") return Orientation::ras();
        return fail("its coordinateSystem is " + shown(text), place_, "LPS and RAS are read");
    }

    // One for each control point; 0: not known.
    Result<std::vector<double>> radii_of(const nlohmann::json& curve, std::size_t count) {
        std::vector<double> radii(count, 0.0);
        const nlohmann::json* measurements = json_list(curve, "measurements");
        const nlohmann::json* values = nullptr;
        if (measurements != nullptr)
            for (const nlohmann::json& measurement : *measurements)
                if (values == nullptr && !measurement_.empty() && json_text(measurement, "name") == measurement_)
                    values = json_list(measurement, "controlPointValues");
        if (values == nullptr) {
            ++bare_;
            return radii;
        }
        if (values->size() != count)
            return fail("the measurement " + shown(measurement_) + " has " + counted(values->size(), "value") +
                            " for " + counted(count, "control point"),
                        place_, "measure the curve anew, or remove the measurement");
        has_radii_ = true;
        for (std::size_t p = 0; p < count; ++p) radii[p] = json_real(&(*values)[p]).value_or(0.0);
        return radii;
    }

    // Other measurements of a curve whose points all have a place, as data of points.
    void read_data(const nlohmann::json& curve, std::size_t first, std::size_t count) {
        const nlohmann::json* measurements = json_list(curve, "measurements");
        if (measurements == nullptr || imported_.graph.points.size() != first + count) return;
        for (const nlohmann::json& measurement : *measurements) {
            const std::string name = json_text(measurement, "name");
            const nlohmann::json* values = json_list(measurement, "controlPointValues");
            if (values == nullptr || values->size() != count || name == measurement_) continue;
            const std::size_t array = data_.array(name);
            for (std::size_t p = 0; p < count; ++p)
                data_.set(array, first + p, json_real(&(*values)[p]).value_or(tree::kUnknownValue));
        }
    }

    // What this program wrote beside the curves; false, and nothing taken, where it does not fit them.
    bool take_own(const nlohmann::json& own) {
        const nlohmann::json* curves = json_list(own, "curves");
        if (curves == nullptr || others_ + undefined_ + bare_ > 0 || curves->size() != firsts_.size()) return false;
        const tree::Graph& read = imported_.graph;
        std::vector<std::int64_t> stands; // by point that was read: the tree's
        for (const nlohmann::json& curve : *curves)
            for (const nlohmann::json& point : curve) {
                if (!point.is_number_unsigned() || point.get<std::uint64_t>() >= read.points.size()) return false;
                stands.push_back(point.get<std::int64_t>());
            }
        if (stands.size() != read.points.size()) return false;
        for (std::size_t c = 0, first = 0; c < firsts_.size(); first += (*curves)[c].size(), ++c)
            if (first != firsts_[c]) return false;
        std::size_t count = 0;
        for (const std::int64_t index : stands) count = std::max(count, static_cast<std::size_t>(index) + 1);
        tree::Graph graph;
        graph.points.resize(count);
        std::vector<std::uint32_t> first_of(count, std::numeric_limits<std::uint32_t>::max());
        for (std::uint32_t p = 0; p < stands.size(); ++p) {
            std::uint32_t& first = first_of[static_cast<std::size_t>(stands[p])];
            if (first != std::numeric_limits<std::uint32_t>::max() && read.points[first] != read.points[p])
                return false; // it was moved
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
        if (const nlohmann::json* roots = json_list(own, "roots"))
            for (const nlohmann::json& root : *roots) {
                if (!below(root, graph.points.size())) return false;
                graph.roots.push_back(root.get<std::uint32_t>());
            }
        if (const nlohmann::json* labels = json_list(own, "labels")) {
            if (labels->size() != graph.points.size()) return false;
            for (const nlohmann::json& label : *labels) {
                if (!label.is_number_integer()) return false;
                graph.labels.push_back(static_cast<int>(label.get<std::int64_t>()));
            }
        }
        const nlohmann::json *systems = json_list(own, "systems"), *of_curves = json_list(own, "curve_systems");
        if (systems == nullptr) return true;
        if (systems->empty() || of_curves == nullptr || of_curves->size() != firsts_.size()) return false;
        for (const nlohmann::json& entry : *systems) {
            tree::System system{json_text(entry, "name"), {}};
            const nlohmann::json* colour = json_list(entry, "colour");
            for (std::size_t c = 0; c < 3 && colour != nullptr && colour->size() == 3; ++c)
                if (below((*colour)[c], 256)) system.colour[c] = (*colour)[c].get<std::uint8_t>();
            graph.systems.push_back(std::move(system));
        }
        graph.point_systems.assign(graph.points.size(), 0);
        for (std::size_t c = 0; c < firsts_.size(); ++c) {
            if (!below((*of_curves)[c], graph.systems.size())) return false;
            const std::size_t end = c + 1 < firsts_.size() ? firsts_[c + 1] : stands.size();
            for (std::size_t p = firsts_[c]; p < end; ++p)
                graph.point_systems[static_cast<std::size_t>(stands[p])] = (*of_curves)[c].get<int>();
        }
        return true;
    }

    const TreeInput& input_;
    const std::string& name_;
    const nlohmann::json& document_;
    std::string place_, measurement_; // the curve that is read; the name of its radii
    std::vector<std::uint32_t> firsts_;
    std::vector<std::size_t> numbers_; // by curve: its first point, and its place among all markups
    std::size_t others_ = 0, undefined_ = 0, bare_ = 0;
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
    RAMUS_TRY(document, parsed_json(input.text, input.name));
    return MarkupsReader(input, document).read();
}

} // namespace ramus::io
