#include "app/session/colour_by.h"

#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

std::vector<ColouringRow> colouring_table() {
    std::vector<ColouringRow> rows = {
        {ColourBy::kNothing, "nothing", "One colour", "One colour for the whole tree."},
        {ColourBy::kState, "state", "State", "Explains what is highlighted, defocused, selected and lost."},
    };
    for (const QuantityRow* row : rows_with(&QuantityRow::colours))
        rows.push_back({row->quantity, row->key, row->label, row->colours.help});
    rows.push_back({ColourBy::kLesion, "lesion", "Distance to lesion", "Colours the margins around the lesions."});
    rows.push_back({ColourBy::kLabel, "label", "Names", "Colours named branches and what depends on them."});
    rows.push_back(
        {ColourBy::kSystem, "system", "System", "Colours each system (portal vein, artery) as it is listed."});
    rows.push_back(
        {ColourBy::kDeviation, "deviation", "Deviation", "Colours the surface by how far it lies from another one."});
    rows.push_back({ColourBy::kBranch, "branch", "Branch", "Tells neighbouring branches apart."});
    return rows;
}

using Stations = std::array<glm::vec3, 9>;

constexpr Stations kViridis{{{0.267004F, 0.004874F, 0.329415F},
                             {0.278826F, 0.175490F, 0.483397F},
                             {0.229739F, 0.322361F, 0.545706F},
                             {0.172719F, 0.448791F, 0.557885F},
                             {0.127568F, 0.566949F, 0.550556F},
                             {0.157851F, 0.683765F, 0.501686F},
                             {0.369214F, 0.788888F, 0.382914F},
                             {0.678489F, 0.863742F, 0.189503F},
                             {0.993248F, 0.906157F, 0.143936F}}};
constexpr Stations kCividis{{{0.000000F, 0.135112F, 0.304751F},
                             {0.103401F, 0.220406F, 0.435790F},
                             {0.263738F, 0.307831F, 0.422789F},
                             {0.380830F, 0.395164F, 0.435653F},
                             {0.488697F, 0.485318F, 0.471008F},
                             {0.605211F, 0.576777F, 0.464441F},
                             {0.732422F, 0.677364F, 0.425717F},
                             {0.866421F, 0.786028F, 0.346571F},
                             {0.995737F, 0.909344F, 0.217772F}}};
constexpr Stations kMagma{{{0.001462F, 0.000466F, 0.013866F},
                           {0.113094F, 0.065492F, 0.276784F},
                           {0.316654F, 0.071690F, 0.485380F},
                           {0.512831F, 0.148179F, 0.507648F},
                           {0.716387F, 0.214982F, 0.475290F},
                           {0.904281F, 0.319610F, 0.388137F},
                           {0.986700F, 0.535582F, 0.382210F},
                           {0.996571F, 0.783977F, 0.547233F},
                           {0.987053F, 0.991438F, 0.749504F}}};
constexpr Stations kPlasma{{{0.050383F, 0.029803F, 0.527975F},
                            {0.299855F, 0.009561F, 0.631624F},
                            {0.494877F, 0.011990F, 0.657865F},
                            {0.665129F, 0.138566F, 0.585582F},
                            {0.798216F, 0.280197F, 0.469538F},
                            {0.898984F, 0.420392F, 0.363047F},
                            {0.973416F, 0.585761F, 0.251540F},
                            {0.989587F, 0.803205F, 0.146529F},
                            {0.940015F, 0.975158F, 0.131326F}}};
constexpr Stations kCoolwarm{{{0.229806F, 0.298718F, 0.753683F},
                              {0.383013F, 0.509419F, 0.917388F},
                              {0.552953F, 0.688929F, 0.995376F},
                              {0.722193F, 0.813953F, 0.976575F},
                              {0.865395F, 0.865410F, 0.865396F},
                              {0.958853F, 0.769768F, 0.678008F},
                              {0.958003F, 0.602842F, 0.481776F},
                              {0.869187F, 0.378313F, 0.300267F},
                              {0.705673F, 0.015556F, 0.150233F}}};
constexpr Stations kGrey{{glm::vec3(0.0F), glm::vec3(0.125F), glm::vec3(0.25F), glm::vec3(0.375F), glm::vec3(0.5F),
                          glm::vec3(0.625F), glm::vec3(0.75F), glm::vec3(0.875F), glm::vec3(1.0F)}};

// By ColourMap: stops, and the omitted share of the dark end.
struct MapRow {
    std::string_view name;
    const Stations& stations;
    double darkest;
};
constexpr std::array<MapRow, kColourMaps.size()> kMaps{{{"viridis", kViridis, 0.12},
                                                        {"cividis", kCividis, 0.12},
                                                        {"magma", kMagma, 0.28},
                                                        {"plasma", kPlasma, 0.10},
                                                        {"coolwarm", kCoolwarm, 0.0},
                                                        {"grey", kGrey, 0.16}}};

constexpr std::string_view kOfFile = "file:";

} // namespace

const std::vector<ColouringRow>& colourings() {
    static const std::vector<ColouringRow> rows = colouring_table();
    return rows;
}

std::string name_of(const ColourBy& by) {
    if (by.kind == ColourBy::kData) return std::string(kOfFile) + by.data;
    const auto row = std::ranges::find(colourings(), by, &ColouringRow::by);
    return row == colourings().end() ? std::string() : std::string(row->key);
}

Result<ColourBy> colouring_of_tree(std::string_view key, const tree::VesselTree& tree) {
    const auto is_there = [&](const std::string& name) {
        return array_named(tree.point_data, name) != nullptr || array_named(tree.branch_data, name) != nullptr;
    };
    const auto known = colouring_named(key);
    if (known && (known->kind != ColourBy::kData || is_there(known->data))) return *known;
    if (!known && is_there(std::string(key))) return ColourBy::array(std::string(key));
    std::string names;
    for (const tree::DataArrays* arrays : {&tree.point_data, &tree.branch_data})
        for (const tree::DataArray& array : *arrays) names += ", " + array.name;
    return fail(
        "there is no colouring \"" + std::string(key) + "\"", {},
        "one of " + joined(colourings(), ", ", &ColouringRow::key) +
            (names.empty() ? "; the tree's file has no data" : "; data of the tree's file: " + names.substr(2)));
}

std::optional<ColourBy> colouring_named(std::string_view key) {
    if (key.starts_with(kOfFile) && key.size() > kOfFile.size())
        return ColourBy::array(std::string(key.substr(kOfFile.size())));
    const auto row = std::ranges::find(colourings(), key, &ColouringRow::key);
    return row == colourings().end() ? std::nullopt : std::optional(row->by);
}

std::string_view name_of(ColourMap map) { return kMaps[static_cast<std::size_t>(map)].name; }

std::optional<ColourMap> colour_map_named(std::string_view name) {
    const auto found = std::ranges::find(kColourMaps, name, [](ColourMap map) { return name_of(map); });
    return found == kColourMaps.end() ? std::nullopt : std::optional(*found);
}

glm::vec3 colour_at(ColourMap map, double t) {
    const auto& [name, stations, darkest] = kMaps[static_cast<std::size_t>(map)];
    const double at = (darkest + (1.0 - darkest) * std::clamp(t, 0.0, 1.0)) * (stations.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(at), stations.size() - 2);
    return glm::mix(stations[below], stations[below + 1], static_cast<float>(at - static_cast<double>(below)));
}

std::vector<glm::vec3> ramp_of(ColourMap map, std::size_t steps) {
    std::vector<glm::vec3> ramp;
    for (std::size_t i = 0; i < steps; ++i)
        ramp.push_back(colour_at(map, static_cast<double>(i) / static_cast<double>(steps - 1)));
    return ramp;
}

std::optional<std::array<double, 2>> colour_range_in(std::string_view text) {
    const std::vector<std::string_view> parts = parts_of(text);
    if (parts.size() != 2) return {};
    const auto low = parsed<double>(parts[0]), high = parsed<double>(parts[1]);
    constexpr double kMost = 1e14; // shaders would take larger values for unknown ones
    if (!low || !high || !(std::abs(*low) <= kMost) || !(std::abs(*high) <= kMost) || !(*low < *high)) return {};
    return std::array{*low, *high};
}

Result<void> check(const ColourLook& look) {
    if (look.range && look.logarithmic.value_or(false) && !((*look.range)[0] > 0.0))
        return fail("a logarithmic scale of colours cannot begin at " + exact_text((*look.range)[0]), {},
                    "begin the range above 0, or switch the logarithm off");
    return {};
}

std::array<std::uint8_t, 3> bytes_of(const glm::vec3& colour) {
    const auto byte = [](float channel) { return static_cast<std::uint8_t>(std::lround(255.0F * channel)); };
    return {byte(colour.x), byte(colour.y), byte(colour.z)};
}

std::string colour_text(const std::array<std::uint8_t, 3>& colour) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "#";
    for (const std::uint8_t byte : colour) text += {kDigits[byte >> 4U], kDigits[byte & 15U]};
    return text;
}

std::optional<std::array<std::uint8_t, 3>> colour_in(std::string_view text) {
    if (text.starts_with('#')) text.remove_prefix(1);
    std::array<std::uint8_t, 3> colour{};
    if (text.size() != 6) return {};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto byte = parsed<std::uint8_t>(text.substr(2 * i, 2), 16);
        if (!byte) return {};
        colour[i] = *byte;
    }
    return colour;
}

} // namespace ramus::app
