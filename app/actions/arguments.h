// Helpers of commands: parsing arguments, conditions for `enabled`, and edits of marks. Errors say what is wrong with
// an argument.
#pragma once

#include "app/actions/command_table.h"
#include "app/session/session_limits.h"
#include "core/organ/organ.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app::actions {

[[nodiscard]] Result<int> branch_id(const Document& document, const std::string& word);
[[nodiscard]] Result<std::vector<int>> branch_ids(const Document& document, Arguments arguments); // at least one
// Parses a number from `least` to `most`; the whole word must be the number.
[[nodiscard]] std::optional<double> number_in(std::string_view word, double least, double most);
// Parses "1.5,2,-3": exactly `count` numbers with absolute values of at most `most`.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(const std::string& word, std::size_t count, double most);
// Parses a number from 1 to `count` and returns it as an index from 0; `what`: "cut", for errors.
[[nodiscard]] Result<std::size_t> list_index(Arguments arguments, std::size_t count, const std::string& what);
// The file argument of a command, or the suggestion of app/storage/user_folders.h.
[[nodiscard]] Result<std::filesystem::path> file_argument(ActionContext& context, Arguments arguments,
                                                          std::string_view command, std::string_view extension);

// Parses FILE [--label LABEL,...] [--units UNIT] of a command that reads masks.
[[nodiscard]] Result<OrganSource> mask_argument(std::string_view command, Arguments arguments);

// Shows the window's file dialog; fails with `without` if there is no window.
[[nodiscard]] Result<void> ask_for_file(ActionContext& context, FilePurpose purpose, tl::unexpected<Error> without);
// Parses "on" or "off"; without an argument, the opposite of `now`. None: invalid.
[[nodiscard]] std::optional<bool> switched(Arguments arguments, bool now);
// Positions of everything in the picture, mm: the surface without branches hidden since it was made, lesions, visible
// context. Of the surface only the points that determine the fit of a camera with the direction of `camera` to a
// picture of `size`. Empty without a surface.
[[nodiscard]] std::vector<glm::vec3> visible_positions(const ActionContext& context, const render::Camera& camera,
                                                       glm::ivec2 size);
// The camera with the same direction that shows all of that and the organ.
[[nodiscard]] render::Camera fitted_to_organ(const ActionContext& context, const organ::Organ& organ, glm::ivec2 size);
// Whether the camera shows all of the tree.
[[nodiscard]] bool whole_in_picture(const ActionContext& context, glm::ivec2 size);
// Moves the camera at once. Always succeeds.
Result<void> move_camera(ActionContext& context, const render::Camera& camera);

// Shows or hides a part of the window.
[[nodiscard]] Result<void> toggle_part(ActionContext& context, const std::string& part);
// Tests whether the part is shown, for Command::in_use_when().
[[nodiscard]] std::function<bool(const ActionContext&, const Command&)> shows_part(std::string part);
[[nodiscard]] tl::unexpected<Error> no_window(const std::string& part); // "there is no help without a window"

// Changes the marks by change(marks), as one step of the document. Fails only if a list exceeds its limit
// (app/session/session_limits.h).
template <class Change> Result<void> edit(ActionContext& context, const Change& change) {
    Marks next = context.document.marks();
    change(next);
    if (auto few = check_counts(next); !few) return few;
    context.document.change(std::move(next));
    return {};
}
// Changes the marks. If that makes viewports narrower than the picture was, the whole tree stays visible if it was.
void change_keeping_whole(ActionContext& context, Marks next);
// Removes the list element that the argument names; `what` as for list_index().
template <class Owner, class List>
Result<void> remove_from(ActionContext& context, Arguments arguments, List Owner::*list, const std::string& what) {
    RAMUS_TRY(index, list_index(arguments, (context.document.marks().*list).size(), what));
    return edit(context,
                [&](Marks& marks) { (marks.*list).erase((marks.*list).begin() + static_cast<std::ptrdiff_t>(index)); });
}

inline constexpr double kFarthestMm = 1e6; // largest position, distance and diameter in arguments

// Selects these branches, in any order. Always succeeds.
Result<void> select_these(ActionContext& context, std::vector<int> ids);
// All branches that are not selected.
[[nodiscard]] std::vector<int> unselected(const Document& document);
// Fails if nothing is selected.
[[nodiscard]] Result<void> expect_selection(const Document& document);

// For Command::enabled.
[[nodiscard]] bool has_tree(const Document& document);
[[nodiscard]] bool has_scene(const Document& document); // a tree, or objects without one
[[nodiscard]] bool has_selection(const Document& document);
[[nodiscard]] bool has_lesions(const Document& document);

} // namespace ramus::app::actions
