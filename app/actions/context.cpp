// Commands of context: surfaces next to the tree, in the same coordinates (organs, bones, other surfaces of the same
// vessels).
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/actions/objects.h"
#include "app/assets/assets.h"
#include "app/assets/half_turn.h"
#include "app/session/colour_by.h"
#include "app/session/comparison.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/io/input_file.h"
#include "core/io/trees/imported_tree.h"
#include "core/io/volumes/volume_file.h"
#include "core/volume/label_counts.h"
#include "render/scene/bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace ramus::app::actions {

namespace {

constexpr const char* kUsage =
    "context FILE [--label LABEL,...|all] [--isovalue X] [--colour RRGGBB] [--opacity X] [--wireframe] [--exact] "
    "[--units UNIT] [--mesh-orientation LPS|RAS]";

// Muted colours unlike vessels: brown for an organ, bone, and colours that do not occur in a body.
constexpr std::array<std::array<std::uint8_t, 3>, 6> kColours{
    {{201, 130, 104}, {222, 211, 178}, {106, 152, 201}, {122, 178, 132}, {176, 134, 196}, {205, 176, 92}}};

std::array<std::uint8_t, 3> next_colour(const std::vector<ContextItem>& context) {
    for (const auto& colour : kColours)
        if (std::ranges::find(context, colour, &ContextItem::colour) == context.end()) return colour;
    return kColours[context.size() % kColours.size()];
}

// The request of the arguments.
struct AskedContext {
    ContextItem item;
    std::vector<volume::LabelChoice> labels; // one item each; empty: one item for everything inside
    bool each_label = false;                 // one item for each label of the mask
    bool coloured = false;                   // colour given; false: from the file, or unlike the others
};

Result<AskedContext> asked_in(Arguments arguments) {
    AskedContext asked;
    ContextItem& item = asked.item;
    std::optional<double> opacity;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--wireframe") {
            item.wireframe = true;
        } else if (word == "--exact") {
            item.exact = true;
        } else if (word == "--label" || word == "--isovalue" || word == "--colour" || word == "--opacity" ||
                   word == "--units" || word == "--mesh-orientation") {
            const std::string value = i + 1 < arguments.size() ? arguments[++i] : std::string();
            if (word == "--label") {
                asked.each_label = value == "all";
                const auto labels = asked.each_label ? std::vector<volume::LabelChoice>() : label_list(value);
                if (!labels) return fail("--label takes names and whole numbers other than 0", {}, kUsage);
                asked.labels = *labels;
            } else if (word == "--isovalue") {
                item.isovalue = parsed<double>(value);
                if (!item.isovalue || !std::isfinite(*item.isovalue))
                    return fail("--isovalue takes a number", {}, kUsage);
            } else if (word == "--units") {
                if (!io::length_unit(value)) return fail("--units takes a unit of length: mm, um, cm or m", {}, kUsage);
                item.units = value;
            } else if (word == "--mesh-orientation") {
                if (!io::slicer_space(value)) return fail("--mesh-orientation takes LPS or RAS", {}, kUsage);
                item.axes = value;
            } else if (word == "--colour") {
                const auto colour = colour_in(value);
                if (!colour)
                    return fail("--colour takes a colour: RRGGBB", {}, "c98268, say; with a # only between quotes");
                item.colour = *colour;
                asked.coloured = true;
            } else {
                opacity = number_in(value, 0.0, 1.0);
                if (!opacity) return fail("--opacity takes a number from 0 to 1", {}, kUsage);
            }
        } else if (word.starts_with("--") || word.empty() || !item.file.empty()) {
            return fail("context takes a file and how it looks", {}, kUsage);
        } else {
            item.file = std::filesystem::absolute(word).lexically_normal().string();
        }
    }
    if (item.file.empty()) return fail("context takes a file", {}, kUsage);
    if (item.isovalue && (asked.each_label || !asked.labels.empty()))
        return fail("context takes a label of a mask or an isovalue of a scan, not both", {}, kUsage);
    item.opacity = opacity.value_or(item.wireframe ? 1.0 : item.opacity);
    return asked;
}

std::vector<ContextItem> items_of(const AskedContext& asked) {
    if (asked.labels.empty()) return {asked.item};
    std::vector<ContextItem> items(asked.labels.size(), asked.item);
    for (std::size_t i = 0; i < items.size(); ++i) items[i].label = asked.labels[i];
    return items;
}

// Context far from the tree belongs to another patient, or has other coordinates.
std::string distance_text(const ContextShape& shape, const std::string& read_in, const tree::VesselTree* tree) {
    if (tree == nullptr) return {};
    const render::Box vessels = render::bounds_of(*tree), &box = shape.box;
    const std::string turned = half_turn_hint({box, shape.claims.orientation}, {vessels, tree->claims.orientation},
                                              other_axes_option(read_in));
    if (!turned.empty()) return "; " + turned;
    if (box.empty() || vessels.empty()) return {};
    const double away = glm::length(glm::max(glm::max(box.lower - vessels.upper, vessels.lower - box.upper), 0.0));
    return away > 0.0 ? "; it lies " + Lengths().text(away) + " beside the tree: is it in the same coordinates?"
                      : std::string();
}

Result<void> check_new(const ContextItem& item, const std::vector<ContextItem>& context) {
    const auto same = [&](const ContextItem& other) {
        return source_of(other) == source_of(item) && other.wireframe == item.wireframe;
    };
    if (std::ranges::any_of(context, same)) return fail("this is shown already", item.file);
    return {};
}

Result<AskedContext> asked_of(const Document& document, Arguments arguments) {
    RAMUS_TRY(asked, asked_in(arguments));
    if (auto possible = io::check_input(asked.item.file); !possible && !std::filesystem::is_directory(asked.item.file))
        return tl::unexpected(possible.error());
    if (!can_be_context(asked.item.file))
        return fail("this is neither a mask nor a mesh", asked.item.file, "context is " + context_extensions());
    if (asked.each_label) return asked; // the file lists them
    for (const ContextItem& item : items_of(asked))
        if (auto is_new = check_new(item, document.marks().context); !is_new) return tl::unexpected(is_new.error());
    return asked;
}

// All labels of a mask.
Result<std::vector<volume::LabelChoice>> labels_in(const ContextItem& item, Job& job) {
    constexpr std::size_t kMost = 64;
    if (!io::is_volume(item.file))
        return fail("a mesh has no labels", item.file, "masks have them: " + io::readable_volume_extensions());
    RAMUS_TRY(volume, io::read_volume(item.file, {0.0, io::length_unit(item.units)}, job));
    std::vector<volume::LabelChoice> labels;
    for (const volume::LabelCount& count : volume::label_counts(volume)) labels.emplace_back(count.label);
    if (labels.empty() || labels.size() > kMost)
        return fail(labels.empty() ? "no voxel has a label" : "it has more than " + std::to_string(kMost) + " labels",
                    item.file, "name those that are meant, as 1,2");
    return labels;
}

render::Camera at_all(const ActionContext& context) {
    const glm::ivec2 size = context.picture.picture_size();
    const auto visible = visible_positions(context, render::looking({}, render::View::kAnterior), size);
    return render::camera_for(visible, render::View::kAnterior, size);
}

// Requires the surfaces of all labels to be loaded.
Result<void> add_context(ActionContext& context, const AskedContext& asked) {
    std::vector<ContextItem> list = context.document.marks().context;
    std::string said = std::filesystem::path(asked.item.file).filename().string() + ": ";
    for (ContextItem item : items_of(asked)) {
        if (auto is_new = check_new(item, list); !is_new) return is_new;
        const auto shape = context.assets.context_shape(source_of(item));
        if (!shape) return fail("the surface is not there any more", item.file, "ask for it again");
        const volume::LabelName label = shape->label.value_or(volume::LabelName{});
        if (!asked.coloured) item.colour = label.colour.value_or(next_colour(list));
        said += (list.size() > context.document.marks().context.size() ? "; " : "") +
                (label.name.empty() ? "" : label.name + ", ") +
                counted(shape->mesh->triangles.size(), "triangle", "triangles") +
                distance_text(*shape, item.axes, context.document.tree().get()) +
                (shape->suspicion.empty() ? "" : "; " + shape->suspicion);
        list.push_back(std::move(item));
    }
    context.say(said);
    // Without a tree the camera fits everything, until the user moves it.
    const bool looks_at_all = !has_tree(context.document) &&
                              (!has_scene(context.document) || context.document.session().camera == at_all(context));
    auto added = edit(context, [&](Marks& marks) { marks.context = list; });
    if (added && looks_at_all) context.document.set_camera(at_all(context));
    return added;
}

Continuation ask_about(const std::string& file) {
    return [file](ActionContext& then) {
        then.files->ask_about_context(file);
        return Result<void>{};
    };
}

Result<Outcome> context(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(
            ask_for_file(context, FilePurpose::kContext, fail("context needs a FILE here", {}, context_extensions())));
    RAMUS_TRY(wanted, asked_of(context.document, arguments));
    // The surface of a scan needs a threshold, which the user must choose.
    const bool asks =
        arguments.size() == 1 && context.files != nullptr && context.files->asks() && io::is_volume(wanted.item.file);
    return Pending{
        "Reading " + std::filesystem::path(wanted.item.file).filename().string(),
        [asked = std::move(wanted), assets = context.assets, asks](Job& job) mutable -> Result<Continuation> {
            if (asked.each_label) {
                RAMUS_TRY(labels, labels_in(asked.item, job));
                asked.labels = std::move(labels);
            }
            for (const ContextItem& item : items_of(asked)) {
                auto shape = load_context_shape(assets, source_of(item), job);
                if (!shape && asks && !job.cancelled()) return ask_about(item.file);
                if (!shape) return tl::unexpected(shape.error());
            }
            return [asked, read = assets](ActionContext& then) {
                for (const ContextItem& item : items_of(asked))
                    then.assets.put(source_of(item), read.context_shapes.at(source_of(item)));
                return add_context(then, asked);
            };
        }};
}

// Changes the N-th item of the list by `change`, which fails for invalid values.
template <class Change>
Result<void> change_one(ActionContext& context, Arguments arguments, std::size_t values, const char* usage,
                        const Change& change) {
    if (arguments.size() != 1 + values) return fail(std::string(usage), {}, "N counts from 1 in the list of context");
    Marks next = context.document.marks();
    RAMUS_TRY(index, list_index(arguments.first(1), next.context.size(), "context mesh"));
    if (auto changed = change(next.context, index); !changed) return changed;
    context.document.change(std::move(next));
    return {};
}

Result<void> context_clear(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.context.clear(); });
}

Result<void> context_style(ActionContext& context, Arguments arguments) {
    return change_one(context, arguments, 1, "context-style takes a number, and surface or wireframe",
                      [&](auto& list, std::size_t i) -> Result<void> {
                          if (arguments[1] != "surface" && arguments[1] != "wireframe")
                              return fail("there is no style " + arguments[1], {}, "surface or wireframe");
                          list[i].wireframe = arguments[1] == "wireframe";
                          return {};
                      });
}

Result<void> context_axes(ActionContext& context, Arguments arguments) {
    return change_one(context, arguments, 1, "context-axes takes a number, and LPS or RAS",
                      [&](auto& list, std::size_t i) -> Result<void> {
                          if (!io::slicer_space(arguments[1]))
                              return fail("\"" + arguments[1] + "\" are no axes of a mesh", {}, "LPS or RAS");
                          const auto shape = context.assets.context_shape(source_of(list[i]));
                          if (shape && shape->claims.orientation == tree::SaidBy::kFile)
                              return fail("the file states its axes", list[i].file, "correct the file");
                          list[i].axes = arguments[1];
                          return {};
                      });
}

bool has_context(const Document& document) { return !document.marks().context.empty(); }

// Sets the unit of everything shown without a tree. The camera follows the change of size.
Result<void> take_units(ActionContext& context, const std::string& units, const Assets& read) {
    const bool alone = !has_tree(context.document),
               looks_at_all = alone && context.document.session().camera == at_all(context);
    const render::Box before = context.assets.box_of(context.document.marks().context);
    for (const auto& [source, loaded] : read.context_shapes)
        if (source.units == units) context.assets.put(source, loaded);
    auto done = edit(context, [&](Marks& marks) {
        for (ContextItem& item : marks.context) item.units = units;
    });
    if (!done || !alone) return done;
    render::Camera camera = context.document.session().camera;
    const render::Box after = context.assets.box_of(context.document.marks().context);
    const double factor = before.empty() || after.empty() ? 1.0 : after.radius() / before.radius();
    camera.position *= factor;
    camera.focal_point *= factor;
    camera.scale *= factor;
    context.document.set_camera(looks_at_all ? at_all(context) : camera);
    return done;
}

} // namespace

Result<Outcome> read_context_in(ActionContext& context, const std::string& units) {
    if (units != "auto" && !io::length_unit(units))
        return fail("\"" + units + "\" is no unit of length", {}, "mm, um, cm, m, the size of a voxel in mm, or auto");
    if (!has_context(context.document)) return fail("nothing is shown whose unit could be said");
    const std::string wanted = units == "auto" ? std::string() : units;
    std::vector<ContextItem> items = context.document.marks().context;
    for (ContextItem& item : items) item.units = wanted;
    if (items == context.document.marks().context) return Done{};
    return Pending{"Reading what is shown",
                   [items, wanted, assets = context.assets](Job& job) mutable -> Result<Continuation> {
                       for (const ContextItem& item : items) {
                           if (!item.visible) continue;
                           if (auto shape = load_context_shape(assets, source_of(item), job); !shape)
                               return tl::unexpected(shape.error());
                       }
                       return [wanted, assets](ActionContext& then) { return take_units(then, wanted, assets); };
                   }};
}

std::vector<Command> context_commands() {
    return {
        Command(
            "context",
            "[FILE [--label LABEL,...|all] [--isovalue X] [--colour RRGGBB] [--opacity X] [--wireframe] [--exact] "
            "[--units UNIT] [--mesh-orientation LPS|RAS]]",
            "Shows the surface of a mask, of a scan at an isovalue, or of a mesh beside the tree, or alone where there "
            "is none; without FILE, asks for one. A mask's steps between voxels are smoothed, by half a voxel at most, "
            "unless its exact steps are asked for. A mesh that does not state its axes is in RAS unless you say LPS.",
            context)
            .in_menu("File", "Add context..."),
        Command("context-remove", "N", "Takes the N-th context mesh away.", for_kind(ContextItem::kNoun, remove_object))
            .when(has_context),
        Command("context-clear", "", "Takes all context meshes away.", context_clear).when(has_context),
        Command("context-show", "N", "Shows the N-th context mesh again.", for_kind(ContextItem::kNoun, show_object))
            .when(has_context),
        Command("context-hide", "N", "Keeps the N-th context mesh, and does not show it.",
                for_kind(ContextItem::kNoun, hide_object))
            .when(has_context),
        Command("context-opacity", "N X", "How dense the N-th context mesh is, from 0 to 1, which is solid.",
                for_kind(ContextItem::kNoun, fade_object))
            .when(has_context),
        Command("context-colour", "N RRGGBB", "The colour of the N-th context mesh.",
                for_kind(ContextItem::kNoun, colour_object))
            .when(has_context),
        Command("context-axes", "N LPS|RAS",
                "Says where the axes of the N-th context mesh lead, whose file does not state them.", context_axes)
            .when(has_context),
        Command("context-style", "N surface|wireframe",
                "Draws the N-th context mesh as a surface, or as the edges of its triangles.", context_style)
            .when(has_context),
    };
}

} // namespace ramus::app::actions
