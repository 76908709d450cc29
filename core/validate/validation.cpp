#include "core/validate/validation.h"

#include "core/measure/deviation/deviation.h"
#include "core/validate/questions.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace ramus::validate {

namespace {

constexpr double kReach = 4.0;   // of the rays across, in radii
constexpr double kFromEnd = 1.5; // radii: nearer to a free end, the surface closes

// In stretches, so that work can be cancelled and tells how far it is; unfinished where it was cancelled.
std::vector<CrossSection> sections_at(const std::vector<Place>& places, const Probe& probe, const JobRange& job) {
    constexpr std::size_t kStretch = 1U << 13U;
    std::vector<double> widest; // of each branch: a stenosis may be filled to the width beside it
    for (const Place& place : places) {
        const auto branch = static_cast<std::size_t>(place.branch);
        if (widest.size() <= branch) widest.resize(branch + 1, 0.0);
        widest[branch] = std::max(widest[branch], place.radius);
    }
    std::vector<CrossSection> sections(places.size());
    for (std::size_t first = 0; first < places.size() && !job.cancelled(); first += kStretch) {
        const std::size_t end = std::min(first + kStretch, places.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(first, end, 64), [&](const auto& range) {
            for (std::size_t i = range.begin(); i < range.end(); ++i)
                sections[i] = probe.cross_section(
                    places[i].at, places[i].direction,
                    std::max(kReach * places[i].radius, 2.0 * widest[static_cast<std::size_t>(places[i].branch)]));
        });
        job.report(static_cast<float>(end) / static_cast<float>(places.size()));
    }
    return sections;
}

bool is_alone(const Place& place) { return place.beside >= kFar && place.to_end >= kFromEnd * place.radius; }

std::vector<RadiusPlace> radii_of(const Reference& reference, const std::vector<CrossSection>& sections) {
    std::vector<RadiusPlace> radii;
    radii.reserve(sections.size());
    for (std::size_t i = 0; i < sections.size(); ++i) {
        const Place& place = reference.places()[i];
        radii.push_back({place.branch, place.along, place.at, place.input_radius, place.radius, sections[i].radius,
                         sections[i].flat_radius, is_alone(place), place.direction});
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
std::vector<double> errors_at_points(const tree::VesselTree& source, const Reference& reference, const Probe& probe) {
    const tree::VesselTree& smooth = reference.prepared().tree;
    std::vector<std::vector<double>> of_branch(reference.branches());
    tbb::parallel_for(std::size_t(0), reference.branches(), [&](std::size_t branch) {
        const auto places = reference.places_of(branch);
        const std::vector<std::uint32_t>& points = smooth.branches[branch].points;
        double along = 0.0;
        std::size_t before = 0;
        for (std::size_t i = 1; i + 1 < points.size(); ++i) {
            const tree::Point& point = smooth.points[points[i]];
            along += glm::distance(smooth.points[points[i - 1]].position, point.position);
            while (before + 1 < places.size() && places[before + 1].along <= along) ++before;
            const Place& place = places[before];
            if (!is_alone(place)) continue;
            const double input = source.points[points[i]].radius;
            const double radius = probe.cross_section(point.position, place.direction, kReach * point.radius).radius;
            of_branch[branch].push_back(std::abs(radius - input) / input);
        }
    });
    std::vector<double> errors;
    for (const std::vector<double>& some : of_branch) errors.insert(errors.end(), some.begin(), some.end());
    return errors;
}

Result<Validation> run(const tree::VesselTree& source, const mesh::TriangleMesh& surface,
                       const ValidationOptions& options, Job& job) {
    constexpr float kPacked = 0.15F, kSections = 0.85F; // of the work
    const Reference reference(source, options.smooth_passes);
    if (job.cancelled()) return fail("cancelled");
    const Probe probe(surface, reference.places());
    const std::vector<Place>& places = reference.places();
    job.report(kPacked);
    const std::vector<CrossSection> sections = sections_at(places, probe, JobRange(job, kPacked, kSections));
    if (job.cancelled()) return fail("cancelled");
    Validation found;
    const std::vector<LostStretch> lost = lost_stretches(reference, probe, sections);
    for (const LostStretch& stretch : lost) found.lost.push_back(stretch.lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.87F);
    found.false_parts = false_parts(reference, surface, lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.95F);
    found.merged = merged_vessels(reference, probe, options.limits, lost);
    if (job.cancelled()) return fail("cancelled");
    job.report(0.97F);
    const auto smoothed = [&](std::size_t i) { return places[i].radius; };
    found.constrictions = changed_constrictions(reference, smoothed, [&](std::size_t i) { return sections[i].radius; });
    std::erase_if(found.constrictions, [&](const Constriction& one) { return is_oblique(reference, probe, one); });
    found.smoothed_away = changed_constrictions(
        reference, [&](std::size_t i) { return places[i].input_radius; }, smoothed);
    found.radii = radii_of(reference, sections);
    found.radius_error = error_of(found.radii);
    if (std::vector<double> errors = errors_at_points(source, reference, probe); !errors.empty()) {
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
        places[i].radius = radii[i].expected_mm;
    }
    tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
    const auto sections = arena.execute([&] {
        const Probe probe(surface, places);
        return sections_at(places, probe, JobRange(job, 0.1F, 1.0F));
    });
    if (job.cancelled()) return fail("cancelled");
    std::vector<double> found;
    found.reserve(sections.size());
    for (const CrossSection& section : sections) found.push_back(section.radius);
    return found;
}

} // namespace ramus::validate
