// Commands for planning an operation: lesions with margins, cuts with their cost, hiding thin vessels.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/actions/objects.h"
#include "app/assets/assets.h"
#include "app/assets/half_turn.h"
#include "app/session/numbers.h"
#include "core/io/meshes/mesh_file.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

using tree::BranchState;

constexpr const char* kAskedLesion = "a lesion is X,Y,Z,R: its centre and its radius in mm";

std::optional<std::array<double, 4>> sphere_in(const std::string& word) {
    const auto numbers = numbers_in(word, 4, kFarthestMm);
    if (!numbers || (*numbers)[3] <= 0.0) return {};
    return std::array{(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]};
}

Result<void> lesion(ActionContext& context, Arguments arguments) {
    if (!has_tree(context.document)) return fail("there is no tree to place it in");
    const auto sphere = arguments.size() == 1 ? sphere_in(arguments[0]) : std::nullopt;
    if (!sphere) return fail(kAskedLesion);
    return edit(context, [&](Marks& marks) { add_lesion(marks, {.sphere = *sphere}); });
}

Result<void> lesion_change(ActionContext& context, Arguments arguments) {
    const auto sphere = arguments.size() == 2 ? sphere_in(arguments[1]) : std::nullopt;
    if (!sphere) return fail("lesion-change takes a lesion's number and X,Y,Z,R", {}, kAskedLesion);
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().lesions.size(), "lesion"));
    if (context.document.marks().lesions[index].is_mesh())
        return fail("lesion " + arguments[0] + " is a mesh, whose place and size are its file's");
    return edit(context, [&](Marks& marks) { change_lesion(marks, index, *sphere); });
}

Result<void> expect_new_lesion(const Document& document, const std::filesystem::path& path) {
    if (const auto& all = document.marks().lesions; std::ranges::find(all, path.string(), &Lesion::file) != all.end())
        return fail("this lesion is there already", path.string());
    return {};
}

Result<void> add_lesion_mesh(ActionContext& context, const LesionSource& source, const LesionMesh& lesion) {
    const std::filesystem::path path = source.file;
    if (auto is_new = expect_new_lesion(context.document, path); !is_new) return is_new;
    std::string apart;
    if (const tree::VesselTree* tree = context.document.tree().get(); tree != nullptr)
        apart = half_turn_hint({render::bounds_of(lesion.mesh), lesion.claims.orientation},
                               {render::bounds_of(*tree), tree->claims.orientation}, other_axes_option(source.axes));
    context.say("Lesion of " + counted(lesion.mesh.triangles.size(), "triangle", "triangles") + ": " +
                path.filename().string() + (apart.empty() ? "" : "; " + apart));
    return edit(context, [&](Marks& marks) { add_lesion(marks, {.file = source.file, .axes = source.axes}); });
}

Result<Outcome> lesion_mesh(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kLesionMesh,
                                       fail("lesion-mesh needs a FILE here", {}, io::readable_mesh_extensions())));
    std::string axes;
    if (arguments.size() == 3 && arguments[1] == "--mesh-orientation") {
        if (!io::slicer_space(arguments[2])) return fail("--mesh-orientation takes LPS or RAS");
        axes = arguments[2];
        arguments = arguments.first(1);
    }
    if (arguments.size() != 1)
        return fail("lesion-mesh takes a file, " + io::readable_mesh_extensions() + ", and --mesh-orientation", {},
                    "put quotes around a name with blanks");
    const std::filesystem::path path = std::filesystem::absolute(arguments[0]).lexically_normal();
    if (auto is_new = expect_new_lesion(context.document, path); !is_new) return tl::unexpected(is_new.error());
    return Pending{"Reading " + path.filename().string(),
                   [source = LesionSource{path.string(), axes},
                    assets = context.assets](Job& job) mutable -> Result<Continuation> {
                       if (auto mesh = load_lesion(assets, source, job); !mesh) return tl::unexpected(mesh.error());
                       return [source, read = assets.lesion_files.at(source)](ActionContext& then) {
                           then.assets.put(source, read);
                           return add_lesion_mesh(then, source, *(*read.value)->parts.front());
                       };
                   }};
}

// Adds the parts that the session does not have.
Result<void> add_lesion_mask(ActionContext& context, const LesionSource& source, const LesionFile& file) {
    Marks next = context.document.marks();
    std::vector<double> volumes;
    for (std::size_t n = 0; n < file.parts.size(); ++n) {
        const Lesion lesion{.file = source.file,
                            .labels = source.labels,
                            .units = source.units,
                            .part = static_cast<int>(n) + 1,
                            .name = file.parts[n]->name};
        if (std::ranges::any_of(next.lesions,
                                [&](const Lesion& one) { return one.part == lesion.part && source_of(one) == source; }))
            continue;
        add_lesion(next, lesion);
        volumes.push_back(file.parts[n]->volume_mm3.value_or(0.0));
    }
    if (volumes.empty()) return fail("these lesions are there already", source.file);
    if (auto few = check_counts(next); !few) return few;
    context.document.change(std::move(next));
    const Lengths lengths(file.parts.front()->claims);
    std::string said = counted(volumes.size(), "lesion", "lesions") + " of the mask: ";
    said += volumes.size() == 1 ? lengths.volume(volumes.front())
                                : lengths.volume(volumes.back()) + " to " + lengths.volume(volumes.front());
    if (file.more > 0) said += "; " + counted(file.more, "smaller part is", "smaller parts are") + " left out";
    context.say(said + (file.suspicion.empty() ? "" : "; " + file.suspicion));
    return {};
}

Result<Outcome> lesion_mask(ActionContext& context, Arguments arguments) {
    if (arguments.empty())
        return outcome_of(ask_for_file(context, FilePurpose::kLesionMask,
                                       fail("lesion-mask needs a FILE here", {}, io::readable_volume_extensions())));
    RAMUS_TRY(mask, mask_argument("lesion-mask", arguments));
    return Pending{"Reading the lesions",
                   [source = LesionSource{mask.file, {}, true, mask.labels, mask.units},
                    assets = context.assets](Job& job) mutable -> Result<Continuation> {
                       if (auto file = load_lesion(assets, source, job); !file) return tl::unexpected(file.error());
                       return [source, read = assets.lesion_files.at(source)](ActionContext& then) {
                           then.assets.put(source, read);
                           return add_lesion_mask(then, source, **read.value);
                       };
                   }};
}

Result<void> lesion_axes(ActionContext& context, Arguments arguments) {
    Marks next = context.document.marks();
    if (arguments.size() != 2 || !io::slicer_space(arguments[1]))
        return fail("lesion-axes takes a number, and LPS or RAS");
    RAMUS_TRY(index, list_index(arguments.first(1), next.lesions.size(), "lesion"));
    Lesion& lesion = next.lesions[index];
    if (!lesion.is_mesh()) return fail("lesion " + arguments[0] + " is a sphere, without axes of its own");
    if (lesion.of_mask()) return fail("lesion " + arguments[0] + " is of a mask, which states its axes itself");
    const auto mesh = context.assets.lesion_mesh(lesion);
    if (mesh && mesh->claims.orientation == tree::SaidBy::kFile)
        return fail("the file states its axes", lesion.file, "correct the file");
    lesion.axes = arguments[1];
    context.document.change(std::move(next));
    return {};
}

// Reports measurements that were removed with a lesion.
void say_what_went(ActionContext& context, std::size_t measurements) {
    if (measurements > 0)
        context.say("Removed with " + counted(measurements, "measurement", "measurements") + " from the lesion");
}

Result<void> lesion_clear(ActionContext& context, Arguments) {
    Marks next = context.document.marks();
    std::size_t gone = 0;
    while (!next.lesions.empty()) gone += remove_object(next, next.lesions, next.lesions.size() - 1);
    context.document.change(std::move(next));
    say_what_went(context, gone);
    return {};
}

std::string cost_text(const measure::CutFigures& cut, double limit_mm, const Lengths& lengths) {
    return lengths.text(cut.diameter_mm) + " wide" + (cut.reconstruct ? ", " + over_text(limit_mm, lengths) : "") +
           "; lost: " + amount_text(cut.lost, lengths);
}

Result<void> cut(ActionContext& context, Arguments arguments) {
    Document& document = context.document;
    Marks next = document.marks();
    const std::size_t before = next.cuts.size();
    const auto add = [&](int branch, double fraction) {
        const std::pair cut{branch, fraction};
        if (std::ranges::find(next.cuts, cut) == next.cuts.end()) next.cuts.push_back(cut);
    };
    if (arguments.empty()) {
        // Cuts only the stem of a selected subtree, on which the rest depends.
        if (auto some = expect_selection(document); !some) return some;
        for (const int id : next.selection) {
            const auto above = document.dependency().upstream(id);
            if (std::ranges::none_of(above, [&](int other) { return is_selected(next, other); })) add(id, 0.5);
        }
    } else {
        RAMUS_TRY(id, branch_id(document, arguments[0]));
        const auto fraction = arguments.size() == 1 ? 0.5 : number_in(arguments[1], 0.0, 1.0);
        if (arguments.size() > 2 || !fraction)
            return fail("cut takes a branch and where to cut it", {},
                        "a fraction of its length from the parent's end, 0 to 1; 0.5 unless told");
        add(id, *fraction);
    }
    const std::size_t added = next.cuts.size() - before;
    if (added == 0) return fail("there is a cut already");
    if (auto few = check_counts(next); !few) return few;
    document.change(std::move(next));
    if (added == 1)
        context.say("Cut " + std::to_string(before + 1) + ": " +
                    cost_text(refresh_plan(context.assets, context.document).cuts.cuts.back(),
                              document.marks().planning.reconstruct_mm, document.lengths()));
    else
        context.say(counted(added, "cut", "cuts"));
    return {};
}

Result<void> cut_move(ActionContext& context, Arguments arguments) {
    const auto fraction = arguments.size() == 2 ? number_in(arguments[1], 0.0, 1.0) : std::nullopt;
    if (!fraction) return fail("cut-move takes a cut's number and where on its branch it is to be, 0 to 1");
    RAMUS_TRY(index, list_index(arguments.first(1), context.document.marks().cuts.size(), "cut"));
    return edit(context, [&, index = index](Marks& marks) { marks.cuts[index].second = *fraction; });
}

Result<void> cut_remove(ActionContext& context, Arguments arguments) {
    return remove_from(context, arguments, &Marks::cuts, "cut");
}

Result<void> cut_clear(ActionContext& context, Arguments) {
    return edit(context, [&](Marks& marks) { marks.cuts.clear(); });
}

Result<void> bands(ActionContext& context, Arguments arguments) {
    std::vector<double> found;
    for (const std::string& word : arguments) {
        const auto margin = number_in(word, 1e-6, kFarthestMm);
        if (!margin || (!found.empty() && *margin <= found.back())) {
            found.clear();
            break;
        }
        found.push_back(*margin);
    }
    if (found.empty() || found.size() > kMostBands)
        return fail("bands takes 1 to " + std::to_string(kMostBands) + " margins in mm that ascend", {},
                    "bands 5 10 20 is the default");
    return edit(context, [&](Marks& marks) { marks.planning.bands_mm = std::move(found); });
}

Result<void> reconstruct(ActionContext& context, Arguments arguments) {
    const auto limit = arguments.size() == 1 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    if (!limit)
        return fail("reconstruct takes a diameter in mm", {}, "cuts through vessels larger than that are marked");
    return edit(context, [&](Marks& marks) { marks.planning.reconstruct_mm = *limit; });
}

Result<void> filter_diameter(ActionContext& context, Arguments arguments) {
    struct Way {
        std::string_view name;
        BranchState state;
        const char* done;
    };
    constexpr std::array<Way, 3> kWays{{{"show", BranchState::kNormal, "Shown"},
                                        {"hide", BranchState::kHidden, "Hidden"},
                                        {"defocus", BranchState::kDefocused, "Defocused"}}};
    const auto limit = arguments.size() == 2 ? number_in(arguments[0], 0.0, kFarthestMm) : std::nullopt;
    const auto* way = limit ? std::ranges::find(kWays, std::string_view(arguments[1]), &Way::name) : kWays.end();
    if (way == kWays.end())
        return fail("filter-diameter takes a diameter in mm, and show, hide or defocus", {},
                    "it acts on the branches of a smaller mean diameter");
    if (!has_tree(context.document)) return fail("there is no tree");
    const TreeFacts& facts = *context.document.facts();
    std::vector<int> thin;
    double length = 0.0, volume = 0.0;
    for (std::size_t id = 0; id < facts.branches.size(); ++id) {
        if (facts.branches[id].diameter_mm.mean >= *limit) continue;
        thin.push_back(static_cast<int>(id));
        length += facts.branches[id].length_mm;
        volume += facts.branches[id].volume_mm3;
    }
    Marks next = context.document.marks();
    set_state(next, thin, way->state);
    context.document.change(std::move(next));
    const auto share = [](double part, double whole) {
        return digits(whole > 0.0 ? 100.0 * part / whole : 0.0, 2) + " %";
    };
    context.say(std::string(way->done) + ": " + grouped(thin.size()) + " of " +
                counted(facts.branches.size(), "branch", "branches") + " below " + arguments[0] + " mm, " +
                share(static_cast<double>(thin.size()), static_cast<double>(facts.branches.size())) + " of them, " +
                share(length, facts.statistics.length_mm) + " of the length, " +
                share(volume, facts.statistics.volume_mm3) + " of the volume");
    return {};
}

bool has_cuts(const Document& document) { return !document.marks().cuts.empty(); }

} // namespace

std::vector<Command> surgery_commands() {
    return {
        Command("cut", "[ID [FRACTION]]",
                "Cuts a branch at a fraction of its length from the parent's end, in the middle unless told; without "
                "ID, the selected ones that depend on no other selected one.",
                cut)
            .in_menu("Plan", "Cut the selected", {"C"})
            .when(has_selection),
        Command("cut-move", "N FRACTION", "Moves cut N of the list along its branch.", cut_move).when(has_cuts),
        Command("cut-remove", "N", "Takes cut N of the list back.", cut_remove),
        Command("cut-clear", "", "Takes all cuts back.", cut_clear).in_menu("Plan", "Remove all cuts").when(has_cuts),
        Command("reconstruct", "MM", "Sets the diameter above which cuts through vessels are marked.", reconstruct),
        Command("lesion", "X,Y,Z,R", "Places a lesion: a sphere, its centre and radius in mm.", lesion),
        Command("lesion-change", "N X,Y,Z,R", "Gives lesion N of the list another centre and radius.", lesion_change),
        Command("lesion-mesh", "[FILE [--mesh-orientation LPS|RAS]]",
                "Places a lesion with the shape of a closed mesh: " + io::readable_mesh_extensions() +
                    ", in mm; in RAS, unless the file states other axes, or you do where it states none.",
                lesion_mesh),
        Command("lesion-mask", "[FILE [--label LABEL,...] [--units UNIT]]",
                "Places a lesion for each part of a mask, or of labels of it, that does not touch another one of its "
                "label by a face, the largest first, at most " +
                    std::to_string(kMostLesionParts) + "; without FILE, asks for one.",
                lesion_mask)
            .in_menu("Plan", "Lesions of a mask\xE2\x80\xA6")
            .when(has_tree),
        Command("lesion-axes", "N LPS|RAS",
                "Says where the axes of the mesh of lesion N lead, whose file does not state them.", lesion_axes),
        Command("lesion-remove", "N", "Takes lesion N of the list away; meshes are counted after spheres.",
                for_kind(Lesion::kNoun, remove_object)),
        Command("lesion-clear", "", "Takes all lesions away.", lesion_clear)
            .in_menu("Plan", "Remove all lesions")
            .when(has_lesions),
        Command("bands", "MM...", "Sets the margins around lesions, ascending.", bands),
        Command("bands", "MM...", "Sets the margins around lesions to 5, 10 and 20 mm.", bands)
            .in_menu("Plan", "Margins 5, 10, 20 mm")
            .giving({"5", "10", "20"})
            .when(has_tree),
        Command("bands", "MM...", "Sets the margins around lesions to 2, 5 and 10 mm.", bands)
            .in_menu("Plan", "Margins 2, 5, 10 mm")
            .giving({"2", "5", "10"})
            .when(has_tree),
        Command("filter-diameter", "MM show|hide|defocus",
                "Shows, hides or defocuses the branches of a mean diameter below MM, and says how many those are.",
                filter_diameter),
        Command("filter-diameter", "MM show|hide|defocus", "Hides the branches of a mean diameter below 1 mm.",
                filter_diameter)
            .in_menu("Plan", "Hide vessels below 1 mm")
            .giving({"1", "hide"})
            .when(has_tree),
        Command("filter-diameter", "MM show|hide|defocus",
                "Makes the branches of a mean diameter below 2 mm grey glass.", filter_diameter)
            .in_menu("Plan", "Defocus vessels below 2 mm")
            .giving({"2", "defocus"})
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
