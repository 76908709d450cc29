#include "app/panels/overview.h"

#include <algorithm>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

using tree::BranchState;

std::size_t as_index(int id) { return static_cast<std::size_t>(id); }

glm::vec4 colour_of(BranchState state, const glm::vec3& vessel, bool any_highlight) {
    const render::Appearance appearance;
    switch (state) {
    case BranchState::kNormal:
        return {any_highlight ? glm::mix(glm::vec3(0.35F), vessel, 0.4F) * 0.75F : vessel, 1.0F};
    case BranchState::kHighlighted:
        return {appearance.highlight, 1.0F};
    case BranchState::kDefocused:
        return {appearance.glass, 0.45F};
    case BranchState::kHidden:
        return {appearance.glass, 0.14F};
    }
    return {vessel, 1.0F};
}

// The look of each branch.
void make_single_looks(Overview& overview, const Marks& marks, const PictureLook& picture) {
    const render::Appearance appearance;
    const bool any_highlight = std::ranges::find(marks.states, BranchState::kHighlighted) != marks.states.end();
    overview.looks.assign(overview.layout.lines.size(), {});
    for (std::size_t id = 0; id < overview.looks.size(); ++id) {
        const glm::vec3 vessel = id < picture.colours.size() ? picture.colours[id] : appearance.vessel;
        overview.looks[id].colour = colour_of(state_of(marks, static_cast<int>(id)), vessel, any_highlight);
    }
    for (const render::LostPart& part : picture.lost) {
        if (as_index(part.branch) >= overview.looks.size()) continue;
        Overview::Look& look = overview.looks[as_index(part.branch)];
        look.lost_from = static_cast<float>(part.from);
        look.lost_to = static_cast<float>(part.to);
        if (part.to - part.from > 0.5) look.colour = {1.25F * appearance.lost, look.colour.a};
    }
    for (const int id : marks.selection) {
        Overview::Look& look = overview.looks[as_index(id)];
        look.selected = true;
        look.colour = {glm::mix(glm::vec3(look.colour), appearance.selection, 0.62F), std::max(look.colour.a, 0.6F)};
    }
    const auto brighten = [&](int id, float share) {
        if (id < 0 || as_index(id) >= overview.looks.size()) return;
        Overview::Look& look = overview.looks[as_index(id)];
        look.hovered = true;
        look.colour = {glm::mix(glm::vec3(look.colour), glm::vec3(1.0F), share), std::max(look.colour.a, 0.6F)};
    };
    for (const int id : picture.glowing) brighten(id, 0.35F);
    brighten(picture.hovered, 0.85F);
}

// Prefix sums, for lines that represent several branches.
void sum_looks(Overview& overview) {
    const std::size_t count = overview.layout.order.size();
    overview.colour_sums.assign(count + 1, glm::dvec4(0.0));
    overview.selected_sums.assign(count + 1, 0);
    overview.hovered_sums.assign(count + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
        const Overview::Look& look = overview.looks[as_index(overview.layout.order[i])];
        overview.colour_sums[i + 1] = overview.colour_sums[i] + glm::dvec4(look.colour);
        overview.selected_sums[i + 1] = overview.selected_sums[i] + (look.selected ? 1 : 0);
        overview.hovered_sums[i + 1] = overview.hovered_sums[i] + (look.hovered ? 1 : 0);
    }
}

} // namespace

void make_looks(Overview& overview, const Marks& marks, const PictureLook& picture) {
    const bool fresh = overview.looks.size() == overview.layout.lines.size();
    if (fresh && overview.looks_states == marks.states && overview.looks_selection == marks.selection &&
        overview.looks_picture == picture)
        return;
    overview.looks_states = marks.states;
    overview.looks_selection = marks.selection;
    overview.looks_picture = picture;
    make_single_looks(overview, marks, picture);
    sum_looks(overview);
}

Overview::Look look_of(const Overview& overview, const OverviewPiece& piece) {
    if (!piece.merged) return overview.looks[as_index(piece.branch)];
    const OverviewLine& line = overview.layout.lines[as_index(piece.branch)];
    const auto begin = static_cast<std::size_t>(line.begin);
    const auto end = static_cast<std::size_t>(line.end);
    const auto count = static_cast<double>(end - begin);
    Overview::Look look;
    look.colour = glm::vec4((overview.colour_sums[end] - overview.colour_sums[begin]) / count);
    look.selected = overview.selected_sums[end] > overview.selected_sums[begin];
    look.hovered = overview.hovered_sums[end] > overview.hovered_sums[begin];
    return look;
}

} // namespace ramus::app
