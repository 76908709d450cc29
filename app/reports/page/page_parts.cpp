#include "app/reports/page/page_parts.h"

#include "app/session/systems.h"

#include <algorithm>

namespace ramus::app {

namespace {

// "Lesion 2".
std::string called(std::string_view noun, std::size_t index) {
    std::string name = std::string(noun) + " " + std::to_string(index + 1);
    name[0] = static_cast<char>(name[0] - 'a' + 'A');
    return name;
}

void forget_names(Marks& marks, const tree::VesselTree& tree) {
    marks.names.clear();
    marks.subtree_names.clear();
    Systems systems = systems_of(tree, marks);
    for (std::size_t i = 0; i < systems.size(); ++i) {
        const glm::vec3 colour = shown_colour(systems, static_cast<int>(i));
        systems[i] = {called("system", i), bytes_of(colour)};
    }
    set_systems(marks, std::move(systems), tree);
    for_each_object_list(marks, []<class T>(std::vector<T>& list) {
        for (std::size_t i = 0; i < list.size(); ++i) list[i].name = called(T::kNoun, i);
    });
    for (std::size_t plan = 0; plan < marks.plans.count(); ++plan) name_of_plan(marks, plan) = called("plan", plan);
    for (std::size_t i = 0; i < marks.views.size(); ++i) marks.views[i].name = called("view", i);
    for (OperationPlan& plan : marks.plans.others)
        for (std::size_t i = 0; i < plan.resections.size(); ++i) plan.resections[i].name = called(Resection::kNoun, i);
}

void forget_lesions(Marks& marks) {
    marks.lesions.clear();
    std::erase_if(marks.measurements, names_lesion);
    const auto around_lesion = [](const Resection& one) { return one.kind == Resection::Kind::kLesion; };
    std::erase_if(marks.resections, around_lesion);
    for (OperationPlan& plan : marks.plans.others) std::erase_if(plan.resections, around_lesion);
    if (marks.colour_by == ColourBy::kLesion) marks.colour_by = {};
}

void forget_plans(Marks& marks) {
    marks.cuts.clear();
    marks.resections.clear();
    marks.plans = {};
    marks.organ = {};
}

} // namespace

std::optional<PagePart> page_part_named(std::string_view name) {
    const auto* const found = std::ranges::find(kPageParts, name, &PagePartRow::name);
    return found == kPageParts.end() ? std::nullopt : std::optional(found->part);
}

bool has_part(std::span<const PagePart> parts, PagePart part) { return std::ranges::find(parts, part) != parts.end(); }

Marks marks_without(Marks marks, std::span<const PagePart> left_out, const tree::VesselTree& tree) {
    const auto without = [&](PagePart part) { return has_part(left_out, part); };
    if (without(PagePart::kMeasurements)) marks.measurements.clear(), marks.pins.clear();
    if (without(PagePart::kLesions)) forget_lesions(marks);
    if (without(PagePart::kPlans)) forget_plans(marks);
    if (without(PagePart::kViews)) marks.views.clear();
    if (without(PagePart::kContext)) marks.context.clear();
    if (without(PagePart::kNames)) forget_names(marks, tree);
    return marks;
}

} // namespace ramus::app
