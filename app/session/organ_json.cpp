// The organ of a session as JSON (marks_json.h).
#include "app/session/json_values.h"
#include "app/session/marks_json.h"
#include "core/base/sort_unique.h"

namespace ramus::app::session_json {

namespace {

constexpr double kMostPatient = 1e4; // kg and cm

// A number of OrganChoice: its key, and its bounds.
struct OrganNumber {
    const char* key;
    double OrganChoice::*member;
    double least, most;
};
constexpr OrganNumber kOrganNumbers[] = {{"large_vessels_mm", &OrganChoice::large_vessels_mm, 0.0, 1e6},
                                         {"weight_kg", &OrganChoice::weight_kg, 0.0, kMostPatient},
                                         {"height_cm", &OrganChoice::height_cm, 0.0, kMostPatient},
                                         {"least_of_weight", &OrganChoice::least_of_weight, 0.0, 100.0},
                                         {"least_of_standard", &OrganChoice::least_of_standard, 0.0, 100.0},
                                         {"opacity", &OrganChoice::opacity, 0.0, 1.0},
                                         {"apart_mm", &OrganChoice::apart_mm, 0.0, 1e6}};

} // namespace

json organ_json(const OrganChoice& choice, const std::filesystem::path& folder) {
    const OrganChoice usual;
    json value{{"mask", written_path(choice.source.file, folder).string()}};
    for (const volume::LabelChoice& label : choice.source.labels) value["labels"].push_back(label_json(label));
    if (!choice.source.units.empty()) value["units"] = choice.source.units;
    if (choice.rule != usual.rule) value["by"] = std::string(organ::name_of(choice.rule));
    for (const organ::Role role : choice.roles)
        value["roles"].push_back(role == organ::Role::kDrains ? "drains" : "supplies");
    for (const OrganNumber& number : kOrganNumbers)
        if (choice.*number.member != usual.*number.member) value[number.key] = choice.*number.member;
    if (choice.territories != usual.territories) value["territories"] = std::string(name_of(choice.territories));
    if (choice.generation != usual.generation) value["generation"] = choice.generation;
    if (choice.system >= 0) value["system"] = choice.system;
    if (!choice.hidden.empty()) value["hidden"] = choice.hidden;
    return value;
}

OrganChoice organ_in(const json& value, const std::filesystem::path& folder) {
    std::vector<std::string_view> keys{"mask",        "labels",     "units",  "by",    "roles",
                                       "territories", "generation", "system", "hidden"};
    for (const OrganNumber& number : kOrganNumbers) keys.emplace_back(number.key);
    expect_only(value, "organ", keys);
    if (!value.contains("mask")) throw Refusal{"organ has no mask"};
    OrganChoice choice;
    if (const std::string mask = text(value["mask"], "mask of the organ"); !mask.empty())
        choice.source.file = (folder / mask).lexically_normal().string();
    choice.source.labels = labels_in(value, "labels");
    if (value.contains("units")) choice.source.units = units_in(value["units"]);
    if (value.contains("by")) choice.rule = word(value["by"], "by", "rule", organ::rule_named);
    for (const json& role : list_in(value, "roles"))
        choice.roles.push_back(word(role, "role", "role", [](const std::string& name) -> std::optional<organ::Role> {
            if (name == "drains") return organ::Role::kDrains;
            return name == "supplies" ? std::optional(organ::Role::kSupplies) : std::nullopt;
        }));
    for (const OrganNumber& number : kOrganNumbers)
        if (value.contains(number.key))
            choice.*number.member = session_json::number(value[number.key], number.key, number.least, number.most);
    if (value.contains("territories"))
        choice.territories = word(value["territories"], "territories", "kind of territories", territories_named);
    if (value.contains("generation")) choice.generation = integer(value["generation"], "generation", 0, kMostBranches);
    if (value.contains("system")) choice.system = integer(value["system"], "system", 0, kMostBranches);
    for (const json& name : list_in(value, "hidden")) choice.hidden.push_back(text(name, "hidden territory"));
    sort_unique(choice.hidden);
    return choice;
}

} // namespace ramus::app::session_json
