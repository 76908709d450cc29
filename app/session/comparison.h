// Comparison: which surfaces of one tree are shown together, and how. Plain values, covered by undo.
#pragma once

#include "core/mesh/surface_options.h"
#include "core/volume/label_choice.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// The comparable surfaces: the methods in their order, then the convolution surface with vessels apart and with vessels
// merged, whatever the session's own setting.
enum class Compared : std::uint8_t { kConvolutionSurface, kTruncatedCones, kIsosurface, kApart, kMerged };

struct ComparedRow {
    Compared kind;
    mesh::Method method;
    std::optional<mesh::Blend> blend; // none: the session's
    std::string_view key;             // on the command line, in sessions and commands
    std::string_view label;           // alone
    std::string_view noun;            // within a sentence
};

namespace details {
constexpr ComparedRow row_of_method(Compared kind, mesh::Method method) {
    const mesh::MethodRow& row = mesh::row_of(method);
    return {kind, method, std::nullopt, row.key, row.label, row.noun};
}
} // namespace details

// In the order of `Compared`.
inline constexpr std::array<ComparedRow, 5> kCompared{
    details::row_of_method(Compared::kConvolutionSurface, mesh::Method::kConvolutionSurface),
    details::row_of_method(Compared::kTruncatedCones, mesh::Method::kTruncatedCones),
    details::row_of_method(Compared::kIsosurface, mesh::Method::kIsosurface),
    ComparedRow{Compared::kApart, mesh::Method::kConvolutionSurface, mesh::Blend::kTree,
                mesh::name_of(mesh::Blend::kTree), "Vessels apart", "surface with vessels apart"},
    ComparedRow{Compared::kMerged, mesh::Method::kConvolutionSurface, mesh::Blend::kPaper,
                mesh::name_of(mesh::Blend::kPaper), "Vessels merged", "surface with vessels merged"},
};
[[nodiscard]] constexpr const ComparedRow& row_of(Compared kind) { return kCompared[static_cast<std::size_t>(kind)]; }
[[nodiscard]] constexpr std::string_view name_of(Compared kind) { return row_of(kind).key; }
[[nodiscard]] constexpr Compared compared(mesh::Method method) { return static_cast<Compared>(method); }
// "cs, cones, iso, tree, paper"
[[nodiscard]] std::string compared_names();
// Whether this is the surface that a session with these options shows without a comparison.
[[nodiscard]] bool is_own(Compared kind, const mesh::SurfaceOptions& options);

struct Comparison {
    enum class Mode : std::uint8_t {
        kOff,
        kSideBySide,   // each in its own viewport, with one camera
        kBlend,        // the first two, one fading into the other
        kSuperimposed, // the first shaded, the second as a wireframe over it
        kWipe,         // the first two, left and right of a line
    };
    Mode mode = Mode::kOff;
    // Two or three, without repeats.
    std::vector<Compared> surfaces{Compared::kConvolutionSurface, Compared::kTruncatedCones};
    std::string mask;                        // for the isosurface: absolute path; empty: the tree's own voxels
    std::string mask_units;                  // unit of the mask, "cm"; empty: as its file says
    std::vector<volume::LabelChoice> labels; // of the mask, ascending; empty: all labels
    double blend = 0.5;                      // 0: the first surface alone; 1: the second
    double wipe = 0.5;                       // position of the line as a fraction of the width
    bool operator==(const Comparison&) const = default;
};
inline constexpr std::array kComparisonModes{Comparison::Mode::kOff, Comparison::Mode::kSideBySide,
                                             Comparison::Mode::kBlend, Comparison::Mode::kSuperimposed,
                                             Comparison::Mode::kWipe};
[[nodiscard]] std::string_view name_of(Comparison::Mode mode); // "off", "side-by-side", "blend", "superimposed", "wipe"
[[nodiscard]] std::optional<Comparison::Mode> comparison_mode_named(std::string_view name);

// The surfaces in the picture, in their order; empty without a comparison.
[[nodiscard]] std::vector<Compared> compared_surfaces(const Comparison& comparison);

// "Convolution surface", "Truncated cones", "Isosurface of liver.nii.gz".
[[nodiscard]] std::string title_of(Compared kind, const Comparison& comparison);

// Parses "cs,iso": two or three, without repeats.
[[nodiscard]] std::optional<std::vector<Compared>> surface_list(std::string_view text);
// Parses "1,portal vein": whole numbers other than 0, and names; sorts and removes repeats. Quoted text is a name, even
// with commas or digits.
[[nodiscard]] std::optional<std::vector<volume::LabelChoice>> label_list(std::string_view text);
// Parses "1+3,portal vein": groups of labels as for label_list(); a name that contains + needs quotes.
[[nodiscard]] std::optional<std::vector<std::vector<volume::LabelChoice>>> label_groups(std::string_view text);

} // namespace ramus::app
