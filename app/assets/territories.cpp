#include "app/assets/territories.h"

#include "app/assets/assets.h"
#include "app/session/systems.h"
#include "core/organ/label_surfaces.h"
#include "core/tree/dependency.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace ramus::app {

namespace {

constexpr std::string_view kSelected = "selected";

// The first system of `named`, or else the first that supplies; the session's choice goes before both.
int dividing_system(const OrganTerritories::Of& of, const tree::VesselTree& tree, const Marks& marks) {
    const OrganChoice& choice = marks.organ;
    if (choice.system >= 0 && choice.system < static_cast<int>(tree.systems.size())) return choice.system;
    if (!of.named.empty()) return tree.branches[static_cast<std::size_t>(of.named.front().first)].system;
    const std::vector<organ::Role> roles = roles_of(tree, marks);
    const auto supplies = std::ranges::find(roles, organ::Role::kSupplies);
    return supplies == roles.end() ? 0 : static_cast<int>(supplies - roles.begin());
}

// By system, 1: that whose branches divide the organ.
std::vector<std::uint8_t> only_system(const OrganTerritories::Of& of) {
    std::vector<std::uint8_t> systems(std::max<std::size_t>(of.supply->of.tree->systems.size(), 1), 0);
    systems[static_cast<std::size_t>(of.system)] = 1;
    return systems;
}

organ::Grouping grouping_of(const OrganTerritories::Of& of) {
    const tree::VesselTree& tree = *of.supply->of.tree;
    if (of.kind == TerritoriesOf::kSystems) return organ::by_system(tree);
    const tree::Dependency dependency(tree);
    organ::Grouping grouping = of.kind == TerritoriesOf::kGeneration ? organ::by_generation(tree, of.generation)
                               : of.kind == TerritoriesOf::kCuts     ? organ::by_cuts(tree, dependency, of.cuts)
                                                                     : organ::by_names(tree, dependency, of.named);
    organ::restrict_to(grouping, tree, only_system(of));
    return grouping;
}

// By voxel: its RemnantPart.
std::vector<int> remnant_labels(const Operation& operation) {
    const OrganSupply& supply = *operation.of.supply;
    const std::vector<measure::LostSpan> spans =
        measure::lost_spans(*supply.of.tree, organ::cuts_of(operation.vessels));
    std::vector<int> labels(supply.of.mask->organ.count(), 0);
    const std::vector<organ::SystemSupply> systems = supply.with_roles(operation.of.roles);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, labels.size()), [&](const auto& range) {
        for (std::size_t voxel = range.begin(); voxel < range.end(); ++voxel) {
            bool supplied = true, drained = true;
            for (const organ::SystemSupply& system : systems)
                if (!spans.empty() && organ::is_lost(system, spans, voxel))
                    (system.role == organ::Role::kSupplies ? supplied : drained) = false;
            RemnantPart part = supplied ? (drained ? RemnantPart::kKept : RemnantPart::kNotDrained)
                                        : (drained ? RemnantPart::kNotSupplied : RemnantPart::kLost);
            if (!operation.kept.empty() && operation.kept[voxel] < 0.5F) part = RemnantPart::kRemoved;
            labels[voxel] = static_cast<int>(part);
        }
    });
    return labels;
}

struct Labels {
    std::vector<int> of_voxels;
    std::vector<std::string> names;
};

Result<Labels> labels_of(const OrganTerritories::Of& of, const JobRange& job) {
    const OrganMask& mask = *of.supply->of.mask;
    if (of.kind == TerritoriesOf::kOrgan) return Labels{std::vector<int>(mask.organ.count(), 0), {"organ"}};
    if (of.kind == TerritoriesOf::kRemnant)
        return Labels{remnant_labels(*of.operation), {kRemnantParts.begin(), kRemnantParts.end()}};
    const organ::Grouping grouping = grouping_of(of);
    if (auto few = organ::check_count(grouping); !few) return tl::unexpected(few.error());
    RAMUS_TRY(supply, organ::supply_of(mask.organ, *of.supply->of.tree, {.rule = of.supply->of.rule},
                                       organ::trunk_of(grouping), job));
    return Labels{organ::voxel_groups(supply, grouping), grouping.names};
}

// From the middle of what stays to that of what is removed, `apart_mm` long.
glm::vec3 pull_of(const organ::Organ& organ, const std::vector<int>& labels, double apart_mm) {
    std::array<glm::dvec3, 2> sums{};
    std::array<double, 2> counts{};
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t number) {
        const std::size_t removed = labels[number] == static_cast<int>(RemnantPart::kRemoved) ? 1 : 0;
        sums[removed] += organ.centre_mm(voxel);
        counts[removed] += 1.0;
    });
    if (counts[0] == 0.0 || counts[1] == 0.0) return glm::vec3(0.0F);
    const glm::dvec3 way = sums[1] / counts[1] - sums[0] / counts[0];
    const double length = glm::length(way);
    return length > 0.0 ? glm::vec3(apart_mm / length * way) : glm::vec3(0.0F);
}

} // namespace

double OrganTerritories::volume_mm3(const Part& part) const {
    return 1000.0 * of.supply->of.mask->organ.voxel_ml() * static_cast<double>(part.voxels);
}

double OrganTerritories::percent(const Part& part) const {
    return 100.0 * static_cast<double>(part.voxels) / static_cast<double>(of.supply->of.mask->organ.count());
}

namespace {

// None: no territories are shown, or the organ is not divided yet. `plan`: of kRemnant.
std::optional<OrganTerritories::Of> shown_territories(const Assets& assets, const Marks& marks, std::size_t plan) {
    const auto supply = wanted_supply(assets.organ, marks, assets.tree);
    const OrganChoice& choice = marks.organ;
    if (!supply || choice.territories == TerritoriesOf::kNothing || !assets.organ.supply ||
        assets.organ.supply->of != *supply)
        return {};
    const tree::VesselTree& tree = *assets.tree;
    OrganTerritories::Of of{assets.organ.supply, choice.territories, 0, 0, {}, {}, {}, 0.0};
    switch (of.kind) {
    case TerritoriesOf::kGeneration:
        of.generation = choice.generation;
        break;
    case TerritoriesOf::kNames:
        of.named.assign(marks.names.begin(), marks.names.end());
        break;
    case TerritoriesOf::kSelection:
        for (const int branch : marks.selection) of.named.emplace_back(branch, kSelected);
        break;
    case TerritoriesOf::kRemnant:
        of.operation = operation_of(assets, marks, plan);
        of.apart_mm = choice.apart_mm;
        if (!of.operation) return {};
        break;
    case TerritoriesOf::kCuts:
        of.cuts = marks.cuts;
        if (!of.cuts.empty()) of.system = tree.branches[static_cast<std::size_t>(of.cuts.front().first)].system;
        break;
    case TerritoriesOf::kNothing:
    case TerritoriesOf::kOrgan:
    case TerritoriesOf::kSystems:
        break;
    }
    const bool by_branches = of.kind == TerritoriesOf::kGeneration || of.kind == TerritoriesOf::kNames ||
                             of.kind == TerritoriesOf::kSelection;
    if (by_branches) of.system = dividing_system(of, tree, marks);
    std::ranges::stable_sort(of.named, {}, &std::pair<int, std::string>::second); // S1 to S8, whatever their branches
    return of;
}

bool compares_remnants(const Marks& marks) {
    return marks.plans.compared && marks.organ.territories == TerritoriesOf::kRemnant;
}

} // namespace

std::vector<TerritoryWork> wanted_territories(const Assets& assets, const Marks& marks) {
    std::vector<TerritoryWork> wanted;
    const auto want = [&](std::size_t plan, const std::shared_ptr<const OrganTerritories>& made, bool compared) {
        auto of = shown_territories(assets, marks, plan);
        if (of && (!made || made->of != *of)) wanted.push_back({std::move(*of), compared});
    };
    want(marks.plans.place, assets.organ.territories, false);
    if (compares_remnants(marks)) want(*marks.plans.compared, assets.organ.compared, true);
    return wanted;
}

void put_territories(OrganAssets& assets, const TerritoryWork& work, std::shared_ptr<const OrganTerritories> made) {
    (work.compared ? assets.compared : assets.territories) = std::move(made);
}

void tidy_territories(OrganAssets& assets, const Marks& marks) {
    if (marks.organ.territories == TerritoriesOf::kNothing) assets.territories.reset();
    if (!compares_remnants(marks)) assets.compared.reset();
}

namespace {

// None where it was not measured.
std::optional<organ::Certainty> expected_of(const OrganTerritories::Of& of, std::size_t parts) {
    if (of.supply->of.rule != organ::Rule::kTips || of.kind == TerritoriesOf::kOrgan ||
        of.kind == TerritoriesOf::kSystems || of.kind == TerritoriesOf::kRemnant)
        return {};
    const OrganSupply::Of& supply = of.supply->of;
    return organ::expected_certainty(organ::visible_branches(supply.mask->organ, *supply.tree, only_system(of)), parts);
}

} // namespace

Result<OrganTerritories> make_territories(const OrganTerritories::Of& of, const JobRange& job) {
    const organ::Organ& organ = of.supply->of.mask->organ;
    RAMUS_TRY(labels, labels_of(of, job.part(0.0F, 0.3F)));
    RAMUS_TRY(surfaces, organ::label_surfaces(organ, labels.of_voxels, job.part(0.3F, 0.9F)));
    std::vector<std::size_t> voxels(labels.names.size(), 0);
    for (const int label : labels.of_voxels)
        if (label >= 0) ++voxels[static_cast<std::size_t>(label)];
    OrganTerritories made{.of = of, .parts = {}};
    const glm::vec3 away = of.apart_mm > 0.0 ? pull_of(organ, labels.of_voxels, of.apart_mm) : glm::vec3(0.0F);
    std::vector<std::uint16_t> numbers(labels.names.size(), 0); // by label: the index of its part + 1
    const bool has_rest =
        of.kind == TerritoriesOf::kNames || of.kind == TerritoriesOf::kSelection || of.kind == TerritoriesOf::kCuts;
    for (std::size_t label = 0; label < labels.names.size(); ++label) {
        if (voxels[label] == 0) continue;
        auto mesh = std::make_shared<mesh::TriangleMesh>(surface_of(surfaces, static_cast<int>(label)));
        if (of.apart_mm > 0.0 && label == static_cast<std::size_t>(RemnantPart::kRemoved))
            for (glm::vec3& position : mesh->positions) position += away;
        OrganTerritories::Part part{labels.names[label],
                                    of.kind == TerritoriesOf::kSystems ? static_cast<int>(label) : -1,
                                    has_rest && label + 1 == labels.names.size(),
                                    voxels[label],
                                    mesh,
                                    preview_of(*mesh)};
        made.parts.push_back(std::move(part));
        numbers[label] = static_cast<std::uint16_t>(made.parts.size());
    }
    made.part_of.reserve(labels.of_voxels.size());
    for (const int label : labels.of_voxels)
        made.part_of.push_back(label < 0 ? 0 : numbers[static_cast<std::size_t>(label)]);
    made.expected = expected_of(of, made.parts.size());
    return made;
}

} // namespace ramus::app
