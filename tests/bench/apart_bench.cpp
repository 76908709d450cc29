// Whether surfaces have the pieces and loops of their trees, and whether triangles intersect: on the trees named, and
// on --packed grown trees that overlap. A row for each tree, --detail and --smooth, and below it what is wrong, with
// places. Exit status 1: some surface has other pieces or loops than its tree, or is not a closed manifold. With
// --contacts N: how long the contacts of a grown tree of N branches take to find.
//
// --tubes looks at pairs of straight tubes instead.
//
// Columns: triangles; seconds (not quiet); pieces and loops of the mesh and of the graph as smoothed, counted by
// themselves; loops that were cut; pairs of triangles that intersected and were moved apart; pieces that are not one of
// the graph with its own loops; open edges; edges and vertices that are no manifold; contacts, those of them whose axes
// cross (closeness below 0.005), and those whose axes as good as cross (0.06); pairs of triangles that intersect,
// within two radii of the tubes of a contact's both vessels, and elsewhere.
#include "core/base/disjoint_sets.h"
#include "core/field/separation/wall.h"
#include "core/field/vessel_field.h"
#include "core/io/trees/tree_file.h"
#include "core/mesh/polygonize/polygonize.h"
#include "core/mesh/surface.h"
#include "core/mesh/tree_field.h"
#include "core/tree/contacts/contacts.h"
#include "tests/support/grown_tree.h"
#include "tests/support/mesh_gap.h"
#include "tests/support/mesh_intersections.h"
#include "tests/support/mesh_topology.h"
#include "tests/support/packed_trees.h"
#include "tests/support/surface_shape.h"

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

using namespace ramus;

namespace {

struct ApartOptions {
    mesh::SurfaceOptions surface;
    bool intersections = true;
    bool as_drawn = false;
    int most_places = 12;
};

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// A segment that is kept apart from others.
struct KeptApart {
    glm::dvec3 start, end;
    double start_radius, end_radius;
    std::uint32_t piece;

    // How far a point is outside of the tube, in its radii.
    [[nodiscard]] double radii_outside(const glm::dvec3& p) const {
        const glm::dvec3 line = end - start;
        const double share = glm::clamp(glm::dot(p - start, line) / glm::dot(line, line), 0.0, 1.0);
        const double radius = glm::mix(start_radius, end_radius, share);
        return (glm::distance(p, start + share * line) - radius) / radius;
    }
};

std::vector<KeptApart> kept_apart(const tree::PreparedTree& prepared, const tree::Contacts& contacts) {
    std::vector<KeptApart> all;
    std::size_t segment = 0;
    for (const tree::Branch& branch : prepared.tree.branches) {
        for (std::size_t n = 1; n < branch.points.size(); ++n, ++segment) {
            const std::size_t index = prepared.segment_index.empty() ? segment : prepared.segment_index[segment];
            if (contacts.piece_of_segment.empty()) continue;
            const std::uint32_t piece = contacts.piece_of_segment[index];
            const auto partners = contacts.partners_of(piece);
            if (std::ranges::none_of(partners, [](const auto& p) { return p.apart_from > 0.0F; })) continue;
            const tree::Point& a = prepared.tree.points[branch.points[n - 1]];
            const tree::Point& b = prepared.tree.points[branch.points[n]];
            all.push_back({a.position, b.position, a.radius, b.radius, piece});
        }
    }
    return all;
}

// The more of a place's radii outside of two vessels of a contact, for the contact where that is least.
double radii_from_contact(const glm::dvec3& place, const std::vector<KeptApart>& all, const tree::Contacts& contacts,
                          double limit) {
    std::vector<std::pair<std::uint32_t, double>> near; // by piece
    for (const KeptApart& segment : all)
        if (const double radii = segment.radii_outside(place); radii <= limit) near.emplace_back(segment.piece, radii);
    std::ranges::sort(near);
    double least = limit + 1.0;
    for (const auto& [piece, radii] : near)
        for (const auto& partner : contacts.partners_of(piece))
            if (partner.apart_from > 0.0F)
                for (const auto& [other, also] : near)
                    if (other == partner.piece) least = std::min(least, std::max(radii, also));
    return least;
}

struct Intersections {
    std::size_t at_contacts = 0, elsewhere = 0;
    struct Place {
        glm::dvec3 at;
        std::size_t pairs = 0;
        bool contact = false;
        std::int32_t first = 0, second = 0; // branches
    };
    std::vector<Place> places;
};

Intersections find_intersections(const mesh::TriangleMesh& mesh, const tree::PreparedTree& prepared,
                                 const tree::Contacts& contacts) {
    constexpr double kAtContact = 2.0; // radii
    Intersections found;
    const std::vector<KeptApart> all = kept_apart(prepared, contacts);
    for (const test::IntersectingPair& pair : test::intersecting_triangles(mesh)) {
        const glm::dvec3 at = test::middle_of(mesh, pair);
        const std::uint32_t v = mesh.triangles[pair.first].x;
        const double radius = static_cast<double>(mesh.radii[v]);
        auto place =
            std::ranges::find_if(found.places, [&](const auto& there) { return glm::distance(there.at, at) < radius; });
        if (place == found.places.end()) {
            const bool contact = radii_from_contact(at, all, contacts, kAtContact) <= kAtContact;
            found.places.push_back({at, 0, contact, mesh.branches[v], mesh.branches[mesh.triangles[pair.second].x]});
            place = std::prev(found.places.end());
        }
        ++place->pairs;
        ++(place->contact ? found.at_contacts : found.elsewhere);
    }
    return found;
}

void print_head() {
    std::printf("%-26s %3s %2s %-5s %10s %7s  %13s  %13s %4s %4s %5s %5s %5s  %5s %5s %5s  %6s %6s\n", "tree", "det",
                "sm", "blend", "triangles", "s", "pieces m/g", "loops m/g", "cut", "mend", "wrong", "open", "nonm",
                "cont", "cross", "near", "x-cont", "x-else");
}

// What was counted of one surface.
struct Row {
    mesh::TriangleMesh mesh;
    double seconds = 0.0;
    std::size_t cut = 0, mended = 0;
    tree::Contacts contacts;
    test::Topology topology;
    std::vector<test::MeshPiece> pieces;
    test::GraphPieces graph;
    test::WrongPieces wrong;
    Intersections found;

    [[nodiscard]] bool right() const {
        return wrong.none() && test::shape_of(pieces) == graph.shape() && topology.closed_manifold();
    }
};

void print(const std::string& name, const mesh::SurfaceOptions& options, const Row& row) {
    const auto closer = [&](double than) {
        return std::ranges::count_if(row.contacts.list, [&](const auto& c) { return c.closeness < than; });
    };
    const test::Shape of_mesh = test::shape_of(row.pieces), of_graph = row.graph.shape();
    std::printf(
        "%-26s %3d %2d %-5s %10zu %7.2f  %6ld/%-6ld  %6ld/%-6ld %4zu %4zu %5zu %5zu %5zu  %5zu %5ld %5ld  %6zu %6zu\n",
        name.c_str(), options.detail, options.smooth_passes, std::string(mesh::name_of(options.blend)).c_str(),
        row.mesh.triangles.size(), row.seconds, of_mesh.pieces, of_graph.pieces, of_mesh.loops, of_graph.loops, row.cut,
        row.mended, row.wrong.of_mesh.size() + row.wrong.of_graph.size(), row.topology.open_edges,
        row.topology.repeated_edges + row.topology.split_vertices + row.topology.degenerate, row.contacts.list.size(),
        static_cast<long>(closer(0.005)), static_cast<long>(closer(0.06)), row.found.at_contacts, row.found.elsewhere);
}

void print_wrong_pieces(const Row& row, int most) {
    for (const test::MeshPiece& piece : row.wrong.of_mesh) {
        if (most-- == 0) break;
        const glm::dvec3 at(row.mesh.positions[piece.first_vertex]);
        const int branch = row.mesh.branches[piece.first_vertex];
        std::printf("    wrong piece at %.2f %.2f %.2f of branch %d: %zu triangles, %ld loops (its graph %ld), "
                    "%.4g mm^3\n",
                    at.x, at.y, at.z, branch, piece.triangles, piece.loops,
                    row.graph.loops[row.graph.of_branch.at(branch)], piece.volume);
    }
    for (const std::size_t piece : row.wrong.of_graph)
        std::printf("    piece %zu of the graph has no surface\n", piece);
}

void print_intersections(Row& row, int most) {
    std::ranges::sort(row.found.places, std::greater{}, &Intersections::Place::pairs);
    for (const auto& place : row.found.places) {
        if (most-- == 0) break;
        std::printf("    %4zu pairs intersect at %.2f %.2f %.2f, branches %d and %d, %s", place.pairs, place.at.x,
                    place.at.y, place.at.z, place.first, place.second, place.contact ? "at a contact" : "elsewhere");
        const auto away = [&](const tree::Contact& contact) { return glm::distance(contact.at(), place.at); };
        if (const auto next = std::ranges::min_element(row.contacts.list, {}, away); next != row.contacts.list.end())
            std::printf(" (the next is %.2f mm away, of %d and %d, closeness %.3f)", away(*next), next->sides[0].branch,
                        next->sides[1].branch, next->closeness);
        std::printf("\n");
    }
}

// Whether the surface has the shape of the tree.
bool look_at(const std::string& name, const tree::VesselTree& tree, const ApartOptions& options) {
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, options.surface);
    Row row;
    row.contacts = tree::find_contacts(prepared, tree::limits_of_gaussian(options.surface.width));
    Result<mesh::Surface> surface;
    Job job;
    row.seconds = seconds_of([&] {
        surface = options.as_drawn ? mesh::make_surface(tree, options.surface, job)
                                   : mesh::make_untangled_surface(tree, options.surface, job);
    });
    if (!surface) {
        std::printf("%s: %s\n", name.c_str(), surface.error().message().c_str());
        return false;
    }
    row.mesh = std::move(surface->mesh);
    row.cut = surface->statistics.matched.false_loops.cut;
    row.mended = surface->statistics.untangled.found;
    row.topology = test::topology(row.mesh);
    row.pieces = test::pieces_of(row.mesh);
    row.graph = test::pieces_of(prepared);
    row.wrong = test::wrong_pieces(row.mesh, row.pieces, row.graph);
    if (options.intersections) row.found = find_intersections(row.mesh, prepared, row.contacts);
    print(name, options.surface, row);
    print_wrong_pieces(row, options.most_places);
    print_intersections(row, options.most_places);
    std::fflush(stdout);
    return row.right();
}

std::vector<tree::Point> straight(const glm::dvec3& from, const glm::dvec3& to, double radius) {
    constexpr int kSteps = 40;
    std::vector<tree::Point> points;
    for (int n = 0; n <= kSteps; ++n)
        points.push_back({from + (to - from) * (static_cast<double>(n) / kSteps), radius});
    return points;
}

void add_branch(tree::PreparedTree& prepared, const std::vector<tree::Point>& points) {
    tree::Branch branch;
    for (const tree::Point& point : points) {
        branch.points.push_back(static_cast<std::uint32_t>(prepared.tree.points.size()));
        prepared.tree.points.push_back(point);
    }
    const auto number = static_cast<int>(prepared.tree.branches.size());
    prepared.segment_source.insert(prepared.segment_source.end(), points.size() - 1, number);
    prepared.tree.branches.push_back(branch);
}

// A tube of radius 1 along x, and another one across or along it. Whether they are two closed pieces that nowhere
// intersect.
bool look_at_tubes(bool across, double other, double closeness, int detail) {
    const double distance = closeness * (1.0 + other), half = across ? 2.4 * other + 10.0 : 10.0 + 2.0 * other;
    tree::PreparedTree prepared;
    add_branch(prepared, straight({-12, 0.03, 0}, {12, 0.01, 0}, 1.0));
    add_branch(prepared, across ? straight({0.02, -half, distance}, {-0.05, half, distance}, other)
                                : straight({-half, 0.02, distance}, {half, -0.05, distance}, other));
    const auto contacts =
        std::make_shared<const tree::Contacts>(tree::find_contacts(prepared, tree::limits_of_gaussian(5.0)));
    mesh::PolygonizeOptions options;
    options.detail = detail;
    Job job;
    std::vector<mesh::TriangleBox> walls;
    auto mesh = mesh::polygonize(field::VesselField(field::ConvolutionField(prepared, 5.0), contacts), options, job,
                                 nullptr, &walls)
                    .value();
    (void)mesh::untangle(mesh, walls, job);
    const std::vector<test::MeshPiece> pieces = test::pieces_of(mesh);
    DisjointSets sets(mesh.positions.size());
    for (const glm::uvec3& t : mesh.triangles) sets.join(t.x, t.y), sets.join(t.y, t.z);
    std::vector<std::uint32_t> piece(mesh.positions.size());
    for (std::uint32_t v = 0; v < piece.size(); ++v) piece[v] = sets.find(v);
    const auto pairs = test::intersecting_triangles(mesh);
    const auto between = std::ranges::count_if(pairs, [&](const test::IntersectingPair& pair) {
        return piece[mesh.triangles[pair.first].x] != piece[mesh.triangles[pair.second].x];
    });
    const test::Gap gap = pairs.empty() ? test::least_gap(mesh, piece, 0.5) : test::Gap{};
    const glm::vec3 at = mesh.positions[mesh.triangles[gap.triangles.x].x];
    const test::Shape shape = test::shape_of(pieces);
    const bool right = shape == test::Shape{2, 0} && pairs.empty();
    std::printf("%-8s 1:%g  closeness %.2f  detail %2d: %ld pieces, %ld loops, %4zu pairs intersect, %4ld between the "
                "two, gap %.4f at %.2f %.2f %.2f%s\n",
                across ? "crossing" : "parallel", other, closeness, detail, shape.pieces, shape.loops, pairs.size(),
                static_cast<long>(between), gap.mm, static_cast<double>(at.x), static_cast<double>(at.y),
                static_cast<double>(at.z), right ? "" : "  WRONG");
    return right;
}

// How many of the pairs of tubes are wrong.
int look_at_all_tubes(const std::vector<int>& details) {
    int wrong = 0;
    for (const int detail : details)
        for (const bool across : {true, false})
            for (const double other : {1.0, 5.0})
                for (const double closeness : {0.1, 0.5, 0.9, 1.0, 1.05})
                    wrong += look_at_tubes(across, other, closeness, detail) ? 0 : 1;
    std::printf("%d rows are wrong\n", wrong);
    return wrong;
}

int time_contacts(int branches, const mesh::SurfaceOptions& options) {
    const tree::VesselTree tree = test::grown(branches);
    const tree::PreparedTree prepared = mesh::prepare_tree(tree, options);
    for (int run = 0; run < 3; ++run) {
        tree::Contacts contacts;
        const std::clock_t start = std::clock();
        const double seconds =
            seconds_of([&] { contacts = tree::find_contacts(prepared, tree::limits_of_gaussian(options.width)); });
        std::printf("%zu branches, %zu segments: %zu contacts, %zu partners in %.3f s (%.3f s of all cores)\n",
                    tree.branches.size(), tree.segment_count(), contacts.list.size(), contacts.partners.size(), seconds,
                    static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return 0;
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app{"Pieces, loops and intersections of surfaces against their trees"};
    std::vector<std::string> files;
    std::vector<int> details{16}, smooths{0, 1};
    int packed = 0, first_packed = 0, contacts = 0;
    bool quick = false, open_ends_stay = false, tubes = false;
    std::string blend = "tree", centerline = "smooth";
    ApartOptions options;
    app.add_option("FILE", files, "trees");
    app.add_option("--detail", details)->delimiter(',');
    app.add_option("--smooth", smooths)->delimiter(',');
    app.add_option("--width", options.surface.width);
    app.add_option("--cell", options.surface.cell_mm);
    app.add_option("--prune", options.surface.prune_ratio);
    app.add_option("--threads", options.surface.threads);
    app.add_option("--blend", blend)->check(CLI::IsMember({"tree", "paper"}));
    app.add_option("--centerline", centerline)->check(CLI::IsMember({"smooth", "lines"}));
    app.add_option("--packed", packed, "so many grown trees that overlap");
    app.add_option("--first", first_packed, "the seed of the first of them");
    app.add_option("--contacts", contacts, "time the contacts of a grown tree of so many branches");
    app.add_option("--most", options.most_places, "places to print below a row (12)");
    app.add_flag("--tubes", tubes, "two straight tubes, crossing and parallel, 1:1 and 1:5, from close to touching");
    app.add_flag("--as-drawn", options.as_drawn, "surfaces as in pictures: what intersects stays");
    app.add_flag("--quick", quick, "without intersections of triangles");
    app.add_flag("--open-ends-stay", open_ends_stay, "do not join open ends");
    CLI11_PARSE(app, argc, argv);
    options.surface.blend = *mesh::blend_named(blend);
    options.surface.centerline = centerline == "lines" ? tree::Centerline::kLines : tree::Centerline::kSmooth;
    options.intersections = !quick;
    if (contacts > 0) return time_contacts(contacts, options.surface);
    if (tubes) return look_at_all_tubes(details) == 0 ? 0 : 1;
    int wrong = 0;
    print_head();
    const auto look = [&](const std::string& name, const tree::VesselTree& tree) {
        for (const int smooth : smooths)
            for (const int detail : details) {
                options.surface.smooth_passes = smooth;
                options.surface.detail = detail;
                wrong += look_at(name, tree, options) ? 0 : 1;
            }
    };
    for (const std::string& file : files) {
        io::ReadOptions read;
        if (open_ends_stay) read.repair = tree::without(read.repair, tree::Repair::kOpenEnds);
        const auto tree = io::read_tree(file, read);
        if (!tree) {
            std::fprintf(stderr, "%s\n", tree.error().message().c_str());
            return 2;
        }
        look(std::filesystem::path(file).stem().string(), *tree);
    }
    for (int seed = first_packed; seed < first_packed + packed; ++seed)
        look("packed " + std::to_string(seed), test::packed_trees(static_cast<std::uint64_t>(seed)));
    std::printf("%d rows are wrong\n", wrong);
    return wrong == 0 ? 0 : 1;
}
