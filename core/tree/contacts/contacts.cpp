#include "core/tree/contacts/contacts.h"

#include "core/base/sort_unique.h"
#include "core/tree/contacts/islands.h"
#include "core/tree/contacts/links.h"
#include "core/tree/contacts/spread_axes.h"
#include "core/tree/contacts/touching_links.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>

namespace ramus::tree {

namespace {

// The radius (mm) that is left of a vessel toward another one: a place that both tubes contain belongs to the nearer
// axis.
double kept(double radius, double other, double distance) {
    return std::min(radius, std::max(0.5 * distance, distance - other));
}

// Which of kPlaces evenly spaced places on a link are closer to another link than `close`: one bit each.
constexpr unsigned kPlaces = 64;
std::uint64_t places_beside(const Link& link, const Link& other, double close) {
    std::uint64_t places = 0;
    for (unsigned n = 0; n < kPlaces; ++n)
        if (closeness(point_on(link, (n + 0.5) / kPlaces), other) < close) places |= std::uint64_t{1} << n;
    return places;
}

// Describes the contact of an island. Places with a closeness below `close` count for its branches and lengths.
Contact describe(const Links& links, const Island& island, const Contacts& contacts, double close) {
    Contact contact;
    contact.apart_from = island.apart_from;
    contact.closeness = 1e300;
    std::array<std::map<std::uint32_t, std::uint64_t>, 2> stretches; // links, with their places that are close
    std::array<Point, 2> closest;
    glm::dvec3 moved_apart(0.0);
    for (const OrientedPair& pair : island.pairs) {
        const Link a = links[pair.link[0]];
        const Link b = links[pair.link[1]];
        stretches[0][pair.link[0]] |= places_beside(a, b, close);
        stretches[1][pair.link[1]] |= places_beside(b, a, close);
        const Approach approach = closest_approach(a, b);
        if (approach.closeness >= contact.closeness) continue;
        contact.closeness = approach.closeness;
        closest = {point_on(a, approach.share_a), point_on(b, approach.share_b)};
        moved_apart =
            contacts.move_of(pair.link[1]).at(approach.share_b) - contacts.move_of(pair.link[0]).at(approach.share_a);
        contact.sides[0].branch = a.branch;
        contact.sides[1].branch = b.branch;
    }
    const glm::dvec3 between = closest[1].position - closest[0].position;
    contact.gap = glm::length(between) - closest[0].radius - closest[1].radius;
    const double distance = glm::length(between + moved_apart); // of the moved axes, which decide where the wall lies
    for (std::size_t n = 0; n < 2; ++n) {
        ContactSide& side = contact.sides[n];
        side.at = closest[n].position;
        side.radius = closest[n].radius;
        side.narrowed = side.radius - kept(side.radius, closest[1 - n].radius, distance);
        for (const auto& [link, places] : stretches[n]) {
            if (places == 0) continue;
            side.branches.push_back(links[link].branch);
            side.length += glm::distance(links[link].a.position, links[link].b.position) *
                           static_cast<double>(std::popcount(places)) / kPlaces;
        }
        if (side.branches.empty()) side.branches.push_back(side.branch);
        sort_unique(side.branches);
    }
    return contact;
}

} // namespace

ContactLimits limits_of_gaussian(double width) {
    return {std::sqrt(1.0 + 1.0 / width), std::sqrt(1.0 + 2.0 / width), 1.0 + 0.45 * std::sqrt(5.0 / width)};
}

Contacts find_contacts(const PreparedTree& prepared, const ContactLimits& limits,
                       const LargeAllocator<std::byte>& memory) {
    const Links links(prepared);
    const TouchingLinks touching(links, limits.reach, limits.merged, memory);
    const Islands islands = find_islands(links, touching, limits, memory);
    Contacts contacts;
    contacts.moves = spread_axes(links, islands.all);
    const std::vector<std::uint32_t>& of_segment = links.of_segment();
    if (prepared.segment_index.empty()) {
        contacts.piece_of_segment = of_segment;
    } else {
        contacts.piece_of_segment.assign(prepared.source_segments, 0);
        for (std::size_t n = 0; n < of_segment.size(); ++n)
            contacts.piece_of_segment[prepared.segment_index[n]] = of_segment[n];
    }
    struct Row {
        std::uint32_t piece;
        Contacts::Partner partner;
    };
    std::vector<Row> rows;
    for (const Island& island : islands.all) {
        Contact contact;
        if (island.contact) contact = describe(links, island, contacts, limits.bundled);
        const auto apart_from = static_cast<float>(island.parting ? island.apart_from : contact.apart_from);
        for (const OrientedPair& pair : island.pairs)
            for (std::size_t side = 0; side < 2; ++side)
                rows.push_back({pair.link[side], {pair.link[1 - side], apart_from, island.parting}});
        if (!island.contact) continue;
        if (contact.sides[1].branch < contact.sides[0].branch) std::swap(contact.sides[0], contact.sides[1]);
        contacts.list.push_back(std::move(contact));
    }
    std::ranges::stable_sort(contacts.list, {}, &Contact::closeness);
    const auto pieces = [](const Row& row) { return std::pair(row.piece, row.partner.piece); };
    std::ranges::sort(rows, {}, [&](const Row& row) { return std::pair(pieces(row), -row.partner.apart_from); });
    // A pair may be part of both a fold and a contact.
    const auto same = [&](const Row& a, const Row& b) { return pieces(a) == pieces(b); };
    rows.erase(std::unique(rows.begin(), rows.end(), same), rows.end());
    contacts.first_partner.assign(links.size() + 1, 0);
    for (const Row& row : rows) {
        ++contacts.first_partner[row.piece + 1];
        contacts.partners.push_back(row.partner);
    }
    for (std::size_t n = 1; n < contacts.first_partner.size(); ++n)
        contacts.first_partner[n] += contacts.first_partner[n - 1];
    return contacts;
}

} // namespace ramus::tree
