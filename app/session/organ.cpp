#include "app/session/organ.h"

#include "core/base/words.h"

#include <algorithm>
#include <cmath>

namespace ramus::app {

std::string_view name_of(TerritoriesOf of) { return *paired(kTerritoriesOf, of); }

std::optional<TerritoriesOf> territories_named(std::string_view name) { return paired_with(kTerritoriesOf, name); }

std::optional<double> standard_liver_ml(double weight_kg, double height_cm) {
    if (weight_kg <= 0.0 || height_cm <= 0.0) return {};
    const double volume = -794.41 + 1267.28 * std::sqrt(height_cm * weight_kg / 3600.0);
    return volume > 0.0 ? std::optional(volume) : std::nullopt;
}

} // namespace ramus::app
