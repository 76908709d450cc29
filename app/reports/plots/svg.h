// Svg: a drawing as text, for pages and for separate files. It uses no style sheet, script or font; text is escaped.
// Lengths are in units of the drawing, which a page scales to its width.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::app {

// Colours that colour-blind people can distinguish (M. Okabe and K. Ito, 2008), each with its own dash pattern for
// printing without colours.
struct Stroke {
    std::string_view colour = "#000000";
    double width = 1.0;
    std::string_view dash{}; // "6 3"; empty: a full line
};
inline constexpr Stroke kInputStroke{"#000000", 1.1, ""};
inline constexpr Stroke kSurfaceStroke{"#0072b2", 2.4, ""};
inline constexpr Stroke kConesStroke{"#d55e00", 1.6, "7 3"};
inline constexpr Stroke kMaskStroke{"#009e73", 1.6, "2 2"};
inline constexpr Stroke kAxisStroke{"#5b6570", 1.0, ""};
inline constexpr Stroke kGridStroke{"#e3e6ea", 1.0, ""};
inline constexpr std::string_view kInk = "#1d2126", kQuietInk = "#5b6570";

struct PlotPoint {
    double x = 0.0, y = 0.0; // y downward
};

enum class Anchor { kStart, kMiddle, kEnd };

class Svg {
public:
    // `title`: for screen readers.
    Svg(double width, double height, std::string_view title);

    void line(PlotPoint from, PlotPoint to, const Stroke& stroke);
    void polyline(const std::vector<PlotPoint>& points, const Stroke& stroke);
    void rectangle(PlotPoint corner, PlotPoint size, std::string_view fill, const Stroke* outline = nullptr);
    void circle(PlotPoint middle, double radius, std::string_view fill, const Stroke& outline);
    // All of one colour, without seams where they touch.
    void triangles(const std::vector<std::array<PlotPoint, 3>>& corners, std::string_view fill);
    void diamond(PlotPoint middle, double radius, std::string_view fill);
    // `at`: on the baseline. `whole`: the full text for a tooltip, if `words` is shortened.
    void text(PlotPoint at, std::string_view words, Anchor anchor = Anchor::kStart, double size = 11.0,
              std::string_view colour = kInk, std::string_view whole = {});
    void text_upward(PlotPoint at, std::string_view words); // turned by 90 degrees and centred, for vertical axes

    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] std::string drawing() const; // for embedding in a page
    [[nodiscard]] std::string file() const;    // as a separate file

private:
    double width_;
    std::string text_;
};

// Approximate width of text.
[[nodiscard]] double width_of(std::string_view words, double size = 11.0);
// Shortened with an ellipsis in the middle if wider than `most`.
[[nodiscard]] std::string shortened(std::string_view words, double most, double size = 11.0);

} // namespace ramus::app
