#include "app/assets/organ.h"

#include "app/assets/assets.h"
#include "app/assets/operation.h"
#include "app/assets/territories.h"
#include "app/session/systems.h"
#include "core/io/length_unit.h"
#include "core/io/volumes/volume_file.h"
#include "core/io/volumes/volume_unit.h"
#include "core/organ/roles.h"

#include <algorithm>
#include <new>

namespace ramus::app {

namespace {

Result<std::shared_ptr<const OrganMask>> read_mask(const OrganSource& source, Job& job) {
    try {
        const auto unit = io::length_unit(source.units);
        RAMUS_TRY(volume, io::read_volume(source.file, {0.0, unit}, job));
        auto organ = organ::organ_of(volume, {source.labels, {}}, JobRange(job, 0.9F, 1.0F));
        if (!organ) {
            if (organ.error().where.empty()) organ.error().where = source.file;
            return tl::unexpected(organ.error());
        }
        std::vector<std::size_t> parts = organ::part_sizes(*organ);
        return std::make_shared<const OrganMask>(
            OrganMask{std::move(*organ), io::claims_of(volume, unit),
                      volume.suspicions.empty() ? std::string() : volume.suspicions.front(), std::move(parts)});
    } catch (const std::bad_alloc&) {
        return fail("there is not enough memory for it", source.file, "give a coarser mask");
    }
}

} // namespace

Loaded<OrganMask> read_organ(const OrganSource& source, const Loaded<OrganMask>* before, Job& job) {
    auto loaded = read_if_written(source.file, before, "the organ", [&] { return read_mask(source, job); });
    if (job.cancelled()) loaded.value = fail("cancelled");
    return loaded;
}

std::vector<organ::Role> roles_of(const tree::VesselTree& tree, const Marks& marks) {
    std::vector<organ::Role> roles = organ::roles_by_name(systems_of(tree, marks));
    return marks.organ.roles.size() == roles.size() ? marks.organ.roles : roles;
}

Result<OrganSupply> supply_of(const OrganSupply::Of& of, const JobRange& job) {
    RAMUS_TRY(systems, organ::supplies_by_system(of.mask->organ, *of.tree, {.rule = of.rule}, job));
    return OrganSupply{of, std::move(systems), organ::large_vessels(of.mask->organ, *of.tree, of.large_vessels_mm)};
}

std::vector<organ::SystemSupply> OrganSupply::with_roles(const std::vector<organ::Role>& roles) const {
    std::vector<organ::SystemSupply> found;
    for (std::size_t system = 0; system < systems.size(); ++system)
        found.push_back({roles[system], systems[system].branch, systems[system].at});
    return found;
}

std::optional<OrganSource> wanted_organ(const Marks& marks) {
    return marks.organ.any() ? std::optional(marks.organ.source) : std::nullopt;
}

std::optional<OrganSupply::Of> wanted_supply(const OrganAssets& assets, const Marks& marks,
                                             const std::shared_ptr<const tree::VesselTree>& tree) {
    if (!marks.organ.any() || !tree || assets.source != marks.organ.source || !assets.mask.value || !*assets.mask.value)
        return {};
    return OrganSupply::Of{tree, *assets.mask.value, marks.organ.rule, marks.organ.large_vessels_mm};
}

Result<void> complete_organ(Assets& assets, const Marks& marks, Job& job) {
    const JobRange range(job, 0.0F, 1.0F);
    OrganAssets& organ = assets.organ;
    if (const auto source = wanted_organ(marks); source && organ.source != *source)
        organ = {*source, read_organ(*source, nullptr, job)};
    if (marks.organ.any() && !organ.mask.value) return tl::unexpected(organ.mask.value.error());
    if (const auto of = wanted_supply(organ, marks, assets.tree); of && (!organ.supply || organ.supply->of != *of)) {
        RAMUS_TRY(supply, supply_of(*of, range));
        organ.supply = std::make_shared<const OrganSupply>(std::move(supply));
    }
    for (const ResectionMeshOf& of : wanted_meshes(organ, marks)) {
        const ResectionMesh& read =
            organ.meshes.insert_or_assign(of.file, read_resection_mesh(of, range)).first->second;
        if (!read.surface) return tl::unexpected(read.surface.error());
    }
    tidy_operations(assets, marks);
    for (const OperationWork& work : wanted_operations(assets, marks)) {
        RAMUS_TRY(operation, make_operation(work, range));
        put_operation(assets, work.plan, std::make_shared<const Operation>(std::move(operation)));
    }
    tidy_territories(organ, marks);
    for (const TerritoryWork& work : wanted_territories(assets, marks)) {
        RAMUS_TRY(territories, make_territories(work.of, range));
        put_territories(organ, work, std::make_shared<const OrganTerritories>(std::move(territories)));
    }
    return {};
}

} // namespace ramus::app
