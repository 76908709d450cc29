#include "core/io/output_file.h"
#include "core/io/trees/slicer.h"
#include "core/io/trees/tree_data.h"

#include <array>
#include <nlohmann/json.hpp>

namespace ramus::io {

namespace {

constexpr std::string_view kTakenByMarkups[] = {"radius"};
constexpr std::array<std::uint8_t, 3> kPlainVessel = {214, 69, 65};

class MarkupsWriter {
public:
    MarkupsWriter(const tree::VesselTree& tree, const Orientation& axes, OutputFile& output)
        : tree_(tree), output_(output), unit_(tree.claims.has_unit()),
          axes_(tree.claims.has_sides() ? axes : Orientation::ras()) {}

    void write() {
        output_.write("{\"@schema\": \"https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/"
                      "Resources/Schema/markups-schema-v1.0.3.json#\",\n\"markups\": [");
        for (std::size_t b = 0; b < tree_.branches.size(); ++b) {
            output_.write(b > 0 ? ",\n" : "\n");
            write_curve(b);
        }
        output_.write("\n],\n");
        write_own();
        output_.write("}\n");
    }

private:
    // Names may contain bytes that are not UTF-8.
    static std::string mrk_quoted(const std::string& text) {
        return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    }

    // Writes a list `[a, b]`; one(element) writes each element.
    template <class List> void mrk_list(const List& values, const auto& one) {
        output_.write("[");
        bool first = true;
        for (const auto& value : values) {
            if (!first) output_.write(", ");
            first = false;
            one(value);
        }
        output_.write("]");
    }
    template <class List> void mrk_numbers(const List& values) {
        mrk_list(values, [&](const auto& value) { output_.write_number(value); });
    }

    void write_curve(std::size_t number) {
        const tree::Branch& branch = tree_.branches[number];
        const bool has_system = !tree_.systems.empty();
        const auto system = static_cast<std::size_t>(branch.system);
        const std::string name = (has_system ? tree_.systems[system].name : "Branch") + " " + std::to_string(number);
        output_.write("{\"type\": \"Curve\", \"coordinateSystem\": \"" + axes_.letters() + "\"" +
                      (unit_ ? ", \"coordinateUnits\": \"mm\"" : "") + ", \"name\": " + mrk_quoted(name) +
                      ",\n\"controlPoints\": ");
        std::size_t id = 0;
        mrk_list(branch.points, [&](std::uint32_t point) {
            const glm::dvec3 at = axes_.to_file(tree_.points[point].position);
            output_.write("\n{\"id\": \"" + std::to_string(++id) + "\", \"label\": \"\", \"position\": ");
            mrk_numbers(std::array{at.x, at.y, at.z});
            output_.write(", \"positionStatus\": \"defined\"}");
        });
        output_.write(",\n\"measurements\": [");
        write_measurement("Radius", unit_ ? "mm" : "", branch.points,
                          [&](std::uint32_t point) { output_.write_number(tree_.points[point].radius); });
        for (const tree::DataArray& array : tree_.point_data) {
            output_.write(",\n");
            write_measurement(name_in_file(array.name, kTakenByMarkups), "", branch.points, [&](std::uint32_t point) {
                const double value = array.values[point];
                if (tree::is_known(value))
                    output_.write_number(value);
                else
                    output_.write("null");
            });
        }
        output_.write("],\n\"display\": {\"visibility\": true, \"pointLabelsVisibility\": false, "
                      "\"propertiesLabelVisibility\": false");
        for (const char* key : {"color", "selectedColor"}) {
            output_.write(std::string(", \"") + key + "\": ");
            mrk_list(has_system ? tree_.systems[system].colour : kPlainVessel,
                     [&](std::uint8_t part) { output_.write_number(part / 255.0); });
        }
        output_.write("}}");
    }

    void write_measurement(const std::string& name, const std::string& unit, const std::vector<std::uint32_t>& points,
                           const auto& value) {
        output_.write("{\"name\": " + mrk_quoted(name) + ", \"enabled\": true, \"units\": \"" + unit +
                      "\", \"controlPointValues\": ");
        mrk_list(points, value);
        output_.write("}");
    }

    void write_own() {
        output_.write("\"ramus\": {\"units\": \"" + std::string(tree_.claims.unit_word()) + "\", \"orientation\": \"" +
                      std::string(tree_.claims.axes_word()) + "\",\n\"roots\": ");
        mrk_numbers(tree_.roots);
        if (!tree_.labels.empty()) {
            output_.write(",\n\"labels\": ");
            mrk_numbers(tree_.labels);
        }
        if (!tree_.systems.empty()) {
            output_.write(",\n\"systems\": ");
            mrk_list(tree_.systems, [&](const tree::System& system) {
                output_.write("{\"name\": " + mrk_quoted(system.name) + ", \"colour\": ");
                mrk_list(system.colour, [&](std::uint8_t part) { output_.write_number(int{part}); });
                output_.write("}");
            });
            output_.write(",\n\"curve_systems\": ");
            mrk_list(tree_.branches, [&](const tree::Branch& branch) { output_.write_number(branch.system); });
        }
        output_.write(",\n\"curves\": ");
        mrk_list(tree_.branches, [&](const tree::Branch& branch) {
            output_.write("\n");
            mrk_numbers(branch.points);
        });
        output_.write("}");
    }

    const tree::VesselTree& tree_;
    OutputFile& output_;
    // Slicer assumes mm if the file states no unit. It has no word for unknown axes: then positions are written
    // unchanged, and the member "ramus" says so.
    bool unit_;
    Orientation axes_;
};

} // namespace

Result<void> write_markups(const tree::VesselTree& tree, const std::filesystem::path& file,
                           const std::vector<std::string>& /*comments*/, const Orientation& axes) {
    RAMUS_TRY(output, OutputFile::create(file));
    MarkupsWriter(tree, axes, output).write();
    return output.commit();
}

} // namespace ramus::io
