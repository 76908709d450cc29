#include "app/reports/plots/radius_plot.h"

#include "app/reports/plots/axis.h"

#include <algorithm>
#include <array>

namespace ramus::app {

namespace {

constexpr std::size_t kMostPoints = 600; // per curve: finer than visible

// Draws the parts of a curve below the top of the plot.
void draw_curve(Svg& svg, const PlotArea& area, const std::vector<double>& along, const std::vector<double>& radii,
                const Stroke& stroke) {
    std::vector<PlotPoint> part;
    const auto end_part = [&] {
        svg.polyline(part, stroke);
        part.clear();
    };
    const std::size_t stride = std::max<std::size_t>(1, radii.size() / kMostPoints);
    const double top = area.y.high;
    for (std::size_t i = 0, before = 0; i < radii.size(); before = i, i += stride) {
        const bool is_in = radii[i] <= top;
        if (i > 0 && is_in != (radii[before] <= top)) {
            const double share = (top - radii[before]) / (radii[i] - radii[before]);
            part.push_back({area.at_x(along[before] + share * (along[i] - along[before])), area.top});
            if (!is_in) end_part();
        }
        if (is_in) part.push_back({area.at_x(along[i]), area.at_y(radii[i])});
    }
    end_part();
}

void shade_joints(Svg& svg, const PlotArea& area, const RadiusCurves& curves) {
    const std::size_t count = curves.along_mm.size();
    for (std::size_t i = 0; i < count;) {
        std::size_t end = i;
        while (end < count && !curves.alone[end]) ++end;
        if (end > i) {
            const double left = i == 0 ? area.left : area.at_x(curves.along_mm[i]);
            const double right = end == count ? area.right : area.at_x(curves.along_mm[end]);
            svg.rectangle({left, area.top}, {right - left, area.bottom - area.top}, "#eff0f2");
        }
        i = end + 1;
    }
}

} // namespace

Svg radius_plot(const std::string& title, const RadiusCurves& curves, const std::string& unit) {
    constexpr double kWidth = 440.0, kHeight = 240.0;
    const std::array<std::pair<const std::vector<double>*, LegendLine>, 4> lines{
        {{&curves.input_mm, {"read", kInputStroke}},
         {&curves.surface_mm, {"surface", kSurfaceStroke}},
         {&curves.cones_mm, {"truncated cones", kConesStroke}},
         {&curves.mask_mm, {"mask", kMaskStroke}}}};
    double most = *std::ranges::max_element(curves.input_mm);
    for (const auto& [radii, line] : lines)
        for (std::size_t i = 0; i < radii->size(); ++i)
            if (curves.alone[i]) most = std::max(most, (*radii)[i]);
    Svg svg(kWidth, kHeight, title);
    svg.text({14.0, 16.0}, shortened(title, kWidth - 28.0, 12.0), Anchor::kStart, 12.0, kInk);
    const PlotArea area{60.0,
                        28.0,
                        kWidth - 14.0,
                        kHeight - 54.0,
                        linear_axis(0.0, curves.along_mm.back()),
                        linear_axis(0.0, 1.15 * most)};
    shade_joints(svg, area, curves);
    draw_y_axis(svg, area, "Radius, " + unit);
    draw_x_axis(svg, area, "Along the branch, " + unit);
    std::vector<LegendLine> legend;
    // The surface first: the thin line of the tree's radii is on top.
    for (const std::size_t n : {1, 2, 3, 0})
        draw_curve(svg, area, curves.along_mm, *lines[n].first, lines[n].second.stroke);
    for (const auto& [radii, line] : lines)
        if (!radii->empty()) legend.push_back(line);
    draw_legend(svg, {14.0, kHeight - 8.0}, kWidth - 14.0, legend);
    return svg;
}

} // namespace ramus::app
