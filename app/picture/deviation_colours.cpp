#include "app/picture/deviation_colours.h"

#include "app/picture/colouring.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>

namespace ramus::app {

namespace {

// Rounded up to two digits.
double rounded_up(double value) {
    const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    constexpr double kRounding = 1e-3;
    return std::ceil(value / step - kRounding) * step;
}

std::string title_in(DeviationChoice::Unit unit) {
    return unit == DeviationChoice::Unit::kMm ? "Deviation (mm)" : "Deviation (voxel diagonals)";
}

// Labels the end of the scale, and marks it as clipped if there are larger values.
void mark_end(render::Legend& legend, double end, bool clipped) {
    constexpr double kApart = 0.11; // of the bar: closer texts would overlap
    std::erase_if(legend.ticks, [](const render::Legend::Tick& tick) { return tick.at > 1.0 - kApart; });
    legend.ticks.push_back({1.0, (clipped ? "> " : "") + rounded(end)});
}

} // namespace

double mm_per_unit(const DeviationChoice& choice, const SurfaceDeviation& deviation) {
    return choice.unit == DeviationChoice::Unit::kVoxels && deviation.voxel_mm ? *deviation.voxel_mm : 1.0;
}

double scale_end(const DeviationChoice& choice, const SurfaceDeviation& deviation) {
    if (choice.most > 0.0) return choice.most;
    constexpr double kLeastEnd = 1e-3; // mm: for equal surfaces
    const double mm = deviation.percentile_99_mm > 0.0 ? deviation.percentile_99_mm : deviation.most_mm;
    return rounded_up(std::max(mm, kLeastEnd) / mm_per_unit(choice, deviation));
}

void show_deviation(render::Frame& frame, const Marks& marks, const SurfaceDeviation* deviation) {
    const DeviationChoice& choice = marks.deviation;
    render::Legend& legend = frame.overlays.legend;
    if (deviation == nullptr) {
        legend = {};
        legend.title = title_in(choice.unit);
        legend.swatches.push_back({kNotMeasuredColour, "not measured"});
    } else {
        const double end = scale_end(choice, *deviation), mm = mm_per_unit(choice, *deviation);
        legend = bar_legend(title_in(mm == 1.0 ? DeviationChoice::Unit::kMm : choice.unit), marks.colour_map, 0.0, end,
                            false);
        constexpr double kRounding = 1e-3;
        mark_end(legend, end, deviation->most_mm > (1.0 + kRounding) * end * mm);
        frame.scale = {render::ColourScale::Value::kSurface,
                       0.0F,
                       static_cast<float>(end * mm),
                       false,
                       0,
                       ramp_of(marks.colour_map)};
    }
    legend.subtitle = latin1("from " + noun_of(choice, marks.comparison));
}

void put_surface(render::Frame& frame, const SurfaceDeviation& deviation, const SurfaceDeviation::Paged& mesh,
                 const SurfaceDeviation::Paged& preview) {
    frame.mesh = mesh;
    frame.preview = preview;
    if (frame.scale.value != render::ColourScale::Value::kSurface || mesh != deviation.mesh) return;
    frame.mesh = deviation.valued_mesh;
    frame.preview = preview == deviation.preview ? deviation.valued_preview : nullptr;
}

} // namespace ramus::app
