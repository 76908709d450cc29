#include "app/session/edits_json.h"

#include "app/session/json_values.h"

#include <algorithm>

namespace ramus::app::session_json {

namespace {

// Number of fractions of a kind of edit.
std::size_t places(tree::Edit::Kind kind) {
    using Kind = tree::Edit::Kind;
    return kind == Kind::kJoin ? 2 : kind == Kind::kCut || kind == Kind::kMoveRoot ? 1 : 0;
}

tree::Edit edit_in(const json& value) {
    expect_only(value, "an edit", {"edit", "branches", "at", "value"});
    if (!value.contains("edit")) throw Refusal{"an edit does not say what it is"};
    const std::string name = text(value["edit"], "edit");
    const auto* const found = std::ranges::find(tree::kEditNames, std::string_view(name),
                                                &std::pair<tree::Edit::Kind, std::string_view>::second);
    if (found == std::end(tree::kEditNames)) throw Refusal{"unknown edit \"" + name + "\""};
    tree::Edit edit;
    edit.kind = found->first;
    for (const json& id : list_in(value, "branches"))
        edit.branches.push_back(integer(id, "branch id of an edit", 0, kMostBranches));
    const json at = list_in(value, "at");
    if (at.size() != places(edit.kind)) throw Refusal{"the edit \"" + name + "\" has not as many places as it needs"};
    for (std::size_t i = 0; i < at.size(); ++i) edit.fractions[i] = number(at[i], "place of an edit", 0.0, 1.0);
    if (value.contains("value")) edit.value = number(value["value"], "value of an edit", 0.0, 1e9);
    return edit;
}

} // namespace

json edits_json(const std::vector<tree::Edit>& edits) {
    json list = json::array();
    for (const tree::Edit& edit : edits) {
        json value{{"edit", std::string(name_of(edit.kind))}, {"branches", edit.branches}};
        if (const std::size_t count = places(edit.kind); count > 0)
            value["at"] = std::vector<double>(edit.fractions.begin(),
                                              edit.fractions.begin() + static_cast<std::ptrdiff_t>(count));
        if (edit.value != 0.0) value["value"] = edit.value;
        list.push_back(std::move(value));
    }
    return list;
}

std::vector<tree::Edit> edits_in(const json& list) {
    if (!list.is_array()) throw Refusal{"edits is not a list"};
    std::vector<tree::Edit> edits;
    for (const json& value : list) edits.push_back(edit_in(value));
    return edits;
}

} // namespace ramus::app::session_json
