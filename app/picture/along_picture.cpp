#include "app/picture/along_picture.h"

#include "app/assets/assets.h"
#include "app/picture/colouring.h"
#include "app/picture/slices.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app {

namespace {

// Room around the picture, points: distances at the left, the caption above, scale bar and names below.
constexpr double kLeftPoints = 62.0, kRightPoints = 12.0, kTopPoints = 48.0, kBottomPoints = 44.0;

std::string arc_caption(const slice::VesselPath& path, const AlongVessel& along, const Lengths& lengths) {
    std::string caption(slice::name_of(along.kind));
    caption.front() = static_cast<char>(caption.front() - 'a' + 'A');
    caption += ", " + (along.way.to ? way_words(along.way) + ", at " : std::string("at ")) +
               arc_words(path, along.at_mm, lengths);
    if (along.angle_deg != 0.0) caption += ", turned by " + rounded(along.angle_deg) + "\xC2\xB0";
    return caption;
}

std::optional<render::AlongView::Stretch> pair_of(const Stretch& stretch) {
    return render::AlongView::Stretch{stretch.from_mm, stretch.to_mm};
}

render::AlongView along_view(const Session& session, const Assets& assets,
                             const std::shared_ptr<const render::PagedMesh>& mesh) {
    const AlongVessel& along = *session.slices.along;
    render::AlongView view{.path = assets.followed.path};
    view.kind = along.kind;
    view.angle_deg = along.angle_deg;
    view.width_mm = along.width_mm.value_or(usual_width_mm(*view.path));
    view.at_mm = along.at_mm;
    if (assets.sections && assets.sections->fits(assets.followed, mesh))
        view.lumens = {assets.sections, &assets.sections->lumens};
    if (along.stenosis) {
        view.narrow = pair_of(along.stenosis->where);
        if (along.stenosis->reference) view.reference = pair_of(*along.stenosis->reference);
    }
    const Lengths lengths(assets.tree->claims); // lengths along the vessel are the tree's, not the scan's
    for (const double arc : round_numbers(0.0, view.path->length_mm()))
        view.ticks.emplace_back(arc, latin1(lengths.text(arc)));
    return view;
}

// Fits the picture into its part of the window, and gives the grid the size of its pixels, for the scale bar.
void fit_along(render::SliceView& view, const Viewing& viewing, int inset_top) {
    render::AlongView& along = *view.along;
    const double ratio = viewing.pixel_ratio;
    const slice::Reformation picture = along.reformation();
    const glm::dvec2 cells(picture.columns, static_cast<double>(picture.rows.size()));
    const glm::dvec2 low(kLeftPoints * ratio, inset_top + kTopPoints * ratio);
    const glm::dvec2 room =
        glm::max(glm::dvec2(viewing.size) - low - ratio * glm::dvec2(kRightPoints, kBottomPoints), glm::dvec2(1.0));
    along.scale = std::min(room.x / cells.x, room.y / cells.y);
    along.corner = glm::round(low + 0.5 * (room - along.scale * cells));
    const glm::dvec3 middle = along.path->at(along.at_mm).at;
    view.grid = slice::grid_around(slice::Axes{}, middle, picture.mm_per_pixel / along.scale, viewing.size);
}

} // namespace

double usual_width_mm(const slice::VesselPath& path) {
    constexpr double kDiameters = 4.0;
    double widest = 0.0;
    for (const slice::PathSample& sample : path.samples) widest = std::max(widest, sample.radius_mm);
    return std::clamp(2.0 * kDiameters * widest, kLeastWidthMm, kMostWidthMm);
}

SliceViews views_at(SliceViews views, const slice::VesselPath& path, double at_mm) {
    if (!views.along) return views;
    views.along->at_mm = std::clamp(at_mm, 0.0, path.length_mm());
    const slice::PathSample sample = path.at(views.along->at_mm);
    views.crosshair = sample.at;
    views.oblique_normal = sample.axes.to_viewer();
    views.oblique_right = sample.axes.right;
    return views;
}

render::SliceView compose_along(const Session& session, const Assets& assets,
                                const std::shared_ptr<const render::PagedMesh>& mesh, const Viewing& viewing,
                                int inset_top) {
    render::SliceView view;
    view.sampling = session.slices.sampling;
    view.outlines = session.slices.outlines;
    view.pixel_ratio = viewing.pixel_ratio;
    add_scans(view, session, assets);
    view.masks.clear();
    view.along.emplace();
    view.grid = slice::grid_around(slice::Axes{}, {}, 1.0, viewing.size);
    const tree::Claims claims = slice_claims(session, assets);
    render::Overlays& overlays = view.overlays;
    overlays.orientation_cube = false;
    overlays.orientation_letters = false;
    overlays.unit_known = claims.has_unit();
    overlays.inset_top = inset_top;
    if (session.slices.along && assets.followed.path) {
        view.along = along_view(session, assets, mesh);
        fit_along(view, viewing, inset_top);
        overlays.caption = latin1(arc_caption(*view.along->path, *session.slices.along, Lengths(assets.tree->claims)));
    } else {
        overlays.scale_bar = false;
        overlays.caption =
            latin1(session.slices.along ? assets.followed.problem
                                        : "Along a vessel: right-click a branch, and follow it in slices");
    }
    return view;
}

void mark_followed(render::Frame& frame, const Session& session, const Assets& assets) {
    if (!session.slices.along || !assets.followed.path) return;
    const slice::PathSample sample = assets.followed.path->at(session.slices.along->at_mm);
    frame.lines.push_back({ring_around(sample.at, sample.tangent, 1.35 * sample.radius_mm),
                           slice_colour(slice::Direction::kOblique), 2.6F});
}

std::string way_words(const Way& way) {
    if (!way.to) return "branch " + std::to_string(way.from.branch);
    const std::string text = text_of(way);
    const std::size_t dots = text.find("..");
    const std::string from = text.substr(0, dots);
    const std::string to = text.substr(dots + 2);
    return from + " to " + (way.to->fraction ? to : "branch " + to);
}

std::string arc_words(const slice::VesselPath& path, double at_mm, const Lengths& lengths) {
    return lengths.text(at_mm) + " of " + lengths.text(path.length_mm()) + ", branch " +
           std::to_string(path.at(at_mm).place.branch);
}

std::string stenosis_words(const NarrowPlaces& places, const VesselSections& sections, const Lengths& lengths) {
    const auto one = [&](const char* measure, const slice::Narrowing& narrowing, const std::string& least,
                         const std::string& reference) {
        return std::string(measure) + " " + digits(narrowing.percent) + " % less (" + least + " against " + reference +
               ") at " + lengths.text(sections.path->samples[narrowing.sample].arc_mm);
    };
    const auto figures = [&](const slice::Narrowing& narrowing) -> const slice::ShapeFigures& {
        return *sections.figures[narrowing.sample];
    };
    const slice::Stenosis& found = places.found;
    const slice::ShapeFigures& reference = places.reference;
    return one("Least diameter", found.least_diameter, lengths.text(figures(found.least_diameter).least_mm),
               lengths.text(reference.least_mm)) +
           "; " +
           one("equivalent diameter", found.equivalent_diameter,
               lengths.text(figures(found.equivalent_diameter).equivalent_mm), lengths.text(reference.equivalent_mm)) +
           "; " + one("area", found.area, lengths.area(figures(found.area).area_mm2), lengths.area(reference.area_mm2));
}

} // namespace ramus::app
