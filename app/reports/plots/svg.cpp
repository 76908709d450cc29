#include "app/reports/plots/svg.h"

#include "app/reports/html.h"

#include <array>
#include <cstdio>

namespace ramus::app {

namespace {

// Hundredths are finer than any screen or printer.
std::string coordinate(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", value + 0.0);
    std::string number = text;
    number.erase(number.find_last_not_of('0') + 1);
    if (number.back() == '.') number.pop_back();
    return number == "-0" ? "0" : number;
}

std::string place(PlotPoint at) { return coordinate(at.x) + "," + coordinate(at.y); }

std::string attribute(std::string_view name, double value) {
    return std::string(" ").append(name).append("=\"").append(coordinate(value)).append("\"");
}

std::string stroke_text(const Stroke& stroke) {
    std::string text = " stroke=\"" + std::string(stroke.colour) + "\"" + attribute("stroke-width", stroke.width);
    if (!stroke.dash.empty()) text += " stroke-dasharray=\"" + std::string(stroke.dash) + "\"";
    return text;
}

bool begins_letter(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80; }

} // namespace

Svg::Svg(double width, double height, std::string_view title) : width_(width) {
    const std::string name = html_text(title);
    text_ = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + coordinate(width) + " " + coordinate(height) +
            "\" role=\"img\" aria-label=\"" + name +
            "\" font-family=\"Open Sans, Helvetica, Arial, sans-serif\">\n<title>" + name + "</title>\n";
}

void Svg::line(PlotPoint from, PlotPoint to, const Stroke& stroke) {
    text_ += "<line" + attribute("x1", from.x) + attribute("y1", from.y) + attribute("x2", to.x) +
             attribute("y2", to.y) + stroke_text(stroke) + "/>\n";
}

void Svg::polyline(const std::vector<PlotPoint>& points, const Stroke& stroke) {
    if (points.empty()) return;
    text_ += "<polyline fill=\"none\" stroke-linejoin=\"round\"" + stroke_text(stroke) + " points=\"";
    for (const PlotPoint& point : points) text_.append(&point == &points.front() ? "" : " ").append(place(point));
    text_ += "\"/>\n";
}

void Svg::rectangle(PlotPoint corner, PlotPoint size, std::string_view fill, const Stroke* outline) {
    text_ += "<rect" + attribute("x", corner.x) + attribute("y", corner.y) + attribute("width", size.x) +
             attribute("height", size.y) + " fill=\"" + std::string(fill) + "\"" +
             (outline != nullptr ? stroke_text(*outline) : "") + "/>\n";
}

void Svg::circle(PlotPoint middle, double radius, std::string_view fill, const Stroke& outline) {
    text_ += "<circle" + attribute("cx", middle.x) + attribute("cy", middle.y) + attribute("r", radius) + " fill=\"" +
             std::string(fill) + "\"" + stroke_text(outline) + "/>\n";
}

void Svg::triangles(const std::vector<std::array<PlotPoint, 3>>& corners, std::string_view fill) {
    if (corners.empty()) return;
    text_ += "<path shape-rendering=\"crispEdges\" fill=\"" + std::string(fill) + "\" d=\"";
    for (const auto& [a, b, c] : corners)
        text_.append("M").append(place(a)).append("L").append(place(b)).append("L").append(place(c)).append("Z");
    text_ += "\"/>\n";
}

void Svg::diamond(PlotPoint middle, double radius, std::string_view fill) {
    text_.append("<path d=\"M").append(place({middle.x - radius, middle.y}));
    for (const auto& [x, y] : std::array{std::pair{0.0, -radius}, std::pair{radius, 0.0}, std::pair{0.0, radius}})
        text_.append("L").append(place({middle.x + x, middle.y + y}));
    text_ += "Z\" fill=\"" + std::string(fill) + "\"/>\n";
}

void Svg::text(PlotPoint at, std::string_view words, Anchor anchor, double size, std::string_view colour,
               std::string_view whole) {
    text_ += "<text" + attribute("x", at.x) + attribute("y", at.y) + attribute("font-size", size) + " fill=\"" +
             std::string(colour) + "\"";
    if (anchor != Anchor::kStart)
        text_ += anchor == Anchor::kMiddle ? " text-anchor=\"middle\"" : " text-anchor=\"end\"";
    text_ += ">";
    if (!whole.empty()) text_ += "<title>" + html_text(whole) + "</title>";
    text_ += html_text(words) + "</text>\n";
}

void Svg::text_upward(PlotPoint at, std::string_view words) {
    text_ += "<text font-size=\"11\" fill=\"" + std::string(kQuietInk) +
             "\" text-anchor=\"middle\" transform=\"translate(" + coordinate(at.x) + " " + coordinate(at.y) +
             ") rotate(-90)\">" + html_text(words) + "</text>\n";
}

std::string Svg::drawing() const { return text_ + "</svg>\n"; }

std::string Svg::file() const { return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + drawing(); }

double width_of(std::string_view words, double size) {
    std::size_t letters = 0;
    for (const char c : words) letters += begins_letter(c) ? 1 : 0;
    return 0.56 * size * static_cast<double>(letters); // average width of characters of a common font, by eye
}

std::string shortened(std::string_view words, double most, double size) {
    if (width_of(words, size) <= most) return std::string(words);
    std::vector<std::string> letters;
    for (const char c : words)
        if (begins_letter(c) || letters.empty())
            letters.emplace_back(1, c);
        else
            letters.back() += c;
    const auto kept = static_cast<std::size_t>(most / width_of("x", size));
    const std::size_t behind = kept / 2, before = kept - kept / 2 - (kept > 0 ? 1 : 0);
    std::string text;
    for (std::size_t i = 0; i < before && i < letters.size(); ++i) text += letters[i];
    text += "\xE2\x80\xA6";
    for (std::size_t i = letters.size() - std::min(behind, letters.size()); i < letters.size(); ++i) text += letters[i];
    return text;
}

} // namespace ramus::app
