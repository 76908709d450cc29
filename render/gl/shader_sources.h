// The text of the files in shaders/, by their path in there, embedded at build time.
#pragma once

#include <map>
#include <string_view>

namespace ramus::render {

extern const std::map<std::string_view, std::string_view> kShaderSources;

} // namespace ramus::render
