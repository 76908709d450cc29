// How every command reads its tree: what was repaired is told on standard error, and with --verbose what was found.
#pragma once

#include "app/commands/surface_flags.h"
#include "core/base/error.h"
#include "core/tree/vessel_tree.h"

#include <string>

namespace ramus::app {

[[nodiscard]] Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags);

// A line on standard error, with --verbose only.
void say(const SurfaceFlags& flags, const std::string& line);

// 1234567 as 1,234,567 and 0.123456 as 0.1235, for people.
[[nodiscard]] std::string grouped(std::uint64_t number);
[[nodiscard]] std::string rounded(double number);

// "1 branch", "1,504 branches".
[[nodiscard]] std::string counted(std::uint64_t number, const std::string& one, const std::string& many);

} // namespace ramus::app
