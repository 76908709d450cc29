// Commands of the vessel that slices follow: its way, the current place, the picture along it, a stenosis, and the
// table of its cross-sections. Like the other slice views they are no steps of undo.
#include "app/actions/along.h"

#include "app/actions/arguments.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/picture/along_picture.h"
#include "app/picture/slices.h"
#include "app/reports/section_tables.h"
#include "core/base/words.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

constexpr const char* kAlongUsage = "along 12, along root..12 or along 3@0.2..12@0.5, say";

using FollowedVessel = std::shared_ptr<const slice::VesselPath>;

// The path of the vessel that slices follow.
Result<FollowedVessel> followed_path(ActionContext& context) {
    refresh(context.assets, context.document);
    const FollowedPath& followed = context.assets.followed;
    if (followed.path) return followed.path;
    return fail(followed.problem.empty() ? "slices follow no vessel" : followed.problem, {}, kAlongUsage);
}

// Sets views of a vessel that slices follow, at the place that they have.
void set_along(ActionContext& context, const slice::VesselPath& path, const SliceViews& views) {
    context.document.set_slices(views_at(views, path, views.along->at_mm));
}

// Where a person looks already, or the middle of the way.
double first_place(const SliceViews& views, const slice::VesselPath& path) {
    if (!views.crosshair) return 0.5 * path.length_mm();
    const auto away = [&](const slice::PathSample& sample) { return glm::distance(sample.at, *views.crosshair); };
    const auto nearest = std::ranges::min_element(path.samples, {}, away);
    return away(*nearest) <= nearest->radius_mm ? nearest->arc_mm : 0.5 * path.length_mm();
}

Result<void> follow_no_vessel(ActionContext& context) {
    SliceViews views = context.document.session().slices;
    views.along.reset();
    views.oblique_right.reset();
    if (views.layout == SliceLayout::kAlong) views.layout = SliceLayout::kSlices;
    context.document.set_slices(views);
    return {};
}

// The way that is named, or the selected branch.
Result<Way> wanted_way(const Document& document, Arguments arguments) {
    const std::vector<int>& selection = document.marks().selection;
    if (arguments.empty() && !selection.empty()) return Way{{selection.front()}};
    if (arguments.size() == 1)
        if (const auto way = way_in(arguments[0])) return *way;
    return fail("along takes a branch, two places of vessels, or off; without one, a branch is selected", {},
                kAlongUsage);
}

Result<void> along(ActionContext& context, Arguments arguments) {
    if (arguments.size() == 1 && arguments[0] == "off") return follow_no_vessel(context);
    RAMUS_TRY(way, wanted_way(context.document, arguments));
    const SliceViews before = context.document.session().slices;
    SliceViews views = before;
    views.along = AlongVessel{.way = way};
    if (before.along) {
        views.along->kind = before.along->kind;
        if (before.along->way == way) views.along = before.along;
    }
    context.document.set_slices(views);
    auto path = followed_path(context);
    if (!path) {
        context.document.set_slices(before);
        return tl::unexpected(path.error());
    }
    views.along->at_mm = first_place(views, **path);
    // A person wants to see what was asked for; a script says which picture it wants.
    if (context.window != nullptr) {
        views.layout = SliceLayout::kAlong;
        context.window->toggle("slices"); // the page of the panel
    }
    set_along(context, **path, views);
    return {};
}

Result<void> along_root(ActionContext& context, Arguments /*arguments*/) {
    const std::vector<int>& selection = context.document.marks().selection;
    if (selection.empty()) return fail("no branch is selected", {}, "select the last branch of the way");
    const std::string way = "root.." + std::to_string(selection.front());
    return along(context, {&way, 1});
}

Result<void> along_at(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(path, followed_path(context));
    const auto at = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!at) return fail("along-at takes a distance from the start of the way in mm", {}, "along-at 12.5, say");
    SliceViews views = context.document.session().slices;
    views.along->at_mm = *at;
    set_along(context, *path, views);
    return {};
}

Result<void> along_step(ActionContext& context, Arguments arguments) {
    const auto steps = arguments.size() == 1 ? number_in(arguments[0], -1e4, 1e4) : std::nullopt;
    if (!steps) return fail("along-step takes a number of steps", {}, "along-step -1, say");
    return step_along_vessel(context, *steps);
}

Result<void> along_show(ActionContext& context, Arguments arguments) {
    if (auto path = followed_path(context); !path) return tl::unexpected(path.error());
    SliceViews views = context.document.session().slices;
    constexpr const char* kUsage = "along-show straightened|stretched [--degrees D] [--width MM|auto]";
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        const std::string value = i + 1 < arguments.size() ? arguments[i + 1] : std::string();
        if (const auto kind = slice::reformation_named(word)) {
            views.along->kind = *kind;
        } else if (word == "--degrees") {
            const auto degrees = number_in(value, -360.0, 360.0);
            if (!degrees) return fail("--degrees takes an angle from -360 to 360", {}, kUsage);
            views.along->angle_deg = *degrees;
            ++i;
        } else if (word == "--width") {
            const auto width = number_in(value, kLeastWidthMm, kMostWidthMm);
            if (!width && value != "auto") return fail("--width takes a width in mm, or auto", {}, kUsage);
            views.along->width_mm = width;
            ++i;
        } else {
            return fail("along-show takes a kind of picture, --degrees and --width", {}, kUsage);
        }
    }
    context.document.set_slices(views);
    return {};
}

// The arguments of `stenosis`.
Result<StenosisChoice> stenosis_choice(Arguments arguments, const slice::VesselPath& path) {
    constexpr const char* kUsage =
        "stenosis FROM TO [--reference AT|FROM..TO | --diameter MM], in mm from the start of the way";
    const auto place = [&](std::string_view word) { return number_in(word, 0.0, path.length_mm()); };
    const auto outside = [&] {
        return fail("a place of the stenosis is not on the way", {},
                    "give distances from 0 to " + rounded(path.length_mm()) + " mm");
    };
    if (arguments.size() != 2 && arguments.size() != 4)
        return fail("stenosis takes two places, and what they are compared with", {}, kUsage);
    const auto from = place(arguments[0]);
    const auto to = place(arguments[1]);
    if (!from || !to) return outside();
    StenosisChoice choice{{*from, *to}};
    if (arguments.size() == 2) return choice;
    const std::string_view value = arguments[3];
    if (arguments[2] == "--diameter") {
        choice.reference_mm = number_in(value, kLeastWidthMm, kMostWidthMm);
        if (!choice.reference_mm) return fail("--diameter takes a diameter in mm", {}, kUsage);
        return choice;
    }
    if (arguments[2] != "--reference") return fail("stenosis has no option " + arguments[2], {}, kUsage);
    const std::size_t dots = value.find("..");
    const auto first = place(value.substr(0, dots));
    const auto last = dots == std::string_view::npos ? first : place(value.substr(dots + 2));
    if (!first || !last) return outside();
    choice.reference = Stretch{*first, *last};
    return choice;
}

using ShownMesh = std::shared_ptr<const render::PagedMesh>;

Result<ShownMesh> surface_to_cut(const ActionContext& context) {
    RAMUS_TRY(mesh, context.picture.current_mesh());
    if (!mesh) return fail("there is no surface to cut", {}, "show the vessels");
    return mesh;
}

// Requires sections of the followed path.
Result<void> tell_stenosis(const ActionContext& context, const StenosisChoice& choice) {
    RAMUS_TRY(places, narrow_places(*context.assets.sections, choice));
    context.say(stenosis_words(places, *context.assets.sections, context.document.lengths()));
    return {};
}

Result<Outcome> stenosis(ActionContext& context, Arguments arguments) {
    RAMUS_TRY(path, followed_path(context));
    SliceViews views = context.document.session().slices;
    if (arguments.size() == 1 && arguments[0] == "off") {
        views.along->stenosis.reset();
        context.document.set_slices(views);
        return Done{};
    }
    RAMUS_TRY(choice, stenosis_choice(arguments, *path));
    // In a window the panel has the figures as soon as they are measured.
    const bool tells = context.window == nullptr && (choice.reference || choice.reference_mm);
    RAMUS_TRY(mesh, tells ? surface_to_cut(context) : Result<ShownMesh>(nullptr));
    views.along->stenosis = choice;
    context.document.set_slices(views);
    if (!tells) return Done{};
    if (context.assets.sections && context.assets.sections->fits(context.assets.followed, mesh))
        return outcome_of(tell_stenosis(context, choice));
    const auto work = [followed = context.assets.followed, mesh = mesh,
                       choice = choice](Job& job) -> Result<Continuation> {
        RAMUS_TRY(sections, make_sections(followed, mesh, job));
        return [sections = sections, choice](ActionContext& then) {
            then.assets.sections = sections;
            return tell_stenosis(then, choice);
        };
    };
    return Pending{"Measuring sections", work};
}

Result<Outcome> sections(ActionContext& context, Arguments arguments) {
    if (auto path = followed_path(context); !path) return tl::unexpected(path.error());
    constexpr const char* kUsage = "sections FILE.csv [--step MM]";
    const bool has_step = arguments.size() == 3 && arguments[1] == "--step";
    const auto step = has_step ? number_in(arguments[2], 1e-3, kFarthestMm) : std::nullopt;
    if (arguments.size() > 1 && !step) return fail("sections takes a file, and a step in mm", {}, kUsage);
    RAMUS_TRY(named,
              file_argument(context, arguments.first(std::min<std::size_t>(arguments.size(), 1)), "sections", ".csv"));
    const std::filesystem::path file = std::filesystem::absolute(named).lexically_normal();
    if (file.extension() != ".csv") return fail("sections are a table", file.string(), "give a name that ends in .csv");
    RAMUS_TRY(mesh, surface_to_cut(context));
    const auto work = [mesh = mesh, file, step, of = *context.assets.followed.of,
                       lengths = context.document.lengths()](Job& job) -> Result<Continuation> {
        RAMUS_TRY(fine, path_along(*of.tree, of.way, path_step_mm(of.step_mm, step)));
        const std::vector<slice::PathSample> samples = step ? samples_every(fine, *step) : usual_samples(fine);
        RAMUS_TRY(lumens, measured_lumens(*of.tree, fine, samples, *mesh, job));
        const Table table = sections_table(samples, {std::move(lumens), {}}, lengths);
        if (auto written = io::write_file(file, csv_of(table)); !written) return tl::unexpected(written.error());
        return has_written(file, "Cross-sections saved: " + file.string());
    };
    return Pending{"Measuring sections", work, true};
}

bool follows_vessel(const Document& document) { return document.session().slices.along.has_value(); }

} // namespace

Result<void> step_along_vessel(ActionContext& context, double steps) {
    RAMUS_TRY(path, followed_path(context));
    SliceViews views = context.document.session().slices;
    views.along->at_mm = views.along->at_mm + steps * kStepsOfPath * path->step_mm;
    set_along(context, *path, views);
    return {};
}

bool oblique_follows(const ActionContext& context) {
    const SliceViews& views = context.document.session().slices;
    const auto& path = context.assets.followed.path;
    return views.along && path && views.crosshair &&
           glm::distance(*views.crosshair, path->at(views.along->at_mm).at) < path->step_mm;
}

std::vector<Command> along_commands() {
    constexpr const char* kAlongHelp = "Follows a vessel in slices: the selected branch, a branch, or a way between "
                                       "two places; off ends it.";
    const auto of_vessel = [](Command command) { return std::move(command).when(follows_vessel); };
    return {
        Command("along", "[BRANCH|root..BRANCH|A..B|off]", kAlongHelp, along)
            .in_menu("Slices", "Follow in slices")
            .in_submenu("Along a vessel")
            .when(has_selection),
        Command("along-root", "", "Follows the vessels from the root to the selected branch in slices.", along_root)
            .in_menu("Slices", "Follow from the root")
            .in_submenu("Along a vessel")
            .when(has_selection),
        of_vessel(Command("along", "[BRANCH|root..BRANCH|A..B|off]", kAlongHelp, along)
                      .in_menu("Slices", "Follow no vessel")
                      .in_submenu("Along a vessel")
                      .giving({"off"})),
        of_vessel(Command("along-at", "MM", "Moves the slice across a vessel to a distance along it.", along_at)),
        of_vessel(Command("along-step", "N", "Moves the slice across a vessel by N voxels along it.", along_step)),
        of_vessel(Command("along-show", "[straightened|stretched] [--degrees D] [--width MM|auto]",
                          "Sets the picture along a vessel: its kind, rotation about the axis, and width.",
                          along_show)),
        of_vessel(Command("stenosis", "FROM TO [--reference AT|FROM..TO | --diameter MM] | off",
                          "Compares the narrowest section between two places of a vessel with a reference.", stenosis)),
        of_vessel(Command("sections", "[FILE.csv] [--step MM]",
                          "Writes a table of the cross-sections of the vessel that slices follow.", sections)
                      .in_menu("Slices", "Save cross-sections...")
                      .in_submenu("Along a vessel"))};
}

} // namespace ramus::app::actions
