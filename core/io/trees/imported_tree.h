// What the reader of a tree format finds, in the file's own numbers, and the one step that makes a VesselTree of it:
// unit, axes, radius or diameter, radii that belong to edges, polylines that meet or repeat each other. Readers only
// say what stands in the file; what it means is decided here, so that every format is treated alike, and whatever the
// file does not say becomes a note that tells how to change it.
#pragma once

#include "core/base/error.h"
#include "core/io/length_unit.h"
#include "core/io/orientation.h"
#include "core/tree/build_tree.h"
#include "core/volume/label_choice.h"

#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::io {

enum class RadiusIs : std::uint8_t { kRadius, kDiameter };

// How a segmentation mask becomes a tree; what is none is as usual.
struct MaskReading {
    // Those of each system; empty: all of them together are one. None: each is a system of its own.
    std::optional<std::vector<std::vector<volume::LabelChoice>>> labels;
    // As in volume::SkeletonizeOptions.
    std::optional<double> bulge_size, islands_mm;
    std::optional<bool> fill_holes;
    std::optional<double> isovalue; // of a scan: what is at least that is vessel; its values are no labels then
    std::optional<glm::dvec3> root;
    bool operator==(const MaskReading&) const = default;
};

// What a person says about a file, against what it says or is taken for.
struct ReadOptions {
    tree::Repair repair = tree::Repair::kUsual;
    std::optional<LengthUnit> unit;
    std::optional<RadiusIs> radius_is;
    std::optional<Orientation> orientation;     // where the file's axes lead
    std::optional<double> radius_mm;            // of points whose radius the file does not give
    std::map<std::string, std::string> columns; // of tables: what is read (x, y, z, radius, from, to) by its column
    std::string data_checksum;                  // its SHA-256 (core/io/checksum.h); empty: any
    std::string data;                           // a table of further data of branches (branch_table.h); empty: none
    MaskReading mask;
    bool operator==(const ReadOptions&) const = default;
};

// How polylines that have points of their own hang together.
enum class Joining : std::uint8_t {
    kByIndex,          // they share points
    kAtCoincidingEnds, // where an end of one lies at a point of another
    kAtAnyPoint,       // where points lie at the same place
};

struct ImportedTree {
    tree::Graph graph;                      // positions, radii and edges as they stand in the file
    std::vector<double> edge_radii;         // where radii belong to edges: one for each of graph.edges; else empty
    std::optional<LengthUnit> unit;         // that the file states
    std::optional<Orientation> orientation; // that the file states
    RadiusIs radius_is = RadiusIs::kRadius;
    std::string radius_name; // "thickness": what the file calls it, where that leaves open which of both it is
    Joining joining = Joining::kByIndex;
    bool edges_are_vessels = false;    // also where several connect the same two points: none of them repeats another
    bool pieces_are_meant = false;     // what the file leaves apart is apart: open ends are not joined
    bool may_repeat_trunks = false;    // polylines may each begin at the root, as VMTK's centerlines do
    std::string unit_hint;             // what speaks for another unit than mm, where the file states none; may be empty
    std::optional<glm::dmat3> voxel;   // of the mask that the tree was made of: its edges, in the file's own numbers
    std::vector<std::string> left_out; // names of arrays that are no single numbers: texts, vectors
    std::vector<tree::Note> notes;
    std::string source;                                 // the file that the tree came from first, where it says so
    std::function<std::string(std::uint32_t)> place_of; // of a point of `graph`, for messages: "liver.swc:41"

    void assume(std::string topic, std::string text) {
        notes.push_back({tree::Note::Kind::kAssumed, std::move(topic), std::move(text), {}});
    }

    // The file is one that ramus wrote of a tree: nothing is left open but what was open then. The words are those of
    // tree::Claims.
    void take_as_written(std::string_view unit_word = "mm", std::string_view axes_word = "RAS") {
        unit = unit_word == "mm" ? std::optional(LengthUnit{}) : std::nullopt;
        orientation = Orientation::named(axes_word); // none of tree::kNotSaid
        pieces_are_meant = true;
    }
};

// Fails like tree::build_tree, on numbers of the wrong length, and on a radius that no point has.
[[nodiscard]] Result<tree::VesselTree> tree_of(ImportedTree imported, const ReadOptions& options);

} // namespace ramus::io
