#include "app/reports/table_kinds.h"

#include "app/assets/assets.h"
#include "app/assets/operation.h"
#include "app/reports/organ_tables.h"
#include "app/reports/section_tables.h"
#include "core/base/words.h"

#include <algorithm>

namespace ramus::app {

namespace {

Table pins_table(const Document& document, const Assets& /*assets*/) {
    Table table{"Pins", {{"pin", "No."}, {"text", "Text"}, {"x", "x, mm"}, {"y", "y, mm"}, {"z", "z, mm"}}, {}};
    int number = 0;
    for (const Pin& pin : document.marks().pins)
        table.rows.push_back({++number, pin.name, pin.at.x, pin.at.y, pin.at.z});
    add_unit(table, document.lengths());
    return table;
}

bool has_operation(const Document& document, const Assets& assets) {
    return operation_of(assets, document.marks(), document.marks().plans.place) != nullptr;
}

} // namespace

std::span<const TableKind> table_kinds() {
    static constexpr TableKind kKinds[] = {
        {"cuts", "Cuts", cuts_table, [](const Document& d, const Assets&) { return !d.marks().cuts.empty(); }},
        {"bands", "Margins of lesions", bands_table,
         [](const Document&, const Assets& a) { return !a.plan->bands.empty(); }},
        {"lesions", "Lesions and the nearest vessels", lesions_table,
         [](const Document&, const Assets& a) { return !a.plan->vessels.empty(); }},
        {"selection", "Selected branches", selection_table,
         [](const Document& d, const Assets&) { return !d.marks().selection.empty(); }},
        {"measurements", "Measurements", measurements_table,
         [](const Document& d, const Assets&) { return !d.marks().measurements.empty(); }, true},
        {"pins", "Pins", pins_table, [](const Document& d, const Assets&) { return !d.marks().pins.empty(); }, true},
        {"organ", "Organ", organ_table, has_operation},
        {"cut-vessels", "Vessels that are cut", cut_vessels_table,
         [](const Document& d, const Assets& a) { return has_operation(d, a) && !d.marks().resections.empty(); }},
        {"territories", "Territories", territories_table,
         [](const Document&, const Assets& a) { return a.organ.territories != nullptr; }, true},
        {"stenosis", "Stenosis", stenosis_table, has_stenosis, true},
        {"sections", "Cross-sections along the vessel", followed_sections_table, has_sections, true},
        {"systems", "Systems", systems_table,
         [](const Document& d, const Assets&) { return !d.tree()->systems.empty(); }},
        {"contacts", "Contacts", contacts_table,
         [](const Document& d, const Assets& a) {
             return a.contacts.fits(d.marks().options) && !a.contacts.list->empty();
         }},
        {"validation", "Validation", validation_table,
         [](const Document& d, const Assets& a) { return a.validation.fits(validation_of(d.tree(), d.marks())); }}};
    return kKinds;
}

std::string table_names() {
    return joined(table_kinds(), ", ", [](const TableKind& kind) { return std::string(kind.name); });
}

const TableKind* table_kind_named(std::string_view name) {
    const auto found = std::ranges::find(table_kinds(), name, &TableKind::name);
    return found == table_kinds().end() ? nullptr : &*found;
}

Error nothing_to_report(std::string_view name) {
    return {"there is nothing to report of " + std::string(name),
            {},
            "cut, place a lesion, select or measure first; what is still computed can be reported in a moment"};
}

} // namespace ramus::app
