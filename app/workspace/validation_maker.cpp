#include "app/workspace/validation_maker.h"

#include "app/workspace/compared_surfaces.h"
#include "core/base/memory.h"
#include "core/field/kernel.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"

#include <memory>
#include <utility>

namespace ramus::app {

namespace {

validate::ValidationOptions how_to_validate(const mesh::SurfaceOptions& options) {
    return {mesh::kernel_of(options).limits, options.threads};
}

// Ends of the steps as shares of the work (measured on a tree of 30,000 branches).
struct Steps {
    explicit Steps(bool with_mask) {
        if (with_mask) looked = 0.4F, cones = 0.7F;
    }
    float made = 0.1F, looked = 0.55F, cones = 1.0F;
};

Result<std::vector<double>> radii_of(const ValidationOf& of, const validate::Validation& found, Compared kind,
                                     Job& job) {
    ComparedRequest request;
    request.kind = kind;
    request.surface.options = of.options;
    request.surface.options.method = mesh::Method::kTruncatedCones;
    request.surface.options.smooth_passes = 0; // the tree as read
    request.mask = of.mask;
    request.units = of.mask_units;
    request.labels = of.labels;
    Job making(job, 0.0F, 0.1F), looking(job, 0.1F, 1.0F);
    RAMUS_TRY(other, compared_mesh(*of.tree, request, making));
    if (other.mesh.triangles.empty()) return fail("there is no surface in it", of.mask);
    return validate::radii_in(other.mesh, found.radii, how_to_validate(of.options), looking);
}

} // namespace

Result<TreeValidation> make_validation(const ValidationOf& of, Job& job) {
    TreeValidation made;
    made.of = of;
    const Steps steps(!of.mask.empty());
    Job making(job, 0.0F, steps.made), looking(job, steps.made, steps.looked);
    RAMUS_TRY(surface, mesh::make_surface(*of.tree, of.options, making));
    surface.mesh.radii = {}; // unused, and large for millions of vertices
    surface.mesh.branches = {};
    const bool large = surface.mesh.triangles.size() >= kWorthReleasing;
    if (large) release_unused_memory();
    RAMUS_TRY(found, validate::validate(*of.tree, surface.mesh, how_to_validate(of.options), looking));
    const bool cones = of.options.method == mesh::Method::kTruncatedCones;
    if (!cones) found.shape = validate::shape_of(*of.tree, surface.mesh);
    surface.mesh = {};
    if (large) release_unused_memory();
    if (!cones) {
        Job of_cones(job, steps.looked, steps.cones);
        RAMUS_TRY(radii, radii_of(of, found, Compared::kTruncatedCones, of_cones));
        made.cones_mm = std::move(radii);
    }
    if (!of.mask.empty()) {
        Job of_mask(job, steps.cones, 1.0F);
        auto radii = radii_of(of, found, Compared::kIsosurface, of_mask);
        if (radii)
            made.mask_mm = std::move(*radii);
        else
            made.mask_trouble = radii.error().message();
    }
    if (large) release_unused_memory();
    if (job.cancelled()) return fail("cancelled");
    made.findings = std::make_shared<const std::vector<Finding>>(findings_of(found));
    made.found = std::make_shared<const validate::Validation>(std::move(found));
    return made;
}

} // namespace ramus::app
