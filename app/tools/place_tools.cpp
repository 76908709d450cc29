#include "app/tools/place_tools.h"

#include "app/session/numbers.h"
#include "app/session/usual_sizes.h"
#include "app/tools/spelling.h"
#include "core/measure/branch_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace ramus::app {

namespace {

const glm::vec4 kCutColour{1.0F, 0.48F, 0.40F, 1.0F};
constexpr int kCorners = 40;

bool on_tree(const Pointing& pointing, const render::Pick& pick) {
    return pick.branch >= 0 && pick.branch < pointing.document.branch_count();
}

constexpr double kOutlineShare = 0.72; // of its radius: presses farther out grab the outline
constexpr double kSlackPoints = 5.0;   // distance outside the outline that still grabs it
constexpr double kClickPoints = 3.0;   // a pointer that moved less was only clicked
const glm::vec4 kLesionColour{1.0F, 0.86F, 0.35F, 1.0F};

// A sphere projected into the picture.
struct Disc {
    glm::dvec2 at{0.0};
    double radius = 0.0; // pixels
    double depth_mm = 0.0;
};

double mm_per_pixel_at(const Pointing& pointing, glm::dvec2 at, double depth_mm) {
    const auto here = render::unproject(pointing.camera(), pointing.size, at, depth_mm);
    const auto beside = render::unproject(pointing.camera(), pointing.size, at + glm::dvec2(1.0, 0.0), depth_mm);
    return glm::distance(here, beside);
}

std::optional<Disc> disc_of(const Pointing& pointing, const std::array<double, 4>& sphere) {
    const auto at = render::project(pointing.camera(), pointing.size, {sphere[0], sphere[1], sphere[2]});
    if (!at) return {};
    return Disc{glm::dvec2(*at), sphere[3] / mm_per_pixel_at(pointing, glm::dvec2(*at), at->z), at->z};
}

// Whether a slice passes through the sphere, if the pointer is on a slice.
bool is_cut(const Pointing& pointing, const std::array<double, 4>& sphere) {
    return !pointing.slice ||
           std::abs(pointing.slice->grid.plane().height({sphere[0], sphere[1], sphere[2]})) < sphere[3];
}

// The sphere nearest to the eye under the pointer.
std::optional<std::pair<std::size_t, Disc>> lesion_under(const Pointing& pointing) {
    std::optional<std::pair<std::size_t, Disc>> found;
    const auto& lesions = pointing.document.marks().lesions;
    for (std::size_t i = 0; i < lesions.size(); ++i) {
        if (lesions[i].is_mesh() || !lesions[i].visible || !is_cut(pointing, lesions[i].sphere)) continue;
        const auto disc = disc_of(pointing, lesions[i].sphere);
        if (!disc || glm::distance(disc->at, pointing.at) > disc->radius + kSlackPoints * pointing.pixel_ratio)
            continue;
        if (!found || disc->depth_mm < found->second.depth_mm) found = {i, *disc};
    }
    return found;
}

double usual_radius(const Pointing& pointing) {
    const auto tree = pointing.document.tree();
    return (tree != nullptr ? usual_sizes(*tree) : UsualSizes()).lesion_radius_mm;
}

void put(std::array<double, 4>& sphere, const glm::dvec3& centre) {
    for (int k = 0; k < 3; ++k) sphere[static_cast<std::size_t>(k)] = centre[k];
}

constexpr double kCutReachPoints = 12.0; // distance from the middle of a cut's ring that still grabs it

// The index of the cut whose ring is under the pointer.
std::optional<std::size_t> cut_under(const Pointing& pointing) {
    const auto& cuts = pointing.document.marks().cuts;
    std::optional<std::size_t> found;
    double nearest = kCutReachPoints * pointing.pixel_ratio;
    for (std::size_t n = 0; n < cuts.size() && pointing.document.tree(); ++n) {
        if (cuts[n].first >= pointing.document.branch_count()) continue;
        const measure::BranchPoint place = measure::point_on(*pointing.document.tree(), cuts[n].first, cuts[n].second);
        const auto at = render::project(pointing.camera(), pointing.size, place.position);
        const double away = at ? glm::distance(glm::dvec2(*at), pointing.at) : nearest;
        if (away < nearest && pointing.shows(place.position)) nearest = away, found = n;
    }
    return found;
}

} // namespace

void CutTool::press(const Pointing& pointing) {
    const render::Pick pick = pointing.pick();
    if (const auto cut = cut_under(pointing)) {
        const auto& [branch, fraction] = pointing.document.marks().cuts[*cut];
        held_ = Held{*cut, branch, fraction, fraction};
        return;
    }
    if (!on_tree(pointing, pick)) return;
    const double fraction = measure::nearest_fraction(*pointing.document.tree(), pick.branch, pick.position);
    command({"cut", std::to_string(pick.branch), spelled(fraction, 3)});
}

void CutTool::move(const Pointing& pointing) {
    under_ = pointing.pick();
    const auto& cuts = pointing.document.marks().cuts;
    if (!held_ || !pointing.held || !on_tree(pointing, under_) || under_.branch != held_->branch) return;
    if (held_->cut >= cuts.size() || cuts[held_->cut].first != held_->branch) return; // removed meanwhile
    send(measure::nearest_fraction(*pointing.document.tree(), under_.branch, under_.position));
}

void CutTool::send(double fraction) {
    if (fraction == std::exchange(held_->now, fraction)) return;
    command({"cut-move", std::to_string(held_->cut + 1), spelled(fraction, 3)});
}

bool CutTool::escape() {
    if (!held_) return false;
    send(held_->before);
    held_.reset();
    return true;
}

// The ring of the cross-section, a little wider than the vessel.
ToolDrawing CutTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    if (!on_tree(pointing, under_)) return drawing;
    const tree::VesselTree& tree = *pointing.document.tree();
    const double fraction = measure::nearest_fraction(tree, under_.branch, under_.position);
    const measure::BranchPoint place = measure::point_on(tree, under_.branch, fraction);
    const glm::dvec3 aside = std::abs(place.direction.x) < 0.8 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 u = glm::normalize(glm::cross(place.direction, aside));
    const glm::dvec3 v = glm::cross(place.direction, u);
    ToolDrawing::Line ring{.points = {}, .colour = kCutColour, .width = 2.0F, .closed = true};
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        const auto at =
            render::project(pointing.camera(), pointing.size,
                            place.position + 1.15 * place.radius_mm * (std::cos(angle) * u + std::sin(angle) * v));
        if (!at) return drawing;
        ring.points.emplace_back(*at);
    }
    drawing.lines.push_back(std::move(ring));
    drawing.texts.push_back({pointing.at + glm::dvec2(16.0, 12.0) * static_cast<double>(pointing.pixel_ratio),
                             "\xC3\x98 " + pointing.document.lengths().text(2.0 * place.radius_mm), kCutColour});
    return drawing;
}

void LesionTool::press(const Pointing& pointing) {
    Held held;
    held.pressed_at = pointing.at;
    held.usual_mm = usual_radius(pointing);
    if (const auto under = lesion_under(pointing)) {
        held.index = under->first;
        held.sphere = held.before = pointing.document.marks().lesions[under->first].sphere;
        held.sizing = glm::distance(under->second.at, pointing.at) > kOutlineShare * under->second.radius;
        held.depth_mm = under->second.depth_mm;
        held_ = held;
        return;
    }
    const render::Pick pick = pointing.pick();
    const render::Camera& camera = pointing.camera();
    const glm::dvec3 forward = render::axes_of(camera).forward;
    const glm::dvec3 reference = pick.branch != render::kNoBranch ? pick.position : camera.focal_point;
    held.depth_mm = glm::dot(reference - camera.position, forward);
    put(held.sphere, pick.branch != render::kNoBranch
                         ? pick.position
                         : render::unproject(camera, pointing.size, pointing.at, held.depth_mm));
    held.sphere[3] = held.usual_mm;
    held_ = held;
}

void LesionTool::move(const Pointing& pointing) {
    if (!held_ || !pointing.held) return;
    if (!held_->moved && glm::distance(pointing.at, held_->pressed_at) < kClickPoints * pointing.pixel_ratio) return;
    held_->moved = true;
    const glm::dvec3 centre(held_->sphere[0], held_->sphere[1], held_->sphere[2]);
    if (held_->sizing) {
        const glm::dvec3 rim = render::unproject(pointing.camera(), pointing.size, pointing.at, held_->depth_mm);
        held_->sphere[3] = std::max(kLeastOfUsual * held_->usual_mm, glm::distance(rim, centre));
        return;
    }
    const auto from = render::unproject(pointing.camera(), pointing.size, held_->pressed_at, held_->depth_mm);
    const auto to = render::unproject(pointing.camera(), pointing.size, pointing.at, held_->depth_mm);
    put(held_->sphere, glm::dvec3(held_->before[0], held_->before[1], held_->before[2]) + to - from);
}

// A lesion that was changed meanwhile, for example by a key, is left as it is.
void LesionTool::release(const Pointing& pointing) {
    const auto held = std::exchange(held_, std::nullopt);
    if (!held) return;
    const auto& lesions = pointing.document.marks().lesions;
    if (held->index && (*held->index >= lesions.size() || lesions[*held->index].sphere != held->before)) return;
    const auto& [x, y, z, r] = held->sphere;
    const std::string sphere = spelled({x, y, z}) + "," + spelled(r);
    if (!held->index)
        command({"lesion", sphere});
    else if (held->moved)
        command({"lesion-change", std::to_string(*held->index + 1), sphere});
}

ToolDrawing LesionTool::drawing(const Pointing& pointing) const {
    ToolDrawing drawing;
    const auto outline = [&](const std::array<double, 4>& sphere, float strength) {
        const auto disc = disc_of(pointing, sphere);
        if (!disc) return;
        drawing.circles.push_back({disc->at, disc->radius, glm::vec4(glm::vec3(kLesionColour), strength), 1.5F, false});
        drawing.texts.push_back({disc->at + glm::dvec2(disc->radius + 8.0 * pointing.pixel_ratio, 0.0),
                                 "\xC3\x98 " + pointing.document.lengths().text(2.0 * sphere[3]), kLesionColour});
    };
    if (held_)
        outline(held_->sphere, 1.0F);
    else if (const auto under = lesion_under(pointing))
        outline(pointing.document.marks().lesions[under->first].sphere, 0.6F);
    return drawing;
}

std::string LesionTool::hint() const {
    return held_ ? "Drag to size or move it, let go to keep it, Escape to leave it"
                 : "Press on a vessel, next to it or on a slice to place a lesion, drag to size it; press on a lesion "
                   "to change "
                   "it";
}

} // namespace ramus::app
