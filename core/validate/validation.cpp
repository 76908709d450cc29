#include "core/validate/validation.h"

#include "core/measure/deviation/deviation.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace ramus::validate {

namespace {

constexpr double kAcrossPoint = 4.0; // of the rays across a point, in radii

std::vector<RadiusPlace> radii_of(const Reference& reference, std::span<const Section> sections) {
    std::vector<RadiusPlace> radii;
    radii.reserve(sections.size());
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const Place& place = reference.places()[i];
        radii.push_back({place.branch, place.along, place.at, place.radius, sections[i].through.radius,
                         sections[i].through.flat_radius, is_alone(place), place.direction});
    }
    return radii;
}

RadiusError error_of(const std::vector<RadiusPlace>& radii) {
    std::vector<double> errors, flat_errors;
    for (const RadiusPlace& place : radii) {
        if (!place.alone) continue;
        errors.push_back(std::abs(place.surface_mm - place.input_mm) / place.input_mm);
        flat_errors.push_back(std::abs(place.flat_mm - place.input_mm) / place.input_mm);
    }
    if (errors.empty()) return {};
    RadiusError error;
    error.places = errors.size();
    error.median = measure::quantile(errors, 0.5);
    error.p95 = measure::quantile(errors, 0.95);
    error.flat_median = measure::quantile(flat_errors, 0.5);
    error.flat_p95 = measure::quantile(flat_errors, 0.95);
    return error;
}

// |surface - input| / input at the points that were read.
std::vector<double> errors_at_points(const Reference& reference, const Probe& probe) {
    const tree::VesselTree& tree = reference.tree();
    std::vector<std::vector<double>> of_branch(reference.branches());
    tbb::parallel_for(std::size_t(0), reference.branches(), [&](std::size_t branch) {
        const auto places = reference.places_of(branch);
        const std::vector<std::uint32_t>& points = tree.branches[branch].points;
        double along = 0.0;
        std::size_t before = 0;
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            const tree::Point& point = tree.points[points[i]];
            along += glm::distance(tree.points[points[i - 1]].position, point.position);
            while (before + 1 < places.size() && places[before + 1].along <= along) ++before;
            const Place& place = places[before];
            if (!is_alone(place)) continue;
            const double radius =
                probe.cross_section(point.position, place.direction, kAcrossPoint * point.radius).radius;
            of_branch[branch].push_back(std::abs(radius - point.radius) / point.radius);
        }
    });
    std::vector<double> errors;
    for (const std::vector<double>& some : of_branch) errors.insert(errors.end(), some.begin(), some.end());
    return errors;
}

// Near a false part or a merged vessel, cross-sections include it, so their radii are not reported.
bool is_explained(const Validation& found, const Reference& reference, int branch, const glm::dvec3& at) {
    constexpr double kLeaves = 4.0, kMerges = 6.0; // radii
    const double radius =
        std::ranges::find(reference.places_of(static_cast<std::size_t>(branch)), at, &Place::at)->scale;
    return std::ranges::any_of(found.false_parts,
                               [&](const FalsePart& one) {
                                   return glm::distance(one.at, at) <= 0.5 * one.length_mm + kLeaves * radius;
                               }) ||
           std::ranges::any_of(found.merged, [&](const Merged& one) {
               return std::ranges::find(one.branches, branch) != one.branches.end() &&
                      glm::distance(one.at, at) <= kMerges * radius;
           });
}

Fidelity fidelity_of(const Reference& reference, std::span<const Section> sections, const Probe& probe) {
    const tree::VesselTree& tree = reference.tree();
    std::vector<std::uint8_t> used(tree.points.size(), 0), outside(tree.points.size(), 0);
    for (const tree::Branch& branch : tree.branches)
        for (const std::uint32_t p : branch.points) used[p] = 1;
    tbb::parallel_for(std::size_t(0), used.size(), [&](std::size_t p) {
        outside[p] = used[p] != 0 && !probe.inside(tree.points[p].position) ? 1 : 0;
    });
    Fidelity found;
    found.points = static_cast<std::size_t>(std::ranges::count(used, 1));
    found.outside = static_cast<std::size_t>(std::ranges::count(outside, 1));
    std::vector<double> offsets;
    for (std::size_t i = 0; i < sections.size(); ++i)
        if (const Place& place = reference.places()[i]; is_alone(place) && sections[i].found)
            offsets.push_back(glm::length(offset_of(sections[i], place)));
    found.places = offsets.size();
    if (offsets.empty()) return found;
    found.offset_median_mm = measure::quantile(offsets, 0.5);
    found.offset_p95_mm = measure::quantile(offsets, 0.95);
    found.offset_max_mm = measure::quantile(offsets, 1.0);
    return found;
}

Result<Validation> run(const tree::VesselTree& source, const mesh::TriangleMesh& surface,
                       const ValidationOptions& options, Job& job) {
    constexpr float kPacked = 0.15F, kSections = 0.85F; // of the work
    const Reference reference(source);
    if (job.cancelled()) return fail("cancelled");
    const Probe probe(surface, reference.places());
    job.report(kPacked);
    const std::vector<Section> sections = sections_of(reference, probe, JobRange(job, kPacked, kSections));
    if (job.cancelled()) return fail("cancelled");
    Validation found;
    const std::vector<LostStretch> lost = lost_stretches(reference, sections);
    for (const LostStretch& stretch : lost) found.lost.push_back(stretch.lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.87F);
    const std::vector<MovedStretch> moved = moved_stretches(reference, probe, sections);
    found.false_parts = false_parts(reference, surface, sections, moved, lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.95F);
    found.merged = merged_vessels(reference, probe, options.limits, lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.97F);
    found.constrictions = changed_constrictions(reference, sections, moved);
    std::erase_if(found.constrictions, [&](const Constriction& one) { return is_oblique(reference, probe, one); });
    found.widths = changed_widths(reference, sections, moved, found.constrictions);
    for (const MovedStretch& stretch : moved) found.positions.push_back(stretch.offset);
    const auto explained = [&](const auto& one) { return is_explained(found, reference, one.branch, one.at); };
    std::erase_if(found.widths, explained);
    std::erase_if(found.positions, explained);
    found.fidelity = fidelity_of(reference, sections, probe);
    found.radii = radii_of(reference, sections);
    found.radius_error = error_of(found.radii);
    if (std::vector<double> errors = errors_at_points(reference, probe); !errors.empty()) {
        found.radius_error.points = errors.size();
        found.radius_error.points_median = measure::quantile(errors, 0.5);
        found.radius_error.points_p95 = measure::quantile(errors, 0.95);
    }
    return found;
}

} // namespace

Result<Validation> validate(const tree::VesselTree& source, const mesh::TriangleMesh& surface,
                            const ValidationOptions& options, Job& job) {
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    return arena.execute([&] { return run(source, surface, options, job); });
}

Result<std::vector<double>> radii_in(const mesh::TriangleMesh& surface, const std::vector<RadiusPlace>& radii,
                                     const ValidationOptions& options, Job& job) {
    std::vector<Place> places(radii.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
        places[i].branch = radii[i].branch;
        places[i].at = radii[i].at;
        places[i].direction = radii[i].direction;
        places[i].radius = radii[i].input_mm;
    }
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    const auto sections = arena.execute([&] {
        const Probe probe(surface, places);
        return cross_sections(places, probe, JobRange(job, 0.1F, 1.0F));
    });
    if (job.cancelled()) return fail("cancelled");
    std::vector<double> found;
    found.reserve(sections.size());
    for (const CrossSection& section : sections) found.push_back(section.radius);
    return found;
}

} // namespace ramus::validate
