#include "core/io/volumes/nrrd_space.h"

#include "core/io/input_file.h"
#include "core/io/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <optional>

namespace ramus::io {

namespace {

// An axis of the file, and the step along it if it is spatial.
struct NrrdAxis {
    std::int64_t extent = 1;
    std::string kind; // lower case; empty: not said
    bool of_space = true;
    std::optional<glm::dvec3> direction;
};

// The first three numbers of "(1,0,0)". In spaces with time, the fourth is time.
std::optional<glm::dvec3> vector_in(std::string_view text) {
    if (text.size() < 2 || text.front() != '(' || text.back() != ')') return std::nullopt;
    std::string inner(text.substr(1, text.size() - 2));
    std::ranges::replace(inner, ',', ' ');
    const auto numbers = numbers_in(inner);
    if (!numbers || numbers->empty() || numbers->size() > 4) return std::nullopt;
    glm::dvec3 vector(0.0);
    for (std::size_t n = 0; n < std::min<std::size_t>(numbers->size(), 3); ++n)
        vector[static_cast<int>(n)] = (*numbers)[n];
    return vector;
}

// "none (1,0,0) (0,1,0)", with blanks in the parentheses or not.
Result<void> read_directions(const HeaderText& header, const std::string& text, std::vector<NrrdAxis>& axes) {
    std::string_view left = trimmed(text);
    for (NrrdAxis& axis : axes) {
        const bool in_parentheses = left.starts_with('(');
        const std::size_t end = in_parentheses ? left.find(')') : std::min(left.find_first_of(" \t"), left.size());
        if (left.empty() || end == std::string_view::npos)
            return header.refused("space directions", "does not hold a vector for each axis");
        const std::string_view word = left.substr(0, in_parentheses ? end + 1 : end);
        if (lower_case(word) == "none") {
            axis.of_space = false;
        } else {
            axis.direction = vector_in(word);
            if (!axis.direction)
                return header.refused("space directions", "holds what is no vector: " + std::string(word));
        }
        left = trimmed(left.substr(word.size()));
    }
    if (!left.empty()) return header.refused("space directions", "holds more vectors than there are axes");
    return {};
}

// Kinds of spatial axes. All others hold several values of one position, or another time.
bool is_kind_of_space(const std::string& kind) {
    return kind.empty() || kind == "???" || kind == "none" || kind == "domain" || kind == "space";
}

Result<std::vector<NrrdAxis>> nrrd_axes(const HeaderText& header) {
    RAMUS_TRY(dimension, header.whole_number({"dimension"}));
    constexpr std::int64_t kMostAxes = 16; // NRRD_DIM_MAX
    if (!dimension || *dimension < 1 || *dimension > kMostAxes)
        return header.refused("dimension", "is no number from 1 to 16");
    std::vector<NrrdAxis> axes(static_cast<std::size_t>(*dimension));
    const std::string* sizes = header.find({"sizes"});
    const auto extents = whole_numbers_in(sizes == nullptr ? "" : *sizes);
    if (!extents || extents->size() != axes.size()) return header.refused("sizes", "does not hold one for each axis");
    for (std::size_t n = 0; n < axes.size(); ++n) axes[n].extent = (*extents)[n];
    if (const std::string* kinds = header.find({"kinds"})) {
        std::vector<std::string_view> words;
        split_words(*kinds, " \t", words);
        if (words.size() != axes.size()) return header.refused("kinds", "does not hold one for each axis");
        for (std::size_t n = 0; n < axes.size(); ++n) {
            axes[n].kind = lower_case(words[n]);
            axes[n].of_space = is_kind_of_space(axes[n].kind);
        }
    }
    if (const std::string* directions = header.find({"spacedirections"})) {
        for (NrrdAxis& axis : axes) axis.of_space = true; // these say it better than kinds
        if (auto read = read_directions(header, *directions, axes); !read) return tl::unexpected(read.error());
    }
    return axes;
}

// The number of layers along the first axis. 1: it has no layers.
std::size_t layers_of(const std::vector<NrrdAxis>& axes, ListAxis list) {
    constexpr std::int64_t kMostLayers = 4096;
    const NrrdAxis& first = axes.front();
    const bool is_list = !first.of_space && (first.kind == "list" || first.kind == "vector");
    const bool is_taken = list == ListAxis::kLayers && is_list && first.extent > 1 && first.extent <= kMostLayers;
    return is_taken ? static_cast<std::size_t>(first.extent) : 1;
}

Result<void> check_other_axes(const std::vector<NrrdAxis>& axes, std::size_t layers, const std::string& name) {
    bool before_space = true;
    for (std::size_t n = layers > 1 ? 1 : 0; n < axes.size(); ++n) {
        const NrrdAxis& axis = axes[n];
        before_space = before_space && !axis.of_space;
        if (axis.of_space || axis.extent == 1) continue;
        const std::string count = std::to_string(axis.extent);
        const std::string which =
            " (axis " + std::to_string(n + 1) + (axis.kind.empty() ? "" : ", of kind \"" + axis.kind + "\"") + ")";
        return fail(before_space ? "each of its voxels holds " + count + " values" + which
                                 : "it holds " + count + " volumes" + which,
                    name, "write the one that is meant to a file of its own");
    }
    return {};
}

// Signs that turn the axes of the file's space to right, anterior, superior.
Result<glm::dvec3> signs_of_space(const HeaderText& header, std::vector<std::string>& notes) {
    const std::string* text = header.find({"space"});
    std::string word = text == nullptr ? "" : lower_case(*text);
    if (word.ends_with("-time")) word.resize(word.size() - 5);
    if (word.size() == 4 && word.back() == 't') word.pop_back();
    if (word == "right-anterior-superior" || word == "ras") return glm::dvec3(1, 1, 1);
    if (word == "left-anterior-superior" || word == "las") return glm::dvec3(-1, 1, 1);
    if (word == "left-posterior-superior" || word == "lps") return glm::dvec3(-1, -1, 1);
    constexpr std::array<std::string_view, 4> kNoPatient = {"", "scanner-xyz", "3d-right-handed", "3d-left-handed"};
    if (std::ranges::find(kNoPatient, word) == kNoPatient.end())
        return header.refused("space", "is not known: " + *text);
    notes.push_back(std::string(volume::kLeavesSidesOpen) + ": axes taken as right, anterior, superior");
    return glm::dvec3(1, 1, 1);
}

// The length of the file's unit in mm. None: it names no known unit.
std::optional<double> unit_of_space(const HeaderText& header, std::vector<std::string>& notes) {
    const std::string* text = header.find({"spaceunits", "units"});
    std::string_view left = text == nullptr ? std::string_view() : *text;
    // The first known unit among the quoted words, one for each axis.
    while (!left.empty()) {
        const std::size_t begin = left.find('"');
        const std::size_t end = begin == std::string_view::npos ? begin : left.find('"', begin + 1);
        if (end == std::string_view::npos) break;
        const std::string_view word = left.substr(begin + 1, end - begin - 1);
        if (const auto mm = named_unit_mm(trimmed(word))) return mm;
        if (!trimmed(word).empty()) {
            notes.emplace_back("the file has an unknown unit of length, \"" + std::string(word) + '"');
            return std::nullopt;
        }
        left = left.substr(end + 1);
    }
    return std::nullopt;
}

// Directions and origin from spacings and axis minima, if the file has no directions.
Result<glm::dvec3> take_spacings(const HeaderText& header, std::vector<NrrdAxis>& axes,
                                 const std::vector<std::size_t>& of_space, std::vector<std::string>& notes) {
    RAMUS_TRY(spacings, header.numbers({"spacings"}, axes.size()));
    RAMUS_TRY(least, header.numbers({"axismins"}, axes.size()));
    const std::string* words = header.find({"centerings", "centers"});
    std::vector<std::string_view> centers;
    if (words != nullptr) split_words(*words, " \t", centers);
    glm::dvec3 origin(0.0);
    bool known = true;
    for (std::size_t n = 0; n < of_space.size() && n < 3; ++n) {
        const std::size_t axis = of_space[n];
        const int row = static_cast<int>(n);
        const bool given = spacings && std::isfinite((*spacings)[axis]) && (*spacings)[axis] != 0.0;
        known = known && given;
        const double spacing = given ? (*spacings)[axis] : 1.0;
        axes[axis].direction = glm::dvec3(0.0);
        (*axes[axis].direction)[row] = spacing;
        // The axis minimum is at the border of the first voxel, unless the values are centred on nodes.
        const bool of_points = axis < centers.size() && lower_case(centers[axis]) == "node";
        if (least && std::isfinite((*least)[axis])) origin[row] = (*least)[axis] + (of_points ? 0.0 : 0.5 * spacing);
    }
    if (!known) notes.emplace_back("the file does not say how far voxels are apart: taken as 1 mm");
    return origin;
}

} // namespace

Result<NrrdSpace> nrrd_space(const HeaderText& header, ListAxis list, std::vector<std::string>& notes) {
    RAMUS_TRY(axes, nrrd_axes(header));
    const std::size_t layers = layers_of(axes, list);
    if (auto alone = check_other_axes(axes, layers, header.file); !alone) return tl::unexpected(alone.error());
    std::vector<std::size_t> of_space;
    std::vector<std::int64_t> extents;
    for (std::size_t n = 0; n < axes.size(); ++n)
        if (axes[n].of_space) of_space.push_back(n), extents.push_back(axes[n].extent);
    if (of_space.empty()) return header.refused("kinds", "names no axis of space");
    RAMUS_TRY(size, checked_size(extents, header.file));
    glm::dvec3 origin(0.0);
    if (!axes[of_space.front()].direction) {
        RAMUS_TRY(from_axes, take_spacings(header, axes, of_space, notes));
        origin = from_axes;
    }
    if (const std::string* text = header.find({"spaceorigin"})) {
        const auto vector = vector_in(trimmed(*text));
        if (!vector) return header.refused("space origin", "is no vector");
        origin = *vector;
    }
    RAMUS_TRY(signs, signs_of_space(header, notes));
    const std::optional<double> unit_mm = unit_of_space(header, notes);
    const double mm = unit_mm.value_or(1.0);
    std::array<glm::dvec3, 3> steps{glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)};
    for (std::size_t n = 0; n < of_space.size() && n < 3; ++n) steps[n] = mm * *axes[of_space[n]].direction;
    if (of_space.size() == 2) steps[2] = slice_axis(steps[0], steps[1]);
    NrrdSpace space{.size = size, .layers = layers, .unit_mm = unit_mm};
    for (int column = 0; column < 3; ++column)
        space.to_patient[column] = glm::dvec4(signs * steps[static_cast<std::size_t>(column)], 0.0);
    space.to_patient[3] = glm::dvec4(mm * signs * origin, 1.0);
    auto sound = check_affine(space.to_patient, size, "geometry (space directions, space origin)",
                              "correct where its voxels lie and write it again", header.file);
    if (!sound) return tl::unexpected(sound.error());
    return space;
}

} // namespace ramus::io
