// Where the three axes of a file lead in the patient, as three letters: "LPS" leads to the left, to the back, to the
// head. All 48 signed permutations of the axes are such values. 24 of them turn the file's numbers into the patient's
// axes (RAS); the other 24 are left-handed, so that the patient is the mirror image of the numbers. Which of both a
// value is, mirrors() says: a left-handed one is never assumed, only taken when somebody has said all three letters.
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
// 0 of right and left, 1 of anterior and posterior, 2 of superior and inferior.
[[nodiscard]] constexpr int line_of(Side side) { return static_cast<int>(side) / 2; }
[[nodiscard]] constexpr bool is_positive(Side side) { return static_cast<int>(side) % 2 == 0; }

class Orientation {
public:
    constexpr Orientation() = default; // RAS
    // None: two of the axes would lead along one line.
    [[nodiscard]] static std::optional<Orientation> leading_to(const std::array<Side, 3>& sides);
    // "RAS", "lps", in any case. None: it is none.
    [[nodiscard]] static std::optional<Orientation> named(std::string_view letters);
    [[nodiscard]] static constexpr Orientation ras() { return {}; }
    [[nodiscard]] static constexpr Orientation lps() {
        return Orientation({Side::kLeft, Side::kPosterior, Side::kSuperior});
    }

    [[nodiscard]] Side side(int axis) const { return sides_.at(static_cast<std::size_t>(axis)); }
    [[nodiscard]] std::string letters() const;                            // "LPS"
    [[nodiscard]] std::string words() const;                              // "left, posterior, superior (LPS)"
    [[nodiscard]] glm::dvec3 to_patient(const glm::dvec3& in_file) const; // in RAS; exact: numbers change their sign
    [[nodiscard]] glm::dvec3 to_file(const glm::dvec3& in_patient) const; // and back
    [[nodiscard]] bool mirrors() const;                                   // turns right hands into left ones
    bool operator==(const Orientation&) const = default;

private:
    constexpr explicit Orientation(const std::array<Side, 3>& sides) : sides_(sides) {}
    std::array<Side, 3> sides_{Side::kRight, Side::kAnterior, Side::kSuperior};
};

// The axes that 3D Slicer's files may have, and the word that says so in the header of an STL file, in comments of PLY
// and OBJ files and in the title of a legacy VTK file: "SPACE=LPS".
inline constexpr std::array kSlicerSpaces{Orientation::ras(), Orientation::lps()};
[[nodiscard]] std::optional<Orientation> slicer_space(std::string_view letters); // in any case
[[nodiscard]] std::string space_word(const Orientation& axes);
// The first such word in a text; none: it has none.
[[nodiscard]] std::optional<Orientation> space_in(std::string_view text);

// Whether what is taken as RAS can be written in these axes: fails on others than RAS of which nobody has said that it
// is RAS; `where` is what the error names.
[[nodiscard]] Result<void> check_axes(const Orientation& axes, const tree::Claims& claims, const std::string& where);
// What a file in these axes says of them: "LPS"; tree::kNotSaid where nobody has said that the tree is RAS.
[[nodiscard]] std::string axes_word(const Orientation& axes, const tree::Claims& claims);

// The 48, RAS first, those that do not mirror before those that do.
[[nodiscard]] std::vector<Orientation> all_orientations();

} // namespace ramus::io
