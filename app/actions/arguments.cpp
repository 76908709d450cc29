#include "app/actions/arguments.h"

#include "app/assets/assets.h"
#include "app/picture/scene_objects.h"
#include "app/storage/user_folders.h"
#include "core/base/words.h"
#include "core/io/length_unit.h"
#include "core/io/volumes/volume_file.h"

#include <algorithm>
#include <filesystem>
#include <glm/geometric.hpp>
#include <numeric>

namespace ramus::app::actions {

Result<int> branch_id(const Document& document, const std::string& word) {
    const auto id = parsed<int>(word);
    if (!id) return fail("\"" + word + "\" is not a branch id");
    if (*id < 0 || *id >= document.branch_count())
        return fail("there is no branch " + word, {},
                    "ids go from 0 to " + std::to_string(document.branch_count() - 1) + " in this tree");
    return *id;
}

Result<std::vector<int>> branch_ids(const Document& document, Arguments arguments) {
    if (arguments.empty()) return fail("which branches?", {}, "give their ids");
    std::vector<int> ids;
    for (const std::string& word : arguments) {
        RAMUS_TRY(id, branch_id(document, word));
        ids.push_back(id);
    }
    return ids;
}

std::optional<double> number_in(std::string_view word, double least, double most) {
    const auto value = parsed<double>(word);
    return value && *value >= least && *value <= most ? value : std::nullopt;
}

std::optional<std::vector<double>> numbers_in(const std::string& word, std::size_t count, double most) {
    std::vector<double> numbers;
    for (const std::string_view part : parts_of(word)) {
        const auto number = number_in(part, -most, most);
        if (!number) return {};
        numbers.push_back(*number);
    }
    return numbers.size() == count ? std::optional(numbers) : std::nullopt;
}

Result<std::size_t> list_index(Arguments arguments, std::size_t count, const std::string& what) {
    if (count == 0) return fail("there is no " + what);
    const auto number =
        arguments.size() == 1 ? number_in(arguments[0], 1.0, static_cast<double>(count)) : std::optional<double>();
    if (!number || *number != static_cast<double>(static_cast<std::size_t>(*number)))
        return fail("which " + what + "?", {}, "give its number, from 1 to " + std::to_string(count));
    return static_cast<std::size_t>(*number) - 1;
}

Result<std::filesystem::path> file_argument(ActionContext& context, Arguments arguments, std::string_view command,
                                            std::string_view extension) {
    if (arguments.size() > 1)
        return fail(std::string(command) + " takes one file", {}, "put quotes around a name with blanks");
    if (!arguments.empty() && arguments[0].empty()) return fail("the name of a file is empty");
    const std::filesystem::path path =
        arguments.empty() ? suggested_file(context.document, extension) : std::filesystem::path(arguments[0]);
    return path;
}

Result<OrganSource> mask_argument(std::string_view command, Arguments arguments) {
    OrganSource source{std::filesystem::absolute(arguments[0]).lexically_normal().string()};
    for (std::size_t i = 1; i < arguments.size(); i += 2) {
        const std::string& option = arguments[i];
        if (i + 1 == arguments.size() || (option != "--label" && option != "--units"))
            return fail(std::string(command) + " takes a mask, and --label and --units of it", {},
                        "put quotes around a name with blanks");
        const std::string& value = arguments[i + 1];
        if (option == "--units") {
            if (!io::length_unit(value)) return fail("\"" + value + "\" is no unit of length", {}, "mm, um, cm or m");
            source.units = value;
        } else {
            const auto labels = label_list(value);
            if (!labels) return fail("\"" + value + "\" is not a list of names and whole numbers other than 0");
            source.labels = *labels;
        }
    }
    if (!io::is_volume(source.file))
        return fail("this is no mask", source.file, "a mask is " + io::readable_volume_extensions());
    return source;
}

Result<void> ask_for_file(ActionContext& context, FilePurpose purpose, tl::unexpected<Error> without) {
    if (context.files == nullptr) return without;
    context.files->ask_for_file(purpose);
    return {};
}

std::optional<bool> switched(Arguments arguments, bool now) {
    if (arguments.empty()) return !now;
    if (arguments.size() > 1 || (arguments[0] != "on" && arguments[0] != "off")) return std::nullopt;
    return arguments[0] == "on";
}

std::vector<glm::vec3> visible_positions(const ActionContext& context, const render::Camera& camera, glm::ivec2 size) {
    const auto mesh = context.picture.picture_mesh();
    if (!mesh && context.document.tree()) return {};
    const Marks& marks = context.document.marks();
    std::vector<glm::vec3> positions;
    if (mesh)
        positions = mesh->farthest(render::fitting_directions(camera, size),
                                   [&](int branch) { return state_of(marks, branch) != tree::BranchState::kHidden; });
    const auto shown = visible_points(marks, context.assets);
    positions.insert(positions.end(), shown.begin(), shown.end());
    return positions;
}

Result<void> move_camera(ActionContext& context, const render::Camera& camera) {
    context.document.set_camera(camera);
    context.picture.camera_leapt();
    return {};
}

render::Camera fitted_to_organ(const ActionContext& context, const organ::Organ& organ, glm::ivec2 size) {
    constexpr int kEach = 4; // voxels along each axis: the picture has a margin wider than these
    const render::Camera& camera = context.document.session().camera;
    std::vector<glm::vec3> positions = visible_positions(context, camera, size);
    if (positions.empty() && context.document.tree()) // no surface yet
        for (const tree::Point& point : context.document.tree()->points) positions.emplace_back(point.position);
    organ.for_voxels([&](const glm::ivec3& voxel, std::size_t) {
        if (voxel % kEach == glm::ivec3(0)) positions.emplace_back(organ.centre_mm(voxel));
    });
    return positions.empty() ? camera : render::fitted(camera, positions, size);
}

bool whole_in_picture(const ActionContext& context, glm::ivec2 size) {
    const auto& tree = context.document.tree();
    if (!tree) return false;
    const render::Projector project(context.document.session().camera, size);
    return std::ranges::all_of(tree->points, [&](const tree::Point& point) {
        const auto at = project(point.position);
        return at && at->x >= 0.0 && at->y >= 0.0 && at->x <= size.x && at->y <= size.y;
    });
}

void change_keeping_whole(ActionContext& context, Marks next) {
    const glm::ivec2 before = context.picture.picture_size();
    const bool whole = whole_in_picture(context, before);
    context.document.change(std::move(next));
    if (whole && context.picture.picture_size() != before)
        if (const Command* fit = find_command("fit")) (void)fit->action(context, {});
}

std::function<bool(const ActionContext&, const Command&)> shows_part(std::string part) {
    return [part = std::move(part)](const ActionContext& context, const Command&) {
        return context.window != nullptr && context.window->shows(part);
    };
}

Result<void> toggle_part(ActionContext& context, const std::string& part) {
    if (context.window == nullptr) return no_window(part);
    context.window->toggle(part);
    return {};
}

tl::unexpected<Error> no_window(const std::string& part) { return fail("there is no " + part + " without a window"); }

Result<void> select_these(ActionContext& context, std::vector<int> ids) {
    return edit(context, [&](Marks& marks) { marks.selection = canonical(std::move(ids)); });
}

std::vector<int> unselected(const Document& document) {
    std::vector<int> rest(static_cast<std::size_t>(document.branch_count()));
    std::iota(rest.begin(), rest.end(), 0);
    std::erase_if(rest, [&](int id) { return is_selected(document.marks(), id); });
    return rest;
}

Result<void> expect_selection(const Document& document) {
    if (document.marks().selection.empty()) return fail("nothing is selected", {}, "select branches first");
    return {};
}

bool has_tree(const Document& document) { return document.branch_count() > 0; }
bool has_scene(const Document& document) { return document.has_scene(); }
bool has_selection(const Document& document) { return !document.marks().selection.empty(); }

bool has_lesions(const Document& document) { return !document.marks().lesions.empty(); }

} // namespace ramus::app::actions
