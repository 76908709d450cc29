#include "app/assets/operation.h"

#include "app/assets/assets.h"
#include "core/base/bounds.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/orientation.h"
#include "core/mesh/sphere_mesh.h"
#include "core/mesh/value_bands.h"
#include "core/organ/resect/removal.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::app {

namespace {

// The resection without what it looks like.
Resection shape_of(Resection resection) {
    const Resection usual;
    resection.id = usual.id;
    resection.name = usual.name;
    resection.visible = usual.visible;
    resection.colour = usual.colour;
    resection.opacity = usual.opacity;
    return resection;
}

// A lesion of a mask as the file has it: the boxes of its voxels, from which the command line measures, too.
std::shared_ptr<const organ::VoxelSolid> solid_of(const PlannedLesion& lesion) {
    if (lesion.mesh && lesion.mesh->voxels) return lesion.mesh->voxels;
    const auto& [x, y, z, radius] = lesion.sphere;
    return std::make_shared<const organ::VoxelSolid>(lesion.mesh ? mesh::TriangleMesh(lesion.mesh->mesh)
                                                                 : mesh::sphere_mesh({x, y, z}, radius));
}

std::vector<organ::VoxelLesion> solids_of(const std::vector<PlannedLesion>& lesions) {
    std::vector<organ::VoxelLesion> solids;
    for (const PlannedLesion& lesion : lesions) solids.push_back({lesion.name, solid_of(lesion)});
    return solids;
}

// The resections of a plan as functions over space. Those whose lesion or whose cuts take nothing away are left out;
// `numbers` receives the index of each among the plan's.
std::vector<organ::Resection> functions_of(const Operation::Of& of, const std::vector<organ::VoxelLesion>& solids,
                                           const std::vector<organ::SystemSupply>& systems,
                                           std::vector<std::size_t>& numbers) {
    std::vector<organ::Resection> functions;
    const auto add = [&](std::size_t n, organ::Resection function) {
        functions.push_back(std::move(function));
        numbers.push_back(n);
    };
    for (std::size_t n = 0; n < of.resections.size(); ++n) {
        const Resection& one = of.resections[n];
        switch (one.kind) {
        case Resection::Kind::kPlane:
            add(n, organ::HalfSpace{one.point, one.normal});
            break;
        case Resection::Kind::kSheet:
            add(n, one.sheet);
            break;
        case Resection::Kind::kSurface:
            if (const auto mesh = of.meshes.find(one.file); mesh != of.meshes.end())
                add(n, organ::SurfaceCut{mesh->second, one.other_side});
            break;
        case Resection::Kind::kCuts: {
            const auto lost = organ::lost_voxels(systems, measure::lost_spans(*of.supply->of.tree, of.cuts));
            if (auto solid = organ::solid_of(of.supply->of.mask->organ, lost))
                add(n, organ::Around{std::move(solid), one.margin_mm,
                                     std::make_shared<const std::vector<std::uint8_t>>(
                                         organ::spared_by(*of.supply->of.tree, of.cuts))});
            break;
        }
        case Resection::Kind::kLesion: {
            const auto lesion = std::ranges::find(of.lesions, one.lesion, &PlannedLesion::id);
            if (lesion != of.lesions.end())
                add(n,
                    organ::Around{solids[static_cast<std::size_t>(lesion - of.lesions.begin())].solid, one.margin_mm});
            break;
        }
        }
    }
    return functions;
}

// The part of a surface that one resection leaves.
organ::ResectionSurface part_of(const organ::ResectionSurface& surface, std::size_t resection,
                                std::vector<std::uint32_t>& vertices) {
    organ::ResectionSurface part;
    std::vector<std::uint32_t> numbers(surface.places.size(), UINT32_MAX);
    for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
        if (surface.resections[n] != resection) continue;
        glm::uvec3 triangle;
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = surface.triangles[n][corner];
            if (numbers[vertex] == UINT32_MAX) {
                numbers[vertex] = static_cast<std::uint32_t>(vertices.size());
                vertices.push_back(vertex);
                part.places.push_back(surface.places[vertex]);
            }
            triangle[corner] = numbers[vertex];
        }
        part.triangles.push_back(triangle);
    }
    return part;
}

void put_surfaces(Operation& operation, const organ::ResectionSurface& surface, const std::vector<std::size_t>& numbers,
                  const std::vector<organ::VoxelLesion>& solids) {
    const std::vector<float> distances =
        solids.empty() ? std::vector<float>() : organ::lesion_distances(surface, solids);
    operation.surfaces.resize(operation.of.resections.size());
    for (std::size_t n = 0; n < numbers.size(); ++n) {
        std::vector<std::uint32_t> vertices;
        const organ::ResectionSurface part = part_of(surface, n, vertices);
        if (part.triangles.empty()) continue;
        Operation::Parts& parts = operation.surfaces[numbers[n]];
        mesh::TriangleMesh mesh = organ::mesh_of(part);
        if (distances.empty()) {
            parts.push_back(std::make_shared<const mesh::TriangleMesh>(std::move(mesh)));
            continue;
        }
        std::vector<float> of_vertices;
        for (const std::uint32_t vertex : vertices) of_vertices.push_back(distances[vertex]);
        for (mesh::TriangleMesh& band : mesh::value_bands(mesh, of_vertices, operation.of.bands_mm))
            parts.push_back(std::make_shared<const mesh::TriangleMesh>(std::move(band)));
    }
}

organ::PartRemnant in_parts(const organ::Remnant& found) {
    return {static_cast<double>(found.supplied),
            static_cast<double>(found.drained),
            static_cast<double>(found.both),
            {found.lost.begin(), found.lost.end()}};
}

} // namespace

std::vector<PlannedLesion> planned_lesions(const Assets& assets, const Marks& marks) {
    std::vector<PlannedLesion> lesions;
    int number = 0;
    for (const Lesion& lesion : marks.lesions) {
        ++number;
        PlannedLesion planned{lesion.id, lesion.name.empty() ? "Lesion " + std::to_string(number) : lesion.name,
                              lesion.sphere, assets.lesion_mesh(lesion)};
        if (!lesion.is_mesh() || planned.mesh) lesions.push_back(std::move(planned));
    }
    return lesions;
}

bool Operation::has(organ::Role role) const {
    for (std::size_t system = 0; system < of.roles.size(); ++system)
        if (of.roles[system] == role && of.supply->reaches(system)) return true;
    return false;
}

namespace {

// What all plans of a session have in common; none: something that comes first is missing.
std::optional<Operation::Of> common_part(const Assets& assets, const Marks& marks) {
    const auto supply = wanted_supply(assets.organ, marks, assets.tree);
    if (!supply || !assets.organ.supply || assets.organ.supply->of != *supply) return {};
    return Operation::Of{assets.organ.supply,
                         roles_of(*assets.tree, marks),
                         {},
                         {},
                         planned_lesions(assets, marks),
                         marks.planning.bands_mm,
                         {}};
}

// With what is of one plan; none: a mesh of it is not read.
std::optional<Operation::Of> with_plan(Operation::Of of, const Assets& assets, const OperationPlan& plan) {
    of.cuts = plan.cuts;
    for (const Resection& resection : plan.resections) {
        of.resections.push_back(shape_of(resection));
        if (resection.kind != Resection::Kind::kSurface) continue;
        const auto mesh = assets.organ.meshes.find(resection.file);
        if (mesh == assets.organ.meshes.end()) return {};
        if (mesh->second.surface) of.meshes.emplace(resection.file, *mesh->second.surface);
    }
    return of;
}

} // namespace

std::shared_ptr<const Operation> operation_of(const Assets& assets, const Marks& marks, std::size_t plan,
                                              OperationOf which) {
    if (plan >= assets.organ.operations.size()) return {};
    const auto& made = assets.organ.operations[plan];
    if (!made || which == OperationOf::kLast) return made;
    auto common = common_part(assets, marks);
    if (!common) return {};
    return with_plan(std::move(*common), assets, all_plans(marks)[plan]) == made->of ? made : nullptr;
}

std::vector<OperationWork> wanted_operations(const Assets& assets, const Marks& marks) {
    std::vector<OperationWork> wanted;
    const auto common = common_part(assets, marks);
    if (!common) return wanted;
    const std::vector<OperationPlan> plans = all_plans(marks);
    const auto& made = assets.organ.operations;
    for (std::size_t plan = 0; plan < plans.size(); ++plan) {
        auto of = with_plan(*common, assets, plans[plan]);
        if (!of || (plan < made.size() && made[plan] && made[plan]->of == *of)) continue;
        std::vector<int> ids;
        for (const Resection& resection : plans[plan].resections) ids.push_back(resection.id);
        wanted.insert(plan == marks.plans.place ? wanted.begin() : wanted.end(),
                      {plan, std::move(*of), std::move(ids)});
    }
    return wanted;
}

void put_operation(Assets& assets, std::size_t plan, std::shared_ptr<const Operation> made) {
    auto& operations = assets.organ.operations;
    operations.resize(std::max(operations.size(), plan + 1));
    operations[plan] = std::move(made);
}

const Operation::Parts* surface_of(const Assets& assets, const Resection& resection) {
    const OrganAssets& organ = assets.organ;
    if (organ.plan >= organ.operations.size() || !organ.operations[organ.plan]) return nullptr;
    const Operation& operation = *organ.operations[organ.plan];
    auto index = static_cast<std::size_t>(std::ranges::find(operation.ids, resection.id) - operation.ids.begin());
    if (index == operation.ids.size()) { // made while the plan waited
        const auto& shapes = operation.of.resections;
        index = static_cast<std::size_t>(std::ranges::find(shapes, shape_of(resection)) - shapes.begin());
    }
    return index < operation.surfaces.size() ? &operation.surfaces[index] : nullptr;
}

void tidy_operations(Assets& assets, const Marks& marks) {
    const auto before = assets.organ.operations;
    for (const OperationWork& work : wanted_operations(assets, marks))
        for (const auto& made : before)
            if (made && made->of == work.of) put_operation(assets, work.plan, made);
    assets.organ.operations.resize(marks.organ.any() ? marks.plans.count() : 0);
    assets.organ.plan = marks.plans.place;
}

Result<Operation> make_operation(const OperationWork& work, const JobRange& job) {
    const Operation::Of& of = work.of;
    const organ::Organ& organ = of.supply->of.mask->organ;
    Operation operation;
    operation.of = of;
    operation.ids = work.ids;
    const std::vector<std::uint8_t> functional = functional_voxels(*of.supply, of.lesions);
    operation.functional = static_cast<double>(std::ranges::count(functional, 1));
    const std::vector<organ::SystemSupply> systems = of.supply->with_roles(of.roles);
    const tree::VesselTree& tree = *of.supply->of.tree;
    for (const measure::Cut& cut : of.cuts) {
        operation.vessels.push_back(organ::vessel_at(tree, cut));
        operation.vessels.back().resection = of.resections.size();
    }
    organ::sort_vessels(operation.vessels);
    if (of.resections.empty()) {
        operation.remnant = in_parts(organ::remnant_of(systems, measure::lost_spans(tree, of.cuts), functional));
        return operation;
    }
    const std::vector<organ::VoxelLesion> solids = solids_of(of.lesions);
    std::vector<std::size_t> numbers;
    const std::vector<organ::Resection> functions = functions_of(of, solids, systems, numbers);
    RAMUS_TRY(removal, organ::remove_from(organ, functions, job));
    operation.removed = removal.removed_voxels;
    operation.area_mm2 = removal.area_mm2;
    for (organ::CutVessel& vessel : organ::vessels_cut(organ, tree, functions)) {
        vessel.resection = numbers[vessel.resection];
        operation.vessels.push_back(vessel);
    }
    organ::sort_vessels(operation.vessels);
    const std::vector<measure::Cut> cuts = organ::cuts_of(operation.vessels);
    operation.remnant = organ::remnant_of(systems, measure::lost_spans(tree, cuts), functional, removal.kept);
    operation.margins = organ::margins_of(organ, functions, removal.surface, solids);
    put_surfaces(operation, removal.surface, numbers, solids);
    operation.kept = std::move(removal.kept);
    return operation;
}

std::vector<ResectionMeshOf> wanted_meshes(const OrganAssets& assets, const Marks& marks) {
    std::vector<ResectionMeshOf> wanted;
    if (!marks.organ.any() || assets.source != marks.organ.source || !assets.mask.value || !*assets.mask.value)
        return wanted;
    for (const OperationPlan& plan : all_plans(marks))
        for (const Resection& resection : plan.resections) {
            ResectionMeshOf of{resection.file, resection.axes, *assets.mask.value};
            const auto known = assets.meshes.find(of.file);
            if (resection.kind == Resection::Kind::kSurface &&
                (known == assets.meshes.end() || known->second.mask != of.mask) &&
                std::ranges::find(wanted, of) == wanted.end())
                wanted.push_back(std::move(of));
        }
    return wanted;
}

ResectionMesh read_resection_mesh(const ResectionMeshOf& of, const JobRange& job) {
    auto read = io::read_mesh_file(of.file, {io::Holes::kAllowed, io::slicer_space(of.axes)});
    if (!read) return {of.mask, tl::unexpected(read.error())};
    auto surface = organ::DividingSurface::of(std::move(read->mesh), of.mask->organ, job);
    if (!surface && surface.error().where.empty()) surface.error().where = of.file;
    return {of.mask, std::move(surface)};
}

std::vector<std::uint8_t> functional_voxels(const OrganSupply& supply, const std::vector<PlannedLesion>& lesions) {
    std::vector<std::uint8_t> functional = voxels_in(supply.of.mask->organ, lesions);
    for (std::size_t voxel = 0; voxel < functional.size(); ++voxel)
        functional[voxel] = (functional[voxel] | supply.large[voxel]) == 0 ? 1 : 0;
    return functional;
}

std::vector<std::uint8_t> voxels_in(const organ::Organ& organ, const std::vector<PlannedLesion>& lesions,
                                    double margin_mm) {
    std::vector<std::uint8_t> inside(organ.count(), 0);
    const auto fill = [&](const Bounds<glm::dvec3>& box, const auto& is_inside) {
        organ.for_voxels_near(box, [&](const glm::ivec3& voxel, std::size_t number) {
            if (inside[number] == 0 && is_inside(organ.centre_mm(voxel))) inside[number] = 1;
        });
    };
    for (const PlannedLesion& lesion : lesions) {
        if (lesion.mesh && lesion.mesh->voxels) {
            const organ::VoxelSolid& solid = *lesion.mesh->voxels;
            const auto& bounds = solid.to_surface().bounds();
            fill({bounds.least - margin_mm, bounds.most + margin_mm},
                 [&solid, margin_mm](const glm::dvec3& at) { return solid.distance(at) <= margin_mm; });
            continue;
        }
        if (lesion.mesh) {
            const measure::MeshDistance& mesh = *lesion.mesh->distance;
            fill({mesh.bounds().least - margin_mm, mesh.bounds().most + margin_mm},
                 [&mesh, margin_mm](const glm::dvec3& at) { return mesh.distance(at) <= margin_mm; });
            continue;
        }
        const glm::dvec3 centre(lesion.sphere[0], lesion.sphere[1], lesion.sphere[2]);
        const double radius = lesion.sphere[3] + margin_mm;
        fill({centre - radius, centre + radius},
             [&centre, radius](const glm::dvec3& at) { return glm::distance(at, centre) <= radius; });
    }
    return inside;
}

} // namespace ramus::app
