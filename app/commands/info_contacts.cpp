#include "app/commands/info_contacts.h"

#include "app/assets/contacts.h"
#include "app/commands/listing.h"
#include "app/session/numbers.h"
#include "app/session/systems.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <string>

namespace ramus::app {

namespace {

using nlohmann::ordered_json;

// "3", "3 (portal)", "3 and 2 more"
std::string side_text(const tree::VesselTree& tree, const tree::ContactSide& side) {
    std::string text = std::to_string(side.branch);
    if (!tree.systems.empty())
        text += " (" + system_name(tree.systems, tree.branches[static_cast<std::size_t>(side.branch)].system) + ")";
    if (side.branches.size() > 1) text += " and " + grouped(side.branches.size() - 1) + " more";
    return text;
}

std::string line_of(const tree::VesselTree& tree, const tree::Contact& contact) {
    const auto& [first, second] = contact.sides;
    const glm::dvec3 at = contact.at() + 0.0; // no negative zeros
    const auto both = [&](double a, double b) { return rounded(a) + " and " + rounded(b) + " mm"; };
    return Lengths(tree.claims)
        .worded("branch " + side_text(tree, first) + " with " + side_text(tree, second) + " at " + rounded(at.x) +
                ", " + rounded(at.y) + ", " + rounded(at.z) + " mm: " + (contact.crossing() ? "axes cross, " : "") +
                (contact.gap < 0.0 ? "overlap " : "gap ") + rounded(std::abs(contact.gap)) + " mm; narrowed by " +
                both(first.narrowed, second.narrowed) + "; along " + both(first.length, second.length));
}

} // namespace

ordered_json contacts_json(std::span<const tree::Contact> contacts) {
    ordered_json list = ordered_json::array();
    for (const tree::Contact& contact : contacts) {
        ordered_json sides = ordered_json::array();
        for (const tree::ContactSide& side : contact.sides)
            sides.push_back({{"branch", side.branch},
                             {"branches", side.branches},
                             {"at", place_json(side.at)},
                             {"radius_mm", side.radius},
                             {"narrowed_mm", side.narrowed},
                             {"length_mm", side.length}});
        list.push_back({{"branches", branches_of(contact)},
                        {"at", place_json(contact.at())},
                        {"gap_mm", contact.gap},
                        {"closeness", contact.closeness},
                        {"crossing", contact.crossing()},
                        {"sides", std::move(sides)}});
    }
    return list;
}

void print_contacts(std::ostream& stream, const tree::VesselTree& tree, std::span<const tree::Contact> contacts) {
    const auto overlaps = std::ranges::count_if(contacts, [](const tree::Contact& each) { return each.gap < 0.0; });
    const auto crossings = std::ranges::count_if(contacts, &tree::Contact::crossing);
    stream << std::left << std::setw(14) << "contacts" << std::right;
    if (contacts.empty()) {
        stream << "none\n";
        return;
    }
    stream << grouped(contacts.size()) << " (" << counted(static_cast<std::uint64_t>(overlaps), "overlap", "overlaps")
           << ", " << counted(static_cast<std::uint64_t>(crossings), "crossing", "crossings") << ")\n";
    const std::size_t listed = std::min(contacts.size(), kMostListed);
    for (std::size_t i = 0; i < listed; ++i) stream << "  " << i + 1 << ": " << line_of(tree, contacts[i]) << '\n';
    if (listed < contacts.size())
        stream << "  and " << grouped(contacts.size() - listed) << " more, which --json lists\n";
}

} // namespace ramus::app
