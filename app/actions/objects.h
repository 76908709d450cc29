// Commands for objects of the scene of any kind: show, hide, name, colour, opacity, centre, remove. The first two
// arguments are the kind and the number in its list, from 1: "lesion 2".
#pragma once

#include "app/actions/action.h"

#include <string_view>

namespace ramus::app::actions {

Result<void> show_object(ActionContext& context, Arguments arguments);
Result<void> hide_object(ActionContext& context, Arguments arguments);
Result<void> colour_object(ActionContext& context, Arguments arguments);
Result<void> fade_object(ActionContext& context, Arguments arguments);
Result<void> remove_object(ActionContext& context, Arguments arguments);

// The same command with a fixed kind: "context-hide 2" is "object-hide context 2".
[[nodiscard]] CommandAction for_kind(std::string_view kind, Result<void> (*action)(ActionContext&, Arguments));

} // namespace ramus::app::actions
