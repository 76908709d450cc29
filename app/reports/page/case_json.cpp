#include "app/reports/page/case_json.h"

#include "app/assets/assets.h"
#include "app/picture/compose.h"
#include "app/reports/report_page.h"
#include "app/reports/surface_facts.h"
#include "app/reports/table_kinds.h"
#include "app/session/labels.h"
#include "app/session/numbers.h"
#include "app/session/quantity.h"
#include "app/session/systems.h"
#include "core/base/words.h"
#include "core/tree/data_array.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ramus::app {

using nlohmann::ordered_json;

std::string page_colour(const glm::vec3& srgb) { return colour_text(bytes_of(srgb)); }

double page_number(double value) { return std::isfinite(value) ? *parsed<double>(in_digits(value, 7)) : 0.0; }

ordered_json page_place(const glm::dvec3& place) {
    return {page_number(place.x), page_number(place.y), page_number(place.z)};
}

namespace {

const char* state_word(tree::BranchState state) {
    constexpr std::array<const char*, 4> kWords{"normal", "highlighted", "defocused", "hidden"};
    return kWords[static_cast<std::size_t>(state)];
}

// The colour at a value, as shaders find it.
glm::vec3 colour_on(const render::ColourScale& scale, double value) {
    const auto low = double(scale.low), high = double(scale.high);
    double share =
        scale.logarithmic ? std::log(std::max(value, 1e-9) / low) / std::log(high / low) : (value - low) / (high - low);
    share = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0.0;
    return scale.ramp[static_cast<std::size_t>(std::lround(share * static_cast<double>(scale.ramp.size() - 1)))];
}

glm::vec3 colour_of(const render::Frame& frame, const TreeFacts& facts, std::size_t branch) {
    using enum render::ColourScale::Value;
    const render::ColourScale& scale = frame.scale;
    if (!scale.ramp.empty() && (scale.value == kDiameter || scale.value == kRootDistance)) {
        const BranchFacts& own = facts.branches[branch];
        return colour_on(scale,
                         scale.value == kDiameter ? own.diameter_mm.mean : own.root_distance_mm + 0.5 * own.length_mm);
    }
    return branch < frame.colours.size() ? frame.colours[branch] : frame.appearance.vessel;
}

ordered_json branches_json(const Document& document, const Assets& assets, const render::Frame& frame) {
    const tree::VesselTree& tree = *document.tree();
    const TreeFacts& facts = *document.facts();
    const std::vector<int> labels = label_sources(facts.dependency, document.marks());
    ordered_json list = ordered_json::array();
    for (std::size_t id = 0; id < tree.branches.size(); ++id) {
        const tree::Branch& branch = tree.branches[id];
        const BranchFacts& own = facts.branches[id];
        ordered_json entry = {
            {"id", id},
            {"parent", branch.parent == tree::kNoBranch ? ordered_json() : ordered_json(branch.parent)},
            {"children", branch.children},
            {"from", branch.points.front()},
            {"to", branch.points.back()},
            {"generation", branch.generation},
            {"strahler", branch.strahler},
            {"length_mm", page_number(own.length_mm)},
            {"diameter_mm",
             {{"mean", page_number(own.diameter_mm.mean)},
              {"min", page_number(own.diameter_mm.min)},
              {"max", page_number(own.diameter_mm.max)}}},
            {"state", state_word(state_of(document.marks(), static_cast<int>(id)))},
            {"colour", page_colour(colour_of(frame, facts, id))}};
        if (!tree.systems.empty()) entry["system"] = branch.system;
        if (labels[id] != tree::kNoBranch) entry["name"] = document.marks().names.at(labels[id]);
        if (id < assets.plan->cuts.spans.size() && assets.plan->cuts.spans[id].whole()) entry["lost"] = true;
        list.push_back(std::move(entry));
    }
    return list;
}

ordered_json columns_json(const Document& document) {
    const tree::VesselTree& tree = *document.tree();
    const TreeFacts& facts = *document.facts();
    ordered_json columns = ordered_json::array();
    for (const QuantityRow& row : quantities()) {
        if (row.quantity == Quantity::kId) continue;
        ordered_json values = ordered_json::array();
        for (int id = 0; id < document.branch_count(); ++id) values.push_back(page_number(row.value(tree, facts, id)));
        columns.push_back({{"key", row.key},
                           {"label", row.label},
                           {"unit", document.lengths().worded(row.unit)},
                           {"whole", row.whole},
                           {"values", std::move(values)}});
    }
    return columns;
}

std::string utf8(const std::string& latin1) {
    std::string text;
    for (const char c : latin1) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte >= 0x80) text += static_cast<char>(0xC0 | byte >> 6U);
        text += static_cast<char>(byte < 0x80 ? byte : 0x80 | (byte & 0x3FU));
    }
    return text;
}

ordered_json legend_json(const render::Legend& legend) {
    ordered_json json = {{"title", utf8(legend.title)}, {"stops", ordered_json::array()}};
    if (!legend.subtitle.empty()) json["subtitle"] = utf8(legend.subtitle);
    if (!legend.bar.empty()) {
        for (const glm::vec3& colour : legend.bar) json["bar"].push_back(page_colour(colour));
        for (const render::Legend::Tick& tick : legend.ticks)
            json["ticks"].push_back({page_number(tick.at), utf8(tick.text)});
    }
    for (const render::Legend::Swatch& swatch : legend.swatches)
        json["stops"].push_back({utf8(swatch.text), page_colour(swatch.colour)});
    return json;
}

ordered_json tables_json(const Document& document, const Assets& assets) {
    ordered_json tables = ordered_json::array();
    for (const TableKind& kind : table_kinds()) {
        if (!kind.there(document, assets)) continue;
        const Table table = in_words(kind.table(document, assets));
        ordered_json one = {
            {"title", table.title}, {"columns", ordered_json::array()}, {"rows", ordered_json::array()}};
        for (const Column& column : table.columns)
            one["columns"].push_back(column.heading.empty() ? column.name : column.heading);
        for (const std::vector<Cell>& row : table.rows) {
            ordered_json cells = ordered_json::array();
            for (std::size_t c = 0; c < row.size(); ++c) cells.push_back(text_of(row[c], table.columns[c].digits));
            one["rows"].push_back(std::move(cells));
        }
        tables.push_back(std::move(one));
    }
    return tables;
}

ordered_json claims_json(const tree::Claims& claims, const Lengths& lengths) {
    const auto said = [](tree::SaidBy who, const char* open) {
        return who == tree::SaidBy::kFile     ? "as the file says"
               : who == tree::SaidBy::kPerson ? "as the user says"
                                              : open;
    };
    return {{"unit", lengths.unit()},
            {"letters", claims.has_sides()},
            {"unit_note", said(claims.unit, "not known: lengths count as the file has them")},
            {"orientation_note", said(claims.orientation, "not known: axes x, y, z are those of the file")}};
}

ordered_json settings_json(const Document& document) {
    ordered_json settings = ordered_json::array();
    for (const auto& [name, value] : surface_facts(document.marks().options))
        settings.push_back({name, document.lengths().worded(value)});
    return settings;
}

void add_look(ordered_json& json, const Session& session, const render::Frame& frame) {
    const render::Appearance& look = frame.appearance;
    json["camera"] = render::to_json(session.camera);
    json["ground"] = frame.overlays.dark_ink ? "light" : "dark";
    for (const SavedView& view : session.marks.views)
        json["views"].push_back({{"name", view.name}, {"camera", render::to_json(view.camera)}});
    json["background"] = {{"top", page_colour(frame.background.top)}, {"bottom", page_colour(frame.background.bottom)}};
    json["look"] = {{"vessel", page_colour(look.vessel)},
                    {"highlight", page_colour(look.highlight)},
                    {"selection", page_colour(look.selection)},
                    {"glass", page_colour(look.glass)},
                    {"glass_opacity", page_number(double(look.glass_opacity))},
                    {"centerline", page_colour(look.centerline)},
                    {"lost", page_colour(look.lost)}};
    json["selection"] = session.marks.selection;
    json["colour"] = {{"by", name_of(session.marks.colour_by)}, {"legend", legend_json(frame.overlays.legend)}};
}

} // namespace

ordered_json case_json(const Document& document, const Assets& assets, const CaseHead& head, PageMeshes& meshes) {
    const Marks& marks = document.marks();
    const tree::VesselTree& tree = *document.tree();
    Viewing viewing;
    viewing.ground = head.ground;
    const render::Frame frame = compose(document.session(), assets, std::make_shared<render::PagedMesh>(), viewing);
    ordered_json json = {{"format", kCaseFormat}, {"ramus", RAMUS_VERSION}, {"title", head.title}};
    if (!head.file.empty()) json["file"] = head.file;
    if (!head.checksum.empty()) json["checksum"] = head.checksum;
    json["made"] = head.made;
    json["settings"] = settings_json(document);
    json["assumed"] = sentences(tree, tree::Note::Kind::kAssumed);
    json["repaired"] = sentences(tree, tree::Note::Kind::kRepaired);
    json["claims"] = claims_json(tree.claims, document.lengths());
    add_look(json, document.session(), frame);
    json["branches"] = branches_json(document, assets, frame);
    const tree::Dependency& dependency = document.dependency();
    json["order"] = dependency.order();
    json["dependents"] = ordered_json::array();
    for (const int id : dependency.order()) json["dependents"].push_back(dependency.dependents(id).size());
    const Systems& systems = systems_of(tree, marks);
    for (int system = 0; system < static_cast<int>(systems.size()); ++system)
        json["systems"].push_back(
            {{"name", system_name(systems, system)}, {"colour", page_colour(shown_colour(systems, system))}});
    json["columns"] = columns_json(document);
    add_objects(json, document, assets, meshes);
    add_plans(json, document, assets, meshes);
    if (head.tables) json["tables"] = tables_json(document, assets);
    return json;
}

} // namespace ramus::app
