// OrganChoice: the organ that an operation is planned in: its mask, how its territories are found and which are shown,
// and the patient's size. A plain value, covered by undo.
#pragma once

#include "core/organ/remnant.h"
#include "core/organ/supply.h"
#include "core/volume/label_choice.h"

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

// What the territories that are shown belong to.
enum class TerritoriesOf : std::uint8_t {
    kNothing,    // none are shown
    kOrgan,      // the whole organ
    kSystems,    // each vessel system
    kGeneration, // each branch of a generation
    kNames,      // the branches of each name
    kSelection,  // the selected branches
    kCuts,       // what each cut takes away
    kRemnant,    // what remains after all cuts: kept, not drained, not supplied, neither
};
inline constexpr std::array<std::pair<TerritoriesOf, std::string_view>, 8> kTerritoriesOf{
    {{TerritoriesOf::kNothing, "off"},
     {TerritoriesOf::kOrgan, "organ"},
     {TerritoriesOf::kSystems, "systems"},
     {TerritoriesOf::kGeneration, "generation"},
     {TerritoriesOf::kNames, "names"},
     {TerritoriesOf::kSelection, "selection"},
     {TerritoriesOf::kCuts, "cuts"},
     {TerritoriesOf::kRemnant, "remnant"}}};
[[nodiscard]] std::string_view name_of(TerritoriesOf of);
[[nodiscard]] std::optional<TerritoriesOf> territories_named(std::string_view name);

// The voxels of a mask that are the organ.
struct OrganSource {
    std::string file;                                     // absolute path; empty: there is no organ
    std::vector<volume::LabelChoice> labels{};            // empty: everything but 0
    std::string units{};                                  // of the file's lengths; empty: as the file says
    auto operator<=>(const OrganSource&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};

struct OrganChoice {
    OrganSource source;
    organ::Rule rule = organ::Rule::kTips;
    std::vector<organ::Role> roles;  // by vessel system; empty: by their names
    double large_vessels_mm = 5.0;   // vessels of at least this diameter are not part of the functional organ
    double weight_kg = 0.0;          // of the patient; 0: unknown
    double height_cm = 0.0;          // 0: unknown
    double least_of_weight = 0.5;    // customary limit: remnant (ml) in percent of the weight (g)
    double least_of_standard = 30.0; // and in percent of the standard liver volume
    TerritoriesOf territories = TerritoriesOf::kNothing;
    int generation = 2;                // of kGeneration
    int system = -1;                   // the system whose territories are shown; -1: the first that supplies
    double opacity = 0.4;              // of the territories
    double apart_mm = 0.0;             // how far the removed part is pulled away from what remains
    std::vector<std::string> hidden{}; // territories that are not shown, by name, ascending
    [[nodiscard]] bool any() const { return !source.file.empty(); }
    bool operator==(const OrganChoice&) const = default;
};

// The volume (ml) that a liver of an adult of this size usually has: -794.41 + 1267.28 times the body surface area in
// m2, which is sqrt(height weight / 3600). Vauthey et al., "Body surface area and body weight predict total liver
// volume in Western adults", Liver Transplantation 8 (2002) 233-240. None if a figure is unknown or the result is not
// positive.
[[nodiscard]] std::optional<double> standard_liver_ml(double weight_kg, double height_cm);

} // namespace ramus::app
