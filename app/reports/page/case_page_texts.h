// The files of the page for browsers, embedded at build time: page.html and page.css of assets/page, and page.js, its
// modules as one script.
#pragma once

#include <map>
#include <string_view>

namespace ramus::app {

extern const std::map<std::string_view, std::string_view> kCasePageTexts;

} // namespace ramus::app
