// The parts of a case that a page can leave out, by name (`ramus page --without`).
#pragma once

#include "app/session/session.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace ramus::app {

enum class PagePart : std::uint8_t { kNames, kMeasurements, kLesions, kPlans, kTables, kViews, kContext };
struct PagePartRow {
    PagePart part;
    std::string_view name;
    const char* help; // what the page then lacks
};
inline constexpr std::array<PagePartRow, 7> kPageParts{
    {{PagePart::kNames, "names", "names that people and files gave, and the name of the file"},
     {PagePart::kMeasurements, "measurements", "measurements and pins"},
     {PagePart::kLesions, "lesions", "lesions with their margins, and what is measured to them"},
     {PagePart::kPlans, "plans", "cuts, resections, plans and territories"},
     {PagePart::kTables, "tables", "the tables of the report"},
     {PagePart::kViews, "views", "saved views, and the pictures of the report"},
     {PagePart::kContext, "context", "surfaces next to the tree"}}};
[[nodiscard]] std::optional<PagePart> page_part_named(std::string_view name);
[[nodiscard]] bool has_part(std::span<const PagePart> parts, PagePart part);

// The marks that a page without these parts is made of: nothing of it can then be in a table, a picture or a number.
// Without names, objects are called after their kind and number.
[[nodiscard]] Marks marks_without(Marks marks, std::span<const PagePart> left_out, const tree::VesselTree& tree);

} // namespace ramus::app
