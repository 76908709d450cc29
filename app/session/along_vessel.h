// AlongVessel: the vessel that slices follow, and how it is shown. Ways along vessels are written as the command line
// writes them: "12", "3..12", "3@0.2..12@0.5", "root..12". Plain values. Units: mm, degrees.
#pragma once

#include "core/base/error.h"
#include "core/slice/reformation.h"
#include "core/slice/stenosis.h"
#include "core/slice/vessel_path.h"
#include "core/tree/vessel_tree.h"

#include <optional>
#include <string>
#include <string_view>

namespace ramus::app {

// One end of a way: a branch, and a fraction of its length.
struct WayEnd {
    int branch = tree::kNoBranch; // kNoBranch: the root
    std::optional<double> fraction{};
    bool operator==(const WayEnd&) const = default;
};
// "12", "12@0.5" or "root".
[[nodiscard]] std::optional<WayEnd> way_end_in(std::string_view word);

// A way along vessels. Without `to`: the whole branch `from`.
struct Way {
    WayEnd from;
    std::optional<WayEnd> to{};
    bool operator==(const Way&) const = default;
};

// An end without a fraction is the start of its branch at the start of the way, and the end of its branch at the end.
[[nodiscard]] std::optional<Way> way_in(std::string_view text);
[[nodiscard]] std::string text_of(const Way& way);
[[nodiscard]] Result<slice::VesselPath> path_along(const tree::VesselTree& tree, const Way& way, double step_mm);

// What the narrowest section is compared with: a diameter in mm, a place, or a stretch of the path.
struct Reference {
    std::optional<double> diameter_mm{};
    Way way{}; // without `to`: a place
};
// Parses "8.5", "12@0.3", "12@0.1..12@0.4".
[[nodiscard]] std::optional<Reference> reference_in(std::string_view text);

// The samples of a path that a way covers; one for a place. Fails if it is not on the path.
[[nodiscard]] Result<slice::SampleRange> samples_of(const slice::VesselPath& path, const Way& way);
// The whole path, without the last radius before free ends of the vessel: the surface is rounded there.
[[nodiscard]] slice::SampleRange inner_samples(const tree::VesselTree& tree, const slice::VesselPath& path);

// A part of a way; a place if both are equal.
struct Stretch {
    double from_mm = 0.0, to_mm = 0.0; // from the start of the way, in any order
    bool operator==(const Stretch&) const = default;
};
[[nodiscard]] slice::SampleRange samples_of(const slice::VesselPath& path, const Stretch& stretch);

// Where a person looks for a narrowing, and what it is compared with; without a reference it is only marked.
struct StenosisChoice {
    Stretch where;
    std::optional<Stretch> reference{};   // the mean of its sections
    std::optional<double> reference_mm{}; // instead: a diameter
    bool operator==(const StenosisChoice&) const = default;
};

struct AlongVessel {
    Way way;
    double at_mm = 0.0; // the current place, from the start of the way
    slice::ReformationKind kind = slice::ReformationKind::kStraightened;
    double angle_deg = 0.0;           // of the picture about the vessel's axis
    std::optional<double> width_mm{}; // of the picture; none: four of the vessel's largest diameters
    std::optional<StenosisChoice> stenosis{};
    bool operator==(const AlongVessel&) const = default;
};
inline constexpr double kLeastWidthMm = 0.1, kMostWidthMm = 1000.0;

} // namespace ramus::app
