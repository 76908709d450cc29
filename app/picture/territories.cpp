#include "app/picture/territories.h"

#include "app/assets/assets.h"
#include "app/picture/colouring.h"
#include "app/session/systems.h"
#include "core/base/words.h"

#include <algorithm>

namespace ramus::app {

namespace {

// The grey of the rest differs from all label_colour()s as they do from each other.
constexpr glm::vec3 kOrganColour{0.72F, 0.47F, 0.40F}, kRestColour{0.85F, 0.86F, 0.87F};
// Of RemnantPart, in its order. Violet and yellow stay apart for people with red-green blindness, and violet from blue
// veins.
constexpr std::array<glm::vec3, 5> kRemnantColours{
    {kOrganColour, {0.45F, 0.15F, 0.85F}, {0.96F, 0.85F, 0.30F}, {0.34F, 0.35F, 0.38F}, {0.80F, 0.80F, 0.84F}}};
constexpr std::size_t kMostSwatches = 12; // a longer legend would cover the picture

} // namespace

glm::vec3 territory_colour(const OrganTerritories& territories, std::size_t part, const Marks& marks) {
    const OrganTerritories::Part& one = territories.parts[part];
    if (territories.of.kind == TerritoriesOf::kOrgan) return kOrganColour;
    if (territories.of.kind == TerritoriesOf::kRemnant)
        return kRemnantColours[static_cast<std::size_t>(std::ranges::find(kRemnantParts, std::string_view(one.name)) -
                                                        kRemnantParts.begin())];
    if (one.rest) return kRestColour;
    const tree::VesselTree& tree = *territories.of.supply->of.tree;
    if (one.system >= 0 && !tree.systems.empty()) return shown_colour(systems_of(tree, marks), one.system);
    return label_colour(part);
}

void draw_territories(render::Frame& frame, const Assets& assets, const Marks& marks, std::optional<double> opacity) {
    const auto& territories = assets.organ.territories;
    if (!territories || marks.organ.territories == TerritoriesOf::kNothing) return;
    render::Legend& legend = frame.overlays.legend;
    const Lengths lengths(territories->of.supply->of.mask->claims);
    legend.title = legend.title.empty() ? "Territories" : legend.title + ", territories";
    for (std::size_t n = 0; n < territories->parts.size(); ++n) {
        const OrganTerritories::Part& part = territories->parts[n];
        if (std::ranges::binary_search(marks.organ.hidden, part.name)) continue;
        const glm::vec3 colour = territory_colour(*territories, n, marks);
        frame.context.push_back(
            {part.mesh, part.preview, colour, static_cast<float>(opacity.value_or(marks.organ.opacity)), false, true});
        if (n < kMostSwatches)
            legend.swatches.push_back(
                {colour, latin1(shortened(part.name, 24) + ", " + lengths.volume(territories->volume_mm3(part)))});
    }
}

} // namespace ramus::app
