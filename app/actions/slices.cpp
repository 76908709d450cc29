// Commands of slices: layout of the picture, crosshair, planes in the picture, cutting away. They change how a session
// is looked at, like the camera, and are no steps of undo.
#include "app/picture/slices.h"

#include "app/actions/along.h"
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/framing.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/measure/branch_point.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

using slice::Direction;

constexpr double kFarthest = 1e6; // mm

template <class Change> Result<void> edit_views(ActionContext& context, const Change& change) {
    SliceViews views = context.document.session().slices;
    change(views);
    context.document.set_slices(views);
    return {};
}

std::string direction_names() {
    return joined(slice::kDirections, ", ", [](const auto& known) { return std::string(known.second); });
}

Result<Direction> direction_argument(Arguments arguments, std::string_view command) {
    const auto found = arguments.empty() ? std::nullopt : slice::direction_named(arguments[0]);
    if (!found) return fail(std::string(command) + " takes the name of a slice", {}, direction_names());
    return *found;
}

Result<void> layout(ActionContext& context, Arguments arguments) {
    const auto wanted = arguments.size() == 1 ? layout_named(arguments[0]) : std::nullopt;
    if (!wanted)
        return fail("layout takes a name", {},
                    joined(kSliceLayouts, ", ", [](const auto& known) { return std::string(known.second); }));
    const glm::ivec2 before = context.picture.picture_size();
    (void)edit_views(context, [&](SliceViews& views) { views.layout = *wanted; });
    // A window keeps the vessels in view itself (Framing): it also knows when the earlier view returns.
    if (context.window != nullptr || !has_tree(*wanted)) return {};
    const render::Camera& camera = context.document.session().camera;
    context.document.set_camera(
        reframed(camera, before, context.picture.picture_size(), visible_positions(context, camera, before)));
    return {};
}

// "12@0.3", or "12": the middle of a branch.
std::optional<measure::BranchPlace> branch_place(const tree::VesselTree& tree, const std::string& word) {
    const auto end = way_end_in(word);
    if (!end || end->branch < 0 || static_cast<std::size_t>(end->branch) >= tree.branches.size()) return {};
    return measure::BranchPlace{end->branch, end->fraction.value_or(0.5)};
}

std::optional<glm::dvec3> place_argument(const std::string& word) {
    const auto numbers = numbers_in(word, 3, kFarthest);
    return numbers ? std::optional(glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

Result<void> crosshair(ActionContext& context, Arguments arguments) {
    std::optional<glm::dvec3> place;
    if (arguments.size() == 1) {
        place = place_argument(arguments[0]);
        const auto& tree = context.document.tree();
        if (const auto on = place || !tree ? std::nullopt : branch_place(*tree, arguments[0]))
            place = measure::point_on(*tree, *on).position;
    }
    if (!place) return fail("crosshair takes X,Y,Z in mm, or a branch and a fraction of its length", {}, "12@0.5, say");
    return edit_views(context, [&](SliceViews& views) { views.crosshair = place; });
}

// The axis that a slice is moved along by a number.
int axis_of(Direction direction) {
    return direction == Direction::kAxial ? 2 : direction == Direction::kCoronal ? 1 : 0;
}

Result<void> slice_at(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(direction, direction_argument(arguments, "slice"));
    const auto at = arguments.size() == 2 ? number_in(arguments[1], -kFarthest, kFarthest) : std::nullopt;
    if (!at || direction == Direction::kOblique)
        return fail("slice takes a name, and a place in mm", {},
                    direction == Direction::kOblique ? "slice-across and slice-through set the oblique slice"
                                                     : "slice axial 12.5, say");
    glm::dvec3 place = crosshair_of(context.document.session(), context.assets);
    place[axis_of(direction)] = *at;
    return edit_views(context, [&](SliceViews& views) { views.crosshair = place; });
}

// The slice that fills the picture; axial if several share it.
constexpr std::string_view kShownSlice = "shown";
Direction shown_slice(const SliceViews& views) {
    const std::vector<Direction> slices = slices_of(views.layout);
    return slices.size() == 1 ? slices.front() : Direction::kAxial;
}

Result<void> slice_step(ActionContext& context, Arguments arguments) {
    const bool shown = !arguments.empty() && arguments[0] == kShownSlice;
    RAMUS_TRY(direction, shown ? Result<Direction>(shown_slice(context.document.session().slices))
                               : direction_argument(arguments, "slice-step"));
    const auto steps = arguments.size() == 2 ? number_in(arguments[1], -1e4, 1e4) : std::nullopt;
    if (!steps)
        return fail("slice-step takes the name of a slice and a number of steps", {}, "slice-step axial -1, say");
    if (direction == Direction::kOblique && oblique_follows(context)) return step_along_vessel(context, *steps);
    const Session& session = context.document.session();
    const slice::Plane plane = plane_of(session, context.assets, direction);
    // Forward is up, forward and to the right of the patient, whatever side a slice is seen from.
    const double sign = plane.normal[axis_of(direction)] < 0.0 ? -1.0 : 1.0;
    const double mm = sign * *steps * step_mm(session, context.assets, direction);
    return edit_views(context, [&](SliceViews& views) { views.crosshair = plane.point + mm * plane.normal; });
}

Result<void> slice_plane(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(which, direction_argument(arguments, "slice-plane"));
    const auto on = switched(arguments.subspan(1), context.document.session().slices.in_picture[slice_index(which)]);
    if (!on) return fail("slice-plane takes a name, and on or off", {}, direction_names());
    return edit_views(context, [&, which = which](SliceViews& views) { views.in_picture[slice_index(which)] = *on; });
}

// The oblique slice across a vessel.
Result<void> slice_across(ActionContext& context, Arguments arguments) {
    const auto& tree = context.document.tree();
    const auto place = arguments.size() == 1 && tree ? branch_place(*tree, arguments[0]) : std::nullopt;
    if (!place) return fail("slice-across takes a branch and a fraction of its length", {}, "12@0.5, say");
    const measure::BranchPoint point = measure::point_on(*tree, *place);
    return edit_views(context, [&](SliceViews& views) {
        views.crosshair = point.position;
        views.oblique_normal = point.direction;
        views.in_picture[slice_index(Direction::kOblique)] = true;
    });
}

// The oblique slice through three places.
Result<void> slice_through(ActionContext& context, Arguments arguments) {
    std::vector<glm::dvec3> places;
    for (const std::string& word : arguments)
        if (const auto place = place_argument(word)) places.push_back(*place);
    if (arguments.size() != 3 || places.size() != 3)
        return fail("slice-through takes three places: X,Y,Z X,Y,Z X,Y,Z in mm");
    const glm::dvec3 normal = glm::cross(places[1] - places[0], places[2] - places[0]);
    const double scale = glm::length(places[1] - places[0]) * glm::length(places[2] - places[0]);
    if (!(glm::length(normal) > 1e-6 * scale)) return fail("the three places are on a line", {}, "choose another");
    return edit_views(context, [&](SliceViews& views) {
        views.crosshair = (places[0] + places[1] + places[2]) / 3.0;
        views.oblique_normal = glm::normalize(normal);
        views.in_picture[slice_index(Direction::kOblique)] = true;
    });
}

Result<void> copy_place(ActionContext& context, Arguments arguments) {
    const auto given = arguments.empty() ? std::nullopt : place_argument(arguments[0]);
    if (arguments.size() > 1 || (!arguments.empty() && !given))
        return fail("copy-place takes X,Y,Z in mm, or nothing for the crosshair");
    if (context.clipboard == nullptr) return fail("there is no clipboard without a window");
    const glm::dvec3 place = given.value_or(crosshair_of(context.document.session(), context.assets));
    const std::string words = rounded(place.x) + "," + rounded(place.y) + "," + rounded(place.z);
    context.clipboard->copy_text(words);
    context.say("Copied " + words);
    return {};
}

Result<void> cut_away(ActionContext& context, Arguments arguments) {
    const bool behind = arguments.size() == 2 && arguments[1] == "--behind";
    const bool off = arguments.size() == 1 && arguments[0] == "off";
    const auto direction = arguments.empty() ? std::nullopt : slice::direction_named(arguments[0]);
    if (arguments.empty() || (!off && !direction) || (arguments.size() > 1 && !behind))
        return fail("cut-away takes the name of a slice or off, and --behind", {}, direction_names());
    return edit_views(context, [&](SliceViews& views) {
        views.cut_away = direction;
        views.cut_behind = behind;
        if (direction) views.in_picture[slice_index(*direction)] = true;
    });
}

Result<void> slab(ActionContext& context, Arguments arguments) {
    const bool off = arguments.size() == 1 && arguments[0] == "off";
    const auto mm = off                 ? std::optional(0.0)
                    : arguments.empty() ? std::nullopt
                                        : number_in(arguments[0], 0.0, kMostSlabMm);
    const auto of = arguments.size() == 2 ? slice::slab_named(arguments[1]) : std::optional(slice::Slab::kMaximum);
    if (!mm || !of || arguments.size() > 2)
        return fail("slab takes a thickness in mm, and maximum, mean or minimum; or off");
    return edit_views(context, [&](SliceViews& views) {
        views.sampling.slab_mm = *mm;
        if (arguments.size() == 2 || views.sampling.slab_mm == 0.0) views.sampling.slab = *of;
    });
}

Result<void> slice_zoom(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(direction, direction_argument(arguments, "slice-zoom"));
    SliceZoom zoom;
    const bool fit = arguments.size() == 2 && arguments[1] == "fit";
    const auto factor = arguments.size() < 2 ? std::nullopt : number_in(arguments[1], 0.05, 500.0);
    const auto shift = arguments.size() == 3 ? numbers_in(arguments[2], 2, kFarthest) : std::nullopt;
    if (!fit && (!factor || arguments.size() > 3 || (arguments.size() == 3 && !shift)))
        return fail("slice-zoom takes a slice and a factor, and the shift RIGHT,DOWN in mm; or fit");
    if (!fit) zoom.factor = *factor;
    if (shift) zoom.shift = {(*shift)[0], (*shift)[1]};
    return edit_views(context,
                      [&, direction = direction](SliceViews& views) { views.zooms[slice_index(direction)] = zoom; });
}

// A switch of what slices show.
struct SliceSwitch {
    const char *name, *label, *help;
    bool (*get)(const SliceViews&);
    void (*set)(SliceViews&, bool);
};
constexpr std::array<SliceSwitch, 4> kSliceSwitches{
    {{"outlines", "Outlines of vessels", "Draws the section of vessels, lesions and context on slices.",
      [](const SliceViews& views) { return views.outlines; }, [](SliceViews& views, bool on) { views.outlines = on; }},
     {"axes", "Dots at axes of vessels", "Marks where the axes of vessels cross a slice.",
      [](const SliceViews& views) { return views.axes; }, [](SliceViews& views, bool on) { views.axes = on; }},
     {"crosshair", "Crosshair", "Draws the crosshair on slices.",
      [](const SliceViews& views) { return views.crosshair_lines; },
      [](SliceViews& views, bool on) { views.crosshair_lines = on; }},
     {"smooth", "Interpolate values", "Interpolates between voxels; off: shows each voxel.",
      [](const SliceViews& views) { return views.sampling.interpolation == slice::Interpolation::kLinear; },
      [](SliceViews& views, bool on) {
          views.sampling.interpolation = on ? slice::Interpolation::kLinear : slice::Interpolation::kNearest;
      }}}};

Result<void> slice_show(ActionContext& context, Arguments arguments) {
    const auto found = arguments.empty() ? kSliceSwitches.end()
                                         : std::ranges::find(kSliceSwitches, arguments[0], [](const SliceSwitch& one) {
                                               return std::string(one.name);
                                           });
    const auto on = found == kSliceSwitches.end()
                        ? std::nullopt
                        : switched(arguments.subspan(1), found->get(context.document.session().slices));
    if (!on)
        return fail("slice-show takes a name, and on or off", {},
                    joined(kSliceSwitches, ", ", [](const SliceSwitch& one) { return std::string(one.name); }));
    return edit_views(context, [&](SliceViews& views) { found->set(views, *on); });
}

std::vector<Command> layout_entries() {
    struct Entry {
        SliceLayout layout;
        const char *label, *key, *help;
    };
    constexpr std::array<Entry, 8> kEntries{
        {{SliceLayout::kPicture, "Vessels alone", "1", "Shows the vessels without slices."},
         {SliceLayout::kSlices, "Vessels and three slices", "2",
          "Divides the picture into the vessels and three slices."},
         {SliceLayout::kLarge, "Vessels large", "3", "Shows the vessels large, with three slices next to them."},
         {SliceLayout::kAxial, "Axial slice alone", "4", "Shows the axial slice alone."},
         {SliceLayout::kCoronal, "Coronal slice alone", "5", "Shows the coronal slice alone."},
         {SliceLayout::kSagittal, "Sagittal slice alone", "6", "Shows the sagittal slice alone."},
         {SliceLayout::kOblique, "Oblique slice alone", "7", "Shows the oblique slice alone."},
         {SliceLayout::kAlong, "Along a vessel", "8",
          "Shows the vessels, the slice across a vessel, and the picture along it."}}};
    std::vector<Command> commands;
    for (const Entry& entry : kEntries)
        commands.push_back(Command("layout", "NAME", entry.help, layout)
                               .in_menu("Slices", entry.label, {entry.key})
                               .giving({std::string(name_of(entry.layout))})
                               .when(has_scene)
                               .checked_when([is = entry.layout](const Document& document) {
                                   return document.session().slices.layout == is;
                               }));
    return commands;
}

std::vector<Command> plane_entries() {
    std::vector<Command> commands;
    for (const auto& [direction, name] : slice::kDirections) {
        std::string label(name);
        label.front() = static_cast<char>(label.front() - 'a' + 'A');
        commands.push_back(Command("slice-plane", "NAME [on|off]", "Shows the slice among the vessels.", slice_plane)
                               .in_menu("Slices", label + " plane")
                               .in_submenu("Among the vessels")
                               .giving({std::string(name)})
                               .when(has_scene)
                               .checked_when([which = direction](const Document& document) {
                                   return document.session().slices.in_picture[slice_index(which)];
                               }));
    }
    return commands;
}

std::vector<Command> step_entries() {
    struct Entry {
        std::string_view slice;
        const char *label, *modifier;
    };
    constexpr std::array<Entry, 4> kEntries{{{kShownSlice, "Slice", ""},
                                             {"coronal", "Coronal slice", "Shift+"},
                                             {"sagittal", "Sagittal slice", "Ctrl+"},
                                             {"oblique", "Oblique slice", "Alt+"}}};
    std::vector<Command> commands;
    for (const Entry& entry : kEntries)
        for (const bool forward : {true, false})
            commands.push_back(Command("slice-step", "NAME N",
                                       "Moves a slice by a voxel; the slice that fills the picture, or axial.",
                                       slice_step)
                                   .in_menu("Slices", entry.label + std::string(forward ? " forward" : " back"),
                                            {entry.modifier + std::string(forward ? "PageUp" : "PageDown")})
                                   .in_submenu("Step")
                                   .giving({std::string(entry.slice), forward ? "1" : "-1"})
                                   .when(has_scene));
    return commands;
}

std::vector<Command> cut_entries() {
    std::vector<Command> commands;
    const auto entry = [&](const char* label, std::optional<Direction> direction) {
        commands.push_back(Command("cut-away", "NAME|off [--behind]", "Leaves out what lies before a slice.", cut_away)
                               .in_menu("Slices", label)
                               .in_submenu("Cut away")
                               .giving({direction ? std::string(slice::name_of(*direction)) : "off"})
                               .when(has_scene)
                               .checked_when([direction](const Document& document) {
                                   return document.session().slices.cut_away == direction;
                               }));
    };
    entry("Nothing", {});
    entry("Before the axial slice", Direction::kAxial);
    entry("Before the coronal slice", Direction::kCoronal);
    entry("Before the sagittal slice", Direction::kSagittal);
    entry("Before the oblique slice", Direction::kOblique);
    return commands;
}

std::vector<Command> switch_entries() {
    std::vector<Command> commands;
    for (const SliceSwitch& one : kSliceSwitches)
        commands.push_back(
            Command("slice-show", "NAME [on|off]", one.help, slice_show)
                .in_menu("Slices", one.label)
                .giving({one.name})
                .when(has_scene)
                .checked_when([get = one.get](const Document& document) { return get(document.session().slices); }));
    return commands;
}

} // namespace

std::vector<Command> slice_commands() {
    std::vector<Command> commands = layout_entries();
    commands.push_back(Command("layout", "NAME",
                               "Divides the picture: picture, slices, large, axial, coronal, sagittal or oblique.",
                               layout)
                           .when(has_scene));
    std::ranges::move(plane_entries(), std::back_inserter(commands));
    std::ranges::move(step_entries(), std::back_inserter(commands));
    std::ranges::move(cut_entries(), std::back_inserter(commands));
    std::ranges::move(switch_entries(), std::back_inserter(commands));
    std::ranges::move(
        std::vector{
            Command("crosshair", "X,Y,Z|ID[@FRACTION]", "Moves all slices to a place, or to a place of a branch.",
                    crosshair)
                .when(has_scene),
            Command("slice", "NAME MM", "Moves a slice to a place in mm: axial 12.5, say.", slice_at).when(has_scene),
            Command("slice-plane", "NAME [on|off]", "Shows a slice as a plane among the vessels.", slice_plane)
                .when(has_scene),
            Command("slice-step", "NAME|shown N", "Moves a slice by a number of voxels.", slice_step).when(has_scene),
            Command("slice-across", "ID[@FRACTION]", "Puts the oblique slice across a vessel.", slice_across)
                .when(has_tree),
            Command("slice-through", "X,Y,Z X,Y,Z X,Y,Z", "Puts the oblique slice through three places.", slice_through)
                .when(has_scene),
            Command("copy-place", "[X,Y,Z]", "Copies a place as text, for the commands crosshair and slice-through.",
                    copy_place)
                .when(has_scene),
            Command("slice-zoom", "NAME FACTOR [RIGHT,DOWN]|fit", "Magnifies a slice; a factor of 1 shows all of it.",
                    slice_zoom)
                .when(has_scene),
            Command("cut-away", "NAME|off [--behind]", "Leaves out what lies before a slice, or behind it.", cut_away)
                .when(has_scene),
            Command("slab", "MM [maximum|mean|minimum]|off", "Makes slices thick: the largest, mean or least value.",
                    slab)
                .when(has_scene),
            Command("slice-show", "NAME [on|off]", "Switches what slices show: outlines, axes, crosshair, smooth.",
                    slice_show)
                .when(has_scene),
        },
        std::back_inserter(commands));
    return commands;
}

} // namespace ramus::app::actions
