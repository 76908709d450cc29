#include "app/reports/report_tables.h"

#include "app/assets/assets.h"
#include "app/session/labels.h"
#include "app/session/quantity.h"
#include "app/session/systems.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_data.h"
#include "core/tree/branch_data.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ramus::app {

namespace {

// Labels of branches: their own name or that of a branch they depend on.
class Names {
public:
    explicit Names(const Document& document)
        : names_(document.marks().names), sources_(label_sources(document.dependency(), document.marks())) {}
    [[nodiscard]] std::string of(int branch) const {
        const int source = sources_[static_cast<std::size_t>(branch)];
        return source == tree::kNoBranch ? "" : names_.at(source);
    }

private:
    const BranchNames& names_;
    std::vector<int> sources_;
};

// Inserts column `at` with the systems of branches, if the tree has any; column `branch_at` has the ids.
void add_systems(Table& table, const Document& document, std::size_t branch_at, std::size_t at) {
    const tree::VesselTree& tree = *document.tree();
    if (tree.systems.empty()) return;
    const auto place = static_cast<std::ptrdiff_t>(at);
    table.columns.insert(table.columns.begin() + place, {"system", "System"});
    for (std::vector<Cell>& row : table.rows) {
        const auto id = row[branch_at].number;
        const std::string name = id ? system_of(tree, document.marks(), static_cast<int>(*id)) : std::string();
        row.insert(row.begin() + place, name);
    }
}

// Mean, least and largest for quantities that vary along a branch.
void add_columns(std::vector<Column>& columns, const QuantityRow& row) {
    const std::string name(row.report.name), heading(row.report.heading);
    if (row.least == nullptr) {
        columns.push_back({name, heading});
        return;
    }
    columns.insert(columns.end(),
                   {{"mean_" + name, heading}, {"least_" + name, "least"}, {"largest_" + name, "largest"}});
}

void add_cells(std::vector<Cell>& cells, const QuantityRow& row, const Document& document, int branch) {
    const TreeFacts& facts = *document.facts();
    cells.emplace_back(row.value(*document.tree(), facts, branch));
    if (row.least == nullptr) return;
    cells.emplace_back(row.least(facts, branch));
    cells.emplace_back(row.largest(facts, branch));
}

// Columns for the dependents of a branch, in the order of add().
void add_dependents(std::vector<Column>& columns) {
    for (const Quantity quantity :
         {Quantity::kDependents, Quantity::kDependentLength, Quantity::kDependentVolume, Quantity::kDependentLeaves})
        add_columns(columns, row_of(quantity));
}

void add(std::vector<Cell>& row, const measure::Amount& amount) {
    row.insert(row.end(), {amount.branches, amount.length_mm, amount.volume_mm3, amount.leaves});
}

// Data of the tree's file, one column each; a page may lack room for all.
void add_data(Table& table, const tree::VesselTree& tree, std::span<const int> branches) {
    if (branches.empty()) return;
    std::vector<std::string> names;
    for (const Column& column : table.columns) names.push_back(column.name);
    const std::vector<std::string_view> taken(names.begin(), names.end());
    for (const auto& [name, value] : tree::data_of(tree, branches.front()))
        table.columns.push_back({io::name_in_file(name, taken), name, 3, true});
    for (std::size_t row = 0; row < branches.size(); ++row)
        for (const auto& [name, value] : tree::data_of(tree, branches[row]))
            table.rows[row].push_back(tree::is_known(value) ? Cell(value) : Cell(""));
}

} // namespace

Column unit_column() { return {"unit", ""}; }

void add_unit(Table& table, const Lengths& lengths) {
    table.columns.push_back(unit_column());
    for (std::vector<Cell>& row : table.rows) row.emplace_back(lengths.word());
}

namespace {

constexpr std::string_view kCubicMm = "mm\xC2\xB3";

// Like Lengths::volume(), but with one unit for the whole column, so that its numbers are comparable.
void in_millilitres(Table& table, std::size_t c) {
    constexpr double kCubicMmInMl = 1000.0;
    std::string& heading = table.columns[c].heading;
    const auto large = [c](const std::vector<Cell>& row) { return row[c].number.value_or(0.0) >= kCubicMmInMl; };
    if (!heading.ends_with(kCubicMm) || std::ranges::none_of(table.rows, large)) return;
    heading.replace(heading.size() - kCubicMm.size(), kCubicMm.size(), "ml");
    for (std::vector<Cell>& row : table.rows)
        if (std::optional<double>& volume = row[c].number) *volume /= kCubicMmInMl;
}

} // namespace

Table in_words(Table table) {
    for (std::size_t c = table.columns.size(); c-- > 0;) {
        if (!table.columns[c].in_csv_alone) continue;
        const auto at = static_cast<std::ptrdiff_t>(c);
        table.columns.erase(table.columns.begin() + at);
        for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + at);
    }
    const auto unit = std::ranges::find_if(table.columns, [](const Column& column) { return column.heading.empty(); });
    if (unit == table.columns.end()) return table;
    const auto at = unit - table.columns.begin();
    const auto unit_of = [&](const std::vector<Cell>& row) { return row[static_cast<std::size_t>(at)].text; };
    const bool known = !table.rows.empty() && unit_of(table.rows.front()) != tree::kNotSaid;
    const bool mixed =
        std::ranges::any_of(table.rows, [&](const auto& row) { return unit_of(row) != unit_of(table.rows.front()); });
    const tree::Claims claims{.unit = known ? tree::SaidBy::kFile : tree::SaidBy::kNobody};
    for (std::size_t c = 0; c < table.columns.size() && known && !mixed; ++c) in_millilitres(table, c);
    for (Column& column : table.columns)
        column.heading = mixed ? column.heading.substr(0, column.heading.find(", mm")) : claims.worded(column.heading);
    if (mixed) {
        unit->heading = "Unit";
        return table;
    }
    table.columns.erase(unit);
    for (std::vector<Cell>& row : table.rows) row.erase(row.begin() + at);
    return table;
}

Table selection_table(const Document& document, const Assets& assets) {
    Table table = branches_table(document, assets, document.marks().selection);
    table.title = "Selection";
    return table;
}

Table branches_table(const Document& document, const Assets& assets, std::span<const int> branches) {
    Table table{"Branches", {{"branch", "Branch"}, {"name", "Name"}}, {}};
    const std::vector<const QuantityRow*> quantities = rows_with(&QuantityRow::report);
    const auto behind =
        std::ranges::find_if(quantities, [](const auto* row) { return row->report.order > kBeforeState; });
    for (auto row = quantities.begin(); row != behind; ++row) add_columns(table.columns, **row);
    table.columns.push_back({"state", "State"});
    for (auto row = behind; row != quantities.end(); ++row) add_columns(table.columns, **row);
    const Plan& plan = *assets.plan;
    const bool lesions = !plan.lesion_distances_mm.empty();
    if (lesions) table.columns.push_back({"lesion_distance", "To lesion, mm"});
    const Names names(document);
    for (const int id : branches) {
        std::vector<Cell> cells{id, names.of(id)};
        for (auto row = quantities.begin(); row != behind; ++row) add_cells(cells, **row, document, id);
        cells.emplace_back(std::string(name_of(state_of(document.marks(), id))));
        for (auto row = behind; row != quantities.end(); ++row) add_cells(cells, **row, document, id);
        if (lesions) cells.emplace_back(plan.lesion_distances_mm[static_cast<std::size_t>(id)]);
        table.rows.push_back(std::move(cells));
    }
    add_systems(table, document, 0, 2);
    add_unit(table, document.lengths());
    add_data(table, *document.tree(), branches);
    return table;
}

Table cuts_table(const Document& document, const Assets& assets) {
    Table table{"Cuts",
                {{"cut", "Cut"},
                 {"branch", "Branch"},
                 {"name", "Name"},
                 {"fraction", "At"},
                 {"diameter", "Diameter, mm"},
                 {"over_limit", "Over " + digits(document.marks().planning.reconstruct_mm) + " mm"},
                 {"lost_branches", "Lost branches"},
                 {"lost_length", "Lost length, mm"},
                 {"lost_volume", "Lost volume, mm\xC2\xB3"},
                 {"lost_leaves", "Lost leaves"}},
                {}};
    const Plan& plan = *assets.plan;
    const auto& cuts = document.marks().cuts;
    const Names names(document);
    for (std::size_t i = 0; i < cuts.size(); ++i) {
        const measure::CutFigures& figures = plan.cuts.cuts[i];
        std::vector<Cell> row{static_cast<int>(i + 1), cuts[i].first,       names.of(cuts[i].first),
                              cuts[i].second,          figures.diameter_mm, figures.reconstruct ? "yes" : "no"};
        add(row, figures.lost);
        table.rows.push_back(std::move(row));
    }
    if (!cuts.empty()) {
        std::vector<Cell> row{"all", "", "", "", "", ""};
        add(row, plan.cuts.together);
        table.rows.push_back(std::move(row));
    }
    add_systems(table, document, 1, 3);
    add_unit(table, document.lengths());
    return table;
}

Table bands_table(const Document& document, const Assets& assets) {
    Table table{"Margins around lesions",
                {{"from", "From, mm"},
                 {"to", "to, mm"},
                 {"branch", "Branch"},
                 {"name", "Name"},
                 {"mean_diameter", "Diameter, mm"},
                 {"lesion_distance", "To lesion, mm"}},
                {}};
    add_dependents(table.columns);
    const Names names(document);
    const Plan& plan = *assets.plan;
    for (const measure::Band& band : plan.bands)
        for (const measure::BandRow& found : band.rows) {
            std::vector<Cell> row{band.from_mm,           band.to_mm,       found.branch, names.of(found.branch),
                                  found.mean_diameter_mm, found.distance_mm};
            add(row, found.dependents);
            table.rows.push_back(std::move(row));
        }
    add_systems(table, document, 2, 4);
    add_unit(table, document.lengths());
    return table;
}

Table lesions_table(const Document& document, const Assets& assets) {
    Table table{"Lesions and the nearest vessels",
                {{"lesion", "Lesion"},
                 {"branch", "Branch"},
                 {"name", "Name"},
                 {"distance", "Distance, mm"},
                 {"overlap", "Overlap, mm"},
                 {"contact_branch", "Contact with"},
                 {"contact_angle", "Angle, \xC2\xB0"},
                 {"contact_length", "over, mm"},
                 {"contact_branches", "Branches touched"},
                 {"contact_length_together", "over, mm"}},
                {}};
    for (const char* name : {"contact_within", "lesion_x", "lesion_y", "lesion_z", "wall_x", "wall_y", "wall_z"})
        table.columns.push_back({name, name, 3, true});
    const Names names(document);
    for (const measure::LesionVessels& one : assets.plan->vessels) {
        const measure::NearestWall& nearest = one.nearest;
        if (nearest.branch == tree::kNoBranch) continue;
        const glm::dvec3 &from = nearest.on_lesion, &to = nearest.on_wall;
        table.rows.push_back({static_cast<int>(one.lesion + 1), nearest.branch, names.of(nearest.branch),
                              nearest.distance_mm, nearest.overlap_mm,
                              one.touched > 0 ? Cell(one.contact.branch) : Cell(""), one.contact.angle_deg,
                              one.contact.length_mm, one.touched, one.touched_mm, document.marks().planning.touch_mm,
                              from.x, from.y, from.z, to.x, to.y, to.z});
    }
    add_systems(table, document, 1, 1);
    add_unit(table, document.lengths());
    return table;
}

Table systems_table(const Document& document, const Assets& /*assets*/) {
    Table table{"Systems",
                {{"system", "System"},
                 {"colour", "Colour"},
                 {"branches", "Branches"},
                 {"visible_branches", "visible"},
                 {"length", "Length, mm"},
                 {"volume", "Volume, mm\xC2\xB3"}},
                {}};
    const Systems& systems = systems_of(*document.tree(), document.marks());
    const std::vector<SystemFacts> facts = system_facts(*document.tree(), *document.facts(), document.marks());
    for (std::size_t i = 0; i < facts.size(); ++i)
        table.rows.push_back({system_name(systems, static_cast<int>(i)), colour_text(systems[i].colour),
                              facts[i].branches, facts[i].visible, facts[i].length_mm, facts[i].volume_mm3});
    add_unit(table, document.lengths());
    return table;
}

Table measurements_table(const Document& document, const Assets& assets) {
    Table table{"Measurements",
                {{"measurement", "No."},
                 {"kind", "Kind"},
                 {"what", "What"},
                 {"value", "Value"},
                 {"unit", "Unit"},
                 {"details", "Details"}},
                {}};
    const auto& measurements = assets.measurements->found;
    for (std::size_t i = 0; i < measurements.size(); ++i) {
        const Result<Measured>& found = measurements[i];
        if (!found) {
            table.rows.push_back({static_cast<int>(i + 1), "", found.error().message(), "", "", ""});
            continue;
        }
        std::string details;
        for (const auto& [name, detail] : found->details)
            details += (details.empty() ? "" : "; ") + name + " " + detail;
        const Lengths lengths = document.lengths();
        const std::string unit = found->unit == lengths.unit() ? lengths.word() : found->unit;
        table.rows.push_back({static_cast<int>(i + 1), found->kind, found->what, found->value, unit, details});
    }
    return table;
}

Table contacts_table(const Document& document, const Assets& assets) {
    Table table{"Contacts",
                {{"contact", "No."},
                 {"branch", "Branch"},
                 {"name", "Name"},
                 {"other_branch", "Other branch"},
                 {"other_name", "Name"},
                 {"gap", "Gap, mm"},
                 {"narrowed", "Flattened, mm"},
                 {"other_narrowed", "the other, mm"},
                 {"x", "x, mm"},
                 {"y", "y, mm"},
                 {"z", "z, mm"}},
                {}};
    static const std::vector<tree::Contact> none;
    const bool found = assets.contacts.fits(document.marks().options);
    const Names names(document);
    for (const tree::Contact& contact : found ? *assets.contacts.list : none) {
        const auto& [first, second] = contact.sides;
        const glm::dvec3 at = contact.at();
        table.rows.push_back({static_cast<int>(table.rows.size() + 1), first.branch, names.of(first.branch),
                              second.branch, names.of(second.branch), contact.gap, first.narrowed, second.narrowed,
                              at.x, at.y, at.z});
    }
    add_unit(table, document.lengths());
    return table;
}

Table validation_table(const Document& document, const Assets& assets) {
    Table table{"Validation",
                {{"finding", "No."},
                 {"kind", "What"},
                 {"branch", "Branch"},
                 {"other_branch", "Other branch"},
                 {"value", "Value, mm"},
                 {"expected", "Expected, mm"},
                 {"text", "In words"},
                 {"x", "x, mm"},
                 {"y", "y, mm"},
                 {"z", "z, mm"}},
                {}};
    static const std::vector<Finding> none;
    const bool fits = assets.validation.fits(validation_of(document.tree(), document.marks()));
    const auto cell_of = [](const std::vector<int>& branches, std::size_t index) {
        return index < branches.size() ? Cell(branches[index]) : Cell("");
    };
    for (const Finding& finding : fits ? *assets.validation.findings : none)
        table.rows.push_back({static_cast<int>(table.rows.size() + 1), std::string(name_of(finding.kind)),
                              cell_of(finding.branches, 0), cell_of(finding.branches, 1), finding.value_mm,
                              finding.expected_mm > 0.0 ? Cell(finding.expected_mm) : Cell(""),
                              text_of(finding, document.lengths()), finding.at.x, finding.at.y, finding.at.z});
    add_unit(table, document.lengths());
    return table;
}

std::string csv_field(std::string_view text) {
    const bool formula = io::begins_formula(text);
    if (!formula && text.find_first_of(",;\t\"\r\n") == std::string_view::npos) return std::string(text);
    std::string field = formula ? "\"'" : "\"";
    for (const char c : text) {
        if (c == '"') field += '"';
        field += c;
    }
    return field + '"';
}

std::string csv_of(const Table& table) {
    std::string text;
    for (const Column& column : table.columns)
        text.append(&column == &table.columns.front() ? "" : ",").append(csv_field(column.name));
    text += "\r\n";
    for (const std::vector<Cell>& row : table.rows) {
        for (const Cell& cell : row) {
            if (&cell != &row.front()) text += ',';
            if (!cell.number) {
                text += csv_field(cell.text);
            } else if (std::isfinite(*cell.number)) {
                char number[32];
                const auto done =
                    std::to_chars(number, number + sizeof number, *cell.number, std::chars_format::general, 9);
                text.append(number, done.ptr);
            }
        }
        text += "\r\n";
    }
    return text;
}

std::string csv_lines(const Table& table) {
    std::string text = csv_of(table);
    std::erase(text, '\r');
    return text;
}

} // namespace ramus::app
