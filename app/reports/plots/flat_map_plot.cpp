#include "app/reports/plots/flat_map_plot.h"

#include "app/session/colour_by.h"
#include "app/session/numbers.h"
#include "render/overlay/scale_bar.h"
#include "render/scene/camera.h"

#include <algorithm>
#include <glm/common.hpp>

namespace ramus::app {

namespace {

constexpr double kMapWidth = 460.0, kMapEdge = 26.0; // of the drawing, and around the map for the patient's sides
constexpr double kMapHeight = 220.0;                 // of the map
constexpr double kMapLine = 16.0;                    // between lines of text
constexpr Stroke kThinStroke{kInk, 0.8, ""};

std::string colour_text(const glm::vec3& colour) { return app::colour_text(bytes_of(colour)); }

// From the map to the drawing.
struct Drawing {
    const FlatMap& map;
    double scale = 1.0; // units per mm

    explicit Drawing(const FlatMap& drawn) : map(drawn) {
        const glm::dvec2 size = glm::max(glm::dvec2(map.box.size()), glm::dvec2(1e-6));
        scale = std::min((kMapWidth - 2.0 * kMapEdge) / size.x, kMapHeight / size.y);
    }
    [[nodiscard]] PlotPoint at(const glm::vec2& place) const {
        const glm::dvec2 from_corner(place.x - map.box.least.x, map.box.most.y - place.y);
        return {kMapEdge + scale * from_corner.x, kMapEdge + scale * from_corner.y};
    }
    [[nodiscard]] PlotPoint corner() const { return at({map.box.most.x, map.box.least.y}); } // lower right
};

void draw_sides(Svg& svg, const Drawing& drawing, const tree::Claims& claims) {
    const render::AxisNames& names = claims.has_sides() ? render::side_letters() : render::plain_axes();
    const PlotPoint corner = drawing.corner();
    const double across = 0.5 * (kMapEdge + corner.x), down = 0.5 * (kMapEdge + corner.y);
    const auto& [left, right, below, above] = drawing.map.sides;
    svg.text({kMapEdge - 6.0, down}, names[left], Anchor::kEnd, 12.0, kQuietInk);
    svg.text({corner.x + 6.0, down}, names[right], Anchor::kStart, 12.0, kQuietInk);
    svg.text({across, corner.y + 15.0}, names[below], Anchor::kMiddle, 12.0, kQuietInk);
    svg.text({across, kMapEdge - 7.0}, names[above], Anchor::kMiddle, 12.0, kQuietInk);
}

void draw_scale(Svg& svg, const Drawing& drawing, double y, const Lengths& lengths) {
    const double length = render::scale_bar_length_mm(0.35 * double(drawing.map.box.size().x));
    svg.rectangle({kMapEdge, y - 4.0}, {length * drawing.scale, 3.0}, kInk);
    svg.text({kMapEdge + length * drawing.scale + 6.0, y}, rounded(length) + " " + lengths.unit());
}

} // namespace

Svg flat_map_plot(const std::string& title, const FlatMap& map, const tree::Claims& claims) {
    const Drawing drawing(map);
    const Lengths lengths(claims);
    const bool bands = !map.bands.empty() && !map.bands.front().distance.empty();
    const double below = drawing.corner().y + kMapEdge;
    const std::size_t lines = map.nearest.size() + (bands ? 1 : 0) + 1;
    Svg svg(kMapWidth, below + kMapLine * static_cast<double>(lines), title);
    for (const FlatMap::Band& band : map.bands) {
        std::vector<std::array<PlotPoint, 3>> corners;
        for (const auto& [a, b, c] : band.triangles) corners.push_back({drawing.at(a), drawing.at(b), drawing.at(c)});
        svg.triangles(corners, colour_text(band.colour));
    }
    for (const FlatMap::Vessel& vessel : map.vessels)
        svg.circle(drawing.at(vessel.at), std::max(1.2, drawing.scale * double(vessel.radius_mm)),
                   colour_text(vessel.colour), kThinStroke);
    for (const FlatMap::Nearest& nearest : map.nearest) {
        svg.diamond(drawing.at(nearest.at), 5.5, "#ffffff");
        svg.diamond(drawing.at(nearest.at), 4.0, kInk);
    }
    draw_sides(svg, drawing, claims);
    double y = below + 10.0;
    draw_scale(svg, drawing, y, lengths);
    for (const FlatMap::Nearest& nearest : map.nearest) {
        y += kMapLine;
        svg.diamond({kMapEdge + 5.0, y - 4.0}, 4.0, kInk);
        svg.text({kMapEdge + 15.0, y}, "margin of " + nearest.lesion + ": " + lengths.text(nearest.margin_mm));
    }
    if (!bands) return svg;
    y += kMapLine;
    const std::string words = "to lesion, " + lengths.unit() + ":";
    svg.text({kMapEdge, y}, words);
    double x = kMapEdge + width_of(words) + 8.0;
    for (const FlatMap::Band& band : map.bands) {
        svg.rectangle({x, y - 9.0}, {10.0, 10.0}, colour_text(band.colour), &kThinStroke);
        svg.text({x + 14.0, y}, band.distance);
        x += 14.0 + width_of(band.distance) + 10.0;
    }
    return svg;
}

} // namespace ramus::app
