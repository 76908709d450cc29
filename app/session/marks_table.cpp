#include "app/session/marks_table.h"

#include "app/session/carry_marks.h"
#include "app/session/edits_json.h"
#include "app/session/json_values.h"
#include "app/session/lesion_entries.h"
#include "app/session/marks_json.h"
#include "app/session/numbers.h"
#include "app/session/option_entries.h"
#include "app/session/reading_json.h"
#include "app/session/saved_views_json.h"
#include "app/session/session_limits.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <limits>
#include <type_traits>
#include <utility>

namespace ramus::app {

namespace fs = std::filesystem;
using tree::BranchState;
using namespace session_json;

namespace {

template <class T> constexpr bool kIsList = false;
template <class T> constexpr bool kIsList<std::vector<T>> = true;

// Fills in what follows from the member's type.
template <auto Member> MarksRow row(MarksRow facts) {
    using T = std::remove_cvref_t<decltype(std::declval<Marks>().*Member)>;
    static constexpr T Marks::*kMember = Member; // may belong to a base class
    facts.same = [](const Marks& a, const Marks& b) { return a.*Member == b.*Member; };
    facts.take = [](Marks& to, const Marks& from) { to.*Member = from.*Member; };
    if (facts.change == nullptr)
        facts.change = [](const Marks& before, const Marks& after) {
            return member_change(kMember, before.*Member, after.*Member);
        };
    facts.address = [](const Marks& marks) -> const void* { return &(marks.*Member); };
    if constexpr (kIsList<T>) facts.count = [](const Marks& marks) { return (marks.*Member).size(); };
    return facts;
}

template <auto Member> MarksRow option(const std::vector<MarksEntry>& entries, bool is_look) {
    return row<Member>({.entries = entries, .place = MarksPlace::kOptions, .is_look = is_look});
}

// A value that is omitted at its default.
template <auto Member, class Write, class Read> MarksEntry entry(const char* key, Write write, Read read) {
    return {key,
            [write](const Marks& marks, const fs::path& folder) {
                return marks.*Member == Marks{}.*Member ? json() : write(marks.*Member, folder);
            },
            [read](const json& value, const fs::path& folder, Marks& marks) { marks.*Member = read(value, folder); }};
}

// A list, one element after the other.
template <auto Member, class Write, class Read> MarksEntry list_entry(const std::string& key, Write write, Read read) {
    return {key,
            [write](const Marks& marks, const fs::path& folder) {
                json list = json::array();
                for (const auto& element : marks.*Member) list.push_back(write(element, folder));
                return list;
            },
            [read, key](const json& value, const fs::path& folder, Marks& marks) {
                if (!value.is_array()) throw Refusal{key + " is not a list"};
                for (const json& element : value) (marks.*Member).push_back(read(element, folder));
            }};
}

MarksEntry states_entry() {
    return {"states",
            [](const Marks& marks, const fs::path&) {
                json states = json::object();
                for (const BranchState state : kListedStates)
                    states[std::string(name_of(state))] = branches_in_state(marks, state);
                return states;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                expect_only(value, "states", {"highlighted", "defocused", "hidden"});
                for (const BranchState state : kListedStates) {
                    const std::string name(name_of(state));
                    if (!value.contains(name)) continue;
                    const std::vector<int> found = ids(value[name], name);
                    for (const int id : found)
                        if (state_of(marks, id) != BranchState::kNormal)
                            throw Refusal{"branch " + std::to_string(id) + " has two states"};
                    set_state(marks, found, state);
                }
            }};
}

void name_whole_subtrees(Marks& marks) {
    for (const auto& [id, name] : marks.names) marks.subtree_names.push_back(id);
}

MarksEntry names_entry() {
    return {"names",
            [](const Marks& marks, const fs::path&) {
                json names = json::object();
                for (const auto& [id, name] : marks.names) names[std::to_string(id)] = name;
                return names;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_object()) throw Refusal{"names is not an object"};
                for (const auto& [key, name] : value.items()) {
                    const int id = parsed<int>(key).value_or(-1);
                    if (id < 0) throw Refusal{"\"" + key + "\" in names is not a branch id"};
                    marks.names[id] = text(name, "name of branch " + key);
                }
            }};
}

MarksEntry subtree_names_entry() {
    return {
        "subtree_names",
        [](const Marks& marks, const fs::path&) { return marks.names.empty() ? json() : json(marks.subtree_names); },
        [](const json& value, const fs::path&, Marks& marks) {
            marks.subtree_names = ids(value, "subtree_names");
            for (const int branch : marks.subtree_names)
                if (!marks.names.contains(branch))
                    throw Refusal{"branch " + std::to_string(branch) + " in subtree_names has no name"};
        },
        name_whole_subtrees};
}

json system_json(const tree::System& system) { return {{"name", system.name}, {"colour", colour_text(system.colour)}}; }

MarksEntry systems_entry() {
    MarksEntry entry = list_entry<&Marks::systems>(
        "systems", [](const tree::System& system, const fs::path&) { return system_json(system); },
        [](const json& value, const fs::path&) { return system_in(value); });
    entry.write = [write = entry.write](const Marks& marks, const fs::path& folder) {
        return marks.systems.empty() ? json() : write(marks, folder);
    };
    return entry;
}

MarksRow edits_row() {
    return row<&Marks::edits>({.entries = {entry<&Marks::edits>(
                                   "edits", [](const auto& edits, const fs::path&) { return edits_json(edits); },
                                   [](const json& value, const fs::path&) { return edits_in(value); })},
                               .most = kMostEdits,
                               .noun = "edits"});
}

MarksRow selection_row() {
    return row<&Marks::selection>(
        {.entries = {{"selection", [](const Marks& marks, const fs::path&) { return json(marks.selection); },
                      [](const json& value, const fs::path&, Marks& marks) {
                          marks.selection = ids(value, "selection");
                      }}},
         .is_look = true,
         .largest_branch = [](const Marks& marks) { return marks.selection.empty() ? -1 : marks.selection.back(); },
         .carry = carry_selection,
         .change = [](const Marks& before, const Marks& after) -> std::shared_ptr<const MemberChange> {
             return std::make_shared<SelectionChange>(before.selection, after.selection);
         }});
}

MarksRow states_row() {
    return row<&Marks::states>(
        {.entries = {states_entry()},
         .largest_branch = [](const Marks& marks) { return static_cast<int>(marks.states.size()) - 1; },
         .carry = carry_states,
         .change = [](const Marks& before, const Marks& after) -> std::shared_ptr<const MemberChange> {
             return std::make_shared<StatesChange>(before.states, after.states);
         }});
}

MarksRow lesions_row() {
    return row<&Marks::lesions>({.entries = {spheres_entry(), lesion_meshes_entry()},
                                 .most = kMostMarks,
                                 .noun = "lesions",
                                 .file_noun = "lesion meshes",
                                 .add_files = [](const Marks& marks, std::vector<fs::path>& files) {
                                     const std::vector<std::string> meshes = lesion_files(marks);
                                     files.insert(files.end(), meshes.begin(), meshes.end());
                                 }});
}

MarksRow context_row() {
    return row<&Marks::context>({.entries = {list_entry<&Marks::context>("context", context_json, context_in)},
                                 .most = kMostShapes,
                                 .noun = "context shapes",
                                 .add_files = [](const Marks& marks, std::vector<fs::path>& files) {
                                     for (const ContextItem& item : marks.context) files.emplace_back(item.file);
                                 }});
}

MarksRow cuts_row() {
    return row<&Marks::cuts>({.entries = {list_entry<&Marks::cuts>(
                                  "cuts", [](const auto& cut, const fs::path&) { return json(cut); },
                                  [](const json& value, const fs::path&) { return session_json::cut_in(value); })},
                              .most = kMostMarks,
                              .noun = "cuts",
                              .largest_branch =
                                  [](const Marks& marks) {
                                      int largest = -1;
                                      for (const auto& cut : marks.cuts) largest = std::max(largest, cut.first);
                                      return largest;
                                  },
                              .carry = carry_cuts});
}

MarksEntry measurements_entry() {
    return {"measurements",
            [](const Marks& marks, const fs::path&) {
                json list = json::array();
                for (const Measurement& m : marks.measurements) list.push_back(measurement_json(m, marks));
                return list;
            },
            [](const json& value, const fs::path&, Marks& marks) {
                if (!value.is_array()) throw Refusal{"measurements is not a list"};
                for (const json& m : value) marks.measurements.push_back(measurement_in(m, marks));
            }};
}

MarksRow measurements_row() {
    return row<&Marks::measurements>({.entries = {measurements_entry()},
                                      .most = kMostMarks,
                                      .noun = "measurements",
                                      .largest_branch =
                                          [](const Marks& marks) {
                                              int largest = -1;
                                              for (const Measurement& m : marks.measurements)
                                                  for (const measure::BranchPlace& place : m.places)
                                                      largest = std::max(largest, place.branch);
                                              return largest;
                                          },
                                      .carry = carry_measurements});
}

json pin_json(const Pin& pin, const fs::path& /*folder*/) {
    json value{{"at", {pin.at.x, pin.at.y, pin.at.z}}};
    write_object(value, pin);
    return value;
}

Pin pin_in(const json& value, const fs::path& /*folder*/) {
    Pin pin;
    read_object(value, pin, {"at"});
    const json at = list_in(value, "at");
    if (at.size() != 3) throw Refusal{"a pin is not at [x, y, z]"};
    for (int axis = 0; axis < 3; ++axis)
        pin.at[axis] = session_json::number(at[static_cast<std::size_t>(axis)], "coordinate of a pin", -1e9, 1e9);
    return pin;
}

MarksRow pins_row() {
    return row<&Marks::pins>(
        {.entries = {list_entry<&Marks::pins>("pins", pin_json, pin_in)}, .most = kMostMarks, .noun = "pins"});
}

json scan_json(const Scan& scan, const fs::path& folder) {
    json value{{"path", written_path(scan.file, folder).string()}};
    if (!scan.checksum.empty()) value["checksum"] = scan.checksum;
    if (!scan.units.empty()) value["units"] = scan.units;
    write_part(scan.part, value);
    if (scan.labels) value["labels"] = true;
    if (scan.window) value["window"] = {scan.window->width, scan.window->level};
    write_object(value, scan);
    return value;
}

Scan scan_in(const json& value, const fs::path& folder) {
    Scan scan;
    read_object(value, scan, {"path", "checksum", "units", "channel", "time", "labels", "window"});
    if (!value.contains("path")) throw Refusal{"a scan has no path"};
    scan.file = (folder / text(value["path"], "path of a scan")).lexically_normal().string();
    if (value.contains("checksum")) scan.checksum = text(value["checksum"], "checksum of a scan");
    if (value.contains("units")) scan.units = units_in(value["units"]);
    scan.part = part_in(value);
    if (value.contains("labels")) scan.labels = truth(value["labels"], "labels");
    const json window = list_in(value, "window");
    if (!window.empty() && window.size() != 2) throw Refusal{"the window of a scan is not [width, level]"};
    if (!window.empty())
        scan.window = slice::Window{session_json::number(window[1], "level", -1e12, 1e12),
                                    session_json::number(window[0], "width", 1e-12, 1e12)};
    return scan;
}

MarksRow scans_row() {
    MarksEntry scans = list_entry<&Marks::scans>("scans", scan_json, scan_in);
    scans.write = [write = scans.write](const Marks& marks, const fs::path& folder) {
        return marks.scans.empty() ? json() : write(marks, folder);
    };
    return row<&Marks::scans>({.entries = {std::move(scans)},
                               .most = kMostScans,
                               .noun = "scans",
                               .add_files = [](const Marks& marks, std::vector<fs::path>& files) {
                                   for (const Scan& scan : marks.scans) files.emplace_back(scan.file);
                               }});
}

MarksRow resections_row() {
    return row<&Marks::resections>({.entries = {{"resections",
                                                 [](const Marks& marks, const fs::path& folder) {
                                                     json list = json::array();
                                                     for (const Resection& one : marks.resections)
                                                         list.push_back(resection_json(one, marks, folder));
                                                     return list.empty() ? json() : list;
                                                 },
                                                 [](const json& value, const fs::path& folder, Marks& marks) {
                                                     if (!value.is_array()) throw Refusal{"resections is not a list"};
                                                     for (const json& one : value)
                                                         marks.resections.push_back(resection_in(one, marks, folder));
                                                 }}},
                                    .most = kMostResections,
                                    .noun = "resections",
                                    .file_noun = "surfaces of resections",
                                    .add_files = [](const Marks& marks, std::vector<fs::path>& files) {
                                        for (const OperationPlan& plan : all_plans(marks))
                                            for (const Resection& one : plan.resections)
                                                if (!one.file.empty()) files.emplace_back(one.file);
                                    }});
}

MarksRow plans_row() {
    MarksRow plans =
        row<&Marks::plans>({.entries = {{"plans",
                                         [](const Marks& marks, const fs::path& folder) {
                                             return marks.plans == Plans{} ? json() : plans_json(marks, folder);
                                         },
                                         [](const json& value, const fs::path& folder, Marks& marks) {
                                             marks.plans = plans_in(value, marks, folder);
                                         }}},
                            .largest_branch =
                                [](const Marks& marks) {
                                    int largest = -1;
                                    for (const OperationPlan& plan : marks.plans.others)
                                        for (const auto& cut : plan.cuts) largest = std::max(largest, cut.first);
                                    return largest;
                                },
                            .carry = carry_plans});
    plans.count = [](const Marks& marks) { return marks.plans.count(); };
    plans.most = kMostPlans;
    plans.noun = "plans";
    return plans;
}

std::vector<MarksRow> rows_of_plan() {
    return {edits_row(),
            selection_row(),
            states_row(),
            lesions_row(),
            context_row(),
            cuts_row(),
            measurements_row(),
            pins_row(),
            resections_row(),
            plans_row(),
            scans_row(),
            row<&Marks::views>({.entries = {saved_views_entry()}, .most = kMostViews, .noun = "saved views"}),
            row<&Marks::names>(
                {.entries = {names_entry()},
                 .largest_branch =
                     [](const Marks& marks) { return marks.names.empty() ? -1 : marks.names.rbegin()->first; },
                 .carry = carry_names}),
            row<&Marks::subtree_names>({.entries = {subtree_names_entry()}}), // carried with the names
            row<&Marks::systems>({.entries = {systems_entry()}, .carry = carry_systems})};
}

std::vector<MarksRow> rows_of_files() {
    return {row<&Marks::comparison>(
                {.entries = {entry<&Marks::comparison>("comparison", comparison_json, comparison_in)},
                 .add_files = [](const Marks& marks,
                                 std::vector<fs::path>& files) { files.emplace_back(marks.comparison.mask); }}),
            row<&Marks::deviation>(
                {.entries = {entry<&Marks::deviation>("deviation", deviation_json, deviation_in)},
                 .add_files = [](const Marks& marks,
                                 std::vector<fs::path>& files) { files.emplace_back(marks.deviation.file); }}),
            row<&Marks::organ>(
                {.entries = {entry<&Marks::organ>("organ", organ_json, organ_in)},
                 .add_files = [](const Marks& marks,
                                 std::vector<fs::path>& files) { files.emplace_back(marks.organ.source.file); },
                 .carry = carry_organ}),
            row<&Marks::reading>({.entries = {entry<&Marks::reading>("reading", reading_json, reading_in)},
                                  .add_files = [](const Marks& marks, std::vector<fs::path>& files) {
                                      files.emplace_back(marks.reading.data);
                                  }})};
}

std::vector<MarksRow> rows_of_options() {
    std::vector<MarksRow> rows{
        option<&Marks::colour_by>({colour_by_entry()}, true),
        option<&Marks::colour_map>({colour_map_entry()}, true),
        option<&Marks::colour_look>(colour_look_entries(), true),
        option<&Marks::planning>(planning_entries(), false),
        option<&Marks::glass>(glass_entries(), true),
        option<&Marks::depth_cues>({depth_cues_entry()}, true),
        option<&Marks::skeleton>({flag_entry("skeleton", &Marks::skeleton)}, true),
        option<&Marks::contact_marks>({flag_entry("contact_marks", &Marks::contact_marks)}, true),
        option<&Marks::shortest_distances>({flag_entry("shortest_distances", &Marks::shortest_distances)}, true),
        option<&Marks::options>(surface_entries(), false)};
    rows[0].carry = carry_colour_by;
    rows[3].carry = carry_planning;
    return rows;
}

template <class... List> std::vector<MarksRow> joined_rows(std::vector<MarksRow> first, List... others) {
    (std::ranges::move(others, std::back_inserter(first)), ...);
    return first;
}

} // namespace

std::span<const MarksRow> marks_table() {
    static const std::vector<MarksRow> rows = joined_rows(rows_of_plan(), rows_of_files(), rows_of_options());
    return rows;
}

Result<void> check_counts(const Marks& marks) {
    const auto check = [](std::size_t count, std::size_t most, std::string_view noun) -> Result<void> {
        if (count <= most) return {};
        return fail(grouped(count) + " " + std::string(noun) + ", where there can be " + grouped(most), {},
                    "remove those that are not needed");
    };
    for (const MarksRow& row : marks_table()) {
        if (row.most > 0)
            if (auto few = check(row.count(marks), row.most, row.noun); !few) return few;
        std::vector<fs::path> files;
        if (!row.file_noun.empty()) row.add_files(marks, files);
        if (auto few = check(files.size(), kMostShapes, row.file_noun); !few) return few;
    }
    return {};
}

} // namespace ramus::app
