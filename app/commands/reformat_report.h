// The figures of `ramus reformat` as JSON and as text; its table is in app/reports/section_tables.h.
#pragma once

#include "app/commands/reformat_picture.h"
#include "app/reports/section_tables.h"
#include "core/slice/stenosis.h"
#include "core/slice/vessel_path.h"
#include "core/tree/vessel_tree.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

struct ReformatFigures {
    slice::VesselPath path;
    std::vector<slice::PathSample> samples;          // of the sections
    Outlines sections;                               // a lumen for each of `samples`
    std::optional<NarrowPlaces> by_surface, by_mask; // samples of `path`
    std::optional<PaintedSlices> picture;            // without the pixels
};

[[nodiscard]] nlohmann::ordered_json reformat_json(const ReformatFigures& figures, const tree::Claims& claims);
[[nodiscard]] std::string reformat_text(const ReformatFigures& figures, const Lengths& lengths);

} // namespace ramus::app
