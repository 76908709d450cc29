#include "app/commands/volume_info.h"

#include "app/commands/command.h"
#include "app/commands/load_volume.h"
#include "app/session/numbers.h"
#include "core/volume/label_counts.h"

#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

struct Figures {
    double voxel_ml = 0.0;
    std::vector<volume::LabelCount> labels;
    std::optional<std::uint64_t> inside; // of fractions from 0 to 1
};

// More are no labels of a mask, but the grey values of a scan.
constexpr std::size_t kMostLabels = 256;
constexpr double kHalf = 0.5;

Figures figures_of(const volume::Volume& volume) {
    Figures figures{volume::voxel_volume_mm3(volume.to_patient) / 1e3, label_counts(volume), std::nullopt};
    if (!holds_whole_numbers(volume) && looks_like_a_mask(volume)) figures.inside = count_from(volume, kHalf);
    return figures;
}

ordered_json list_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

void print_json(const volume::Volume& volume, const Figures& figures) {
    const glm::dmat4& m = volume.to_patient;
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 3; ++row) rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
    ordered_json labels = ordered_json::array();
    if (figures.labels.size() <= kMostLabels)
        for (const auto& [label, voxels] : figures.labels)
            labels.push_back(
                {{"label", label}, {"voxels", voxels}, {"volume_ml", static_cast<double>(voxels) * figures.voxel_ml}});
    ordered_json report = {{"size", {volume.size.x, volume.size.y, volume.size.z}},
                           {"spacing_mm", list_of(volume::spacing_mm(m))},
                           {"orientation", volume::orientation(m)},
                           {"to_patient", rows},
                           {"type", volume.type},
                           {"values", {{"min", volume.minimum}, {"max", volume.maximum}}},
                           {"labels", labels}};
    if (figures.labels.size() > kMostLabels) report["different_values"] = figures.labels.size();
    if (figures.inside)
        report["inside"] = {{"isovalue", kHalf},
                            {"voxels", *figures.inside},
                            {"volume_ml", static_cast<double>(*figures.inside) * figures.voxel_ml}};
    report["notes"] = volume.notes;
    std::cout << report.dump(2) << '\n';
}

void print_text(const std::string& file, const volume::Volume& volume, const Figures& figures) {
    const auto line = [](const std::string& name, const std::string& value) {
        std::cout << std::left << std::setw(14) << name << std::right << value << '\n';
    };
    const auto amount = [&](std::uint64_t voxels) {
        return counted(voxels, "voxel", "voxels") + ", " + rounded(static_cast<double>(voxels) * figures.voxel_ml) +
               " ml";
    };
    const glm::dvec3 spacing = volume::spacing_mm(volume.to_patient);
    std::cout << file << '\n';
    line("size", std::to_string(volume.size.x) + " x " + std::to_string(volume.size.y) + " x " +
                     std::to_string(volume.size.z) + " voxels");
    line("spacing", rounded(spacing.x) + " x " + rounded(spacing.y) + " x " + rounded(spacing.z) + " mm");
    line("orientation", volume::orientation(volume.to_patient) + " (where its axes lead)");
    line("type", volume.type);
    line("values", rounded(volume.minimum) + " to " + rounded(volume.maximum));
    if (figures.inside) line("from 0.5", amount(*figures.inside));
    if (figures.labels.size() > kMostLabels)
        line("labels", "none: " + grouped(figures.labels.size()) + " different values");
    else
        for (const auto& [label, voxels] : figures.labels) line("label " + std::to_string(label), amount(voxels));
    for (const std::string& note : volume.notes) line("note", note);
}

} // namespace

Result<int> run_volume_info(const std::string& file, const SurfaceFlags& flags, bool json) {
    const auto volume = load_volume(file, flags);
    if (!volume) return tl::unexpected(volume.error());
    const Figures figures = figures_of(*volume);
    if (json)
        print_json(*volume, figures);
    else
        print_text(file, *volume, figures);
    return kDone;
}

} // namespace ramus::app
