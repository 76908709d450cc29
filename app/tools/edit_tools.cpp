#include "app/tools/edit_tools.h"

#include "app/session/numbers.h"
#include "app/tools/spelling.h"
#include "core/measure/branch_point.h"
#include "core/tree/edit_tree.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

const glm::vec4 kGoes{1.0F, 0.92F, 0.35F, 1.0F};
const glm::vec4 kComes{0.55F, 0.95F, 0.65F, 1.0F};
const glm::vec4 kRefused{1.0F, 0.80F, 0.55F, 1.0F};
constexpr double kAtEnd = 2.0; // snaps to a free end within this many radii

const tree::Branch& branch_of(const Pointing& pointing, int id) {
    return pointing.document.tree()->branches[static_cast<std::size_t>(id)];
}

void write(ToolDrawing& drawing, const Pointing& pointing, const std::string& text, const glm::vec4& colour) {
    drawing.texts.push_back(
        {pointing.at + glm::dvec2(16.0, 12.0) * static_cast<double>(pointing.pixel_ratio), text, colour});
}

// The centerline between two fractions.
void trace(ToolDrawing& drawing, const Pointing& pointing, int id, double from, double to) {
    constexpr int kSteps = 48;
    ToolDrawing::Line line{.points = {}, .colour = kGoes, .width = 4.0F, .closed = false};
    for (int i = 0; i <= kSteps; ++i) {
        const double at = from + (to - from) * i / kSteps;
        const auto place = render::project(pointing.camera(), pointing.size,
                                           measure::point_on(*pointing.document.tree(), id, at).position);
        if (!place) return;
        line.points.emplace_back(*place);
    }
    ToolDrawing::Line rim = line; // visible on vessels of any colour
    rim.colour = {0.05F, 0.05F, 0.05F, 1.0F};
    rim.width = 8.0F;
    drawing.lines.push_back(std::move(rim));
    drawing.lines.push_back(std::move(line));
}

std::optional<glm::dvec2> dot(ToolDrawing& drawing, const Pointing& pointing, int id, double fraction,
                              const glm::vec4& colour) {
    const auto at = render::project(pointing.camera(), pointing.size,
                                    measure::point_on(*pointing.document.tree(), id, fraction).position);
    if (!at) return {};
    drawing.circles.push_back({glm::dvec2(*at), 5.0 * pointing.pixel_ratio, colour, 2.0F, true});
    drawing.circles.push_back({glm::dvec2(*at), 9.0 * pointing.pixel_ratio, colour, 1.5F, false});
    return glm::dvec2(*at);
}

std::string end_word(double fraction) { return fraction > 0.5 ? "end" : "start"; }

// Why the edit that a click would make fails; none: it succeeds.
std::optional<Error> refusal(const Pointing& pointing, const tree::Edit& edit) {
    const auto tried = tree::apply(*pointing.document.tree(), edit);
    return tried ? std::nullopt : std::optional(tried.error());
}

} // namespace

void EditTool::move(const Pointing& pointing) {
    under_ = pointing.pick();
    under_at_ = pointing.at;
    under_of_ = pointing.document.tree();
}

render::Pick EditTool::under(const Pointing& pointing) const {
    return under_of_ == pointing.document.tree() && under_at_ == pointing.at ? under_ : render::Pick{};
}

void EditTool::learn(const Pointing& pointing) const {
    if (tree_ == pointing.document.tree()) return;
    tree_ = pointing.document.tree();
    degrees_ = tree_ ? tree::degrees(*tree_) : std::vector<int>{};
}

std::optional<EditTool::Spot> EditTool::free_end(const Pointing& pointing, const render::Pick& pick) const {
    if (pick.branch < 0 || pick.branch >= pointing.document.branch_count()) return {};
    learn(pointing);
    const auto& points = branch_of(pointing, pick.branch).points;
    const double at = measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position);
    for (const double end : at > 0.5 ? std::array{1.0, 0.0} : std::array{0.0, 1.0})
        if (degrees_[end > 0.5 ? points.back() : points.front()] == 1) return Spot{pick.branch, end, true};
    return {};
}

std::optional<EditTool::Spot> EditTool::spot(const Pointing& pointing, const render::Pick& pick) const {
    const auto end = free_end(pointing, pick);
    if (pick.branch < 0 || pick.branch >= pointing.document.branch_count()) return {};
    const tree::VesselTree& tree = *pointing.document.tree();
    const double at = measure::nearest_fraction(tree, pick.branch, pick.position);
    if (end) {
        const measure::BranchPoint there = measure::point_on(tree, pick.branch, end->fraction);
        const measure::BranchPoint here = measure::point_on(tree, pick.branch, at);
        if (glm::distance(there.position, here.position) <= kAtEnd * there.radius_mm) return end;
    }
    return Spot{pick.branch, at, false};
}

void DisconnectTool::press(const Pointing& pointing) {
    const auto place = spot(pointing, pointing.pick());
    if (!place) return;
    command({"disconnect", std::to_string(place->branch), spelled(place->fraction, 3)});
}

ToolDrawing DisconnectTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    const auto place = spot(pointing, under(pointing));
    if (!place) return drawing;
    const tree::VesselTree& tree = *pointing.document.tree();
    const tree::CutRange range = tree::cut_range(tree, place->branch, place->fraction, 0.0);
    trace(drawing, pointing, place->branch, range.from, range.to);
    const double length = tree::length_mm(tree, branch_of(pointing, place->branch));
    write(drawing, pointing, "takes out " + pointing.document.lengths().text((range.to - range.from) * length), kGoes);
    return drawing;
}

std::optional<EditTool::Spot> JoinTool::first(const Pointing& pointing) const {
    return first_of_ == pointing.document.tree() ? first_ : std::nullopt;
}

void JoinTool::press(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    const auto begun = first(pointing);
    if (!begun) {
        first_ = free_end(pointing, pick);
        first_of_ = pointing.document.tree();
        // The error of the command explains what is wrong with this place.
        if (const auto wrong = spot(pointing, pick); wrong && !first_)
            command({"join", std::to_string(wrong->branch), end_word(wrong->fraction), std::to_string(wrong->branch),
                     end_word(wrong->fraction)});
        return;
    }
    const auto second = spot(pointing, pick);
    if (!second) return;
    command({"join", std::to_string(begun->branch), end_word(begun->fraction), std::to_string(second->branch),
             second->free_end ? end_word(second->fraction) : spelled(second->fraction, 3)});
    if (*second != *begun) first_.reset();
}

ToolDrawing JoinTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    const render::Pick pick = under(pointing);
    const auto begun = first(pointing);
    if (!begun) {
        if (const auto end = free_end(pointing, pick))
            (void)dot(drawing, pointing, end->branch, end->fraction, kComes);
        else if (spot(pointing, pick))
            write(drawing, pointing, "no free end", kRefused);
        return drawing;
    }
    const auto from = dot(drawing, pointing, begun->branch, begun->fraction, kComes);
    const auto second = spot(pointing, pick);
    std::optional<Error> wrong;
    glm::dvec2 to = pointing.at;
    if (second) {
        wrong = refusal(
            pointing,
            {tree::Edit::Kind::kJoin, {begun->branch, second->branch}, {begun->fraction, second->fraction}, 0.0});
        const auto at = dot(drawing, pointing, second->branch, second->fraction, wrong ? kRefused : kComes);
        if (at) to = *at;
        const tree::VesselTree& tree = *pointing.document.tree();
        const double gap = glm::distance(measure::point_on(tree, begun->branch, begun->fraction).position,
                                         measure::point_on(tree, second->branch, second->fraction).position);
        write(drawing, pointing, wrong ? wrong->what : pointing.document.lengths().text(gap),
              wrong ? kRefused : kComes);
    }
    if (from) drawing.lines.push_back({{*from, to}, wrong ? kRefused : kComes, 2.0F, false});
    return drawing;
}

std::string JoinTool::hint() const {
    return first_ ? "Click the end or the place to join it with, Escape to begin again"
                  : "Click a vessel near its free end, then what it belongs to";
}

void SpurTool::press(const Pointing& pointing) {
    if (const auto place = spot(pointing, pointing.pick())) command({"delete-spur", std::to_string(place->branch)});
}

ToolDrawing SpurTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    const auto place = spot(pointing, under(pointing));
    if (!place) return drawing;
    if (!branch_of(pointing, place->branch).children.empty() && !free_end(pointing, under(pointing))) {
        write(drawing, pointing, "carries others: cut it, or delete those first", kRefused);
        return drawing;
    }
    trace(drawing, pointing, place->branch, 0.0, 1.0);
    write(drawing, pointing, "deletes branch " + std::to_string(place->branch), kGoes);
    return drawing;
}

void RootTool::press(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    if (const auto end = free_end(pointing, pick))
        command({"move-root", std::to_string(end->branch), end_word(end->fraction)});
    else if (const auto wrong = spot(pointing, pick))
        command({"move-root", std::to_string(wrong->branch)}); // fails and reports why
}

ToolDrawing RootTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    const render::Pick pick = under(pointing);
    if (const auto end = free_end(pointing, pick))
        (void)dot(drawing, pointing, end->branch, end->fraction, kComes);
    else if (spot(pointing, pick))
        write(drawing, pointing, "no free end", kRefused);
    return drawing;
}

} // namespace ramus::app
