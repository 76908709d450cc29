#include "app/session/option_entries.h"

#include "app/session/json_values.h"
#include "app/session/session_limits.h"
#include "app/session/surface_options.h"

#include <algorithm>

namespace ramus::app::session_json {

namespace fs = std::filesystem;

namespace {

// A number that is always written.
template <class T>
MarksEntry number_entry(const std::string& key, T Marks::*member, double T::*field, double least, double most) {
    return {key, [=](const Marks& marks, const fs::path&) { return json(marks.*member.*field); },
            [=](const json& value, const fs::path&, Marks& marks) {
                marks.*member.*field = number(value, key, least, most);
            }};
}

MarksEntry method_entry() {
    const auto method_of_tree = [](const std::string& name) {
        const auto method = mesh::method_named(name);
        return method && mesh::row_of(*method).of_tree ? method : std::nullopt;
    };
    return {"method",
            [](const Marks& marks, const fs::path&) { return json(std::string(name_of(marks.options.method))); },
            [=](const json& value, const fs::path&, Marks& marks) {
                marks.options.method = word(value, "method", "method", method_of_tree);
            }};
}

json written(const SurfaceOption& option, const mesh::SurfaceOptions& options) {
    const double set = option.value(options);
    if (option.only_when_set && set == 0.0) return {};
    if (!option.words.empty()) return spelled(option, set);
    return option.whole ? json(static_cast<int>(set)) : json(set);
}

double option_in(const SurfaceOption& option, const json& value) {
    const std::string key(option.key);
    if (!option.words.empty())
        return word(value, key, key, [&](const std::string& wanted) { return value_in(option, wanted); });
    const double least = option.only_when_set ? 0.0 : option.least;
    return option.whole ? integer(value, key, static_cast<int>(least), static_cast<int>(option.most))
                        : number(value, key, least, option.most);
}

MarksEntry option_entry(const SurfaceOption& option) {
    MarksEntry entry{std::string(option.key),
                     [&option](const Marks& marks, const fs::path&) { return written(option, marks.options); },
                     [&option](const json& value, const fs::path&, Marks& marks) {
                         option.set(marks.options, option_in(option, value));
                     }};
    if (option.before_it_was)
        entry.absent = [&option](Marks& marks) { option.set(marks.options, *option.before_it_was); };
    return entry;
}

MarksEntry bands_entry() {
    return {"bands", [](const Marks& marks, const fs::path&) { return json(marks.planning.bands_mm); },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_array()) throw Refusal{"bands is not a list"};
                if (value.size() > kMostBands) throw Refusal{"more than " + std::to_string(kMostBands) + " bands"};
                std::vector<double> bands;
                for (const json& band : value) bands.push_back(number(band, "band", 1e-6, 1e6));
                if (!std::ranges::is_sorted(bands)) throw Refusal{"bands do not ascend"};
                marks.planning.bands_mm = std::move(bands);
            }};
}

void read_range(const json& value, ColourLook& look) {
    constexpr double kMost = 1e14;
    if (!value.is_array()) throw Refusal{"colour_range is not a list"};
    if (value.size() != 2) throw Refusal{"colour_range is not [low, high]"};
    look.range = {number(value[0], "colour_range", -kMost, kMost), number(value[1], "colour_range", -kMost, kMost)};
    if (!((*look.range)[0] < (*look.range)[1])) throw Refusal{"colour_range does not ascend"};
}

void expect_good(const ColourLook& look) {
    if (auto good = check(look); !good) throw Refusal{good.error().message()};
}

} // namespace

std::vector<MarksEntry> surface_entries() {
    std::vector<MarksEntry> entries{method_entry()};
    for (const SurfaceOption& option : surface_options())
        if (option.of_session) entries.push_back(option_entry(option));
    return entries;
}

std::vector<MarksEntry> colour_look_entries() {
    return {
        {"colour_range",
         [](const Marks& marks, const fs::path&) {
             return marks.colour_look.range ? json(*marks.colour_look.range) : json();
         },
         [](const json& value, const fs::path&, Marks& marks) {
             read_range(value, marks.colour_look);
             expect_good(marks.colour_look);
         }},
        {"colour_log",
         [](const Marks& marks, const fs::path&) {
             return marks.colour_look.logarithmic ? json(*marks.colour_look.logarithmic) : json();
         },
         [](const json& value, const fs::path&, Marks& marks) {
             marks.colour_look.logarithmic = truth(value, "colour_log");
             expect_good(marks.colour_look);
         }},
        {"legend", [](const Marks& marks, const fs::path&) { return marks.colour_look.legend ? json() : json(false); },
         [](const json& value, const fs::path&, Marks& marks) { marks.colour_look.legend = truth(value, "legend"); }}};
}

std::vector<MarksEntry> planning_entries() {
    return {bands_entry(), number_entry("reconstruct", &Marks::planning, &Planning::reconstruct_mm, 0.0, 1e6),
            number_entry("lesion_contact", &Marks::planning, &Planning::touch_mm, 0.0, 1e6)};
}

std::vector<MarksEntry> glass_entries() {
    return {number_entry("glass_opacity", &Marks::glass, &GlassLook::opacity, 0.0, 2.0),
            number_entry("glass_grey", &Marks::glass, &GlassLook::grey, 0.0, 1.0)};
}

MarksEntry colour_by_entry() {
    return {"colour_by",
            [](const Marks& marks, const fs::path&) { return json(std::string(name_of(marks.colour_by))); },
            [](const json& value, const fs::path&, Marks& marks) {
                marks.colour_by = word(value, "colour_by", "colour_by", colouring_named);
            }};
}

MarksEntry colour_map_entry() {
    return {"colour_map",
            [](const Marks& marks, const fs::path&) { return json(std::string(name_of(marks.colour_map))); },
            [](const json& value, const fs::path&, Marks& marks) {
                marks.colour_map = word(value, "colour_map", "colour_map", colour_map_named);
            }};
}

MarksEntry depth_cues_entry() {
    return {"depth_cues",
            [](const Marks& marks, const fs::path&) {
                json list = json::array();
                for (const DepthCue& cue : depth_cues())
                    if (marks.depth_cues.has(cue)) list.push_back(std::string(cue.name));
                return list;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_array()) throw Refusal{"depth_cues is not a list"};
                marks.depth_cues.clear();
                for (const json& one : value) {
                    const std::string wanted = text(one, "depth cue");
                    const DepthCue* cue = depth_cue_named(wanted);
                    if (cue == nullptr) throw Refusal{"unknown depth cue \"" + wanted + "\""};
                    marks.depth_cues.set(*cue, true);
                }
            }};
}

MarksEntry flag_entry(const char* key, bool Marks::*member) {
    return {key, [=](const Marks& marks, const fs::path&) { return marks.*member ? json(true) : json(); },
            [=](const json& value, const fs::path&, Marks& marks) { marks.*member = truth(value, key); }};
}

} // namespace ramus::app::session_json
