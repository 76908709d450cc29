// `ramus reformat`: the vessel that the command line names, and its cross-sections by the surface and by a mask.
#pragma once

#include "app/commands/surface_flags.h"
#include "app/commands/surface_input.h"
#include "core/base/error.h"
#include "core/slice/cross_section.h"
#include "core/slice/stenosis.h"
#include "core/slice/vessel_path.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// One end of a way: a branch, and a fraction of its length.
struct WayEnd {
    int branch = tree::kNoBranch; // kNoBranch: the root
    std::optional<double> fraction;
};

// A way along vessels. Without `to`: the whole branch `from`.
struct Way {
    WayEnd from;
    std::optional<WayEnd> to;
};

// Parses "12", "3..12", "3@0.2..12@0.5", "root..12". An end without a fraction is the start of its branch at the start
// of the way, and the end of its branch at the end.
[[nodiscard]] std::optional<Way> way_in(std::string_view text);
[[nodiscard]] Result<slice::VesselPath> path_along(const tree::VesselTree& tree, const Way& way, double step_mm);

// What the narrowest section is compared with: a diameter in mm, a place, or a stretch of the path.
struct Reference {
    std::optional<double> diameter_mm;
    Way way; // without `to`: a place
};
// Parses "8.5", "12@0.3", "12@0.1..12@0.4".
[[nodiscard]] std::optional<Reference> reference_in(std::string_view text);

// The samples of a path that a way covers; one for a place. Fails if it is not on the path.
[[nodiscard]] Result<slice::SampleRange> samples_of(const slice::VesselPath& path, const Way& way);
// The whole path, without the last radius before free ends of the vessel: the surface is rounded there.
[[nodiscard]] slice::SampleRange inner_samples(const tree::VesselTree& tree, const slice::VesselPath& path);

// The figures of closed sections.
[[nodiscard]] std::vector<slice::SectionFigures>
section_figures(const std::vector<std::optional<slice::Lumen>>& lumens);

// Loops of a mask. `voxels` must outlive them. `half_mm`: about the extent of the vessel.
[[nodiscard]] slice::LoopsOfPlane loops_of(const MaskVoxels& voxels, double half_mm);
[[nodiscard]] slice::LoopsOfPlane loops_of(const slice::MeshBlocks& blocks); // `blocks` must outlive them

} // namespace ramus::app
