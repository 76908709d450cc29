#include "core/mesh/polygonize/cells/walled_cells.h"

#include "core/mesh/polygonize/cells/fans.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::mesh::bricks {

namespace {

constexpr int other_side(int crossing) { return crossing < kUpperEnd ? crossing + kUpperEnd : crossing - kUpperEnd; }

glm::vec3 direction_of(int crossing) {
    const auto [low, high] = ends_of_edge(crossing);
    return 0.25F * glm::vec3(high - low);
}

// Between some crossings and a little beyond, in a room.
Span around(const Span& crossings, const Span& room) {
    constexpr float kBeyond = 0.25F; // of the crossings' extent
    const glm::vec3 size = crossings.size();
    const float beyond = kBeyond * std::max({size.x, size.y, size.z});
    return {glm::clamp(crossings.lower - beyond, room.lower, room.upper),
            glm::clamp(crossings.upper + beyond, room.lower, room.upper)};
}

field::OwnedPoint move(field::BrickField& field, field::Owner owner, const Span& box, const glm::vec3& guess) {
    field::OwnedGuess whose;
    whose.owner = owner;
    whose.place = field::OwnedGuess::Place::kBox;
    whose.lower = box.lower, whose.upper = box.upper;
    return field.move(whose, guess);
}

// A vertex that was found at one place, and may have been moved a little since.
field::OwnedGuess vertex_at(const field::OwnedPoint& point, const glm::vec3& found_at, field::Owner owner) {
    constexpr float kMoved = 0.03F; // of the radius: so far what was found holds
    field::OwnedGuess vertex;
    vertex.owner = owner;
    vertex.lower = vertex.upper = point.at;
    vertex.placed = point;
    vertex.place = glm::distance(point.at, found_at) < kMoved * point.radius ? field::OwnedGuess::Place::kPlaced
                                                                             : field::OwnedGuess::Place::kBox;
    return vertex;
}

// Within its brick, and the same for both cells at its face.
std::uint32_t arc_number(const glm::ivec3& cell, const FaceArc& arc) {
    const auto number = [&](int crossing) {
        const auto [a, b] = ends_of_edge(crossing);
        return 2 * edge_number(0, 4 * cell + (a + b) / 2) + (crossing < kUpperEnd ? 0U : 1U);
    };
    const auto [first, second] = std::minmax({number(arc.first), number(arc.second)}); // by value
    static_assert(2 * edge_number(1, glm::ivec3(0)) <= 1U << 14);
    return first << 16 | second << 2 | static_cast<std::uint32_t>(arc.face / 2);
}

} // namespace

// A vertex of a cell.
struct WalledCells::Found {
    field::OwnedPoint point;
    glm::vec3 found_at{0.0F}; // before it was moved to part it from others
    field::Owner owner = field::kNoOwner;
};

struct WalledCells::Loop {
    std::size_t first = 0; // of those on both sides of its walls
    glm::vec3 sum{0.0F};   // of these, where it is the first: of their crossings
    float count = 0.0F;
    Span span; // its own crossings
};

struct WalledCells::Work {
    field::BrickField& field;
    const BrickOwners& owners;
    glm::ivec3 cell;
    const CellShape& shape;
    const CellLoops& loops;
    const Guesses& guesses;
    std::vector<Found> of_loops, of_arcs;

    [[nodiscard]] std::size_t loop_of(int crossing) const { return loops.loop_of[static_cast<std::size_t>(crossing)]; }
};

WalledCells::Cell WalledCells::place(field::BrickField& field, const BrickOwners& owners, glm::ivec3 cell,
                                     const CellShape& shape, const CellLoops& loops, const Guesses& guesses) {
    Work work{field, owners, cell, shape, loops, guesses, {}, {}};
    place_arcs(work);
    place_loops(work);
    Cell made;
    for (const Found& found : work.of_loops) made.loops.push_back(vertex_at(found.point, found.found_at, found.owner));
    for (const Found& found : work.of_arcs) made.arcs.push_back(vertex_at(found.point, found.found_at, found.owner));
    return made;
}

void WalledCells::begin(float cell_mm) {
    cell_mm_ = cell_mm;
    number_of_edge_.resize(edge_number(1, glm::ivec3(0)));
    for (const KnownEnds& known : ends_) number_of_edge_[known.edge] = 0;
    ends_.clear(), arcs_.clear();
}

glm::vec3 WalledCells::crossing(Work& work, int crossing) {
    const auto& [a, b] = ends_of_edge(crossing);
    const std::uint32_t edge = edge_number(0, 4 * work.cell + (a + b) / 2);
    std::uint16_t& number = number_of_edge_[edge];
    if (number == 0) {
        number = static_cast<std::uint16_t>(ends_.size() + 1);
        const auto owner = [&](const glm::ivec3& quarter) {
            const glm::ivec3 p = 2 * work.cell + quarter / 2;
            return work.owners.at(p.x, p.y, p.z);
        };
        const auto mm = [&](const glm::ivec3& quarter) {
            return (glm::vec3(work.cell) + 0.25F * glm::vec3(quarter)) * cell_mm_;
        };
        const auto inside = [&](const glm::ivec3& quarter) {
            const glm::ivec3 p = quarter / 2;
            return (work.shape.inside >> (p.x + 3 * p.y + 9 * p.z) & 1U) != 0;
        };
        const EdgeKind kind = !inside(b)   ? EdgeKind::kLowerInside
                              : !inside(a) ? EdgeKind::kUpperInside
                                           : EdgeKind::kWall;
        const float guess = work.guesses[static_cast<std::size_t>(crossing % kUpperEnd)];
        ends_.push_back(
            {edge, {owner(a), owner(b)}, ends_on_edge(work.field, {{mm(a), mm(b)}, kind, owner(a), owner(b), guess})});
    }
    const EdgeEnds& ends = ends_[number - 1U].ends;
    return crossing < kUpperEnd ? ends.lower.at : ends.upper.at;
}

void WalledCells::add_ends(std::uint32_t brick, std::vector<KnownEnds>& to) const {
    for (const KnownEnds& known : ends_) {
        to.push_back(known);
        to.back().edge += edge_number(brick, glm::ivec3(0));
    }
}

void WalledCells::place_arcs(Work& work) {
    const auto& arcs = work.loops.own_arcs;
    // Arcs of one face on both sides of a wall begin at one place.
    std::vector<WallPair> pairs;
    for (std::size_t a = 0; a < arcs.size(); ++a)
        for (std::size_t b = 0; b < arcs.size(); ++b) {
            if (a == b || arcs[a].face != arcs[b].face) continue;
            glm::vec3 toward(0.0F);
            for (const int end : {int{arcs[a].first}, int{arcs[a].second}})
                if (end < kUpperEnd && (arcs[b].first == other_side(end) || arcs[b].second == other_side(end)))
                    toward += direction_of(end);
            if (glm::dot(toward, toward) > 0.0F) pairs.push_back({a, b, toward});
        }
    const auto room_of = [&](const FaceArc& arc) {
        Span room = within_cell(work.cell, cell_mm_);
        const int axis = arc.face / 2;
        room.lower[axis] = room.upper[axis] = static_cast<float>(work.cell[axis] + (arc.face & 1)) * cell_mm_;
        return room;
    };
    const auto straight = [&](std::size_t a) {
        return 0.5F * (crossing(work, arcs[a].first) + crossing(work, arcs[a].second));
    };
    for (std::size_t a = 0; a < arcs.size(); ++a) {
        Span span;
        glm::vec3 guess = straight(a);
        span.include(crossing(work, arcs[a].first)), span.include(crossing(work, arcs[a].second));
        for (const WallPair& pair : pairs)
            if (pair.first == a || pair.second == a) {
                const std::size_t other = pair.first == a ? pair.second : pair.first;
                guess = 0.5F * (guess + straight(other));
                break;
            }
        const field::Owner owner = work.owners.of_crossing(work.cell, arcs[a].first);
        const auto [known, fresh] = arcs_.try_emplace(arc_number(work.cell, arcs[a]));
        if (fresh) known->second = move(work.field, owner, around(span, room_of(arcs[a])), guess);
        work.of_arcs.push_back({known->second, known->second.at, owner});
    }
    const auto meet = [&](std::size_t a, std::size_t b) {
        return lines_meet({crossing(work, arcs[a].first), work.of_arcs[a].point.at, crossing(work, arcs[a].second)},
                          {crossing(work, arcs[b].first), work.of_arcs[b].point.at, crossing(work, arcs[b].second)},
                          arcs[a].face / 2);
    };
    for (const WallPair& pair : pairs)
        part(work.of_arcs[pair.first].point, work.of_arcs[pair.second].point, pair.toward, room_of(arcs[pair.first]));
    // Straight lines between crossings of a face that follow each other around it do not meet.
    for (std::size_t a = 0; a < arcs.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            if (arcs[a].face == arcs[b].face && meet(a, b))
                work.of_arcs[a].point.at = straight(a), work.of_arcs[b].point.at = straight(b);
}

// The loops that walls lie between; those on both sides of one, or of several in a row, get the number of the first.
std::vector<WallPair> WalledCells::join_loops(Work& work, std::vector<Loop>& loop) {
    std::vector<WallPair> pairs;
    for (int m = 0; m < kCrossings; ++m) {
        const std::size_t n = work.loop_of(m), other = work.loop_of(other_side(m));
        if (n == kNoLoop) continue;
        if (const field::Owner owner = work.owners.of_crossing(work.cell, m); owner != field::kNoOwner)
            work.of_loops[n].owner = owner;
        if (other == kNoLoop || other == n) continue;
        const auto [first, second] = std::minmax({loop[n].first, loop[other].first}); // by value: they change
        for (Loop& one : loop)
            if (one.first == second) one.first = first;
        if (m >= kUpperEnd) continue;
        const auto known =
            std::ranges::find_if(pairs, [&](const WallPair& pair) { return pair.first == n && pair.second == other; });
        if (known == pairs.end())
            pairs.push_back({n, other, direction_of(m)});
        else
            known->toward += direction_of(m);
    }
    return pairs;
}

void WalledCells::place_loops(Work& work) {
    const auto count = static_cast<std::size_t>(work.loops.loop_count);
    const Span room = within_cell(work.cell, cell_mm_);
    work.of_loops.resize(count);
    std::vector<Loop> loop(count);
    for (std::size_t n = 0; n < count; ++n) loop[n].first = n;
    const std::vector<WallPair> pairs = join_loops(work, loop);
    for (int m = 0; m < kCrossings; ++m) {
        if (work.loop_of(m) == kNoLoop) continue;
        Loop& own = loop[work.loop_of(m)];
        const glm::vec3 at = crossing(work, m);
        loop[own.first].sum += at, loop[own.first].count += 1.0F;
        own.span.include(at);
    }
    for (std::size_t n = 0; n < count; ++n) {
        const Loop& first = loop[loop[n].first];
        Found& found = work.of_loops[n];
        found.point = move(work.field, found.owner, around(loop[n].span, room), first.sum / first.count);
        found.found_at = found.point.at;
    }
    for (const WallPair& pair : pairs)
        if (glm::dot(pair.toward, pair.toward) > 0.0F)
            part(work.of_loops[pair.first].point, work.of_loops[pair.second].point, pair.toward, room);
    part_loops(work, pairs);
}

// Parts the fans of loops that meet.
void WalledCells::part_loops(Work& work, const std::vector<WallPair>& pairs) {
    const std::size_t count = work.of_loops.size();
    if (count < 2) return;
    const Span room = within_cell(work.cell, cell_mm_);
    std::vector<Fan> fans(count);
    for (const FaceArc& arc : work.loops.arcs) {
        Fan& fan = fans[work.loop_of(arc.first)];
        const glm::vec3 from = crossing(work, arc.first), to = crossing(work, arc.second);
        std::size_t own = 0;
        const auto& with_vertex = work.loops.own_arcs;
        while (own < with_vertex.size() && (with_vertex[own].face != arc.face || with_vertex[own].first != arc.first ||
                                            with_vertex[own].second != arc.second))
            ++own;
        if (own < with_vertex.size()) {
            fan.edges.push_back({from, work.of_arcs[own].point.at});
            fan.edges.push_back({work.of_arcs[own].point.at, to});
        } else {
            fan.edges.push_back({from, to});
        }
    }
    std::vector<glm::vec3> at(count);
    for (std::size_t n = 0; n < count; ++n) at[n] = work.of_loops[n].point.at;
    std::vector<glm::vec3> toward(count, glm::vec3(0.0F));
    for (const WallPair& pair : pairs) toward[pair.first] -= pair.toward, toward[pair.second] += pair.toward;
    part_fans(fans, toward, room.lower, room.upper, at);
    for (std::size_t n = 0; n < count; ++n) work.of_loops[n].point.at = at[n];
}

} // namespace ramus::mesh::bricks
