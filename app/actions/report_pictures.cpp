#include "app/actions/report_pictures.h"

#include "app/actions/arguments.h"
#include "app/actions/slice_pictures.h"
#include "app/assets/assets.h"
#include "app/assets/territories.h"

#include <algorithm>
#include <glm/common.hpp>
#include <span>
#include <utility>

namespace ramus::app::actions {

namespace {

constexpr glm::ivec2 kSmall{720, 600}, kOfPlan{720, 480};
// A page shows the pictures at 0.7 and 0.57 of their size; those of plans have more words.
constexpr double kLargeText = 1.5, kSmallText = 1.7, kPlanText = 1.3;

class Photographer {
public:
    Photographer(ActionContext& context, int finer) : context_(context), finer_(finer) {}

    [[nodiscard]] Result<ReportPicture> take(std::string caption, const Session& session, glm::ivec2 size,
                                             double text_size) const {
        FigureOptions look;
        look.ground = Ground::kWhite;
        look.text_size = finer_ * text_size;
        RAMUS_TRY(image, context_.picture.draw_picture(session, finer_ * size, look));
        RAMUS_TRY(png, render::encode_png(image));
        return ReportPicture{std::move(caption), std::move(png)};
    }

private:
    ActionContext& context_;
    int finer_;
};

Result<std::vector<ReportPicture>> take_saved_views(const ActionContext& context, const Photographer& photographer) {
    std::vector<ReportPicture> pictures;
    Session session = context.document.session();
    const std::vector<SavedView> views = session.marks.views;
    for (const SavedView& view : std::span(views).first(std::min(views.size(), kMostPicturedViews))) {
        session.camera = view.camera;
        RAMUS_TRY(picture, photographer.take(view.name, session, kSmall, kSmallText));
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

Result<std::vector<ReportPicture>> take_general(ActionContext& context, const Photographer& photographer,
                                                glm::ivec2 shape) {
    constexpr int kLongerSide = 1200;
    Session session = context.document.session();
    const render::Camera current = session.camera;
    const glm::dvec2 scaled = glm::dvec2(shape) * (double(kLongerSide) / std::max(shape.x, shape.y));
    const glm::ivec2 large = glm::max(glm::ivec2(glm::round(scaled)), glm::ivec2(1));
    std::vector<ReportPicture> pictures;
    // Drawn first: it computes the document's current surface, to which the other cameras are fitted.
    RAMUS_TRY(seen, photographer.take("As it was looked at", session, large, kLargeText));
    pictures.push_back(std::move(seen));
    for (const auto& [caption, view] :
         {std::pair{"Anterior", render::View::kAnterior}, std::pair{"Left", render::View::kLeft}}) {
        const render::Camera from = render::looking({.orthographic = current.orthographic}, view);
        const auto visible = visible_positions(context, from, kSmall);
        if (visible.empty()) continue;
        session.camera = render::fitted(from, visible, kSmall);
        RAMUS_TRY(picture, photographer.take(caption, session, kSmall, kSmallText));
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

// Before: the organ as it is, with the surfaces of the resections. After: what remains.
Result<std::vector<std::vector<ReportPicture>>> take_plans(ActionContext& context, const Photographer& photographer) {
    std::vector<std::vector<ReportPicture>> pictures;
    const Marks& marks = context.document.marks();
    if (!marks.organ.any() || !operation_of(context.assets, marks, marks.plans.place)) return pictures;
    Session session = context.document.session();
    session.camera = fitted_to_organ(context, (*context.assets.organ.mask.value)->organ, kOfPlan);
    session.marks.comparison.mode = Comparison::Mode::kOff;
    for (std::size_t plan = 0; plan < marks.plans.count(); ++plan) {
        Session shown = session;
        use_plan(shown.marks, plan);
        shown.marks.plans.compared.reset();
        shown.marks.organ.hidden.clear();
        shown.marks.organ.apart_mm = 0.0;
        shown.marks.organ.territories = TerritoriesOf::kOrgan;
        RAMUS_TRY(before, photographer.take("Before", shown, kOfPlan, kPlanText));
        shown.marks.organ.territories = TerritoriesOf::kRemnant;
        if (!shown.marks.resections.empty())
            shown.marks.organ.hidden = {std::string(kRemnantParts[static_cast<std::size_t>(RemnantPart::kRemoved)])};
        RAMUS_TRY(after, photographer.take("After", shown, kOfPlan, kPlanText));
        pictures.push_back({std::move(before), std::move(after)});
    }
    return pictures;
}

} // namespace

Result<ReportPictures> take_report_pictures(ActionContext& context, glm::ivec2 shape, int finer) {
    const Photographer photographer(context, finer);
    RAMUS_TRY(general, take_general(context, photographer, shape));
    RAMUS_TRY(views, take_saved_views(context, photographer));
    RAMUS_TRY(plans, take_plans(context, photographer));
    RAMUS_TRY(slices, take_slices(context, finer));
    return ReportPictures{std::move(general), std::move(plans), std::move(slices), std::move(views)};
}

} // namespace ramus::app::actions
