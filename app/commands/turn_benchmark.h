// How fast the tree turns: `ramus render --benchmark`.
#pragma once

#include "core/base/error.h"
#include "render/renderer/sheet.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace ramus::app {

// Once around in so many frames, of all viewports where surfaces are compared. In a hurry it is drawn as the window
// draws while somebody drags, where full pictures would be slow. Adds to `report`: frames, seconds, processor_seconds
// (of all cores together), fps, triangles and cones (a frame, mean, of all viewports together), panes, quality ("full"
// or "interactive"), difference (from the picture at rest: mean over the vessels' pixels, of 255), apart (the share of
// those that differ by more than 60 of 255: edges that moved).
[[nodiscard]] Result<void> run_turn_benchmark(render::SheetRenderer& renderer, render::Sheet sheet, int frames,
                                              bool hurry, nlohmann::json& report);

// What it found, for a person.
[[nodiscard]] std::string benchmark_sentence(const nlohmann::json& report);

} // namespace ramus::app
