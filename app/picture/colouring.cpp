#include "app/picture/colouring.h"

#include "app/picture/deviation_colours.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

using render::Legend;

// Neighbouring ids far apart on the colour circle: steps of the golden angle.
glm::vec3 distinct(std::size_t index) {
    const double hue = std::fmod(static_cast<double>(index) * 0.61803398875, 1.0) * 6.0;
    const auto channel = [&](double shift) {
        const double k = std::fmod(shift + hue, 6.0);
        return static_cast<float>(0.88 - 0.55 * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
    };
    return {channel(5.0), channel(3.0), channel(1.0)};
}

// Few things told apart, by colour-blind eyes too (M. Okabe and K. Ito, 2008); then any others.
glm::vec3 label_colour(std::size_t index) {
    constexpr std::array<glm::vec3, 7> kPalette{{{0.902F, 0.624F, 0.000F},
                                                 {0.337F, 0.706F, 0.914F},
                                                 {0.000F, 0.620F, 0.451F},
                                                 {0.941F, 0.894F, 0.259F},
                                                 {0.000F, 0.447F, 0.698F},
                                                 {0.835F, 0.369F, 0.000F},
                                                 {0.800F, 0.475F, 0.655F}}};
    return index < kPalette.size() ? kPalette[index] : distinct(index);
}

double mean_diameter(const tree::VesselTree& tree, const tree::Branch& branch) {
    double sum = 0.0;
    for (const auto point : branch.points) sum += 2.0 * tree.points[point].radius;
    return branch.points.empty() ? 0.0 : sum / static_cast<double>(branch.points.size());
}

// Whole numbers: each its swatch while they are few.
void colour_by_count(Colouring& colouring, const std::vector<double>& values, ColourMap map, const std::string& title) {
    const auto [least, most] = std::ranges::minmax(values);
    const auto share = [least = least, most = most](double v) {
        return most > least ? (v - least) / (most - least) : 0.5;
    };
    for (const double v : values) colouring.branches.push_back(colour_at(map, share(v)));
    constexpr int kFew = 9;
    if (most - least >= kFew) {
        colouring.legend = bar_legend(title, map, least, most, false);
        return;
    }
    colouring.legend.title = title;
    for (int v = static_cast<int>(most); v >= static_cast<int>(least); --v)
        colouring.legend.swatches.push_back({colour_at(map, share(v)), std::to_string(v)});
}

void colour_by_measure(Colouring& colouring, const std::vector<double>& values, ColourMap map, const std::string& title,
                       bool logarithmic) {
    const auto [low, high] = std::ranges::minmax(values);
    const bool by_ratio = logarithmic && low > 0.0;
    for (const double v : values)
        colouring.branches.push_back(colour_at(map, !(high > low) ? 0.5
                                                    : by_ratio    ? std::log(v / low) / std::log(high / low)
                                                                  : (v - low) / (high - low)));
    colouring.legend = bar_legend(title, map, low, high, by_ratio);
}

void colour_by_diameter(Colouring& colouring, const tree::VesselTree& tree, ColourMap map, const std::string& title) {
    double low = 1e300, high = 0.0;
    for (const tree::Branch& branch : tree.branches)
        for (const auto point : branch.points) {
            low = std::min(low, 2.0 * tree.points[point].radius);
            high = std::max(high, 2.0 * tree.points[point].radius);
        }
    if (!(high > 0.0)) return;
    for (const tree::Branch& branch : tree.branches) {
        const double share = high > low ? std::log(mean_diameter(tree, branch) / low) / std::log(high / low) : 0.5;
        colouring.branches.push_back(colour_at(map, share));
    }
    colouring.legend = bar_legend(title, map, low, high, true);
    colouring.scale = {render::ColourScale::Value::kDiameter, static_cast<float>(low), static_cast<float>(high), true,
                       ramp_of(map)};
}

void colour_by_root_distance(Colouring& colouring, const TreeFacts& facts, ColourMap map, const std::string& title) {
    double farthest = 0.0;
    for (const BranchFacts& branch : facts.branches)
        farthest = std::max(farthest, branch.root_distance_mm + branch.length_mm);
    if (!(farthest > 0.0)) return;
    for (const BranchFacts& branch : facts.branches)
        colouring.branches.push_back(colour_at(map, (branch.root_distance_mm + 0.5 * branch.length_mm) / farthest));
    colouring.legend = bar_legend(title, map, 0.0, farthest, false);
    colouring.scale = {render::ColourScale::Value::kRootDistance, 0.0F, static_cast<float>(farthest), false,
                       ramp_of(map)};
}

// What the shaders know along a branch has colours of its own; every other quantity one colour for each branch.
void colour_by_quantity(Colouring& colouring, const QuantityRow& row, const tree::VesselTree& tree,
                        const TreeFacts& facts, ColourMap map) {
    const std::string title = std::string(row.label) +
                              (row.unit.empty() ? "" : Lengths(tree.claims).worded(" (" + std::string(row.unit) + ")"));
    if (row.quantity == Quantity::kDiameter) return colour_by_diameter(colouring, tree, map, title);
    if (row.quantity == Quantity::kRootDistance) return colour_by_root_distance(colouring, facts, map, title);
    if (tree.branches.empty()) return;
    std::vector<double> values;
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) values.push_back(row.value(tree, facts, id));
    if (row.whole) return colour_by_count(colouring, values, map, title);
    colour_by_measure(colouring, values, map, title, row.colours.logarithmic);
}

void colour_by_lesion(Colouring& colouring, const Marks& marks, const Plan* plan, const tree::VesselTree& tree) {
    const std::size_t branches = tree.branches.size();
    const auto& bands = marks.planning.bands_mm;
    const std::size_t count = std::min(bands.size(), render::Margins::kMost);
    Legend& legend = colouring.legend;
    legend.title = Lengths(tree.claims).worded("Distance to lesion (mm)");
    colouring.branches.assign(branches, kBeyondMargins);
    if (plan == nullptr || (plan->lesions.empty() && !plan->measuring)) {
        legend.title = "No lesion";
        return;
    }
    colouring.margins.beyond = kBeyondMargins;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 colour = margin_colour(i, count);
        colouring.margins.bands.push_back({static_cast<float>(bands[i]), colour});
        legend.swatches.push_back({colour, (i == 0 ? "up to " : rounded(bands[i - 1]) + " to ") + rounded(bands[i])});
    }
    if (count > 0) legend.swatches.push_back({kBeyondMargins, "beyond " + rounded(bands[count - 1])});
    for (std::size_t id = 0; id < std::min(branches, plan->lesion_distances_mm.size()); ++id)
        for (std::size_t i = count; i-- > 0;)
            if (plan->lesion_distances_mm[id] <= bands[i]) colouring.branches[id] = margin_colour(i, count);
}

void colour_by_label(Colouring& colouring, const TreeFacts& facts, const Marks& marks) {
    constexpr glm::vec3 kUnnamed{0.47F, 0.50F, 0.54F};
    std::map<int, glm::vec3> colours;
    colouring.legend.title = marks.names.empty() ? "No branch has a name" : "Names";
    for (const auto& [id, name] : marks.names) {
        const glm::vec3 colour = label_colour(colours.size());
        colours[id] = colour;
        colouring.legend.swatches.push_back({colour, latin1(name)});
    }
    for (const int source : label_sources(facts.dependency, marks)) {
        const auto found = colours.find(source);
        colouring.branches.push_back(found == colours.end() ? kUnnamed : found->second);
    }
}

void colour_by_system(Colouring& colouring, const tree::VesselTree& tree, const Marks& marks) {
    const Systems& systems = systems_of(tree, marks);
    const glm::vec3 plain = render::Appearance{}.vessel;
    colouring.legend.title = systems.empty() ? "No systems" : "Systems";
    if (systems.empty()) colouring.legend.swatches.push_back({plain, "all branches"});
    std::vector<glm::vec3> colours;
    for (int system = 0; system < static_cast<int>(systems.size()); ++system) {
        colours.push_back(shown_colour(systems, system));
        colouring.legend.swatches.push_back({colours.back(), latin1(system_name(systems, system))});
    }
    for (const tree::Branch& branch : tree.branches) {
        const auto system = static_cast<std::size_t>(branch.system);
        colouring.branches.push_back(system < colours.size() ? colours[system] : plain);
    }
}

void explain_states(Colouring& colouring, const Marks& marks, std::size_t branches) {
    using render::BranchState;
    const render::Appearance look;
    colouring.legend.title = "State";
    const auto any = [&](BranchState state) { return std::ranges::find(marks.states, state) != marks.states.end(); };
    const auto marked = std::ranges::count_if(marks.states, [](BranchState s) { return s != BranchState::kNormal; });
    if (static_cast<std::size_t>(marked) < branches) colouring.legend.swatches.push_back({look.vessel, "normal"});
    if (any(BranchState::kHighlighted)) colouring.legend.swatches.push_back({look.highlight, "highlighted"});
    if (any(BranchState::kDefocused)) colouring.legend.swatches.push_back({0.75F * look.glass, "defocused"});
    if (!marks.selection.empty()) colouring.legend.swatches.push_back({look.selection, "selected"});
}

} // namespace

Legend bar_legend(const std::string& title, ColourMap map, double low, double high, bool logarithmic) {
    Legend legend;
    legend.title = title;
    legend.bar = ramp_of(map);
    const auto at = [&](double v) {
        if (!(high > low)) return 0.5;
        return logarithmic ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
    };
    std::vector<double> numbers = high > low ? round_numbers(low, high, logarithmic) : std::vector<double>{low};
    if (numbers.size() < 2 && high > low) numbers = {low, high};
    for (const double v : numbers) legend.ticks.push_back({at(v), rounded(v)});
    return legend;
}

glm::vec3 margin_colour(std::size_t index, std::size_t count) {
    // From what is near to what is far: after the diverging red-yellow-blue maps, safe for colour-blind eyes.
    constexpr std::array<glm::vec3, 5> kStations{{{0.843F, 0.188F, 0.153F},
                                                  {0.957F, 0.545F, 0.263F},
                                                  {0.996F, 0.878F, 0.565F},
                                                  {0.569F, 0.749F, 0.859F},
                                                  {0.271F, 0.459F, 0.706F}}};
    if (count <= 3) return kStations[std::min<std::size_t>(index, 2)];
    const double at = 4.0 * static_cast<double>(index) / static_cast<double>(count - 1);
    const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
    return glm::mix(kStations[below], kStations[below + 1], static_cast<float>(at - static_cast<double>(below)));
}

std::string latin1(const std::string& utf8) {
    std::string text;
    for (std::size_t i = 0; i < utf8.size(); ++i) {
        const auto byte = static_cast<unsigned char>(utf8[i]);
        if (byte < 0x80) {
            text += utf8[i];
        } else if ((byte == 0xC2 || byte == 0xC3) && i + 1 < utf8.size()) {
            text += static_cast<char>(((byte & 3U) << 6U) | (static_cast<unsigned char>(utf8[++i]) & 0x3FU));
        } else {
            text += '?';
            while (i + 1 < utf8.size() && (static_cast<unsigned char>(utf8[i + 1]) & 0xC0U) == 0x80U) ++i;
        }
    }
    return text;
}

Colouring colouring_of(const tree::VesselTree& tree, const TreeFacts& facts, const Marks& marks, const Plan* plan) {
    Colouring colouring;
    switch (marks.colour_by.kind) {
    case ColourBy::kNothing:
        return colouring;
    case ColourBy::kState:
        explain_states(colouring, marks, tree.branches.size());
        break;
    case ColourBy::kQuantity:
        colour_by_quantity(colouring, row_of(marks.colour_by.quantity), tree, facts, marks.colour_map);
        break;
    case ColourBy::kLesion:
        colour_by_lesion(colouring, marks, plan, tree);
        break;
    case ColourBy::kLabel:
        colour_by_label(colouring, facts, marks);
        break;
    case ColourBy::kSystem:
        colour_by_system(colouring, tree, marks);
        break;
    case ColourBy::kDeviation: // the surface's own, which show_deviation() adds
        colouring.branches.assign(tree.branches.size(), kNotMeasuredColour);
        colouring.legend.title = "Deviation";
        colouring.legend.swatches.push_back({kNotMeasuredColour, "not of branches"});
        break;
    case ColourBy::kBranch:
        for (std::size_t i = 0; i < tree.branches.size(); ++i) colouring.branches.push_back(distinct(i));
        break;
    }
    const bool any_lost =
        plan != nullptr && std::ranges::any_of(plan->cuts.spans, [](const auto& s) { return s.any(); });
    if (any_lost && !colouring.legend.title.empty())
        colouring.legend.swatches.push_back({render::Appearance{}.lost, "lost", true});
    return colouring;
}

} // namespace ramus::app
