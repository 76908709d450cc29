// The files of assets/rating_page by name, embedded at build time.
#pragma once

#include <map>
#include <string_view>

namespace ramus::app {

extern const std::map<std::string_view, std::string_view> kPageTexts;

} // namespace ramus::app
