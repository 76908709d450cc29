#include "core/tree/contacts/contacts.h"

#include "core/tree/contacts/islands.h"
#include "core/tree/contacts/links.h"
#include "core/tree/contacts/move_apart.h"
#include "core/tree/contacts/touching_links.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

namespace ramus::tree {

namespace {

// What is left of a vessel's radius toward another one: where both tubes claim a place the nearer axis has it.
double kept(double radius, double other, double distance) {
    return std::min(radius, std::max(0.5 * distance, distance - other));
}

// The pairs of one contact, as links of its first vessel and links of its second.
Contact describe(const Links& links, std::span<const OrientedPair> pairs, double apart_from) {
    Contact contact;
    contact.apart_from = apart_from;
    contact.closeness = 1e300;
    std::array<std::vector<std::uint32_t>, 2> stretches;
    for (const OrientedPair& pair : pairs) {
        const Link& a = links[pair.link[0]];
        const Link& b = links[pair.link[1]];
        for (std::size_t side = 0; side < 2; ++side) stretches[side].push_back(pair.link[side]);
        const Approach approach = closest_approach(a, b);
        if (approach.closeness >= contact.closeness) continue;
        contact.closeness = approach.closeness;
        const Point p = point_on(a, approach.share_a);
        const Point q = point_on(b, approach.share_b);
        const double distance = glm::distance(p.position, q.position);
        contact.gap = distance - p.radius - q.radius;
        const auto put = [&](ContactSide& side, const Link& link, const Point& at, const Point& other) {
            side.branch = link.branch;
            side.at = at.position;
            side.radius = at.radius;
            side.narrowed = at.radius - kept(at.radius, other.radius, distance);
        };
        put(contact.sides[0], a, p, q);
        put(contact.sides[1], b, q, p);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        auto& stretch = stretches[side];
        std::ranges::sort(stretch);
        stretch.erase(std::unique(stretch.begin(), stretch.end()), stretch.end());
        auto& branches = contact.sides[side].branches;
        for (const std::uint32_t link : stretch) {
            branches.push_back(links[link].branch);
            contact.sides[side].length += glm::distance(links[link].a.position, links[link].b.position);
        }
        std::ranges::sort(branches);
        branches.erase(std::unique(branches.begin(), branches.end()), branches.end());
    }
    const glm::dvec3 aside = 0.5 * move_apart(links, pairs);
    contact.sides[0].aside = -aside;
    contact.sides[1].aside = aside;
    return contact;
}

} // namespace

ContactLimits::ContactLimits(double width)
    : merged(std::sqrt(1.0 + 1.0 / width)), bundled(std::sqrt(1.0 + 2.0 / width)),
      reach(1.0 + 0.45 * std::sqrt(5.0 / width)) {}

Contacts find_contacts(const PreparedTree& prepared, double width) {
    const ContactLimits limits(width);
    const Links links(prepared);
    const TouchingLinks touching(links, limits.reach);
    const Islands islands = find_islands(links, touching, limits);
    Contacts contacts;
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
        if (island.contact) contact = describe(links, island.pairs, island.apart_from);
        for (const OrientedPair& pair : island.pairs)
            for (std::size_t side = 0; side < 2; ++side)
                rows.push_back({pair.link[side],
                                {pair.link[1 - side], static_cast<float>(contact.apart_from),
                                 glm::vec3(contact.sides[side].aside)}});
        if (!island.contact) continue;
        if (contact.sides[1].branch < contact.sides[0].branch) std::swap(contact.sides[0], contact.sides[1]);
        contacts.list.push_back(std::move(contact));
    }
    std::ranges::stable_sort(contacts.list, {}, &Contact::closeness);
    std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.piece, row.partner.piece); });
    contacts.first_partner.assign(links.all().size() + 1, 0);
    for (const Row& row : rows) {
        ++contacts.first_partner[row.piece + 1];
        contacts.partners.push_back(row.partner);
    }
    for (std::size_t n = 1; n < contacts.first_partner.size(); ++n)
        contacts.first_partner[n] += contacts.first_partner[n - 1];
    return contacts;
}

} // namespace ramus::tree
