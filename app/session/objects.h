// Objects of the scene: everything a session has next to the tree. The set of kinds is closed: for_each_object() visits
// all kinds, and its callback needs an overload for each, so a missing kind does not compile.
//
// Every object has an id that is unique within the session, an optional name and a visibility. Plain values: data read
// from files is in app/assets/assets.h.
#pragma once

#include "core/io/volumes/volume_part.h"
#include "core/measure/branch_point.h"
#include "core/organ/resect/sheet.h"
#include "core/slice/window.h"
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

inline constexpr int kNoObject = 0;    // no object
inline constexpr int kLostObject = -1; // an object that a session file refers to but does not contain

using Rgb = std::array<std::uint8_t, 3>; // sRGB
// The same from 0 to 1.
[[nodiscard]] inline glm::vec3 srgb_of(const Rgb& colour) {
    return glm::vec3(colour[0], colour[1], colour[2]) / 255.0F;
}

// A sphere, a closed mesh from a file, or a part of a mask.
struct Lesion {
    static constexpr std::string_view kNoun = "lesion";
    std::array<double, 4> sphere{};            // centre and radius, mm, RAS; unused for meshes
    std::string file{};                        // absolute path of a mesh or mask; empty: a sphere
    std::string axes{};                        // of a mesh that does not state them: "LPS"; empty: not specified
    std::vector<volume::LabelChoice> labels{}; // of a mask; each is divided on its own; empty: all
    std::string units{};                       // of a mask's lengths; empty: as the file says
    int part = 0; // of a mask: which of its parts that do not touch, from 1, the largest first; 0: not of a mask
    int id = kNoObject;
    std::string name{};
    bool visible = true; // margins and distances always use all lesions
    Rgb colour{204, 199, 66};
    double opacity = 0.6;                                        // where it faces the eye
    [[nodiscard]] bool is_mesh() const { return !file.empty(); } // drawn and measured as one, also if of a mask
    [[nodiscard]] bool of_mask() const { return part > 0; }
    bool operator==(const Lesion&) const = default;
};

// A measured distance, path, diameter or angle.
struct Measurement {
    static constexpr std::string_view kNoun = "measurement";
    enum class Kind { kDistance, kPath, kDiameter, kAngle };
    Kind kind = Kind::kDistance;
    std::array<glm::dvec3, 2> points{};               // kDistance: mm, RAS
    std::array<int, 2> lesions{kNoObject, kNoObject}; // kDistance: the lesions on which the points lie
    // kDistance: the shortest distance between the surface of lesions[0] and the wall of the branch of places[0];
    // `points` is unused.
    bool shortest = false;
    // Places on centerlines for the other kinds. kPath: from the first to the second. kDiameter: at the first. kAngle:
    // at the second, between the straight lines to the first and the third; with one place, at the start of its branch.
    std::array<measure::BranchPlace, 3> places{};
    int id = kNoObject;
    std::string name{};
    bool visible = true;
    Rgb colour{140, 237, 209};
    bool operator==(const Measurement&) const = default;
};

[[nodiscard]] std::size_t point_count(const Measurement& measurement); // used entries of `points`
[[nodiscard]] std::size_t place_count(const Measurement& measurement); // used entries of `places`
// An angle at the start of a branch, which has no movable place.
[[nodiscard]] bool of_branching(const Measurement& measurement);
[[nodiscard]] bool names_lesion(const Measurement& measurement);
[[nodiscard]] bool measure_alike(const Measurement& a,
                                 const Measurement& b); // equal except for id, name, visibility and colour

// A surface in the coordinates of the tree: an organ, a bone, another surface of the vessels.
struct ContextItem {
    static constexpr std::string_view kNoun = "context";
    std::string file;          // absolute path: a mask or a mesh (STL, PLY, OBJ)
    volume::LabelChoice label; // of a mask: only this label; none: everything but 0
    Rgb colour{201, 130, 104};
    double opacity = 0.25; // where it faces the eye; 1: opaque
    bool wireframe = false, visible = true;
    bool exact = false;               // of a mask: keep the steps of its voxels
    std::string units;                // of the file's lengths, "cm"; empty: as the file says
    std::optional<double> isovalue{}; // of a scan: threshold
    std::string axes{};               // of a mesh that does not state them: "LPS"; empty: not specified
    int id = kNoObject;
    std::string name{};
    bool operator==(const ContextItem&) const = default;
};

// A text pinned to a place; the text is the name.
struct Pin {
    static constexpr std::string_view kNoun = "pin";
    glm::dvec3 at{0.0}; // mm, RAS
    int id = kNoObject;
    std::string name{};
    bool visible = true;
    Rgb colour{250, 204, 89};
    bool operator==(const Pin&) const = default;
};

// A part of the organ that an operation removes.
struct Resection {
    static constexpr std::string_view kNoun = "resection";
    enum class Kind : std::uint8_t { kPlane, kSheet, kSurface, kCuts, kLesion };
    Kind kind = Kind::kPlane;
    glm::dvec3 point{0.0}, normal{0.0, 0.0, 1.0}; // kPlane: removed is what the normal, of unit length, points to
    organ::Sheet sheet{};                         // kSheet
    std::string file{};                           // kSurface: absolute path of a mesh; of a closed one the inside goes
    std::string axes{};                           // of a mesh that does not state them: "LPS"; empty: not specified
    bool other_side = false;                      // kSurface: the other side goes
    double margin_mm = 0.0; // around what the cuts take away (kCuts), or around a lesion (kLesion)
    int lesion = kNoObject; // kLesion: its id
    int id = kNoObject;
    std::string name{};
    bool visible = true; // hidden ones are still carried out
    Rgb colour{233, 226, 206};
    double opacity = 0.6;
    bool operator==(const Resection&) const = default;
};

// A volume that slices show: a scan in grey, or a segmentation as tinted labels over it.
struct Scan {
    static constexpr std::string_view kNoun = "scan";
    std::string file;                      // absolute path of a volume: a file, or a folder (DICOM, TIFF, Zarr)
    std::string checksum;                  // of the file; empty: unknown
    std::string units{};                   // of the file's lengths; empty: as the file says
    io::VolumePart part{};                 // of a file that holds several volumes
    bool labels = false;                   // a segmentation
    std::optional<slice::Window> window{}; // none: what the file proposes, or from its values
    int id = kNoObject;
    std::string name{};
    bool visible = true;
    Rgb colour{235, 190, 90}; // of labels to which the file gives no colour, if there is one label
    double opacity = 1.0;     // over the scans before it in the list
    bool operator==(const Scan&) const = default;
};

template <class T>
concept SceneObject = std::equality_comparable<T> && requires(T object) {
    {std::string_view(T::kNoun)}; // the kind in messages, "lesion"
    { object.id + 0 } -> std::same_as<int>;
    {std::string(object.name)};
    { !object.visible } -> std::same_as<bool>;
    {Rgb(object.colour)};
};
// A kind that is drawn as a surface.
template <class T>
concept SurfaceObject = SceneObject<T> && requires(T object) {
    { object.opacity + 0.0 } -> std::same_as<double>; // 0 to 1
};

// The lists of all kinds. for_each_object_list() below is the only enumeration of kinds.
struct SceneObjects {
    std::vector<Lesion> lesions;      // spheres first, then meshes; a lesion's number is its index + 1
    std::vector<ContextItem> context; // in order of addition
    std::vector<Measurement> measurements;
    std::vector<Pin> pins;
    std::vector<Resection> resections; // of the current plan
    std::vector<Scan> scans;           // painted in this order
    // The first visible scan in grey: whose window a person changes, and in which regions grow. Null: none.
    [[nodiscard]] const Scan* grey_scan() const {
        for (const Scan& scan : scans)
            if (scan.visible && !scan.labels) return &scan;
        return nullptr;
    }
    bool operator==(const SceneObjects&) const = default;
};
void for_each_object_list(auto& objects, const auto& call) {
    call(objects.lesions);
    call(objects.context);
    call(objects.measurements);
    call(objects.pins);
    call(objects.resections);
    call(objects.scans);
}
void for_each_object(auto& objects, const auto& call) {
    for_each_object_list(objects, [&](auto& list) {
        for (SceneObject auto& object : list) call(object);
    });
}

} // namespace ramus::app
