#include "core/io/orientation.h"

#include <algorithm>
#include <cctype>

namespace ramus::io {

namespace {

constexpr std::array<std::string_view, 6> kSideNames{"right", "left", "anterior", "posterior", "superior", "inferior"};

} // namespace

std::string_view name_of(Side side) { return kSideNames.at(static_cast<std::size_t>(side)); }
char letter_of(Side side) { return static_cast<char>(std::toupper(static_cast<unsigned char>(name_of(side).front()))); }

std::optional<Orientation> Orientation::leading_to(const std::array<Side, 3>& sides) {
    const std::array lines{line_of(sides[0]), line_of(sides[1]), line_of(sides[2])};
    if (lines[0] == lines[1] || lines[1] == lines[2] || lines[0] == lines[2]) return std::nullopt;
    return Orientation(sides);
}

std::optional<Orientation> Orientation::named(std::string_view letters) {
    std::array<Side, 3> sides{};
    if (letters.size() != sides.size()) return std::nullopt;
    for (std::size_t axis = 0; axis < sides.size(); ++axis) {
        const auto letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letters[axis])));
        const auto* const found = std::ranges::find(kSides, letter, letter_of);
        if (found == kSides.end()) return std::nullopt;
        sides.at(axis) = *found;
    }
    return leading_to(sides);
}

std::string Orientation::letters() const { return {letter_of(sides_[0]), letter_of(sides_[1]), letter_of(sides_[2])}; }

std::string Orientation::words() const {
    std::string words;
    for (const Side side : sides_) words.append(words.empty() ? "" : ", ").append(name_of(side));
    return words + " (" + letters() + ")";
}

glm::dvec3 Orientation::to_patient(const glm::dvec3& in_file) const {
    glm::dvec3 there;
    for (int axis = 0; axis < 3; ++axis)
        there[line_of(side(axis))] = is_positive(side(axis)) ? in_file[axis] : -in_file[axis];
    return there;
}

glm::dvec3 Orientation::to_file(const glm::dvec3& in_patient) const {
    glm::dvec3 there;
    for (int axis = 0; axis < 3; ++axis) {
        const double along = in_patient[line_of(side(axis))];
        there[axis] = is_positive(side(axis)) ? along : 0.0 - along; // no -0
    }
    return there;
}

bool Orientation::mirrors() const {
    // An exchange of two axes and a change of sign each reverse the handedness.
    bool odd = false;
    for (int a = 0; a < 3; ++a) {
        odd ^= !is_positive(side(a));
        for (int b = a + 1; b < 3; ++b) odd ^= line_of(side(a)) > line_of(side(b));
    }
    return odd;
}

std::optional<Orientation> slicer_space(std::string_view letters) {
    const auto named = Orientation::named(letters);
    return named && std::ranges::find(kSlicerSpaces, *named) != kSlicerSpaces.end() ? named : std::nullopt;
}

std::string space_word(const Orientation& axes) { return "SPACE=" + axes.letters(); }

std::optional<Orientation> space_in(std::string_view text) {
    std::size_t first = std::string_view::npos;
    std::optional<Orientation> said;
    for (const Orientation& axes : kSlicerSpaces)
        if (const std::size_t at = text.find(space_word(axes)); at < first) first = at, said = axes;
    return said;
}

std::string axes_word(const Orientation& axes, const tree::Claims& claims) {
    return claims.has_sides() ? axes.letters() : std::string(tree::kNotSaid);
}

Result<void> check_axes(const Orientation& axes, const tree::Claims& claims, const std::string& where) {
    if (axes == Orientation::ras() || claims.has_sides()) return {};
    return fail("the axes of the tree are unknown: they cannot be converted to " + axes.letters(), where,
                "state them with --orientation, as RAS");
}

std::vector<Orientation> all_orientations() {
    std::vector<Orientation> all;
    for (const Side x : kSides)
        for (const Side y : kSides)
            for (const Side z : kSides)
                if (const auto one = Orientation::leading_to({x, y, z})) all.push_back(*one);
    std::stable_partition(all.begin(), all.end(), [](const Orientation& one) { return !one.mirrors(); });
    return all;
}

} // namespace ramus::io
