// The figures of `ramus reformat`: a table of cross-sections, JSON, and the narrowest sections against a reference.
#pragma once

#include "app/commands/reformat_picture.h"
#include "app/reports/report_tables.h"
#include "core/slice/stenosis.h"
#include "core/slice/vessel_path.h"
#include "core/tree/vessel_tree.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ramus::app {

// A reference and what is narrower than it.
struct NarrowPlaces {
    slice::ShapeFigures reference;
    slice::Stenosis found;
};

struct ReformatFigures {
    slice::VesselPath path;
    std::vector<slice::PathSample> samples;          // of the sections
    Outlines sections;                               // a lumen for each of `samples`
    std::optional<NarrowPlaces> by_surface, by_mask; // samples of `path`
    std::optional<PaintedSlices> picture;            // without the pixels
};

// A row for each section.
[[nodiscard]] Table sections_table(const ReformatFigures& figures, const Lengths& lengths);
[[nodiscard]] nlohmann::ordered_json reformat_json(const ReformatFigures& figures, const tree::Claims& claims);
[[nodiscard]] std::string reformat_text(const ReformatFigures& figures, const Lengths& lengths);

} // namespace ramus::app
