#include "app/actions/slice_pictures.h"

#include "app/assets/assets.h"
#include "app/picture/along_picture.h"
#include "app/picture/scene_objects.h"
#include "app/picture/slice_marks.h"
#include "app/picture/slices.h"
#include "core/measure/branch_point.h"
#include "render/slice/slice_painter.h"

#include <array>

namespace ramus::app::actions {

namespace {

struct SlicePlace {
    std::string title;
    glm::dvec3 at;
};

// The middle of the box around the points that determine an object's extent.
template <SceneObject T> std::optional<glm::dvec3> middle_of_object(const Assets& assets, const T& object) {
    std::vector<glm::vec3> points;
    add_points(points, assets, object);
    if (points.empty()) return {};
    const Bounds<glm::vec3> box = box_of_points(points);
    return glm::dvec3(0.5F * (box.least + box.most));
}

std::vector<SlicePlace> places_of(const Session& session, const Assets& assets, const Lengths& lengths) {
    const Marks& marks = session.marks;
    std::vector<SlicePlace> places;
    const auto add_objects = [&](const auto& list) {
        for (std::size_t n = 0; n < list.size(); ++n)
            if (const auto at = list[n].visible ? middle_of_object(assets, list[n]) : std::nullopt)
                places.push_back({words_of(list[n], n, assets, lengths).title, *at});
    };
    add_objects(marks.lesions);
    for (std::size_t n = 0; n < marks.cuts.size() && assets.tree; ++n)
        places.push_back({"Cut " + std::to_string(n + 1) + ", branch " + std::to_string(marks.cuts[n].first),
                          measure::point_on(*assets.tree, marks.cuts[n].first, marks.cuts[n].second).position});
    add_objects(marks.resections);
    add_objects(marks.pins);
    if (session.slices.crosshair) places.push_back({"Crosshair", *session.slices.crosshair});
    if (places.size() > kMostSliceRows) places.resize(kMostSliceRows);
    return places;
}

constexpr glm::ivec2 kSliceSize{440, 360};

Viewing viewing_of_slices(int finer) {
    Viewing viewing;
    viewing.size = finer * kSliceSize;
    viewing.pixel_ratio = 1.3F * static_cast<float>(finer); // the page shows them smaller
    return viewing;
}

// The narrowest section of the stenosis, by area.
std::optional<double> narrowest_mm(const AlongVessel& along, const Assets& assets) {
    if (!along.stenosis || !assets.sections || assets.sections->path != assets.followed.path) return {};
    const auto places = narrow_places(*assets.sections, *along.stenosis);
    if (!places) return {};
    return assets.followed.path->samples[places->found.area.sample].arc_mm;
}

// The picture along the vessel that slices follow, and sections across it.
Result<SliceRow> take_along(ActionContext& context, const render::Frame& frame, const Viewing& viewing) {
    Session session = context.document.session();
    const Assets& assets = context.assets;
    const slice::VesselPath& path = *assets.followed.path;
    SliceRow row{"Along " + way_words(session.slices.along->way), {}};
    const auto take = [&](render::SlicePainter& painter, const render::SliceView& view,
                          const std::string& caption) -> Result<void> {
        RAMUS_TRY(png, render::encode_png(painter.paint(frame, view)));
        row.pictures.push_back({caption, std::move(png)});
        return {};
    };
    Viewing tall = viewing;
    tall.size.y = 2 * viewing.size.y; // vessels are long
    const render::SliceView whole = compose_along(session, assets, context.picture.picture_mesh(), tall, 0);
    render::SlicePainter along_painter;
    if (auto taken = take(along_painter, whole, whole.overlays.caption); !taken) return tl::unexpected(taken.error());
    render::SlicePainter across;
    const auto take_across = [&](double at_mm, const std::string& what) {
        session.slices = views_at(session.slices, path, at_mm);
        render::SliceView view = compose_slice(session, assets, slice::Direction::kOblique, viewing);
        const double across_mm = session.slices.along->width_mm.value_or(usual_width_mm(path));
        view.grid = slice::grid_around(axes_of(session.slices, slice::Direction::kOblique), *session.slices.crosshair,
                                       across_mm / viewing.size.y, viewing.size);
        return take(across, view, what + arc_words(path, at_mm, context.document.lengths()));
    };
    const double current = session.slices.along->at_mm;
    if (const auto narrowest = narrowest_mm(*session.slices.along, assets))
        if (auto taken = take_across(*narrowest, "Narrowest by area, at "); !taken)
            return tl::unexpected(taken.error());
    if (auto taken = take_across(current, "Current place, at "); !taken) return tl::unexpected(taken.error());
    return row;
}

} // namespace

Result<std::vector<SliceRow>> take_slices(ActionContext& context, int finer) {
    std::vector<SliceRow> rows;
    Session session = context.document.session();
    constexpr double kAcrossMm = 150.0;
    const Viewing viewing = viewing_of_slices(finer);
    {
        render::SliceView shown;
        add_scans(shown, session, context.assets);
        if (shown.scans.empty()) return rows;
    }
    const render::Frame frame = compose(session, context.assets, context.picture.picture_mesh(), viewing);
    const Lengths lengths = context.document.lengths();
    if (session.slices.along && context.assets.followed.path) {
        RAMUS_TRY(along, take_along(context, frame, viewing));
        rows.push_back(std::move(along));
    }
    constexpr std::array kShown{slice::Direction::kAxial, slice::Direction::kCoronal, slice::Direction::kSagittal};
    std::array<render::SlicePainter, kShown.size()> painters; // each keeps the indices of the meshes
    for (const SlicePlace& place : places_of(session, context.assets, lengths)) {
        session.slices.crosshair = place.at;
        SliceRow row{place.title + ", " + place_words(place.at, slice_claims(session, context.assets)), {}};
        for (std::size_t n = 0; n < kShown.size(); ++n) {
            render::SliceView view = compose_slice(session, context.assets, kShown[n], viewing);
            view.grid =
                slice::grid_around(slice::axes_of(kShown[n]), place.at, kAcrossMm / viewing.size.x, viewing.size);
            draw_marks(view, session, context.assets, kShown[n], viewing);
            RAMUS_TRY(png, render::encode_png(painters[n].paint(frame, view)));
            row.pictures.push_back({view.overlays.caption, std::move(png)});
        }
        rows.push_back(std::move(row));
    }
    return rows;
}

} // namespace ramus::app::actions
