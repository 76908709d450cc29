#include "app/actions/command_table.h"
#include "app/assets/assets.h"
#include "app/picture/colouring.h"
#include "app/reports/report_tables.h"
#include "app/session/branch_filter.h"
#include "app/session/quantity.h"
#include "core/io/trees/swc.h"
#include "tests/support/command_stage.h"

#include <doctest/doctest.h>
#include <set>

using namespace ramus;
using namespace ramus::app;

namespace {

std::shared_ptr<const tree::VesselTree> small_tree() {
    return std::make_shared<const tree::VesselTree>(*io::parse_tree(
        "# id type x y z radius parent (mm, RAS)\n1 0 0 0 0 2 -1\n2 0 0 0 9 1 1\n3 0 3 0 12 0.5 2\n4 0 -3 0 15 0.5 2\n",
        "small.swc"));
}

} // namespace

TEST_CASE("every quantity has a row with a unique name and a valid value") {
    const auto tree = small_tree();
    const TreeFacts facts = facts_of(*tree);
    std::set<std::string_view> keys, filters;
    for (const QuantityRow& row : quantities()) {
        CAPTURE(row.key);
        CHECK(row_of(row.quantity).key == row.key);
        CHECK(keys.insert(row.key).second);
        CHECK_FALSE(row.label.empty());
        CHECK((row.least == nullptr) == (row.largest == nullptr));
        CHECK(row.filter_names.empty() == row.filter_example.empty());
        CHECK((row.list.order > 0 || row.report.order > 0 || row.info.order > 0 || row.colours.order > 0 ||
               !row.filter_names.empty()));
        for (int id = 0; id < static_cast<int>(tree->branches.size()); ++id) {
            const double value = row.value(*tree, facts, id);
            CHECK(value >= 0.0);
            if (row.whole) CHECK(value == std::floor(value));
            if (row.least != nullptr) CHECK(row.least(facts, id) <= value);
            if (row.largest != nullptr) CHECK(row.largest(facts, id) >= value);
        }
        for (const std::string_view name : row.filter_names) CHECK(filters.insert(name).second);
    }
}

TEST_CASE("the filter, the list and the report show the same value of a quantity") {
    const auto tree = small_tree();
    Document document;
    Session session;
    session.marks.selection = {0, 1, 2};
    document.open(tree, session);
    const TreeFacts& facts = *document.facts();
    Assets assets;
    refresh(assets, document);
    const Table table = selection_table(document, assets);
    for (const QuantityRow& row : quantities()) {
        CAPTURE(row.key);
        // The filter: exactly the branches that have the value of the first.
        for (const std::string_view name : row.filter_names) {
            CHECK(filtered_quantity(name) == row.quantity);
            const double wanted = row.value(*tree, facts, 0);
            const auto filter = parse_branch_filter(std::string(name) + "=" + std::to_string(wanted));
            REQUIRE(filter);
            for (const int id : branches_passing(*filter, *tree, facts, document.marks()))
                CHECK(row.value(*tree, facts, id) == doctest::Approx(wanted).epsilon(1e-3));
            CHECK(parse_branch_filter("nonsense>1").error().hint.find(row.filter_names.front()) != std::string::npos);
        }
        if (row.report.order > 0) {
            const std::string name = (row.least != nullptr ? "mean_" : "") + std::string(row.report.name);
            const auto column = std::ranges::find(table.columns, name, &Column::name);
            REQUIRE(column != table.columns.end());
            for (const auto& cells : table.rows) {
                const int id = static_cast<int>(*cells.front().number);
                CHECK(cells[static_cast<std::size_t>(column - table.columns.begin())].number ==
                      row.value(*tree, facts, id));
            }
        }
    }
    for (const auto& cells : table.rows) CHECK(cells.size() == table.columns.size());
}

TEST_CASE("every colouring has a key and a menu entry, and colours a tree") {
    const auto tree = small_tree();
    const TreeFacts facts = facts_of(*tree);
    test::CommandStage stage(*tree);
    std::set<std::string_view> keys;
    for (const ColouringRow& row : colourings()) {
        CAPTURE(row.key);
        CHECK(keys.insert(row.key).second);
        CHECK(colouring_named(row.key) == row.by);
        CHECK(name_of(row.by) == row.key);
        CHECK_FALSE(row.label.empty());
        CHECK(row.help.ends_with('.'));
        stage.good("colour-by " + std::string(row.key));
        CHECK(stage.marks().colour_by == row.by);
        const auto entry = std::ranges::find_if(command_table(), [&](const Command& command) {
            return command.name == "colour-by" && command.preset == std::vector<std::string>{std::string(row.key)};
        });
        REQUIRE(entry != command_table().end());
        CHECK(entry->checked(stage.document));
        CHECK(find_command("colour-by")->help.find(row.key) != std::string::npos);
        if (row.by.kind != ColourBy::kQuantity) continue;
        const Colouring colouring = colouring_of(*tree, facts, stage.marks(), nullptr);
        CHECK(colouring.branches.size() == tree->branches.size());
        CHECK(colouring.legend.title.starts_with(row_of(row.by.quantity).label));
    }
    CHECK_FALSE(colouring_named("nonsense"));
    for (const QuantityRow* row : rows_with(&QuantityRow::colours)) CHECK(colouring_named(row->key) == row->quantity);
}

TEST_CASE("a quantity that is a length colours each branch between the least and the largest") {
    const auto tree = small_tree();
    Marks marks;
    marks.colour_by = Quantity::kLength;
    const Colouring colouring = colouring_of(*tree, facts_of(*tree), marks, nullptr);
    REQUIRE(colouring.branches.size() == 3);
    CHECK(colouring.branches[0] == colour_at(marks.colour_map, 1.0)); // 9 mm; the others are 4.2 and 6.7
    CHECK(colouring.branches[1] == colour_at(marks.colour_map, 0.0));
    CHECK(colouring.legend.title == "Length (mm)");
    CHECK(colouring.scale.value == render::ColourScale::Value::kNone);
}
