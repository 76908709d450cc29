// VesselTree: the centerlines of vessels with a radius at every point, cut into branches, with the hierarchy of the
// flow from the root. A plain value: build it with build_tree(), and derive others with smooth() and prune().
//
// Positions and radii are in mm, positions in RAS (see Claims for files that do not say so).
// Guarantees (after build_tree): every branch has at least two points and positive length between consecutive points;
// every radius is positive and finite; branch ids are indices into `branches`, stable for a given file; a branch's
// points run from its parent's end outward. Networks with loops and several components are legal: the hierarchy is then
// a spanning tree from the roots, and `loop_count` is the number of branches that close a loop.
#pragma once

#include "core/tree/data_array.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::tree {

// A centerline point: position in mm (RAS), radius in mm.
struct Point {
    glm::dvec3 position{0.0};
    double radius = 0.0;
    bool operator==(const Point&) const = default;
};

inline constexpr int kNoBranch = -1;

// A run of points between two nodes of degree other than 2 (a node on a pure cycle counts as one).
struct Branch {
    std::vector<std::uint32_t> points; // indices into VesselTree::points, from the parent's end outward, nodes included
    int parent = kNoBranch;            // branch id, or kNoBranch at a root
    std::vector<int> children;         // branch ids, ascending
    int generation = 0;                // 0 at a root, parent's + 1 elsewhere
    int strahler = 1;                  // Strahler order: 1 at a leaf
    int system = 0;                    // index into VesselTree::systems, 0 where there are none
    bool operator==(const Branch&) const = default;
};

// Vessels that carry blood, or air, of one kind: the portal vein, the hepatic vein, an artery. Systems are never
// connected with each other.
struct System {
    std::string name;
    std::array<std::uint8_t, 3> colour{}; // sRGB
    bool operator==(const System&) const = default;
};

// A note of the reader of a tree: an assumption, a repair, or a suspicious place.
struct Note {
    enum class Kind : std::uint8_t { kAssumed, kRepaired, kSuspect };
    Kind kind = Kind::kAssumed;
    std::string topic;            // "units", "zero-radii": the option or repair that changes it
    std::string text;             // one sentence
    std::optional<glm::dvec3> at; // mm, RAS; none: the note is about the whole tree
    // Topic kCutEnds only: the border of the volume cuts the end of a vessel at `at`. The outward unit normal of the
    // border there.
    std::optional<glm::dvec3> outward{};
    bool operator==(const Note&) const = default;
};

inline constexpr std::string_view kCutEnds = "cut-ends";

// The source of the claim that lengths are mm, or that axes are RAS. Without a source (kNobody) the numbers are in the
// file's own unit and axes. Computations then treat them as mm and RAS, but no unit and no side may be shown.
enum class SaidBy : std::uint8_t { kFile, kPerson, kNobody };
struct Claims {
    SaidBy unit = SaidBy::kFile;        // that lengths are mm
    SaidBy orientation = SaidBy::kFile; // that axes lead to the right, anterior, superior
    [[nodiscard]] bool has_unit() const { return unit != SaidBy::kNobody; }
    [[nodiscard]] bool has_sides() const { return orientation != SaidBy::kNobody; }
    [[nodiscard]] bool complete() const { return has_unit() && has_sides(); }
    // What both state together: each claim of the weaker source.
    [[nodiscard]] Claims with(const Claims& other) const {
        return {std::max(unit, other.unit), std::max(orientation, other.orientation)};
    }
    // The words in files: "mm" and "RAS", or kNotSaid.
    [[nodiscard]] std::string_view unit_word() const;
    [[nodiscard]] std::string_view axes_word() const;
    // Adapts a text for people with lengths in mm: "3 mm" becomes "3 units" if the unit is not known.
    [[nodiscard]] std::string worded(std::string_view text) const;
    bool operator==(const Claims&) const = default;
};
inline constexpr std::string_view kNotSaid = "unknown";

[[nodiscard]] std::string_view name_of(SaidBy who); // "file", "person", "nobody"

// The grid of voxels that the points come from (core/tree/voxels.h).
struct Voxels {
    glm::dmat3 edges_mm{0.0}; // columns: the three edges of a voxel
    bool estimated = false;   // estimated from the points, since the file does not contain it
    bool operator==(const Voxels&) const = default;
};

struct VesselTree {
    std::vector<Point> points;
    std::vector<int> labels; // per point, the file's label (SWC type code); empty if the file has none
    std::vector<Branch> branches;
    DataArrays point_data, branch_data; // further data of the file
    std::vector<std::uint32_t> roots;   // point index of the root of each component, in file order
    int loop_count = 0;                 // independent cycles (edges - nodes + components)
    std::vector<System> systems;        // empty: all branches belong to one system without a name
    std::string source;                 // name of the original file; empty if unknown
    std::vector<Note> notes;            // assumptions, repairs and suspicions of the reader
    Claims claims;                      // whether units and axes are known
    std::optional<Voxels> voxels;       // none: the points do not come from voxels, or the voxels are unknown

    [[nodiscard]] std::size_t segment_count() const;
    bool operator==(const VesselTree&) const = default;
};

// The notes of one kind, as sentences.
[[nodiscard]] std::vector<std::string> sentences(const VesselTree& tree, Note::Kind kind);

[[nodiscard]] std::string_view name_of(Note::Kind kind); // "assumed", "repaired", "suspect"

// Notes of one kind about one topic, as indices into `VesselTree::notes`.
struct NoteGroup {
    Note::Kind kind = Note::Kind::kAssumed;
    std::string topic;
    std::vector<std::size_t> notes; // ascending
};
// All notes: suspicions first, then repairs, then assumptions; topics in the order of their first note.
[[nodiscard]] std::vector<NoteGroup> note_groups(const VesselTree& tree);

// Length of one branch's centerline in mm.
[[nodiscard]] double length_mm(const VesselTree& tree, const Branch& branch);

// The branch and its dependents (the branches that are reached only through it): ascending ids. Takes time linear in
// the size of the tree. Callers that query repeatedly should use core/tree/dependency.h.
[[nodiscard]] std::vector<int> subtree(const VesselTree& tree, int branch);

} // namespace ramus::tree
