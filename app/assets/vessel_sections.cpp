#include "app/assets/vessel_sections.h"

#include "render/slice/frame_section.h"

#include <algorithm>

namespace ramus::app {

double fine_step_mm(const volume::Volume& scan) { return 0.5 * slice::smallest_spacing_mm(scan); }

double path_step_mm(double fine_mm, const std::optional<double>& step_mm) {
    if (!step_mm) return fine_mm;
    return fine_mm > 0.0 ? std::min(fine_mm, *step_mm) : *step_mm;
}

std::vector<slice::PathSample> samples_every(const slice::VesselPath& path, double step_mm) {
    std::vector<slice::PathSample> samples;
    constexpr double kRounding = 1e-9;
    for (double n = 0.0; n * step_mm <= path.length_mm() * (1.0 + kRounding); ++n)
        samples.push_back(path.at(n * step_mm));
    return samples;
}

std::vector<slice::PathSample> usual_samples(const slice::VesselPath& path) {
    constexpr double kUsualSections = 24.0;
    return samples_every(path, path.length_mm() / (kUsualSections - 1.0));
}

std::vector<slice::SectionFigures> section_figures(const Lumens& lumens) {
    std::vector<slice::SectionFigures> figures;
    for (const auto& lumen : lumens)
        figures.push_back(lumen && lumen->closed ? slice::SectionFigures(lumen->figures) : std::nullopt);
    return figures;
}

Result<Lumens> measured_lumens(const tree::VesselTree& tree, const slice::VesselPath& path,
                               std::span<const slice::PathSample> samples, const render::PagedMesh& mesh, Job& job) {
    const slice::OtherBranches others(tree, path);
    const auto loops = [&](const slice::Plane& plane) { return render::section_of(mesh, plane); };
    // Parts of the way, to report progress and to be cancelled.
    constexpr std::size_t kPart = 32;
    Lumens lumens;
    lumens.reserve(samples.size());
    for (std::size_t first = 0; first < samples.size(); first += kPart) {
        if (job.cancelled()) return fail("cancelled");
        const std::size_t count = std::min(kPart, samples.size() - first);
        for (auto& lumen : slice::lumens_along(samples.subspan(first, count), loops, others))
            lumens.push_back(std::move(lumen));
        job.report(static_cast<float>(first + count) / static_cast<float>(samples.size()));
    }
    return lumens;
}

Result<std::shared_ptr<const VesselSections>> make_sections(const FollowedPath& followed,
                                                            std::shared_ptr<const render::PagedMesh> mesh, Job& job) {
    VesselSections sections;
    const slice::VesselPath& path = *followed.path;
    const tree::VesselTree& tree = *followed.of->tree;
    RAMUS_TRY(lumens, measured_lumens(tree, path, path.samples, *mesh, job));
    sections.path = followed.path;
    sections.mesh = std::move(mesh);
    sections.figures = section_figures(lumens);
    sections.lumens = std::move(lumens);
    sections.inner = inner_samples(tree, path);
    return std::make_shared<const VesselSections>(std::move(sections));
}

Result<NarrowPlaces> narrow_places(const VesselSections& sections, const StenosisChoice& choice) {
    NarrowPlaces places;
    if (choice.reference_mm) {
        places.reference = slice::figures_of_disc(*choice.reference_mm);
    } else if (choice.reference) {
        RAMUS_TRY(reference, slice::reference_of(sections.figures, samples_of(*sections.path, *choice.reference)));
        places.reference = reference;
    } else {
        return fail("the stenosis has no reference", {}, "choose a place of the vessel, or give a diameter");
    }
    RAMUS_TRY(found, slice::stenosis_of(sections.figures, samples_of(*sections.path, choice.where), places.reference));
    places.found = found;
    return places;
}

} // namespace ramus::app
