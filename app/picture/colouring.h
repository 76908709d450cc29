// What the colours of a picture say: the colour of every branch, what varies along branches or with the distance to
// lesions, and the legend of it. Derived from a session; the picture, flat pictures of the tree and reports use it.
#pragma once

#include "app/assets/plan.h"
#include "app/session/session.h"
#include "render/scene/scene.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct Colouring {
    std::vector<glm::vec3> branches; // sRGB by branch id, of the branch as a whole; empty: all have the vessels' colour
    render::ColourScale scale;       // finer than `branches`, for the picture
    render::Margins margins;         // the same
    std::vector<glm::vec3> beyond;   // sRGB by branch id, beyond `margins`; empty: there are none
    bool some_unknown = false;       // of `scale`: places without a value, which have kUnknownColour
    render::Legend legend;           // without a title when there is nothing to explain
};

// `facts` of the tree; `plan`: of the same marks (Assets::plan); null: as without lesions and cuts.
[[nodiscard]] Colouring colouring_of(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks,
                                     const Plan* plan);

// A bar from `low` to `high`, ticks at round numbers.
[[nodiscard]] render::Legend bar_legend(const std::string& title, ColourMap map, double low, double high,
                                        bool logarithmic);
// Its ends, where values lie beyond them, say so: "< 5", "> 90".
void mark_ends(render::Legend& legend, const std::optional<double>& low, const std::optional<double>& high);

// The colour of a margin around lesions, the innermost first; beyond all of them. Of several systems each has so much
// of its own colour there.
[[nodiscard]] glm::vec3 margin_colour(std::size_t index, std::size_t count);
inline constexpr glm::vec3 kBeyondMargins{0.56F, 0.60F, 0.66F};
// Tuned so that portal and hepatic veins differ from each other and from the margins.
inline constexpr float kOwnBeyondMargins = 0.55F;

// UTF-8 as the Latin-1 that pictures are lettered in; what that does not have becomes a question mark.
[[nodiscard]] std::string latin1(const std::string& utf8);

} // namespace ramus::app
