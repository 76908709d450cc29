// ramus info FILE: what a vessel tree consists of.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_info(CLI::App& app, Action& chosen);

} // namespace ramus::app
