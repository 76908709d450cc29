#include "core/io/trees/imported_tree.h"

#include "core/base/bounds.h"
#include "core/base/grouped.h"
#include "core/io/text_numbers.h"
#include "core/io/trees/tree_data.h"
#include "core/tree/merge_trunks.h"
#include "core/tree/suspicions.h"
#include "core/tree/voxels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

namespace ramus::io {

namespace {

using tree::Note;

Result<void> check_lengths(const ImportedTree& imported) {
    const tree::Graph& graph = imported.graph;
    if (graph.points.size() >= std::numeric_limits<std::uint32_t>::max())
        return fail("the file has more points than can be counted", {}, "split it");
    for (const auto& [a, b] : graph.edges)
        if (a >= graph.points.size() || b >= graph.points.size())
            return fail("a connection names point " + std::to_string(std::max(a, b)) + ", but there are only " +
                            std::to_string(graph.points.size()),
                        imported.place_of(0), "correct the file");
    return {};
}

// The largest radius, and the longest side of the bounding box of all points, in the units of the graph.
std::pair<double, double> sizes_of(const tree::Graph& graph) {
    double radius = 0.0;
    Bounds<glm::dvec3> box;
    for (const tree::Point& p : graph.points) {
        radius = std::max(radius, p.radius);
        box.hold(p.position);
    }
    const glm::dvec3 side = box.size();
    return {radius, std::max({side.x, side.y, side.z, 0.0})};
}

// Thresholds in mm of suspicions about the unit, not of decisions. No vessel of any animal is wider than the first and
// no tree longer than the second. No vessel that carries blood cells is thinner than the third, and no traced tree is
// shorter than the fourth. The others: no whole tree of an adult's large vessels is that small.
constexpr double kWidestRadius = 25.0, kFarthest = 1000.0, kThinnestRadius = 0.001, kShortest = 0.02;
constexpr double kNarrowestRadius = 0.6, kNearest = 100.0, kRadiusInMetres = 0.02, kNearestInMetres = 1.5;
// The same if there is evidence for cm: an adult's aorta and its branches in cm.
constexpr double kNarrowestHinted = 2.5, kNearestHinted = 60.0;
constexpr std::size_t kManyPoints = 100; // fewer may all have whole coordinates by hand

// A file that stores notes may have the note already.
void add_once(ImportedTree& imported, Note note) {
    if (std::ranges::find(imported.notes, note) == imported.notes.end()) imported.notes.push_back(std::move(note));
}

void suspect(ImportedTree& imported, std::string text) {
    add_once(imported, {Note::Kind::kSuspect, "units", std::move(text), {}});
}

// Removes stored notes about an assumption that a person has settled since.
void forget(ImportedTree& imported, std::string_view topic) {
    std::erase_if(imported.notes,
                  [&](const Note& note) { return note.topic == topic && note.kind != Note::Kind::kRepaired; });
}

std::string sizes_text(double radius, double side) {
    return "the tree spans " + short_number(side) + " mm and its thickest vessel is " + short_number(2.0 * radius) +
           " mm wide";
}

// Checks the size of a tree whose unit was assumed.
void suspect_unit(ImportedTree& imported) {
    const auto [radius, side] = sizes_of(imported.graph);
    const std::string spans = "if a unit is 1 mm, " + sizes_text(radius, side);
    if (radius > kWidestRadius || side > kFarthest)
        suspect(imported, spans + ": that is too large; --units um, or the size of a voxel, may be what is meant");
    else if (!imported.unit_hint.empty() && radius < kNarrowestHinted && side < kNearestHinted)
        suspect(imported, spans + ", and " + imported.unit_hint + ": --units cm is likely what is meant");
    else if (radius < kRadiusInMetres && side < kNearestInMetres)
        suspect(imported, spans + ": if these are vessels of a patient, --units m is what is meant");
    else if (radius < kNarrowestRadius && side < kNearest)
        suspect(imported, spans + ": if these are large vessels of an adult, --units cm is what is meant");
    const auto whole = [](const tree::Point& p) { return p.position == glm::floor(p.position); };
    if (imported.graph.points.size() >= kManyPoints && std::ranges::all_of(imported.graph.points, whole))
        suspect(imported, "every coordinate is a whole number, as those of voxels are: --units takes the size of a "
                          "voxel in mm, as 0.62 or 0.3x0.3x0.6");
}

// Checks the size of a tree, in mm, whose unit the file or a person states. Skipped if the file stores such a note.
void suspect_sizes(ImportedTree& imported, const LengthUnit& unit) {
    for (const Note& note : imported.notes)
        if (note.kind == Note::Kind::kSuspect && note.topic == "units") return;
    const auto [radius, side] = sizes_of(imported.graph);
    const bool large = radius > kWidestRadius || side > kFarthest;
    if (!large && (radius >= kThinnestRadius || radius <= 0.0) && side >= kShortest) return;
    suspect(imported, "read in " + name_of(unit) + ", " + sizes_text(radius, side) + ": that is too " +
                          (large ? "large" : "small") + " for vessels; --units takes another unit");
}

double radius_factor(const LengthUnit& unit) {
    const glm::dvec3 mm = unit.mm;
    return mm.x == mm.y && mm.y == mm.z ? mm.x : std::cbrt(mm.x * mm.y * mm.z);
}

// Programs write -1 or NaN for a radius that was not measured.
void mark_unmeasured(ImportedTree& imported) {
    const auto mark = [](double& radius) {
        if (radius == -1.0 || std::isnan(radius)) radius = tree::kNotMeasured;
    };
    for (tree::Point& p : imported.graph.points) mark(p.radius);
    for (double& radius : imported.edge_radii) mark(radius);
}

// Sets missing radii, in the file's unit. Radii of the file stay.
void apply_radius(ImportedTree& imported, const ReadOptions& options) {
    if (!options.radius_mm) return;
    const std::string mm = short_number(*options.radius_mm) + " mm";
    std::vector<tree::Point>& points = imported.graph.points;
    const bool has_radii = std::ranges::any_of(points, [](const tree::Point& p) { return p.radius > 0.0; });
    const LengthUnit unit = options.unit.value_or(imported.unit.value_or(LengthUnit{}));
    std::size_t given = 0;
    for (tree::Point& p : points)
        if (!has_radii || p.radius == tree::kNotMeasured) p.radius = *options.radius_mm / radius_factor(unit), ++given;
    if (has_radii && given == 0) {
        imported.assume("radius", "the file has radii: that of " + mm + ", which was asked for, is not used");
        return;
    }
    if (has_radii) {
        imported.assume("radius",
                        std::to_string(given) + " radii that were not measured are taken as " + mm + ", as asked for");
        if (auto invented = tree::check_invented(given, points.size())) imported.notes.push_back(std::move(*invented));
        return;
    }
    imported.graph.radii_are_invented = true;
    imported.radius_name.clear();
    imported.assume("radius", "the file has no radii: every point has a radius of " + mm + " as asked for");
}

void apply_unit(ImportedTree& imported, const ReadOptions& options) {
    if (!imported.unit && !options.unit) {
        add_once(imported, {Note::Kind::kAssumed,
                            "units",
                            "the file names no unit of length: next to other files a unit counts as 1 mm",
                            {}});
        suspect_unit(imported);
        return;
    }
    if (options.unit && !imported.unit) forget(imported, "units");
    const LengthUnit unit = options.unit ? *options.unit : *imported.unit;
    if (options.unit && imported.unit && *imported.unit != unit)
        imported.assume("units",
                        "lengths are in " + name_of(unit) + " as asked for; the file says " + name_of(*imported.unit));
    else if (options.unit && !imported.unit)
        imported.assume("units", "lengths are in " + name_of(unit) + " as asked for; the file does not say");
    const glm::dvec3 mm = unit.mm;
    const bool cubes = mm.x == mm.y && mm.y == mm.z;
    if (!cubes) imported.assume("units", "radii are multiplied by the geometric mean of the three sizes");
    const double radius_mm = radius_factor(unit);
    for (tree::Point& p : imported.graph.points) p.position *= mm, p.radius *= radius_mm;
    for (int edge = 0; imported.voxel && edge < 3; ++edge) (*imported.voxel)[edge] *= mm;
    for (Note& note : imported.notes) {
        if (note.at) *note.at *= mm;
        if (note.outward) note.outward = glm::normalize(*note.outward / mm);
    }
    suspect_sizes(imported, unit);
}

void apply_orientation(ImportedTree& imported, const ReadOptions& options) {
    const std::optional<Orientation>&asked = options.orientation, &stated = imported.orientation;
    if (!stated && !asked)
        add_once(imported, {Note::Kind::kAssumed,
                            "axes",
                            "the file does not say where its axes lead: taken as " + Orientation::ras().words(),
                            {}});
    if (asked && !stated) {
        forget(imported, "axes");
        imported.assume("axes", "axes lead to " + asked->words() + " as asked for; the file does not say");
    }
    if (asked && stated && *asked != *stated)
        imported.assume("axes", "axes lead to " + asked->words() + " as asked for; the file says " + stated->letters());
    const Orientation orientation = asked.value_or(stated.value_or(Orientation::ras()));
    if (orientation.mirrors())
        imported.notes.push_back({Note::Kind::kSuspect,
                                  "axes",
                                  "axes that lead to " + orientation.words() +
                                      " are left-handed: the patient is the mirror image of the file's numbers",
                                  {}});
    if (orientation == Orientation::ras()) return;
    for (tree::Point& p : imported.graph.points) p.position = orientation.to_patient(p.position);
    for (int edge = 0; imported.voxel && edge < 3; ++edge)
        (*imported.voxel)[edge] = orientation.to_patient((*imported.voxel)[edge]);
    for (Note& note : imported.notes) {
        if (note.at) note.at = orientation.to_patient(*note.at);
        if (note.outward) note.outward = orientation.to_patient(*note.outward);
    }
}

tree::SaidBy said_by(bool asked, bool stated) {
    return asked ? tree::SaidBy::kPerson : stated ? tree::SaidBy::kFile : tree::SaidBy::kNobody;
}

void apply_radius_meaning(ImportedTree& imported, const ReadOptions& options) {
    const RadiusIs is = options.radius_is.value_or(imported.radius_is);
    if (options.radius_is && *options.radius_is != imported.radius_is)
        imported.assume("radius-is", std::string("widths are taken as ") +
                                         (is == RadiusIs::kDiameter ? "diameters" : "radii") + " as asked for");
    else if (!options.radius_is && !imported.radius_name.empty())
        imported.assume("radius-is", "\"" + imported.radius_name + "\" is taken as the " +
                                         (is == RadiusIs::kDiameter ? "diameter" : "radius"));
    if (is == RadiusIs::kRadius) return;
    for (tree::Point& p : imported.graph.points) p.radius *= 0.5;
    for (double& radius : imported.edge_radii) radius *= 0.5;
}

// Parallel edges between the same two points would become one. So all but the first get a point in their middle.
void keep_parallel_vessels(ImportedTree& imported) {
    tree::Graph& graph = imported.graph;
    if (!imported.edges_are_vessels) return;
    const std::size_t count = graph.edges.size();
    const auto first_new = static_cast<std::uint32_t>(graph.points.size());
    const auto key = [&](std::size_t e) {
        const auto [a, b] = graph.edges[e];
        return tree::Edge(std::min(a, b), std::max(a, b));
    };
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, [&](std::size_t x, std::size_t y) { return key(x) < key(y); });
    std::vector<bool> again(count, false);
    for (std::size_t n = 1; n < count; ++n) again[order[n]] = key(order[n]) == key(order[n - 1]);
    std::vector<std::uint32_t> beside; // by new point: an old neighbour, for messages
    for (std::size_t e = 0; e < count; ++e) {
        const auto [a, b] = graph.edges[e];
        if (a == b || !again[e]) continue;
        const std::uint32_t middle = graph.add_point_between(a, b, 0.5);
        append_copy(graph.edge_data, e);
        if (e < imported.edge_radii.size()) imported.edge_radii.push_back(imported.edge_radii[e]);
        graph.edges[e].second = middle;
        graph.edges.emplace_back(middle, b);
        beside.push_back(a);
    }
    if (beside.empty()) return;
    imported.assume("joining",
                    std::to_string(beside.size()) + (beside.size() == 1 ? " vessel runs" : " vessels run") +
                        " straight between the same two points as another; a point in the middle keeps them apart");
    imported.place_of = [place = std::move(imported.place_of), first_new, beside = std::move(beside)](std::uint32_t p) {
        return place(p < first_new ? p : beside[p - first_new]);
    };
}

// Moves the radius of each edge to the point at its downstream end, along a spanning tree from the roots (or from each
// component's thickest end).
Result<void> move_radii_to_points(ImportedTree& imported) {
    tree::Graph& graph = imported.graph;
    if (imported.edge_radii.empty()) return {};
    if (imported.edge_radii.size() != graph.edges.size())
        return fail(std::to_string(imported.edge_radii.size()) + " radii for " + std::to_string(graph.edges.size()) +
                        " connections",
                    imported.place_of(0), "correct the file");
    const Grouped<std::uint32_t> at(graph.points.size(), [&](const auto& put) {
        for (std::uint32_t e = 0; e < graph.edges.size(); ++e)
            put(graph.edges[e].first, e), put(graph.edges[e].second, e);
    });
    std::vector<std::uint32_t> starts = graph.roots;
    std::vector<std::uint32_t> order(graph.points.size());
    for (std::uint32_t p = 0; p < order.size(); ++p) order[p] = p;
    const auto thickness = [&](std::uint32_t p) {
        double most = 0.0;
        for (const std::uint32_t e : at.of(p)) most = std::max(most, imported.edge_radii[e]);
        return std::pair(at.of(p).size() == 1, most);
    };
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return thickness(a) > thickness(b); });
    starts.insert(starts.end(), order.begin(), order.end());
    std::vector<bool> reached(graph.points.size(), false);
    std::vector<std::uint32_t> open;
    for (const std::uint32_t start : starts) {
        if (start >= reached.size() || reached[start]) continue;
        reached[start] = true;
        if (!at.of(start).empty()) graph.points[start].radius = thickness(start).second;
        open.assign(1, start);
        for (std::size_t n = 0; n < open.size(); ++n) {
            for (const std::uint32_t e : at.of(open[n])) {
                const std::uint32_t other =
                    graph.edges[e].first == open[n] ? graph.edges[e].second : graph.edges[e].first;
                if (reached[other]) continue;
                reached[other] = true;
                graph.points[other].radius = imported.edge_radii[e];
                open.push_back(other);
            }
        }
    }
    imported.assume("radius", "the radius of a vessel that has but one is that of its far end; it tapers toward it");
    return {};
}

std::string counted_points(std::size_t count) { return std::to_string(count) + (count == 1 ? " point" : " points"); }

Result<void> join(ImportedTree& imported, tree::Repair repair) {
    tree::Graph& graph = imported.graph;
    bool repeats_points = false; // trunks with equal points were merged by join_coincident()
    if (imported.joining != Joining::kByIndex) {
        tree::Joined joined = tree::join_coincident(graph, imported.joining == Joining::kAtCoincidingEnds);
        imported.place_of = [place = std::move(imported.place_of), first = std::move(joined.first)](std::uint32_t p) {
            return place(first[p]);
        };
        if (joined.points > 0)
            imported.assume("joining", counted_points(joined.points) +
                                           " joined with others at the same place: so the file connects its vessels");
        repeats_points = joined.edges > 0;
        if (joined.edges > 0)
            imported.notes.push_back({Note::Kind::kRepaired, std::string(name_of(tree::Repair::kRepeatedTrunks)),
                                      std::to_string(joined.edges) +
                                          (joined.edges == 1 ? " segment that is" : " segments that are") +
                                          " traced several times were kept once",
                                      joined.repeat});
    }
    if (!imported.may_repeat_trunks || repeats_points || !tree::allows(repair, tree::Repair::kRepeatedTrunks))
        return {};
    for (const tree::RepeatedTrunk& trunk : tree::merge_repeated_trunks(graph))
        imported.notes.push_back(
            {Note::Kind::kRepaired, std::string(name_of(tree::Repair::kRepeatedTrunks)),
             counted_points(trunk.points) + " of a trunk that another centerline traces too were left out",
             0.5 * (trunk.from + trunk.to)});
    return {};
}

} // namespace

Result<tree::VesselTree> tree_of(ImportedTree imported, const ReadOptions& options) {
    if (auto good = check_lengths(imported); !good) return tl::unexpected(good.error());
    if (auto settled = settle_data(imported); !settled) return tl::unexpected(settled.error());
    mark_unmeasured(imported);
    keep_parallel_vessels(imported);
    if (auto moved = move_radii_to_points(imported); !moved) return tl::unexpected(moved.error());
    apply_radius_meaning(imported, options);
    apply_radius(imported, options);
    apply_unit(imported, options);
    apply_orientation(imported, options);
    const tree::Claims claims{said_by(options.unit.has_value(), imported.unit.has_value()),
                              said_by(options.orientation.has_value(), imported.orientation.has_value())};
    if (auto joined = join(imported, options.repair); !joined) return tl::unexpected(joined.error());
    const tree::Repair repair =
        imported.pieces_are_meant ? tree::without(options.repair, tree::Repair::kOpenEnds) : options.repair;
    auto tree = tree::build_tree(std::move(imported.graph), repair, imported.place_of);
    if (!tree) return tree;
    for (tree::DataArrays* arrays : {&tree->point_data, &tree->branch_data}) // their points and edges were left out
        std::erase_if(*arrays, [](const tree::DataArray& array) { return range_of(array).known == 0; });
    if (tree->source.empty()) tree->source = std::move(imported.source);
    // A file that stores notes may have some of the new ones already.
    std::set<std::string> known;
    for (const Note& note : imported.notes) known.insert(note.text);
    for (std::vector<Note>* notes : {&imported.notes, &tree->notes})
        for (Note& note : *notes)
            if (note.topic != "units") note.text = claims.worded(note.text);
    for (Note& note : tree->notes)
        if (!known.contains(note.text)) imported.notes.push_back(std::move(note));
    std::stable_partition(imported.notes.begin(), imported.notes.end(),
                          [](const Note& note) { return note.topic == tree::kInventedRadii; });
    tree->notes = std::move(imported.notes);
    tree->claims = claims;
    if (imported.voxel && tree::is_a_voxel(*imported.voxel))
        tree->voxels = tree::Voxels{*imported.voxel, false};
    else
        tree->voxels = tree::estimated_voxels(*tree);
    return tree;
}

} // namespace ramus::io
