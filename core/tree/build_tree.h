// Builds a VesselTree from points (mm) and edges: repairs damaged data, cuts the graph into branches, and finds the
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

// The repairs that are allowed, as a set of bits.
enum class Repair : unsigned {
    kNone = 0,
    kZeroRadii = 1,         // a radius of 0 is interpolated from positive radii (core/tree/missing_radii.h)
    kRepeatedPoints = 2,    // connected points at one place become one; repeated connections count once
    kLonelyPoints = 4,      // points without a connection are removed
    kRepeatedTrunks = 8,    // a trunk that several polylines trace becomes one vessel (core/tree/merge_trunks.h)
    kRadiusJumps = 16,      // a radius far from those on both sides becomes their mean; otherwise it is only reported
    kOrphans = 32,          // a point whose parent is missing becomes a root; otherwise the file is refused
    kOpenEnds = 64,         // an end within a vessel of another piece is joined to it (core/tree/open_ends.h)
    kUsual = 79,            // the default: zero radii, repeated points, lonely points, repeated trunks, open ends
    kUnmeasuredRadii = 128, // an unmeasured radius is interpolated as a zero radius is; otherwise the file is refused
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

// The names of single repairs in files, commands and messages.
inline constexpr std::pair<Repair, const char*> kRepairNames[] = {
    {Repair::kZeroRadii, "zero-radii"},       {Repair::kRepeatedPoints, "repeated-points"},
    {Repair::kLonelyPoints, "lonely-points"}, {Repair::kRepeatedTrunks, "repeated-trunks"},
    {Repair::kRadiusJumps, "radius-jumps"},   {Repair::kOrphans, "orphans"},
    {Repair::kOpenEnds, "open-ends"},         {Repair::kUnmeasuredRadii, "unmeasured-radii"}};
[[nodiscard]] std::string_view name_of(Repair one);

// The radius of a point that the file marks as not measured, by -1 or NaN. It is below every radius, so the maximum of
// two radii is the measured one.
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
    // Removes all points but `kept`, ascending. Edges and roots keep the old numbers of points.
    void keep_points(const std::vector<std::uint32_t>& kept);
};

// The largest plausible coordinate and radius, mm. A file with larger numbers has the wrong unit or is damaged.
inline constexpr double kMaximumCoordinate = 1e7;
inline constexpr double kMaximumRadius = 1e6;

// `source(point)` names the origin of a point in messages ("liver.swc:41"). Fails on points that are not finite or too
// far out; on radii that are negative, too large, or zero everywhere; on edges to points that do not exist, or between
// systems; on graphs without a segment; and on the first damage whose repair is not allowed. The tree's notes list the
// repairs, and suspicious radii, loops and pieces (core/tree/suspicions.h).
[[nodiscard]] Result<VesselTree> build_tree(Graph graph, Repair repair,
                                            const std::function<std::string(std::uint32_t)>& source);

// Cuts valid points and edges into branches with their hierarchy. The roots of the result are those of `roots` that
// belong to a component with a segment; `point_systems` as in Graph.
[[nodiscard]] VesselTree assemble(std::vector<Point> points, std::vector<int> labels, const std::vector<Edge>& edges,
                                  const std::vector<std::uint32_t>& roots, const std::vector<int>& point_systems = {});

// `roots`, and for every component without a root its thickest end, or its thickest point if it has no end.
[[nodiscard]] std::vector<std::uint32_t>
complete_roots(const std::vector<Point>& points, const std::vector<Edge>& edges, std::vector<std::uint32_t> roots);

// Replaces the tree's notes about loops and unconnected pieces, which are rare in real vessels, by current ones.
void note_network(VesselTree& tree);

} // namespace ramus::tree
