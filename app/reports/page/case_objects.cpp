#include "app/assets/assets.h"
#include "app/assets/organ_text.h"
#include "app/assets/territories.h"
#include "app/picture/colouring.h"
#include "app/picture/scene_objects.h"
#include "app/picture/territories.h"
#include "app/reports/page/case_json.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

ordered_json colour_entry(const Rgb& colour) { return colour_text(colour); }

template <class T>
ordered_json object_entry(const T& object, std::size_t index, const Assets& assets, const Lengths& lengths) {
    const ObjectWords words = words_of(object, index, assets, lengths); // its details may have a path
    ordered_json entry = {{"name", words.title}, {"colour", colour_entry(object.colour)}, {"visible", object.visible}};
    if (!words.trouble && !words.value.empty()) entry["text"] = words.value;
    return entry;
}

void add_lesions(ordered_json& json, const Marks& marks, const Assets& assets, const Lengths& lengths,
                 PageMeshes& meshes) {
    for (std::size_t i = 0; i < marks.lesions.size(); ++i) {
        const Lesion& lesion = marks.lesions[i];
        ordered_json entry = object_entry(lesion, i, assets, lengths);
        entry["opacity"] = lesion.opacity;
        const auto mesh = assets.lesion_mesh(lesion);
        if (lesion.is_mesh() && !mesh) continue;
        if (mesh) {
            entry["mesh"] = meshes.add({mesh, &mesh->mesh});
        } else {
            entry["centre"] = page_place({lesion.sphere[0], lesion.sphere[1], lesion.sphere[2]});
            entry["radius"] = page_number(lesion.sphere[3]);
        }
        json["lesions"].push_back(std::move(entry));
    }
    if (marks.lesions.empty()) return;
    const std::vector<double>& bands = marks.planning.bands_mm;
    for (std::size_t i = 0; i < bands.size(); ++i)
        json["bands"].push_back({{"mm", bands[i]}, {"colour", page_colour(margin_colour(i, bands.size()))}});
    for (const double distance : assets.plan->lesion_distances_mm)
        json["lesion_distances_mm"].push_back(page_number(distance));
}

void add_measurements(ordered_json& json, const Marks& marks, const Assets& assets, const Lengths& lengths) {
    for (std::size_t i = 0; i < marks.measurements.size(); ++i) {
        const Measurement& measurement = marks.measurements[i];
        const auto* const found = assets.measured(measurement.id);
        if (found == nullptr || !*found) continue;
        ordered_json entry = object_entry(measurement, i, assets, lengths);
        entry["kind"] = (*found)->kind;
        entry["points"] = ordered_json::array();
        for (const auto& line : (*found)->lines) {
            ordered_json points = ordered_json::array();
            for (const glm::dvec3& point : line) points.push_back(page_place(point));
            entry["lines"].push_back(std::move(points));
        }
        for (const glm::dvec3& end : (*found)->ends) entry["points"].push_back(page_place(end));
        entry["label_at"] = page_place((*found)->label_place);
        json["measurements"].push_back(std::move(entry));
    }
}

void add_notes(ordered_json& json, const tree::VesselTree& tree) {
    for (const tree::Note& note : tree.notes) {
        ordered_json entry = {{"kind", tree::name_of(note.kind)}, {"text", note.text}};
        if (note.at) entry["point"] = page_place(*note.at);
        json["notes"].push_back(std::move(entry));
    }
}

void add_contacts(ordered_json& json, const Document& document, const Assets& assets) {
    if (!assets.contacts.fits(document.marks().options)) return;
    for (const tree::Contact& contact : *assets.contacts.list)
        json["contacts"].push_back({{"branches", branches_of(contact)},
                                    {"point", page_place(contact.at())},
                                    {"gap_mm", page_number(contact.gap)},
                                    {"text", gap_text(contact, document.lengths())}});
}

using PageParts = Operation::Parts;

// An entry for each part of its surface; none without an organ.
void add_resections(ordered_json& plan, const std::vector<Resection>& resections, const Operation* operation,
                    const Assets& assets, const Lengths& lengths, PageMeshes& meshes) {
    for (std::size_t n = 0; n < resections.size(); ++n) {
        const PageParts* const parts =
            operation != nullptr && n < operation->surfaces.size() ? &operation->surfaces[n] : nullptr;
        if (parts == nullptr || parts->empty()) {
            plan["resections"].push_back(object_entry(resections[n], n, assets, lengths));
            continue;
        }
        for (std::size_t part = 0; part < parts->size(); ++part) {
            if ((*parts)[part]->triangles.empty()) continue;
            ordered_json entry = object_entry(resections[n], n, assets, lengths);
            if (part + 1 < parts->size()) entry["colour"] = page_colour(margin_colour(part, parts->size() - 1));
            entry["opacity"] = resections[n].opacity;
            entry["mesh"] = meshes.add((*parts)[part]);
            plan["resections"].push_back(std::move(entry));
        }
    }
}

ordered_json plan_entry(const Document& document, const OperationPlan& plan, const Operation* operation) {
    const tree::VesselTree& tree = *document.tree();
    const TreeFacts& facts = *document.facts();
    const Lengths lengths = document.lengths();
    ordered_json entry = {{"name", plan.name}, {"cuts", ordered_json::array()}, {"lost", ordered_json::array()}};
    const measure::CutReport report = measure::cut_report(tree, facts.dependency, facts.dependents, plan.cuts,
                                                          document.marks().planning.reconstruct_mm);
    for (std::size_t i = 0; i < plan.cuts.size(); ++i) {
        const auto& [branch, fraction] = plan.cuts[i];
        const measure::BranchPoint at = measure::point_on(tree, branch, fraction);
        entry["cuts"].push_back({{"branch", branch},
                                 {"fraction", page_number(fraction)},
                                 {"point", page_place(at.position)},
                                 {"direction", page_place(at.direction)},
                                 {"radius", page_number(at.radius_mm)},
                                 {"reconstruct", report.cuts[i].reconstruct},
                                 {"text", "\xC3\x98 " + lengths.text(report.cuts[i].diameter_mm) + ", takes away " +
                                              amount_text(report.cuts[i].lost, lengths)}});
    }
    for (std::size_t id = 0; id < report.spans.size(); ++id) {
        const measure::LostSpan& span = report.spans[id];
        if (span.whole())
            entry["lost"].push_back(id);
        else if (span.any())
            entry["lost_in_part"].push_back({id, page_number(span.from), page_number(span.to)});
    }
    entry["figures"] = ordered_json::array();
    if (!plan.cuts.empty()) entry["figures"].push_back({"Lost by the cuts", amount_text(report.together, lengths)});
    if (operation != nullptr)
        for (const OrganFact& fact : organ_facts(*operation, document.marks()))
            entry["figures"].push_back({fact.label, fact.value(Lengths(operation->of.supply->of.mask->claims))});
    return entry;
}

void add_territories(ordered_json& json, const Marks& marks, const Assets& assets, PageMeshes& meshes) {
    const auto territories = assets.organ.territories;
    if (!territories || marks.organ.territories == TerritoriesOf::kNothing) return;
    constexpr double kMm3InMl = 1000.0;
    for (std::size_t n = 0; n < territories->parts.size(); ++n) {
        const OrganTerritories::Part& part = territories->parts[n];
        json["territories"].push_back({{"name", part.name},
                                       {"mesh", meshes.add(part.mesh)},
                                       {"colour", page_colour(territory_colour(*territories, n, marks))},
                                       {"opacity", marks.organ.opacity},
                                       {"volume_ml", page_number(territories->volume_mm3(part) / kMm3InMl)},
                                       {"percent", page_number(territories->percent(part))}});
    }
}

} // namespace

void add_objects(ordered_json& json, const Document& document, const Assets& assets, PageMeshes& meshes) {
    const Marks& marks = document.marks();
    const Lengths lengths = document.lengths();
    add_lesions(json, marks, assets, lengths, meshes);
    for (std::size_t i = 0; i < marks.context.size(); ++i) {
        const auto shape = assets.context_shape(source_of(marks.context[i]));
        if (!shape) continue;
        ordered_json entry = object_entry(marks.context[i], i, assets, lengths);
        entry["opacity"] = marks.context[i].opacity;
        entry["mesh"] = meshes.add(shape->mesh);
        json["context"].push_back(std::move(entry));
    }
    add_measurements(json, marks, assets, lengths);
    add_notes(json, *document.tree());
    for (std::size_t i = 0; i < marks.pins.size(); ++i) {
        ordered_json entry = object_entry(marks.pins[i], i, assets, lengths);
        entry["point"] = page_place(marks.pins[i].at);
        json["pins"].push_back(std::move(entry));
    }
    add_contacts(json, document, assets);
}

void add_plans(ordered_json& json, const Document& document, const Assets& assets, PageMeshes& meshes) {
    const Marks& marks = document.marks();
    const std::vector<OperationPlan> plans = all_plans(marks);
    const auto is_empty = [](const OperationPlan& plan) { return plan.cuts.empty() && plan.resections.empty(); };
    if (!std::ranges::all_of(plans, is_empty)) {
        for (std::size_t n = 0; n < plans.size(); ++n) {
            const auto operation = operation_of(assets, marks, n);
            ordered_json entry = plan_entry(document, plans[n], operation.get());
            entry["current"] = n == marks.plans.place;
            add_resections(entry, plans[n].resections, operation.get(), assets, document.lengths(), meshes);
            json["plans"].push_back(std::move(entry));
        }
    }
    add_territories(json, marks, assets, meshes);
}

} // namespace ramus::app
