// From points and edges to a VesselTree: repairs what can be repaired, cuts the graph into branches, and finds the
// hierarchy from the roots. Any graph is legal: loops, several components, nodes of any degree, chains of any length.
#pragma once

#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::tree {

// What may be mended, as a set.
enum class Repair : unsigned {
    kNone = 0,
    kZeroRadii = 1,         // a radius of 0 is interpolated from positive radii (core/tree/missing_radii.h)
    kRepeatedPoints = 2,    // connected points at one place become one; connections named twice count once
    kLonelyPoints = 4,      // points connected to nothing are left out
    kRepeatedTrunks = 8,    // what several polylines trace alike becomes one vessel (core/tree/merge_trunks.h)
    kRadiusJumps = 16,      // a radius far from those on both sides becomes their mean; else it is only told
    kOrphans = 32,          // a point whose parent is missing becomes a root; else the file is refused
    kOpenEnds = 64,         // an end within a vessel of another piece is joined to it (core/tree/open_ends.h)
    kUsual = 79,            // all that leaves measured numbers alone, and invents nothing that vessels do not show
    kUnmeasuredRadii = 128, // so is a radius that was not measured; else the file is refused
    kAll = 255
};
[[nodiscard]] constexpr Repair operator|(Repair a, Repair b) {
    return static_cast<Repair>(static_cast<unsigned>(a) | static_cast<unsigned>(b));
}
[[nodiscard]] constexpr Repair without(Repair set, Repair one) {
    return static_cast<Repair>(static_cast<unsigned>(set) & ~static_cast<unsigned>(one));
}
[[nodiscard]] constexpr bool allows(Repair set, Repair one) {
    return (static_cast<unsigned>(set) & static_cast<unsigned>(one)) != 0;
}

// The names that people use for single repairs.
inline constexpr std::pair<Repair, const char*> kRepairNames[] = {
    {Repair::kZeroRadii, "zero-radii"},       {Repair::kRepeatedPoints, "repeated-points"},
    {Repair::kLonelyPoints, "lonely-points"}, {Repair::kRepeatedTrunks, "repeated-trunks"},
    {Repair::kRadiusJumps, "radius-jumps"},   {Repair::kOrphans, "orphans"},
    {Repair::kOpenEnds, "open-ends"},         {Repair::kUnmeasuredRadii, "unmeasured-radii"}};
[[nodiscard]] std::string_view name_of(Repair one);

// The radius of a point that was not measured, as the file says: -1 or NaN there. Below every radius, so that the
// larger one of two radii is the measured one.
inline constexpr double kNotMeasured = -std::numeric_limits<double>::infinity();

using Edge = std::pair<std::uint32_t, std::uint32_t>; // points

struct Graph {
    std::vector<Point> points;
    std::vector<int> labels; // per point, or empty
    std::vector<Edge> edges;
    std::vector<std::uint32_t> roots; // requested roots; a component without one gets its thickest end
    std::vector<System> systems;
    std::vector<int> point_systems;  // per point, an index into `systems`; empty where there are none
    bool radii_are_invented = false; // no radius comes from the file
    DataArrays point_data{}, edge_data{};

    // Adds a point at `share` of the way from point `a` to point `b`, with the label and the system of `a`.
    std::uint32_t add_point_between(std::uint32_t a, std::uint32_t b, double share);
    // Leaves points out: `kept` are the others, ascending. Edges and roots keep the numbers that they had.
    void keep_points(const std::vector<std::uint32_t>& kept);
};

// Largest coordinate and radius that make sense in mm; beyond, a file has the wrong unit or is damaged.
inline constexpr double kMaximumCoordinate = 1e7;
inline constexpr double kMaximumRadius = 1e6;

// `source(point)` says where a point came from, for messages ("liver.swc:41"). Fails on points that are not finite or
// too far out, radii that are negative, too large, or zero everywhere, edges to points that do not exist, and graphs
// without a segment, edges between systems; and on the first thing that needs a repair which `repair` does not allow.
// The tree's notes are what was repaired, and what looks wrong (core/tree/suspicions.h): radii, loops, pieces.
[[nodiscard]] Result<VesselTree> build_tree(Graph graph, Repair repair,
                                            const std::function<std::string(std::uint32_t)>& source);

// Cuts points and edges that are known to be good into branches with their hierarchy. Roots of the result are those of
// `roots` that belong to a component with a segment; `point_systems` as in Graph.
[[nodiscard]] VesselTree assemble(std::vector<Point> points, std::vector<int> labels, const std::vector<Edge>& edges,
                                  const std::vector<std::uint32_t>& roots, const std::vector<int>& point_systems = {});

// `roots`, and the thickest end (or point, where there is none) of every component that has no root yet.
[[nodiscard]] std::vector<std::uint32_t>
complete_roots(const std::vector<Point>& points, const std::vector<Edge>& edges, std::vector<std::uint32_t> roots);

// Notes what a tree of vessels has seldom: loops, and pieces that nothing connects; what was noted of them before goes.
void note_network(VesselTree& tree);

} // namespace ramus::tree
