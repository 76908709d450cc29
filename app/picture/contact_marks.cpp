#include "app/picture/contact_marks.h"

#include "app/assets/contacts.h"
#include "app/picture/place_marks.h"

#include <algorithm>
#include <array>
#include <string>

namespace ramus::app {

namespace {

constexpr glm::vec3 kOverlapColour{0.95F, 0.94F, 0.40F}, kGapColour{0.52F, 0.72F, 1.00F};
constexpr double kBeyondVessels = 1.25; // of the larger radius

bool is_hidden(const render::Frame& frame, int branch) {
    const auto index = static_cast<std::size_t>(branch);
    return index < frame.states.size() && frame.states[index] == tree::BranchState::kHidden;
}

// Colours the two vessels of the contact that a person looks at; a selection would hide the colours. Colours that vary
// along a branch stay.
void colour_sides(render::Frame& frame, const tree::Contact& contact, std::size_t branches) {
    constexpr std::array<glm::vec3, 2> kSideColours{{{0.20F, 0.70F, 0.62F}, {0.66F, 0.48F, 0.90F}}};
    if (frame.scale.value != render::ColourScale::Value::kNone) return;
    frame.colours.resize(branches, frame.appearance.vessel);
    for (std::size_t side = 0; side < contact.sides.size(); ++side)
        for (const int branch : contact.sides[side].branches) {
            if (static_cast<std::size_t>(branch) < branches)
                frame.colours[static_cast<std::size_t>(branch)] = kSideColours[side];
            std::erase(frame.selected, branch);
        }
}

} // namespace

void mark_contacts(render::Frame& frame, std::span<const tree::Contact> contacts, ContactMarks which, int current,
                   std::size_t branches, const Lengths& lengths) {
    const bool numbered = contacts.size() <= kMostNumberedContacts;
    for (std::size_t n = 0; n < contacts.size(); ++n) {
        const tree::Contact& contact = contacts[n];
        const bool is_current = static_cast<int>(n) == current;
        if (!is_current && (which == ContactMarks::kCurrent || n >= kMostContactMarks)) continue;
        const auto& [first, second] = contact.sides;
        if (is_hidden(frame, first.branch) || is_hidden(frame, second.branch)) continue;
        frame.lines.push_back(ring_facing_eye(frame, contact.at(),
                                              kBeyondVessels * std::max(first.radius, second.radius),
                                              contact.gap < 0.0 ? kOverlapColour : kGapColour, is_current));
        const std::string number = std::to_string(n + 1);
        if (is_current) colour_sides(frame, contact, branches);
        if (is_current)
            frame.labels.push_back({contact.at(), number + ": " + gap_text(contact, lengths)});
        else if (numbered)
            frame.labels.push_back({contact.at(), number});
    }
}

} // namespace ramus::app
