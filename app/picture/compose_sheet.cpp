#include "app/picture/compose_sheet.h"

#include "app/assets/assets.h"
#include "app/picture/along_picture.h"
#include "app/picture/colouring.h"
#include "app/picture/other_session.h"
#include "app/picture/slices.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

namespace ramus::app {

namespace {

constexpr glm::vec3 kLineColour{0.62F, 0.90F, 1.00F}; // of superimposed lines: unlike the vessels' colours

// For surfaces of all systems together: a bone colour that no system, state or quantity has; lines are lighter.
constexpr glm::vec3 kNeutralColour{0.76F, 0.74F, 0.69F}, kNeutralLineColour{0.95F, 0.93F, 0.87F};

// Removes everything that needs branches from a frame whose surface has none.
void take_branches_away(render::Frame& frame) {
    frame.states.clear();
    frame.colours.clear();
    frame.scale = {};
    frame.margins = {};
    frame.lost.clear();
    frame.hovered = render::kNoBranch;
    frame.hovered_dependents.clear();
    frame.selected.clear();
    frame.centerlines = nullptr; // otherwise moving views would be drawn as cones along them
    frame.overlays.legend = {};
}

std::string lowered(std::string title) {
    title.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(title.front())));
    return title;
}

std::string percent(double share) { return std::to_string(std::lround(100.0 * share)) + " %"; }

// "Truncated cones 30 %, isosurface of liver.nii.gz 70 %"; at either end only the visible one.
std::string blend_heading(const std::string& first, const std::string& second, double blend) {
    if (blend <= 0.0) return first;
    if (blend >= 1.0) return second;
    return first + " " + percent(1.0 - blend) + ", " + lowered(second) + " " + percent(blend);
}

// "Truncated cones left, isosurface of liver.nii.gz right"; at either end only the visible one.
std::string wipe_heading(const std::string& first, const std::string& second, double wipe) {
    if (wipe <= 0.0) return second;
    if (wipe >= 1.0) return first;
    return first + " left, " + lowered(second) + " right";
}

// Whether the mode mixes two pictures.
bool mixes(Comparison::Mode mode) { return mode == Comparison::Mode::kBlend || mode == Comparison::Mode::kWipe; }

// Divides a picture of `size` into viewports of one size.
void put_side_by_side(std::vector<Viewport>& viewports, glm::ivec2 size, float pixel_ratio) {
    const int axis = size.x >= size.y ? 0 : 1;
    const int count = static_cast<int>(viewports.size());
    const int line = std::max(1, static_cast<int>(std::lround(pixel_ratio)));
    const int side = std::max(1, (size[axis] - (count - 1) * line) / count);
    for (int i = 0; i < count; ++i) {
        Viewport& viewport = viewports[static_cast<std::size_t>(i)];
        // The remainder of the division goes into the dividing lines: all viewports have equal size.
        viewport.at[axis] = std::max(0, (size[axis] - side) * i / (count - 1));
        viewport.size[axis] = side;
    }
}

std::vector<Viewport> viewports_of_plans(const Marks& marks, glm::ivec2 size, float pixel_ratio) {
    const std::vector<OperationPlan> plans = all_plans(marks);
    std::vector<Viewport> viewports;
    const auto [first, second] = std::minmax(marks.plans.place, *marks.plans.compared);
    for (const std::size_t plan : {first, second})
        viewports.push_back({glm::ivec2(0), size, compared(marks.options.method),
                             "Plan " + plans[plan].name + (plan == marks.plans.place ? ", current" : ""), true, plan});
    put_side_by_side(viewports, size, pixel_ratio);
    return viewports;
}

// The picture along the vessel at the right, as high as the whole; at the left the tree above the section.
std::vector<Viewport> viewports_along(const Session& session, glm::ivec2 size, float pixel_ratio) {
    const int line = std::max(1, static_cast<int>(std::lround(pixel_ratio)));
    const int left = size.x * 11 / 20;
    const int upper = (size.y - line) / 2;
    const Compared surface = compared(session.marks.options.method);
    const auto viewport_of = [&](glm::ivec2 at, glm::ivec2 end) {
        return Viewport{at, glm::max(end - at, glm::ivec2(1)), surface, {}, true};
    };
    std::vector<Viewport> viewports{viewport_of({0, 0}, {left, upper}), viewport_of({0, upper + line}, {left, size.y}),
                                    viewport_of({left + line, 0}, size)};
    viewports[1].slice = viewports[2].slice = slice::Direction::kOblique;
    viewports[2].along = true;
    return viewports;
}

// The tree and three slices in 2 x 2 parts, or the tree large with the slices in a column; or one slice.
std::vector<Viewport> viewports_of_slices(const Session& session, glm::ivec2 size, float pixel_ratio) {
    const int line = std::max(1, static_cast<int>(std::lround(pixel_ratio)));
    const SliceLayout layout = session.slices.layout;
    const std::vector<slice::Direction> slices = slices_of(layout);
    const auto viewport_of = [&](glm::ivec2 at, glm::ivec2 end) {
        return Viewport{at, glm::max(end - at, glm::ivec2(1)), compared(session.marks.options.method), {}, true};
    };
    std::vector<Viewport> viewports;
    if (layout == SliceLayout::kAlong) return viewports_along(session, size, pixel_ratio);
    if (!has_tree(layout)) {
        viewports.push_back(viewport_of({0, 0}, size));
        viewports.back().slice = slices.front();
        return viewports;
    }
    if (layout == SliceLayout::kSlices) {
        // The axial slice is at the upper left, as in other viewers; the tree next to it.
        const glm::ivec2 first = (size - line) / 2;
        const glm::ivec2 second = first + line;
        viewports.push_back(viewport_of({second.x, 0}, {size.x, first.y}));
        const std::array<std::pair<glm::ivec2, glm::ivec2>, 3> parts{
            {{{0, 0}, first}, {{0, second.y}, {first.x, size.y}}, {second, size}}};
        for (std::size_t n = 0; n < slices.size(); ++n) {
            viewports.push_back(viewport_of(parts[n].first, parts[n].second));
            viewports.back().slice = slices[n];
        }
        return viewports;
    }
    // Slices at the right of a wide picture, below a high one.
    const int along = size.x >= size.y ? 0 : 1;
    const int across = 1 - along;
    const int large = size[along] * 2 / 3;
    glm::ivec2 end = size;
    end[along] = large;
    viewports.push_back(viewport_of({0, 0}, end));
    const int count = static_cast<int>(slices.size());
    for (int n = 0; n < count; ++n) {
        glm::ivec2 at(0);
        at[along] = large + line;
        at[across] = size[across] * n / count + (n > 0 ? line : 0);
        glm::ivec2 to = size;
        to[across] = size[across] * (n + 1) / count;
        viewports.push_back(viewport_of(at, to));
        viewports.back().slice = slices[static_cast<std::size_t>(n)];
    }
    return viewports;
}

// Mixes the two viewports of a sheet. `with_legend`: the one that has the legend.
void mix(render::Sheet& sheet, const std::vector<Viewport>& viewports, std::size_t with_legend,
         const Comparison& comparison, const Viewing& viewing, const SheetViewing& sheet_viewing) {
    const std::string &first_title = viewports[0].title, &second_title = viewports[1].title;
    if (comparison.mode == Comparison::Mode::kBlend) {
        sheet.blend = sheet_viewing.blend.value_or(comparison.blend);
        sheet.heading = latin1(blend_heading(first_title, second_title, *sheet.blend));
    } else {
        sheet.wipe = sheet_viewing.wipe.value_or(comparison.wipe);
        sheet.line_width = std::max(1.0F, std::round(1.5F * viewing.pixel_ratio));
        sheet.heading = latin1(wipe_heading(first_title, second_title, *sheet.wipe));
    }
    sheet.heading_top = sheet_viewing.heading_top + static_cast<int>(std::lround(8.0F * viewing.pixel_ratio));
    // Overlays of a mixed picture belong to both.
    render::Overlays& first = sheet.viewports[0].frame.overlays;
    render::Overlays& second = sheet.viewports[1].frame.overlays;
    (with_legend == 0 ? second : first).legend = sheet.viewports[with_legend].frame.overlays.legend;
}

} // namespace

std::vector<Viewport> viewports_of(const Session& session, glm::ivec2 size, float pixel_ratio) {
    const Marks& marks = session.marks;
    const Comparison& comparison = marks.comparison;
    const std::vector<Compared> kinds = compared_surfaces(comparison);
    if (kinds.empty() && marks.plans.compared) return viewports_of_plans(marks, size, pixel_ratio);
    if (kinds.empty() && session.slices.layout != SliceLayout::kPicture)
        return viewports_of_slices(session, size, pixel_ratio);
    if (kinds.empty()) return {{glm::ivec2(0), size, compared(marks.options.method), {}, true}};
    std::vector<Viewport> viewports;
    for (const Compared kind : kinds)
        viewports.push_back({glm::ivec2(0), size, kind, title_of(kind, comparison), kind != Compared::kIsosurface});
    // Voxels of a mask's file belong to no branch, and stay when branches are hidden.
    if (!comparison.mask.empty() && std::ranges::find(marks.states, tree::BranchState::kHidden) != marks.states.end())
        for (Viewport& viewport : viewports)
            if (viewport.surface == Compared::kIsosurface) viewport.title += ", with what is hidden";
    if (comparison.mode == Comparison::Mode::kSuperimposed) {
        viewports[0].title += ", lines: " + lowered(viewports[1].title);
        viewports.resize(1);
    }
    if (comparison.mode != Comparison::Mode::kSideBySide) return viewports;
    put_side_by_side(viewports, size, pixel_ratio);
    return viewports;
}

namespace {

// The slice, or the picture along a vessel, that a viewport shows; none: it shows the tree. `top`: pixels that the
// window covers at the top of the whole picture.
std::optional<render::SliceView> slice_in(const Viewport& viewport, const Session& session, const Assets& assets,
                                          const ShownSurfaces& surfaces, const Viewing& viewing, int top) {
    if (!viewport.slice) return {};
    render::SliceView slice = viewport.along
                                  ? compose_along(session, assets, surfaces.of(viewport.surface), viewing, top)
                                  : compose_slice(session, assets, *viewport.slice, viewing);
    slice.mark = slice_colour(*viewport.slice);
    if (viewport.at.y == 0) slice.overlays.inset_top = top;
    return slice;
}

} // namespace

render::Sheet compose_sheet(const Session& session, const Assets& assets, const ShownSurfaces& surfaces,
                            const Viewing& viewing, const SheetViewing& sheet_viewing) {
    const Marks& marks = session.marks;
    const Comparison& comparison = marks.comparison;
    const std::vector<Viewport> viewports = viewports_of(session, viewing.size, viewing.pixel_ratio);
    const bool slices = std::ranges::any_of(viewports, [](const Viewport& one) { return one.slice.has_value(); });
    const bool beside = viewports.size() > 1 && !mixes(comparison.mode) && !slices;
    render::Sheet sheet;
    sheet.size = viewing.size;
    sheet.divider = kDividerColour;
    // Only one viewport shows the legend: the last with colours of branches, or the one with its own scale.
    const auto is_own_surface = [&](const Viewport& viewport) { return is_own(viewport.surface, marks.options); };
    const bool of_surface = marks.colour_by == ColourBy::kDeviation && std::ranges::any_of(viewports, is_own_surface);
    std::size_t with_legend = 0;
    for (std::size_t i = 0; i < viewports.size(); ++i)
        if (!viewports[i].slice && (of_surface ? is_own_surface(viewports[i]) : viewports[i].has_branches))
            with_legend = i;
    for (std::size_t i = 0; i < viewports.size(); ++i) {
        Viewing own = viewing;
        own.size = viewports[i].size;
        own.method = row_of(viewports[i].surface).method;
        const auto& plan = viewports[i].plan;
        const auto composed = [&] {
            // All slices cut the frame of the tree, which comes first.
            if (viewports[i].slice && i > 0) return sheet.viewports.front().frame;
            return plan && plan != marks.plans.place
                       ? compose_plan(session, assets, surfaces.of(viewports[i].surface), own, *plan)
                       : compose(session, assets, surfaces.of(viewports[i].surface), own);
        };
        render::Frame frame = composed();
        frame.size = own.size;
        if (!viewports[i].has_branches) take_branches_away(frame);
        // In its own colour it could be mistaken for a system of that colour.
        const bool systems = assets.tree && !assets.tree->systems.empty();
        if (!viewports[i].has_branches && systems) frame.appearance.vessel = kNeutralColour;
        if (comparison.mode == Comparison::Mode::kSuperimposed && surfaces.lines)
            frame.context.push_back({.mesh = surfaces.lines,
                                     .preview = surfaces.lines_preview,
                                     .colour = systems ? kNeutralLineColour : kLineColour,
                                     .opacity = 0.9F,
                                     .wireframe = true});
        // These overlays are equal in all viewports; viewports side by side share one of each.
        const bool there = assets.tree || frame.overlays.scale_bar;
        frame.overlays.orientation_cube = there && (!beside || i + 1 == viewports.size());
        frame.overlays.scale_bar = there && (!beside || i == 0);
        if (i != with_legend) frame.overlays.legend = {};
        if (!mixes(comparison.mode)) frame.overlays.heading = latin1(viewports[i].title);
        if (!viewports[i].title.empty()) frame.overlays.inset_top = sheet_viewing.heading_top;
        auto slice = slice_in(viewports[i], session, assets, surfaces, own, sheet_viewing.heading_top);
        sheet.viewports.push_back({viewports[i].at, std::move(frame), viewports[i].has_branches, std::move(slice)});
    }
    if (mixes(comparison.mode) && assets.tree)
        mix(sheet, viewports, with_legend, marks.comparison, viewing, sheet_viewing);
    return sheet;
}

} // namespace ramus::app
