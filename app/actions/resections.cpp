// Commands of resections: what an operation removes of the organ by planes, sheets, surfaces and margins.
// objects.cpp shows, names, colours and removes resections.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/actions/organ_strokes.h"
#include "app/assets/assets.h"
#include "app/assets/territories.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/orientation.h"
#include "core/organ/resect/border.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

using ResectionKind = Resection::Kind;

constexpr const char* kResectUsage = "plane X,Y,Z NX,NY,NZ, points and three X,Y,Z, sheet and three or more X,Y,Z, "
                                     "along NX,NY,NZ and two or more X,Y,Z, border plane|sheet TERRITORY, line or "
                                     "stroke and X,Y of the picture, surface FILE, cuts MM, or lesion N MM";

std::optional<glm::dvec3> vector_in(const std::string& word) {
    const auto numbers = numbers_in(word, 3, kFarthestMm);
    return numbers ? std::optional(glm::dvec3((*numbers)[0], (*numbers)[1], (*numbers)[2])) : std::nullopt;
}

Result<Resection> plane_of(Arguments arguments) {
    const auto point = arguments.size() == 2 ? vector_in(arguments[0]) : std::nullopt;
    const auto normal = arguments.size() == 2 ? vector_in(arguments[1]) : std::nullopt;
    if (!point || !normal || glm::length(*normal) == 0.0)
        return fail("a plane is a point X,Y,Z and a normal NX,NY,NZ", {}, "what the normal points to is removed");
    return Resection{.kind = ResectionKind::kPlane, .point = *point, .normal = glm::normalize(*normal)};
}

Result<Resection> plane_through(const ActionContext& context, Arguments arguments) {
    std::array<glm::dvec3, 3> points{};
    for (std::size_t n = 0; n < points.size(); ++n) {
        const auto point = arguments.size() == points.size() ? vector_in(arguments[n]) : std::nullopt;
        if (!point) return fail("a plane goes through three points X,Y,Z");
        points[n] = *point;
    }
    constexpr double kFlat = 1e-6; // the sine of the angle between two sides of the triangle
    const glm::dvec3 one = points[1] - points[0], other = points[2] - points[0], across = glm::cross(one, other);
    if (glm::length(across) <= kFlat * glm::length(one) * glm::length(other))
        return fail("the three points are on one line", {}, "choose points that make a triangle");
    Resection resection{.kind = ResectionKind::kPlane,
                        .point = (points[0] + points[1] + points[2]) / 3.0,
                        .normal = glm::normalize(across)};
    if (auto chosen = choose_side(context, resection); !chosen) return tl::unexpected(chosen.error());
    return resection;
}

// A border of the territories that are shown.
struct Border {
    std::shared_ptr<const OrganTerritories> territories;
    std::uint16_t part = 0; // as in part_of
    bool plane = false;
};
Result<Border> border_in(const ActionContext& context, Arguments arguments) {
    const auto& territories = context.assets.organ.territories;
    if (arguments.size() != 2 || (arguments[0] != "plane" && arguments[0] != "sheet"))
        return fail("resect border takes plane or sheet, and the name of a territory that is shown");
    if (!territories || context.document.marks().organ.territories == TerritoriesOf::kNothing)
        return fail("no territories are shown", {}, "territories names shows those of branches with names");
    for (std::size_t n = 0; n < territories->parts.size(); ++n)
        if (territories->parts[n].name == arguments[1])
            return Border{territories, static_cast<std::uint16_t>(n + 1), arguments[0] == "plane"};
    return fail("there is no territory " + arguments[1], {}, "the page Plan lists those that are shown");
}
Result<Resection> along(const Border& border) {
    const OrganTerritories& territories = *border.territories;
    RAMUS_TRY(sheet,
              organ::sheet_along_border(territories.of.supply->of.mask->organ, territories.part_of, border.part));
    if (!border.plane) return Resection{.kind = ResectionKind::kSheet, .sheet = std::move(sheet)};
    const glm::dvec3 middle = sheet.origin + 0.5 * ((sheet.size.x - 1) * sheet.step.x * sheet.u +
                                                    (sheet.size.y - 1) * sheet.step.y * sheet.v);
    return Resection{
        .kind = ResectionKind::kPlane, .point = middle, .normal = (sheet.removes_below ? -1.0 : 1.0) * sheet.normal()};
}

Result<Resection> sheet_of(const ActionContext& context, Arguments arguments) {
    std::vector<glm::dvec3> contour;
    for (const std::string& word : arguments) {
        const auto point = vector_in(word);
        if (!point) return fail("\"" + word + "\" is not a point X,Y,Z", {}, "a sheet goes through three or more");
        contour.push_back(*point);
    }
    RAMUS_TRY(sheet, organ::sheet_through(contour));
    Resection resection{.kind = ResectionKind::kSheet, .sheet = std::move(sheet)};
    if (auto chosen = choose_side(context, resection); !chosen) return tl::unexpected(chosen.error());
    return resection;
}

Result<std::vector<glm::dvec3>> places_of(Arguments arguments) {
    std::vector<glm::dvec3> places;
    for (const std::string& word : arguments) {
        const auto place = vector_in(word);
        if (!place) return fail("\"" + word + "\" is not a place X,Y,Z in mm");
        places.push_back(*place);
    }
    return places;
}

Result<Resection> sheet_across(const ActionContext& context, Arguments arguments) {
    const auto normal = arguments.size() < 3 ? std::nullopt : vector_in(arguments[0]);
    if (!normal || glm::length(*normal) == 0.0)
        return fail("resect along takes a direction NX,NY,NZ and a line of two or more X,Y,Z", {},
                    "the sheet leads through the organ along the direction");
    RAMUS_TRY(places, places_of(arguments.subspan(1)));
    return resection_drawn_on_slice(context, *normal, places);
}

Result<Resection> surface_of(Arguments arguments) {
    if (arguments.empty() || (arguments.size() != 1 && (arguments.size() != 3 || arguments[1] != "--mesh-orientation")))
        return fail("resect surface takes a mesh, and --mesh-orientation LPS or RAS", {},
                    io::readable_mesh_extensions());
    Resection resection{.kind = ResectionKind::kSurface};
    resection.file = std::filesystem::absolute(arguments[0]).lexically_normal().string();
    if (arguments.size() == 3) {
        if (!io::slicer_space(arguments[2])) return fail("--mesh-orientation takes LPS or RAS");
        resection.axes = arguments[2];
    }
    return resection;
}

Result<Resection> margin_of(const Marks& marks, ResectionKind kind, Arguments arguments) {
    const bool of_lesion = kind == ResectionKind::kLesion;
    Resection resection{.kind = kind};
    if (of_lesion) {
        if (arguments.size() != 2) return fail("resect lesion takes a lesion's number and a margin in mm");
        RAMUS_TRY(index, list_index(arguments.first(1), marks.lesions.size(), "lesion"));
        resection.lesion = marks.lesions[index].id;
        arguments = arguments.subspan(1);
    } else if (marks.cuts.empty()) {
        return fail("there are no cuts", {}, "cut ID makes one");
    }
    const auto margin = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!margin) return fail("a margin is a length in mm");
    resection.margin_mm = *margin;
    return resection;
}

Result<Resection> asked_resection(const ActionContext& context, Arguments arguments) {
    const Marks& marks = context.document.marks();
    if (!marks.organ.any()) return fail("there is no organ", {}, "organ FILE reads its mask");
    if (arguments.empty()) return fail("what is removed?", {}, kResectUsage);
    const std::string& kind = arguments[0];
    arguments = arguments.subspan(1);
    if (kind == "plane") return plane_of(arguments);
    if (kind == "points") return plane_through(context, arguments);
    if (kind == "sheet") return sheet_of(context, arguments);
    if (kind == "along") return sheet_across(context, arguments);
    if (kind == "surface") return surface_of(arguments);
    if (kind == "cuts") return margin_of(marks, ResectionKind::kCuts, arguments);
    if (kind == "lesion") return margin_of(marks, ResectionKind::kLesion, arguments);
    if (kind == "line" || kind == "stroke") return resection_drawn(context, kind == "line", arguments);
    return fail("there is no resection by " + kind, {}, kResectUsage);
}

Result<void> add_resection(ActionContext& context, const Resection& resection) {
    return edit(context, [&](Marks& marks) {
        marks.resections.push_back(resection);
        number_objects(marks);
    });
}

Result<Outcome> resect(ActionContext& context, Arguments arguments) {
    if (!arguments.empty() && arguments[0] == "border") {
        RAMUS_TRY(wanted, border_in(context, arguments.subspan(1)));
        return Pending{"Finding a border", [border = wanted](Job&) -> Result<Continuation> {
                           RAMUS_TRY(found, along(border));
                           return [resection = found](ActionContext& then) { return add_resection(then, resection); };
                       }};
    }
    RAMUS_TRY(asked, asked_resection(context, arguments));
    if (asked.kind != ResectionKind::kSurface) return outcome_of(add_resection(context, asked));
    if (auto organ = organ_read(context); !organ) return tl::unexpected(organ.error());
    return Pending{"Reading a resection",
                   [resection = asked, of = ResectionMeshOf{asked.file, asked.axes, *context.assets.organ.mask.value}](
                       Job& job) -> Result<Continuation> {
                       const ResectionMesh read = read_resection_mesh(of, JobRange(job, 0.0F, 1.0F));
                       if (!read.surface) return tl::unexpected(read.surface.error());
                       return [resection, read](ActionContext& then) {
                           then.assets.organ.meshes.insert_or_assign(resection.file, read);
                           return add_resection(then, resection);
                       };
                   }};
}

// Changes resection N by change(it, the arguments after N).
CommandAction changing(const char* usage, std::size_t values, Result<void> (*change)(Resection&, Arguments)) {
    return [usage, values, change](ActionContext& context, Arguments arguments) -> Result<void> {
        if (arguments.size() != 1 + values) return fail(usage);
        Marks next = context.document.marks();
        RAMUS_TRY(index, list_index(arguments.first(1), next.resections.size(), "resection"));
        if (auto changed = change(next.resections[index], arguments.subspan(1)); !changed) return changed;
        context.document.change(std::move(next));
        return {};
    };
}

Result<void> flip_resection(Resection& resection, Arguments) {
    switch (resection.kind) {
    case ResectionKind::kPlane:
        resection.normal = -resection.normal;
        return {};
    case ResectionKind::kSheet:
        resection.sheet.removes_below = !resection.sheet.removes_below;
        return {};
    case ResectionKind::kSurface:
        resection.other_side = !resection.other_side;
        return {};
    case ResectionKind::kCuts:
    case ResectionKind::kLesion:
        break;
    }
    return fail("a margin has no other side");
}

Result<void> set_margin(Resection& resection, Arguments arguments) {
    const auto margin = number_in(arguments[0], 0.0, kFarthestMm);
    if (!margin || (resection.kind != ResectionKind::kCuts && resection.kind != ResectionKind::kLesion))
        return fail(margin ? "this resection has no margin" : "a margin is a length in mm");
    resection.margin_mm = *margin;
    return {};
}

Result<void> set_plane(Resection& resection, Arguments arguments) {
    if (resection.kind != ResectionKind::kPlane) return fail("this resection is no plane");
    RAMUS_TRY(plane, plane_of(arguments));
    resection.point = plane.point;
    resection.normal = plane.normal;
    return {};
}

Result<void> set_control(Resection& resection, Arguments arguments) {
    if (resection.kind != ResectionKind::kSheet) return fail("this resection is no sheet");
    const auto i = parsed<int>(arguments[0]), j = parsed<int>(arguments[1]);
    const auto height = number_in(arguments[2], -kFarthestMm, kFarthestMm);
    organ::Sheet& sheet = resection.sheet;
    if (!i || !j || *i < 0 || *j < 0 || *i >= sheet.size.x || *j >= sheet.size.y || !height)
        return fail("a control point is two numbers from 0 and a height in mm", {},
                    "this sheet has " + std::to_string(sheet.size.x) + " by " + std::to_string(sheet.size.y));
    sheet.heights[sheet.index(*i, *j)] = *height;
    return {};
}

Result<void> bend_through(ActionContext& context, Arguments arguments) {
    if (arguments.size() < 2) return fail("resection-through takes a resection's number and places X,Y,Z in mm");
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().resections.size(), "resection"));
    const Resection& resection = context.document.marks().resections[index];
    if (resection.kind != ResectionKind::kSheet) return fail("this resection is no sheet");
    RAMUS_TRY(places, places_of(arguments.subspan(1)));
    RAMUS_TRY(bent, organ::bent_through(resection.sheet, places));
    return edit(context, [&, n = index, &sheet = bent](Marks& marks) { marks.resections[n].sheet = sheet; });
}

bool has_an_organ(const Document& document) { return document.marks().organ.any(); }
bool has_resections(const Document& document) { return !document.marks().resections.empty(); }

} // namespace

std::vector<Command> resection_commands() {
    return {
        Command(
            "resect", "plane|points|sheet|along|border|line|stroke|surface|cuts|lesion ...",
            "Removes a part of the organ: plane X,Y,Z NX,NY,NZ what the normal points to; points X,Y,Z X,Y,Z X,Y,Z and "
            "sheet X,Y,Z... the lesions' side of the plane or smooth sheet through these points, without lesions the "
            "smaller one; along NX,NY,NZ X,Y,Z... a sheet that leads through the organ in this direction from a line "
            "that "
            "is drawn on a slice; border plane|sheet TERRITORY that side of the border of a territory; line X,Y X,Y "
            "and "
            "stroke X,Y... what lies behind a "
            "line drawn across the picture; surface FILE the inside of a closed mesh or the smaller side of an open "
            "one; cuts MM all that depends on the cuts, with a margin; lesion N MM a lesion with a margin.",
            resect)
            .when(has_an_organ),
        Command("resect", "cuts MM", "Removes all that depends on the cuts.", resect)
            .in_menu("Plan", "Resect beyond the cuts")
            .giving({"cuts", "0"})
            .when(has_an_organ),
        Command("resection-flip", "N", "Removes the other side of a plane, sheet or surface.",
                changing("resection-flip takes a resection's number", 0, flip_resection))
            .when(has_resections),
        Command("resection-margin", "N MM", "Sets the margin of a resection around a lesion or beyond cuts.",
                changing("resection-margin takes a resection's number and a margin in mm", 1, set_margin))
            .when(has_resections),
        Command("resection-plane", "N X,Y,Z NX,NY,NZ", "Moves the plane of resection N.",
                changing("resection-plane takes a resection's number, a point and a normal", 2, set_plane))
            .when(has_resections),
        Command("resection-control", "N I J MM", "Moves a control point of the sheet of resection N to a height.",
                changing("resection-control takes a resection's number, two numbers of a control point and its height",
                         3, set_control))
            .when(has_resections),
        Command("resection-through", "N X,Y,Z ...", "Bends the sheet of resection N so that it passes through places.",
                bend_through)
            .when(has_resections),
    };
}

} // namespace ramus::app::actions
