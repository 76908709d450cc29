// Pictures from several sides: four views on one sheet, and once around. Surfaces that are compared are in every one of
// them, seen by one camera.
#pragma once

#include "app/commands/figures.h"

#include <filesystem>
#include <functional>
#include <vector>

namespace ramus::app {

// The document's picture in another size: its viewports are where that has room for them.
using ComposeSheet = std::function<Result<render::Sheet>(glm::ivec2 size)>;

// Anterior, left, posterior and superior, all at one scale, in a picture of this size: two and two; where surfaces are
// compared side by side a column each, with the surfaces below each other, or a row each in a picture that is higher
// than wide. What stands over all of a row or a column stands there once.
[[nodiscard]] Result<render::Image> draw_four_views(render::SheetRenderer& renderer, const ComposeSheet& compose,
                                                    glm::ivec2 size, const FigureFlags& flags);

// name.png becomes name_001.png, ...: once around the tree to the viewer's right, which stays whole in all of them
// unless `keep_camera`. Returns the files.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_turntable(render::SheetRenderer& renderer,
                                                                         const render::Sheet& sheet,
                                                                         const FigureFlags& flags, bool keep_camera,
                                                                         const std::filesystem::path& output);

} // namespace ramus::app
