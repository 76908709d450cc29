#include "app/assets/contacts.h"

#include "app/session/numbers.h"
#include "core/field/kernel.h"
#include "core/mesh/tree_field.h"

#include <cmath>
#include <utility>

namespace ramus::app {

TreeContacts contacts_of(const tree::VesselTree& tree, const mesh::SurfaceOptions& options) {
    tree::Contacts found = tree::find_contacts(mesh::prepare_tree(tree, options), mesh::kernel_of(options).limits);
    return {options.smooth_passes, options.prune_ratio, options.width, options.kernel,
            std::make_shared<const std::vector<tree::Contact>>(std::move(found.list))};
}

std::vector<int> branches_of(const tree::Contact& contact) {
    const auto& [first, second] = contact.sides;
    return first.branch == second.branch ? std::vector{first.branch} : std::vector{first.branch, second.branch};
}

std::string gap_text(const tree::Contact& contact, const Lengths& lengths) {
    const std::string length = lengths.text(std::abs(contact.gap));
    if (contact.crossing()) return "axes cross, overlap " + length;
    return (contact.gap < 0.0 ? "overlap " : "gap ") + length;
}

} // namespace ramus::app
