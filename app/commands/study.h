// `ramus study FILE -o FOLDER`: the pictures of the paper's user study (section V), for any tree: the whole tree, and
// three places close by as isosurface of the mask, as truncated cones and as convolution surface, each from the same
// eye in the same light.
#pragma once

#include "app/commands/command.h"

namespace ramus::app {

void register_study(CLI::App& app, Action& chosen);

} // namespace ramus::app
