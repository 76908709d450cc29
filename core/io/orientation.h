// Orientation: the directions of a file's three axes in the patient, as three letters. "LPS" means: x to the left, y to
// the back (posterior), z to the head (superior). There are 48, the signed permutations of the axes. 24 of them are
// rotations to the patient's axes (RAS); the other 24 mirror. A mirroring orientation is never assumed: readers use it
// only if the file or a person states all three letters.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

enum class Side : std::uint8_t { kRight, kLeft, kAnterior, kPosterior, kSuperior, kInferior };
inline constexpr std::array kSides{Side::kRight,     Side::kLeft,     Side::kAnterior,
                                   Side::kPosterior, Side::kSuperior, Side::kInferior};

[[nodiscard]] char letter_of(Side side);           // 'R', 'L', 'A', 'P', 'S', 'I'
[[nodiscard]] std::string_view name_of(Side side); // "right", ...
// The patient's axis that a side belongs to: 0 right and left, 1 anterior and posterior, 2 superior and inferior.
[[nodiscard]] constexpr int line_of(Side side) { return static_cast<int>(side) / 2; }
[[nodiscard]] constexpr bool is_positive(Side side) { return static_cast<int>(side) % 2 == 0; }

class Orientation {
public:
    constexpr Orientation() = default; // RAS
    // None: two of the sides belong to the same axis of the patient.
    [[nodiscard]] static std::optional<Orientation> leading_to(const std::array<Side, 3>& sides);
    // Parses three letters such as "RAS" or "lps", case-insensitive. None: they are no orientation.
    [[nodiscard]] static std::optional<Orientation> named(std::string_view letters);
    [[nodiscard]] static constexpr Orientation ras() { return {}; }
    [[nodiscard]] static constexpr Orientation lps() {
        return Orientation({Side::kLeft, Side::kPosterior, Side::kSuperior});
    }

    [[nodiscard]] Side side(int axis) const { return sides_.at(static_cast<std::size_t>(axis)); }
    [[nodiscard]] std::string letters() const;                            // "LPS"
    [[nodiscard]] std::string words() const;                              // "left, posterior, superior (LPS)"
    [[nodiscard]] glm::dvec3 to_patient(const glm::dvec3& in_file) const; // to RAS; exact: only order and signs change
    [[nodiscard]] glm::dvec3 to_file(const glm::dvec3& in_patient) const; // the inverse
    [[nodiscard]] bool mirrors() const;                                   // whether to_patient() is a reflection
    bool operator==(const Orientation&) const = default;

private:
    constexpr explicit Orientation(const std::array<Side, 3>& sides) : sides_(sides) {}
    std::array<Side, 3> sides_{Side::kRight, Side::kAnterior, Side::kSuperior};
};

// The orientations that 3D Slicer's files can have, and the word that states one in the header of an STL file, in
// comments of PLY and OBJ files and in the title of a legacy VTK file: "SPACE=LPS".
inline constexpr std::array kSlicerSpaces{Orientation::ras(), Orientation::lps()};
[[nodiscard]] std::optional<Orientation> slicer_space(std::string_view letters); // case-insensitive
[[nodiscard]] std::string space_word(const Orientation& axes);
// The orientation of the first such word in a text. None: there is no such word.
[[nodiscard]] std::optional<Orientation> space_in(std::string_view text);

// Fails if `axes` are not RAS and the claims do not say that the tree's axes are RAS: then there is nothing to convert
// from. `where`: the place in the error.
[[nodiscard]] Result<void> check_axes(const Orientation& axes, const tree::Claims& claims, const std::string& where);
// The word for `axes` in a written file: "LPS"; tree::kNotSaid if the claims do not say that the tree's axes are RAS.
[[nodiscard]] std::string axes_word(const Orientation& axes, const tree::Claims& claims);

// All 48, RAS first, the 24 rotations before the 24 that mirror.
[[nodiscard]] std::vector<Orientation> all_orientations();

} // namespace ramus::io
