// Colouring: the colours of a picture with their legend: per branch, along branches, by distance from lesions. Derived
// from a session; used by pictures, the overview and reports.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "render/scene/scene.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

struct Colouring {
    std::vector<glm::vec3> branches; // sRGB by branch id, one per branch; empty: the default colour
    render::ColourScale scale;       // replaces `branches` in the picture
    render::Margins margins;         // replaces `branches` in the picture, near lesions
    std::vector<glm::vec3> beyond;   // sRGB by branch id, beyond `margins`; empty: no margins
    bool some_unknown = false;       // `scale` has places without a value, in kUnknownColour
    render::Legend legend;           // without a title: no legend
};

// `facts`: of the tree. `plan`: of the same marks (Assets::plan); null: no lesions and cuts.
[[nodiscard]] Colouring colouring_of(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                                     const Plan* plan);

// Colours (sRGB) for up to eight things, then arbitrary ones. The first seven are those of M. Okabe and K. Ito (2008),
// moved apart with the eighth: any two of the eight differ by 28 in CIELAB for normal sight and for people who lack red
// or green receptors (simulated by G. Machado et al., 2009).
[[nodiscard]] glm::vec3 label_colour(std::size_t index);

// A bar from `low` to `high` with ticks at round numbers.
[[nodiscard]] render::Legend bar_legend(const std::string& title, ColourMap map, double low, double high,
                                        bool logarithmic);
// Labels the ends beyond which there are values: "< 5", "> 90".
void mark_ends(render::Legend& legend, const std::optional<double>& low, const std::optional<double>& high);

// The colour of the margin with this index, innermost first. kBeyondMargins: beyond all margins; trees with several
// systems mix in the system's colour by kOwnBeyondMargins.
[[nodiscard]] glm::vec3 margin_colour(std::size_t index, std::size_t count);
// A swatch per margin: "up to 5", "5 to 10".
[[nodiscard]] std::vector<render::Legend::Swatch> margin_swatches(std::span<const double> bands_mm);
inline constexpr glm::vec3 kBeyondMargins{0.56F, 0.60F, 0.66F};
// Tuned so that portal and hepatic veins differ from each other and from the margins.
inline constexpr float kOwnBeyondMargins = 0.55F;

// Converts UTF-8 to Latin-1, the encoding of text in pictures; other characters become question marks.
[[nodiscard]] std::string latin1(const std::string& utf8);

} // namespace ramus::app
