// ImportedTree: the content of a tree file in the file's own numbers, as its reader finds it; and tree_of(), which
// converts it to a VesselTree. A reader only reports what the file says. tree_of() decides what it means, in the same
// way for all formats: unit, axes, radius or diameter, radii of edges, polylines that meet or repeat each other. Each
// assumption becomes a note that tells how to change it.
#pragma once

#include "core/base/error.h"
#include "core/io/length_unit.h"
#include "core/io/orientation.h"
#include "core/io/volumes/volume_part.h"
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

// How a segmentation mask becomes a tree. None: the default.
struct MaskReading {
    // The labels of each system. Empty: all labels are one system. None: each label is a system of its own.
    std::optional<std::vector<std::vector<volume::LabelChoice>>> labels;
    // As in volume::SkeletonizeOptions.
    std::optional<double> bulge_size, islands_mm;
    std::optional<bool> fill_holes;
    std::optional<double> isovalue; // of a scan: voxels of at least this value are vessel; values are not labels then
    std::optional<glm::dvec3> root;
    bool operator==(const MaskReading&) const = default;
};

// Options of a person for reading a file. They override the file's statements and the reader's assumptions.
struct ReadOptions {
    tree::Repair repair = tree::Repair::kUsual;
    std::optional<LengthUnit> unit;
    std::optional<RadiusIs> radius_is;
    std::optional<Orientation> orientation;     // of the file's axes
    std::optional<double> radius_mm;            // for points without a radius in the file
    std::map<std::string, std::string> columns; // of tables: the column for each of id, x, y, z, radius, from, to
    std::string data_checksum;                  // SHA-256 of `data` (core/io/checksum.h); empty: not checked
    std::string data;                           // path of a table of branch data (branch_table.h); empty: none
    VolumePart part;                            // of volumes whose files hold several
    MaskReading mask;
    bool operator==(const ReadOptions&) const = default;
};

// How the polylines of a file are connected.
enum class Joining : std::uint8_t {
    kByIndex,          // by shared points
    kAtCoincidingEnds, // where the end of a polyline has the position of a point of another one
    kAtAnyPoint,       // where any two points have the same position
};

struct ImportedTree {
    tree::Graph graph;                      // positions, radii and edges in the file's own numbers
    std::vector<double> edge_radii;         // for each of graph.edges, if radii belong to edges; else empty
    std::optional<LengthUnit> unit;         // stated by the file
    std::optional<Orientation> orientation; // stated by the file
    RadiusIs radius_is = RadiusIs::kRadius;
    std::string radius_name; // the file's name for the width ("thickness"), if it can mean radius or diameter
    Joining joining = Joining::kByIndex;
    bool edges_are_vessels = false;    // parallel edges between the same two points are different vessels
    bool pieces_are_meant = false;     // unconnected pieces are intended: open ends are not joined
    bool may_repeat_trunks = false;    // polylines may all begin at the root, as VMTK's centerlines do
    std::string unit_hint;             // evidence for another unit than mm, if the file states none; may be empty
    std::optional<glm::dmat3> voxel;   // edges of a voxel of the source mask, one a column, in the file's own numbers
    std::vector<std::string> left_out; // names of arrays that are not one number each: texts, vectors
    std::vector<tree::Note> notes;
    std::string source;                                 // the original file of the tree, if the file states it
    std::function<std::string(std::uint32_t)> place_of; // place of a point of `graph` in messages: "liver.swc:41"

    void assume(std::string topic, std::string text) {
        notes.push_back({tree::Note::Kind::kAssumed, std::move(topic), std::move(text), {}});
    }

    // For files that ramus wrote: unit and axes are as stated, also if stated as unknown. The words are those of
    // tree::Claims.
    void take_as_written(std::string_view unit_word = "mm", std::string_view axes_word = "RAS") {
        unit = unit_word == "mm" ? std::optional(LengthUnit{}) : std::nullopt;
        orientation = Orientation::named(axes_word); // none of tree::kNotSaid
        pieces_are_meant = true;
    }
};

// Converts to a tree in mm and RAS (unless unknown), with notes and claims. Fails like tree::build_tree(), and on
// arrays of a wrong length and edges to missing points.
[[nodiscard]] Result<tree::VesselTree> tree_of(ImportedTree imported, const ReadOptions& options);

} // namespace ramus::io
