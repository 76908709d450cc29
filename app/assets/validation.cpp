#include "app/assets/validation.h"

#include "core/validate/worst_radii.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ramus::app {

namespace {

using Kind = Finding::Kind;

constexpr double kLeastError = 0.02;    // relative error of a radius; smaller ones are invisible
constexpr std::size_t kMostErrors = 10; // branches

double vessel_radius(const validate::Validation& found, const glm::dvec3& at) {
    const validate::RadiusPlace* place = validate::nearest_place(found, at);
    return place != nullptr ? place->input_mm : 0.0;
}

} // namespace

std::vector<Finding> findings_of(const validate::Validation& found) {
    std::vector<Finding> list;
    for (const validate::Lost& one : found.lost)
        list.push_back({Kind::kLost, {one.branch}, one.at, vessel_radius(found, one.at), one.length_mm});
    for (const validate::FalsePart& one : found.false_parts)
        list.push_back({Kind::kFalse, {}, one.at, 0.5 * one.length_mm, one.length_mm});
    for (const validate::Merged& one : found.merged) {
        std::vector<int> branches(one.branches.begin(), one.branches.end());
        branches.erase(std::unique(branches.begin(), branches.end()), branches.end());
        list.push_back({Kind::kMerged, branches, one.at, vessel_radius(found, one.at), one.gap_mm});
    }
    for (const validate::Constriction& one : found.constrictions)
        list.push_back(
            {Kind::kConstriction, {one.branch}, one.at, one.expected_radius_mm, one.radius_mm, one.expected_radius_mm});
    for (const validate::Width& one : found.widths)
        list.push_back(
            {Kind::kWidth, {one.branch}, one.at, one.expected_radius_mm, one.radius_mm, one.expected_radius_mm});
    for (const validate::Offset& one : found.positions)
        list.push_back({Kind::kPosition, {one.branch}, one.at, vessel_radius(found, one.at), one.offset_mm});
    for (const validate::BranchError& branch : validate::worst_branches(found, kMostErrors)) {
        if (branch.error < kLeastError) break;
        const validate::RadiusPlace& place = found.radii[branch.worst];
        list.push_back({Kind::kRadius, {place.branch}, place.at, place.input_mm, place.surface_mm, place.input_mm});
    }
    return list;
}

std::string_view name_of(Finding::Kind kind) {
    constexpr std::array<std::string_view, kFindingKinds> kNames{"lost",  "false",    "merged", "constriction",
                                                                 "width", "position", "radius"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string text_of(const Finding& finding, const Lengths& lengths) {
    switch (finding.kind) {
    case Kind::kLost:
    case Kind::kFalse:
        return lengths.text(finding.value_mm) + " long";
    case Kind::kMerged:
        return (finding.value_mm < 0.0 ? "overlap " : "gap ") + lengths.text(std::abs(finding.value_mm));
    case Kind::kPosition:
        return lengths.text(finding.value_mm) + " off";
    case Kind::kConstriction:
    case Kind::kWidth:
    case Kind::kRadius:
        return digits(finding.value_mm) + " instead of " + lengths.text(finding.expected_mm);
    }
    return {};
}

ValidationOf validation_of(std::shared_ptr<const tree::VesselTree> tree, const Marks& marks) {
    ValidationOf of{std::move(tree), marks.options, marks.comparison.mask, {}, {}};
    if (!of.mask.empty()) of.mask_units = marks.comparison.mask_units, of.labels = marks.comparison.labels;
    return of;
}

} // namespace ramus::app
