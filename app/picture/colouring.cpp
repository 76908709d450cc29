#include "app/picture/colouring.h"

#include "app/picture/deviation_colours.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"
#include "core/tree/branch_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <map>
#include <set>

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

double mean_diameter(const tree::VesselTree& tree, const tree::Branch& branch) {
    double sum = 0.0;
    for (const auto point : branch.points) sum += 2.0 * tree.points[point].radius;
    return branch.points.empty() ? 0.0 : sum / static_cast<double>(branch.points.size());
}

// The legend omits systems that are completely hidden.
std::set<int> shown_systems(const tree::VesselTree& tree, const Marks& marks) {
    std::set<int> shown;
    for (std::size_t id = 0; id < tree.branches.size(); ++id)
        if (state_of(marks, static_cast<int>(id)) != tree::BranchState::kHidden) shown.insert(tree.branches[id].system);
    return shown;
}

// Maps values to colours by the user's choices.
struct ValueScale {
    ColourMap map = ColourMap::kViridis;
    double low = 0.0, high = 1.0;
    bool logarithmic = false;

    [[nodiscard]] double share(double value) const {
        if (!(high > low)) return 0.5;
        if (!logarithmic) return std::clamp((value - low) / (high - low), 0.0, 1.0);
        return value > low ? std::min(std::log(value / low) / std::log(high / low), 1.0) : 0.0;
    }
    [[nodiscard]] glm::vec3 colour(double value) const {
        return tree::is_known(value) ? colour_at(map, share(value)) : kUnknownColour;
    }
};

// Least and largest value, and least value above 0; unknown values are skipped.
struct ValueRange {
    double least = HUGE_VAL, largest = -HUGE_VAL, least_positive = HUGE_VAL;
    std::size_t known = 0, unknown = 0;
    bool whole = true;

    void add(double value) {
        ++(tree::is_known(value) ? known : unknown);
        if (!tree::is_known(value)) return;
        least = std::min(least, value), largest = std::max(largest, value);
        if (value > 0.0) least_positive = std::min(least_positive, value);
        whole &= value == std::floor(value);
    }
};
ValueRange range_of(const std::vector<double>& values) {
    ValueRange range;
    for (const double value : values) range.add(value);
    return range;
}

// A logarithmic scale starts at the least value above 0; if there is none, the scale is linear.
ValueScale scale_for(const ValueRange& values, const Marks& marks, bool usually_logarithmic) {
    const ColourLook& look = marks.colour_look;
    ValueScale scale{marks.colour_map, values.least, values.largest, look.logarithmic.value_or(usually_logarithmic)};
    if (look.range) scale.low = (*look.range)[0], scale.high = (*look.range)[1];
    if (!look.range && scale.logarithmic && !(scale.low > 0.0) && look.logarithmic) scale.low = values.least_positive;
    scale.logarithmic &= scale.low > 0.0 && std::isfinite(scale.low);
    if (!std::isfinite(scale.low)) scale.low = values.least;
    return scale;
}

Legend legend_of(const std::string& title, const ValueScale& scale, const ValueRange& values) {
    Legend legend = bar_legend(title, scale.map, scale.low, scale.high, scale.logarithmic);
    constexpr double kRounding = 1e-6; // of the range
    const double slack = kRounding * (scale.high - scale.low);
    const auto end = [](bool beyond, double value) { return beyond ? std::optional(value) : std::nullopt; };
    mark_ends(legend, end(values.least < scale.low - slack, scale.low),
              end(values.largest > scale.high + slack, scale.high));
    if (values.unknown > 0) legend.swatches.push_back({kUnknownColour, "not known"});
    return legend;
}

render::ColourScale shader_scale(render::ColourScale::Value value, const ValueScale& scale) {
    return {
        value, static_cast<float>(scale.low), static_cast<float>(scale.high), scale.logarithmic, 0, ramp_of(scale.map)};
}

// Integers: a swatch for each if there are few, unless the user has chosen a range.
bool colour_by_count(Colouring& colouring, const std::vector<double>& values, const ValueRange& range,
                     const Marks& marks, const std::string& title) {
    constexpr int kFew = 9;
    const ColourLook& look = marks.colour_look;
    if (!range.whole || range.largest - range.least >= kFew || look.range || look.logarithmic) return false;
    const ValueScale scale{marks.colour_map, range.least, range.largest, false};
    for (const double v : values) colouring.branches.push_back(scale.colour(v));
    colouring.legend.title = title;
    for (int v = static_cast<int>(range.largest); v >= static_cast<int>(range.least); --v)
        colouring.legend.swatches.push_back({scale.colour(v), std::to_string(v)});
    if (range.unknown > 0) colouring.legend.swatches.push_back({kUnknownColour, "not known"});
    return true;
}

void colour_by_measure(Colouring& colouring, const std::vector<double>& values, const ValueRange& range,
                       const Marks& marks, const std::string& title, bool logarithmic) {
    const ValueScale scale = scale_for(range, marks, logarithmic);
    for (const double v : values) colouring.branches.push_back(scale.colour(v));
    colouring.legend = legend_of(title, scale, range);
}

void colour_by_diameter(Colouring& colouring, const tree::VesselTree& tree, const Marks& marks,
                        const std::string& title) {
    ValueRange range;
    for (const tree::Branch& branch : tree.branches)
        for (const auto point : branch.points) range.add(2.0 * tree.points[point].radius);
    if (range.known == 0) return;
    const ValueScale scale = scale_for(range, marks, true);
    for (const tree::Branch& branch : tree.branches)
        colouring.branches.push_back(scale.colour(mean_diameter(tree, branch)));
    colouring.legend = legend_of(title, scale, range);
    colouring.scale = shader_scale(render::ColourScale::Value::kDiameter, scale);
}

void colour_by_root_distance(Colouring& colouring, const TreeFacts& facts, const Marks& marks,
                             const std::string& title) {
    ValueRange range;
    for (const BranchFacts& branch : facts.branches) {
        range.add(branch.root_distance_mm);
        range.add(branch.root_distance_mm + branch.length_mm);
    }
    if (!(range.largest > 0.0)) return;
    range.add(0.0);
    const ValueScale scale = scale_for(range, marks, false);
    for (const BranchFacts& branch : facts.branches)
        colouring.branches.push_back(scale.colour(branch.root_distance_mm + 0.5 * branch.length_mm));
    colouring.legend = legend_of(title, scale, range);
    colouring.scale = shader_scale(render::ColourScale::Value::kRootDistance, scale);
}

// Quantities that shaders know along branches vary in colour; every other quantity gives one colour per branch.
void colour_by_quantity(Colouring& colouring, const QuantityRow& row, const tree::VesselTree& tree,
                        const TreeFacts& facts, const Marks& marks) {
    const std::string title = std::string(row.label) +
                              (row.unit.empty() ? "" : Lengths(tree.claims).worded(" (" + std::string(row.unit) + ")"));
    if (row.quantity == Quantity::kDiameter) return colour_by_diameter(colouring, tree, marks, title);
    if (row.quantity == Quantity::kRootDistance) return colour_by_root_distance(colouring, facts, marks, title);
    if (tree.branches.empty()) return;
    std::vector<double> values;
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id) values.push_back(row.value(tree, facts, id));
    const ValueRange range = range_of(values);
    if (row.whole && colour_by_count(colouring, values, range, marks, title)) return;
    colour_by_measure(colouring, values, range, marks, title, row.colours.logarithmic);
}

// An array of the tree's file: arrays of points vary along branches, arrays of branches give one colour each.
void colour_by_data(Colouring& colouring, const tree::VesselTree& tree, const Marks& marks) {
    const std::string &name = marks.colour_by.data, title = latin1(name);
    if (const tree::DataArray* array = array_named(tree.branch_data, name)) {
        const ValueRange range = range_of(array->values);
        if (range.known > 0) {
            if (!colour_by_count(colouring, array->values, range, marks, title))
                colour_by_measure(colouring, array->values, range, marks, title, false);
            return;
        }
    }
    const tree::DataArray* array = array_named(tree.point_data, name);
    ValueRange range;
    for (const tree::Branch& branch : tree.branches)
        for (const auto point : branch.points) range.add(array != nullptr ? array->values[point] : tree::kUnknownValue);
    if (range.known == 0) {
        colouring.branches.assign(tree.branches.size(), kUnknownColour);
        colouring.legend.title = title;
        colouring.legend.swatches.push_back({kUnknownColour, "not known"});
        return;
    }
    const ValueScale scale = scale_for(range, marks, false);
    for (int id = 0; id < static_cast<int>(tree.branches.size()); ++id)
        colouring.branches.push_back(scale.colour(mean_of(tree, *array, id)));
    colouring.legend = legend_of(title, scale, range);
    colouring.scale = shader_scale(render::ColourScale::Value::kOfLines, scale);
    colouring.scale.list = static_cast<std::uint32_t>(array - tree.point_data.data());
    colouring.some_unknown = range.unknown > 0;
}

// Keeps a system's hue, but so pale that margins stand out.
glm::vec3 beyond_margins(const glm::vec3& system) { return glm::mix(kBeyondMargins, system, kOwnBeyondMargins); }

std::vector<glm::vec3> colours_beyond_margins(const tree::VesselTree& tree, const Marks& marks) {
    std::vector<glm::vec3> colours(tree.branches.size(), kBeyondMargins);
    const Systems& systems = systems_of(tree, marks);
    if (systems.size() > 1)
        for (std::size_t id = 0; id < colours.size(); ++id)
            colours[id] = beyond_margins(shown_colour(systems, tree.branches[id].system));
    return colours;
}

void explain_beyond(Legend& legend, const tree::VesselTree& tree, const Marks& marks, const std::string& words) {
    const Systems& systems = systems_of(tree, marks);
    if (systems.size() < 2) return legend.swatches.push_back({kBeyondMargins, words});
    const std::set<int> shown = shown_systems(tree, marks);
    for (const int system : shown)
        legend.swatches.push_back(
            {beyond_margins(shown_colour(systems, system)), words + ": " + latin1(system_name(systems, system))});
}

void colour_by_lesion(Colouring& colouring, const Marks& marks, const Plan* plan, const tree::VesselTree& tree) {
    const std::size_t branches = tree.branches.size();
    const auto& bands = marks.planning.bands_mm;
    const std::size_t count = std::min(bands.size(), render::Margins::kMost);
    Legend& legend = colouring.legend;
    legend.title = Lengths(tree.claims).worded("Distance to lesion (mm)");
    colouring.branches = colours_beyond_margins(tree, marks);
    if (plan == nullptr || (plan->lesions.empty() && !plan->measuring)) {
        legend.title = "No lesion";
        return;
    }
    colouring.beyond = colouring.branches;
    legend.swatches = margin_swatches(std::span(bands).first(count));
    for (std::size_t i = 0; i < count; ++i)
        colouring.margins.bands.push_back({static_cast<float>(bands[i]), legend.swatches[i].colour});
    if (count > 0) explain_beyond(legend, tree, marks, "beyond " + rounded(bands[count - 1]));
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
    const std::set<int> shown = shown_systems(tree, marks);
    std::vector<glm::vec3> colours;
    for (int system = 0; system < static_cast<int>(systems.size()); ++system) {
        colours.push_back(shown_colour(systems, system));
        if (shown.contains(system))
            colouring.legend.swatches.push_back({colours.back(), latin1(system_name(systems, system))});
    }
    for (const tree::Branch& branch : tree.branches) {
        const auto system = static_cast<std::size_t>(branch.system);
        colouring.branches.push_back(system < colours.size() ? colours[system] : plain);
    }
}

void explain_states(Colouring& colouring, const Marks& marks, std::size_t branches) {
    using tree::BranchState;
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
    const auto text = [](double v) {
        constexpr double kLong = 1e7;
        if (std::abs(v) < kLong) return rounded(v);
        std::array<char, 32> digits{};
        std::snprintf(digits.data(), digits.size(), "%.4g", v);
        return std::string(digits.data());
    };
    for (const double v : numbers) legend.ticks.push_back({at(v), text(v)});
    // A short range far from 0 needs more digits.
    const auto same = [](const Legend::Tick& a, const Legend::Tick& b) { return a.text == b.text; };
    if (std::ranges::adjacent_find(legend.ticks, same) != legend.ticks.end())
        for (std::size_t n = 0; n < numbers.size(); ++n) legend.ticks[n].text = exact_text(numbers[n]);
    return legend;
}

void mark_ends(Legend& legend, const std::optional<double>& low, const std::optional<double>& high) {
    constexpr double kApart = 0.08; // of the bar: closer texts would overlap
    const auto put = [&](double at, const std::string& text) {
        std::erase_if(legend.ticks, [&](const Legend::Tick& tick) { return std::abs(tick.at - at) < kApart; });
        legend.ticks.push_back({at, text});
    };
    if (low) put(0.0, "< " + rounded(*low));
    if (high) put(1.0, "> " + rounded(*high));
}

glm::vec3 margin_colour(std::size_t index, std::size_t count) {
    // From near to far, like the sequential yellow-orange-red maps, which are safe for colour-blind people. No blue or
    // grey: vessels beyond the margins, and systems, have those.
    constexpr std::array<glm::vec3, 5> kStations{{{0.565F, 0.0F, 0.149F},
                                                  {0.843F, 0.188F, 0.153F},
                                                  {0.957F, 0.545F, 0.263F},
                                                  {0.996F, 0.878F, 0.565F},
                                                  {1.0F, 0.976F, 0.835F}}};
    if (count <= 4) return kStations[1 + std::min<std::size_t>(index, 3)];
    const double at = 4.0 * static_cast<double>(index) / static_cast<double>(count - 1);
    const auto below = std::min<std::size_t>(static_cast<std::size_t>(at), 3);
    return glm::mix(kStations[below], kStations[below + 1], static_cast<float>(at - static_cast<double>(below)));
}

std::vector<Legend::Swatch> margin_swatches(std::span<const double> bands_mm) {
    std::vector<Legend::Swatch> swatches;
    for (std::size_t i = 0; i < bands_mm.size(); ++i)
        swatches.push_back({margin_colour(i, bands_mm.size()),
                            (i == 0 ? "up to " : rounded(bands_mm[i - 1]) + " to ") + rounded(bands_mm[i])});
    return swatches;
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

glm::vec3 label_colour(std::size_t index) {
    constexpr std::array<glm::vec3, 8> kPalette{{{0.920F, 0.530F, 0.000F},
                                                 {0.360F, 0.755F, 0.995F},
                                                 {0.095F, 0.740F, 0.465F},
                                                 {0.985F, 0.970F, 0.180F},
                                                 {0.120F, 0.370F, 0.800F},
                                                 {0.715F, 0.250F, 0.120F},
                                                 {0.695F, 0.380F, 0.575F},
                                                 {0.340F, 0.130F, 0.930F}}};
    return index < kPalette.size() ? kPalette[index] : distinct(index);
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
        colour_by_quantity(colouring, row_of(marks.colour_by.quantity), tree, facts, marks);
        break;
    case ColourBy::kData:
        colour_by_data(colouring, tree, marks);
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
    case ColourBy::kDeviation: // values of the surface: show_deviation() adds them
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
    if (!marks.colour_look.legend) colouring.legend = {};
    return colouring;
}

} // namespace ramus::app
