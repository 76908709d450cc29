// `ramus render --benchmark`: measures how fast a turning tree is drawn.
#pragma once

#include "core/base/error.h"
#include "render/renderer/sheet.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

// Turns the camera once around the tree in `frames` frames, and draws all viewports of the sheet in each. `hurry`:
// draws in interactive quality, as the window does during a drag when full pictures are slow. Adds these members to
// `report`:
//     frames, seconds, fps
//     processor_seconds   of all cores together
//     triangles, cones    mean per frame, of all viewports together
//     panes               number of viewports
//     quality             "full" or "interactive"
//     difference          from the picture at rest: mean over the pixels of vessels, of 255; 0 in full quality
//     apart               the share of these pixels that differ by more than 60 of 255, since an edge has moved
[[nodiscard]] Result<void> run_turn_benchmark(render::SheetRenderer& renderer, render::Sheet sheet, int frames,
                                              bool hurry, nlohmann::json& report);

// The results of run_turn_benchmark() in one sentence.
[[nodiscard]] std::string benchmark_sentence(const nlohmann::json& report);

} // namespace ramus::app
