// Objects of the scene: what a session has next to the tree. The set is closed: for_each_object()
// goes through all kinds, and the function that it calls has a function for each kind, so that
// a kind without one does not compile.
//
// Every object has an id that is its own as long as it is in the session, a name that a person may give, and says
// whether it is visible. Values only: what is read from files is among the assets (app/assets/assets.h).
#pragma once

#include "core/measure/branch_point.h"
#include "core/volume/label_choice.h"

#include <array>
#include <concepts>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

inline constexpr int kNoObject = 0;    // the id of none
inline constexpr int kLostObject = -1; // of an object that a session file names and does not have

// A sphere, or a closed mesh from a file.
struct Lesion {
    static constexpr std::string_view kNoun = "lesion";
    std::array<double, 4> sphere{}; // centre and radius, mm, RAS; of a lesion without a file
    std::string file{};             // of a mesh, absolute; empty: a sphere
    std::string axes{};             // of a mesh that does not state them: "LPS"; empty: nobody has said
    int id = kNoObject;
    std::string name{};
    bool visible = true; // in the picture; margins and distances are those of all lesions
    [[nodiscard]] bool is_mesh() const { return !file.empty(); }
    bool operator==(const Lesion&) const = default;
};

// A distance, path, diameter or angle that is kept.
struct Measurement {
    static constexpr std::string_view kNoun = "measurement";
    enum class Kind { kDistance, kPath, kDiameter, kAngle };
    Kind kind = Kind::kDistance;
    std::array<glm::dvec3, 2> points{};               // kDistance: mm, RAS
    std::array<int, 2> lesions{kNoObject, kNoObject}; // kDistance: ids of the lesions that these points lie on
    // kDistance: the shortest from the surface of the first of `lesions` to the wall of the branch of the first of
    // `places`; there are no points.
    bool shortest = false;
    // The places on centerlines that the others are of. kPath: from the first to the second. kDiameter: at the first.
    // kAngle: at the second, between the straight lines to the first and the third; of one alone, where its branch
    // begins.
    std::array<measure::BranchPlace, 3> places{};
    int id = kNoObject;
    std::string name{};
    bool visible = true;
    bool operator==(const Measurement&) const = default;
};

[[nodiscard]] std::size_t point_count(const Measurement& measurement); // of `points`
[[nodiscard]] std::size_t place_count(const Measurement& measurement); // of `places`
// An angle where a branch begins: it has no place that could be moved.
[[nodiscard]] bool of_branching(const Measurement& measurement);
[[nodiscard]] bool names_lesion(const Measurement& measurement);
[[nodiscard]] bool measure_alike(const Measurement& a, const Measurement& b); // whatever they are called

// A surface in the coordinates of the tree: an organ, a bone, another surface of the vessels.
struct ContextItem {
    static constexpr std::string_view kNoun = "context";
    std::string file;                                  // absolute: a mask or a mesh (STL, PLY, OBJ)
    volume::LabelChoice label;                         // of a mask: this one alone; none: everything that is not zero
    std::array<std::uint8_t, 3> colour{201, 130, 104}; // sRGB
    double opacity = 0.25;                             // where it faces the eye; 1: solid
    bool wireframe = false, visible = true;
    bool exact = false;               // of a mask: with the steps of its voxels
    std::string units;                // of the file's lengths, "cm"; empty: as it says itself
    std::optional<double> isovalue{}; // of a scan: what is at least that is inside
    std::string axes{};               // of a mesh that does not state them: "LPS"; empty: nobody has said
    int id = kNoObject;
    std::string name{};
    bool operator==(const ContextItem&) const = default;
};

// A text that a person pinned to a place: its name.
struct Pin {
    static constexpr std::string_view kNoun = "pin";
    glm::dvec3 at{0.0}; // mm, RAS
    int id = kNoObject;
    std::string name{};
    bool visible = true;
    bool operator==(const Pin&) const = default;
};

template <class T>
concept SceneObject = std::equality_comparable<T> && requires(T object) {
    {std::string_view(T::kNoun)}; // what people call the kind, "lesion"
    { object.id + 0 } -> std::same_as<int>;
    {std::string(object.name)};
    { !object.visible } -> std::same_as<bool>;
};

// The lists of all kinds. A kind is listed here, and nowhere else.
struct SceneObjects {
    std::vector<Lesion> lesions;      // spheres first, then meshes; a lesion's number is its place, from 1
    std::vector<ContextItem> context; // in the order in which they came
    std::vector<Measurement> measurements;
    std::vector<Pin> pins;
    bool operator==(const SceneObjects&) const = default;
};
void for_each_object_list(auto& objects, const auto& call) {
    call(objects.lesions);
    call(objects.context);
    call(objects.measurements);
    call(objects.pins);
}
void for_each_object(auto& objects, const auto& call) {
    for_each_object_list(objects, [&](auto& list) {
        for (SceneObject auto& object : list) call(object);
    });
}

} // namespace ramus::app
