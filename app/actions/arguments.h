// What commands share: reading their words, and when they make sense. A reading that fails says what was wrong.
#pragma once

#include "app/actions/command_table.h"
#include "app/session/session_limits.h"

#include <optional>
#include <string>
#include <vector>

namespace ramus::app::actions {

[[nodiscard]] Result<int> branch_id(const Document& document, const std::string& word);
[[nodiscard]] Result<std::vector<int>> branch_ids(const Document& document, Arguments arguments); // one at least
// A number from `least` to `most` and nothing else.
[[nodiscard]] std::optional<double> number_in(std::string_view word, double least, double most);
// "1.5,2,-3": as many numbers as asked for, each at most `most` from 0.
[[nodiscard]] std::optional<std::vector<double>> numbers_in(const std::string& word, std::size_t count, double most);
// An index into a list that people count from 1; `what`: "cut", of which there are `count`.
[[nodiscard]] Result<std::size_t> list_index(Arguments arguments, std::size_t count, const std::string& what);
// The one file of a command, or what app/storage/user_folders.h suggests.
[[nodiscard]] Result<std::filesystem::path> file_argument(ActionContext& context, Arguments arguments,
                                                          std::string_view command, std::string_view extension);

// Shows the window's dialog for a file; fails with `without` where there is no window.
[[nodiscard]] Result<void> ask_for_file(ActionContext& context, FilePurpose purpose, tl::unexpected<Error> without);
// "on" or "off"; without a word, the other than now. None: it is something else.
[[nodiscard]] std::optional<bool> switched(Arguments arguments, bool now);
// Points of all that is in the picture: the surface but for branches that were hidden since it was made, lesions,
// context that is shown. Of the surface those that a camera which looks as `camera` does is fitted to, for a picture of
// this size. Empty: there is no surface.
[[nodiscard]] std::vector<glm::vec3> visible_positions(const ActionContext& context, const render::Camera& camera,
                                                       glm::ivec2 size);
// The camera leaps there. Succeeds.
Result<void> move_camera(ActionContext& context, const render::Camera& camera);

// Shows a part of the window that is hidden, and hides one that is shown.
[[nodiscard]] Result<void> toggle_part(ActionContext& context, const std::string& part);
// Whether it is shown, for Command::in_use_when().
[[nodiscard]] std::function<bool(const ActionContext&, const Command&)> shows_part(std::string part);
[[nodiscard]] tl::unexpected<Error> no_window(const std::string& part); // "there is no help without a window"

// A step of the document: its marks, changed by change(marks). Fails only where they become too many (most_marks.h).
template <class Change> Result<void> edit(ActionContext& context, const Change& change) {
    Marks next = context.document.marks();
    change(next);
    if (auto few = check_counts(next); !few) return few;
    context.document.change(std::move(next));
    return {};
}
// Takes the one that is named out of a list of the marks; `what` as for list_index().
template <class Owner, class List>
Result<void> remove_from(ActionContext& context, Arguments arguments, List Owner::*list, const std::string& what) {
    RAMUS_TRY(index, list_index(arguments, (context.document.marks().*list).size(), what));
    return edit(context,
                [&](Marks& marks) { (marks.*list).erase((marks.*list).begin() + static_cast<std::ptrdiff_t>(index)); });
}

inline constexpr double kFarthestMm = 1e6; // of positions, distances and diameters that people give

// Makes these branches, in any order, the selection. Succeeds.
Result<void> select_these(ActionContext& context, std::vector<int> ids);
// All that is not selected.
[[nodiscard]] std::vector<int> unselected(const Document& document);
// Fails when nothing is selected.
[[nodiscard]] Result<void> expect_selection(const Document& document);

// For Command::enabled.
[[nodiscard]] bool has_tree(const Document& document);
[[nodiscard]] bool has_scene(const Document& document); // a tree, or something without one
[[nodiscard]] bool has_selection(const Document& document);
[[nodiscard]] bool has_lesions(const Document& document);

} // namespace ramus::app::actions
