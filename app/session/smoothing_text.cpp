#include "app/session/smoothing_text.h"

#include "core/tree/voxels.h"

#include <nlohmann/json.hpp>

namespace ramus::app {

std::string voxels_text(const tree::Voxels& voxels, const Lengths& lengths) {
    const glm::dvec3 sizes = tree::sizes_mm(voxels);
    const std::string cube = digits(sizes.x);
    const bool cubes = cube == digits(sizes.y) && cube == digits(sizes.z);
    return (cubes ? cube : cube + " x " + digits(sizes.y) + " x " + digits(sizes.z)) + " " + lengths.unit();
}

Smoothing smoothing_of(const tree::VesselTree& tree, int passes) {
    Smoothing smoothing{passes, tree.voxels, {}};
    if (tree.voxels && passes > 0) smoothing.moved = tree::displacement_of(tree, tree::smooth(tree, passes));
    return smoothing;
}

std::string smoothing_text(const Smoothing& smoothing, const Lengths& lengths) {
    if (smoothing.passes == 0) return "off";
    if (!smoothing.voxels) return "none: the points are no voxels";
    const tree::Displacement& moved = smoothing.moved;
    return "voxels of " + voxels_text(*smoothing.voxels, lengths) +
           (smoothing.voxels->estimated ? " (estimated)" : "") + ": points move by " + lengths.text(moved.median_mm) +
           " (" + digits(moved.median_radii) + " radii) in the median, by " + lengths.text(moved.largest_mm) + " (" +
           digits(moved.largest_radii) + " radii) at most";
}

nlohmann::ordered_json smoothing_json(const Smoothing& smoothing) {
    nlohmann::ordered_json report = {{"passes", smoothing.passes}, {"voxel_mm", nullptr}, {"voxel_from", nullptr}};
    if (smoothing.voxels) {
        const glm::dvec3 sizes = tree::sizes_mm(*smoothing.voxels);
        report["voxel_mm"] = {sizes.x, sizes.y, sizes.z};
        report["voxel_from"] = smoothing.voxels->estimated ? "points" : "mask";
    }
    report["displacement_mm"] = {{"median", smoothing.moved.median_mm}, {"max", smoothing.moved.largest_mm}};
    report["displacement_radii"] = {{"median", smoothing.moved.median_radii}, {"max", smoothing.moved.largest_radii}};
    return report;
}

} // namespace ramus::app
