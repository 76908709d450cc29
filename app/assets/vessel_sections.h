// The path that slices follow (AlongVessel), and the cross-sections of the shown surface along it. The path takes
// milliseconds. Sections take a second for a long vessel: use a worker.
#pragma once

#include "app/session/session.h"
#include "core/base/job.h"
#include "core/slice/cross_section.h"
#include "core/slice/stenosis.h"
#include "core/slice/vessel_path.h"
#include "render/scene/paged_mesh.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace ramus::app {

using Lumens = std::vector<std::optional<slice::Lumen>>;

// The path of a session's way, with its inputs.
struct FollowedPath {
    struct Of {
        std::shared_ptr<const tree::VesselTree> tree;
        Way way;
        double step_mm = 0.0; // 0: as the tree says
        bool operator==(const Of&) const = default;
    };
    std::optional<Of> of;
    std::shared_ptr<const slice::VesselPath> path; // null: there is none
    std::string problem;                           // why not
};

// The longest step that shows all voxels of a scan: half of the smallest spacing.
[[nodiscard]] double fine_step_mm(const volume::Volume& scan);
// The step of a path whose sections are `step_mm` apart. `fine_mm`: of the scan; 0 without a scan.
[[nodiscard]] double path_step_mm(double fine_mm, const std::optional<double>& step_mm);
// Places at equal steps from the start of a path.
[[nodiscard]] std::vector<slice::PathSample> samples_every(const slice::VesselPath& path, double step_mm);
// The same for a usual number of sections.
[[nodiscard]] std::vector<slice::PathSample> usual_samples(const slice::VesselPath& path);

// The figures of closed sections.
[[nodiscard]] std::vector<slice::SectionFigures> section_figures(const Lumens& lumens);

// A reference and what is narrower than it.
struct NarrowPlaces {
    slice::ShapeFigures reference;
    slice::Stenosis found;
};

// Sections at all samples of a path.
struct VesselSections {
    std::shared_ptr<const slice::VesselPath> path;
    std::shared_ptr<const render::PagedMesh> mesh; // that was cut
    Lumens lumens;
    std::vector<slice::SectionFigures> figures; // of closed lumina
    slice::SampleRange inner;                   // without the rounded ends of the surface

    [[nodiscard]] bool fits(const FollowedPath& followed, const std::shared_ptr<const render::PagedMesh>& shown) const {
        return path == followed.path && mesh == shown;
    }
};

// Fails with "cancelled".
[[nodiscard]] Result<Lumens> measured_lumens(const tree::VesselTree& tree, const slice::VesselPath& path,
                                             std::span<const slice::PathSample> samples, const render::PagedMesh& mesh,
                                             Job& job);
[[nodiscard]] Result<std::shared_ptr<const VesselSections>>
make_sections(const FollowedPath& followed, std::shared_ptr<const render::PagedMesh> mesh, Job& job);

// Fails without a reference, and where no section is closed.
[[nodiscard]] Result<NarrowPlaces> narrow_places(const VesselSections& sections, const StenosisChoice& choice);

} // namespace ramus::app
