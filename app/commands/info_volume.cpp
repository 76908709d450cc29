#include "app/commands/info_volume.h"

#include "app/commands/info_parts.h"
#include "app/session/colour_by.h"
#include "app/session/numbers.h"
#include "core/volume/label_counts.h"

#include <algorithm>
#include <functional>
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
    std::vector<volume::SharedCount> shared;
    std::optional<std::uint64_t> inside; // voxels from 0.5 on, if values are fractions
};

// A volume with more different values is a scan, not a mask.
constexpr std::size_t kMostLabels = 256;
constexpr double kHalf = 0.5;

Figures figures_of(const volume::Volume& volume) {
    Figures figures{.voxel_ml = volume::voxel_volume_mm3(volume.to_patient) / 1e3,
                    .labels = listed_counts(volume),
                    .shared = shared_counts(volume),
                    .inside = std::nullopt};
    if (!holds_whole_numbers(volume) && looks_like_a_mask(volume)) figures.inside = count_from(volume, kHalf);
    return figures;
}

// Whether the values are probably grey values of a scan.
bool are_greys(const volume::Volume& volume, const Figures& figures) {
    return figures.labels.size() > kMostLabels && !volume.segmentation;
}

// Prints pairs of labels that overlap, those with the most voxels first.
void print_shared(std::vector<volume::SharedCount> shared) {
    constexpr std::size_t kMost = 20;
    std::ranges::stable_sort(shared, std::greater<>(), &volume::SharedCount::voxels);
    for (std::size_t i = 0; i < std::min(kMost, shared.size()); ++i)
        print_fact("overlap", "labels " + std::to_string(shared[i].labels[0]) + " and " +
                                  std::to_string(shared[i].labels[1]) + " share " +
                                  counted(shared[i].voxels, "voxel", "voxels"));
    if (shared.size() > kMost)
        print_fact("overlap", grouped(shared.size() - kMost) + " more pairs (--json lists them all)");
}

} // namespace

ordered_json volume_json(const volume::Volume& volume) {
    const Figures figures = figures_of(volume);
    const glm::dmat4& m = volume.to_patient;
    ordered_json rows = ordered_json::array();
    for (int row = 0; row < 3; ++row) rows.push_back({m[0][row], m[1][row], m[2][row], m[3][row]});
    ordered_json labels = ordered_json::array();
    if (!are_greys(volume, figures))
        for (const auto& [label, voxels] : figures.labels) {
            labels.push_back(
                {{"label", label}, {"voxels", voxels}, {"volume_ml", static_cast<double>(voxels) * figures.voxel_ml}});
            const volume::LabelName* named = volume::name_of_label(volume, label);
            if (named != nullptr && !named->name.empty()) labels.back()["name"] = named->name;
            if (named != nullptr && named->colour) labels.back()["colour"] = colour_text(*named->colour);
        }
    ordered_json report = {{"size", {volume.size.x, volume.size.y, volume.size.z}},
                           {"spacing_mm", list_of(volume::spacing_mm(m))},
                           {"origin_mm", list_of(glm::dvec3(m[3]))},
                           {"orientation", volume::orientation(m)},
                           {"to_patient", rows},
                           {"type", volume.type},
                           {"values", {{"min", volume.minimum}, {"max", volume.maximum}}},
                           {"labels", labels}};
    if (!volume.value_unit.empty()) report["values"]["unit"] = volume.value_unit;
    if (!volume.modality.empty()) report["modality"] = volume.modality;
    if (volume.window) report["window"] = {{"centre", volume.window->centre}, {"width", volume.window->width}};
    if (volume.segmentation) report["overlaps"] = ordered_json::array();
    for (const auto& [both, voxels] : figures.shared)
        report["overlaps"].push_back({{"labels", both}, {"voxels", voxels}});
    if (are_greys(volume, figures)) report["different_values"] = figures.labels.size();
    if (figures.inside)
        report["inside"] = {{"isovalue", kHalf},
                            {"voxels", *figures.inside},
                            {"volume_ml", static_cast<double>(*figures.inside) * figures.voxel_ml}};
    report["notes"] = volume.notes;
    report["suspicions"] = volume.suspicions;
    return report;
}

void print_volume(const std::string& file, const volume::Volume& volume) {
    const Figures figures = figures_of(volume);
    const auto amount = [&](std::uint64_t voxels) {
        return counted(voxels, "voxel", "voxels") + ", " + rounded(static_cast<double>(voxels) * figures.voxel_ml) +
               " ml";
    };
    const glm::dvec3 spacing = volume::spacing_mm(volume.to_patient);
    std::cout << file << '\n';
    print_fact("size", std::to_string(volume.size.x) + " x " + std::to_string(volume.size.y) + " x " +
                           std::to_string(volume.size.z) + " voxels");
    print_fact("spacing", rounded(spacing.x) + " x " + rounded(spacing.y) + " x " + rounded(spacing.z) + " mm");
    const glm::dvec3 origin = glm::dvec3(volume.to_patient[3]) + 0.0; // no negative zeros
    print_fact("origin", rounded(origin.x) + ", " + rounded(origin.y) + ", " + rounded(origin.z) + " mm (RAS)");
    print_fact("orientation", volume::orientation(volume.to_patient) + " (where its axes lead)");
    print_fact("type", volume.type);
    if (!volume.modality.empty()) print_fact("modality", volume.modality);
    const std::string unit = volume.value_unit.empty() ? "" : " " + volume.value_unit;
    print_fact("values", rounded(volume.minimum) + " to " + rounded(volume.maximum) + unit);
    if (volume.window)
        print_fact("window", rounded(volume.window->centre) + ", " + rounded(volume.window->width) + " wide");
    if (figures.inside) print_fact("from 0.5", amount(*figures.inside));
    if (are_greys(volume, figures))
        print_fact("labels", "none: " + grouped(figures.labels.size()) + " different values");
    else
        for (const auto& [label, voxels] : figures.labels) {
            const volume::LabelName* named = volume::name_of_label(volume, label);
            print_fact("label " + std::to_string(label),
                       amount(voxels) + (named == nullptr || named->name.empty() ? "" : ", " + named->name) +
                           (named == nullptr || !named->colour ? "" : ", " + colour_text(*named->colour)));
        }
    print_shared(figures.shared);
    for (const std::string& note : volume.notes) print_fact("note", note);
    for (const std::string& suspicion : volume.suspicions) print_fact("suspicion", suspicion);
}

} // namespace ramus::app
