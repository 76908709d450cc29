// The files of assets/rating_sheet by name, embedded at build time.
#pragma once

#include <map>
#include <string_view>

namespace ramus::app {

extern const std::map<std::string_view, std::string_view> kSheetTexts;

} // namespace ramus::app
