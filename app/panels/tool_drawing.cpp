// Draws the current tool's ToolDrawing, over the picture and under the panels.
#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/tools/pixel_polygon.h"

#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

ImU32 shadow(const glm::vec4& colour) { return IM_COL32(0, 0, 0, static_cast<int>(110.0F * colour.w)); }

class Painter {
public:
    Painter(ImDrawList& list, glm::ivec2 at, glm::ivec2 size, const Lengths& lengths)
        : list_(list), at_(at), size_(size), lengths_(lengths) {}

    // Fills row by row by the even-odd rule, since ImGui fills only convex polygons.
    void area(const ToolDrawing::Area& area) const {
        const PixelPolygon polygon(area.outline);
        const int first = std::max(0, static_cast<int>(std::floor(polygon.top())));
        const int last = std::min(size_.y, static_cast<int>(std::ceil(polygon.bottom())));
        for (int row = first; row < last; ++row) {
            const float y = static_cast<float>(at_.y + row);
            for (const auto& [left, right] : polygon.spans(row + 0.5))
                list_.AddRectFilled({to_window({left, 0.0}).x, y}, {to_window({right, 0.0}).x, y + 1.0F},
                                    widgets::packed(area.colour));
        }
    }

    // With a dark rim, for visibility on bright vessels.
    void line(const ToolDrawing::Line& line) const {
        std::vector<ImVec2> points;
        for (const glm::dvec2& point : line.points) points.push_back(to_window(point));
        const ImDrawFlags flags = line.closed ? ImDrawFlags_Closed : ImDrawFlags_None;
        const float width = line.width * theme::scale();
        const int count = static_cast<int>(points.size());
        list_.AddPolyline(points.data(), count, shadow(line.colour), flags, width + 2.0F * theme::scale());
        list_.AddPolyline(points.data(), count, widgets::packed(line.colour), flags, width);
    }

    void circle(const ToolDrawing::Circle& circle) const {
        const ImVec2 at = to_window(circle.at);
        const auto radius = static_cast<float>(circle.radius);
        const float width = circle.width * theme::scale();
        list_.AddCircle(at, radius, shadow(circle.colour), 0, width + 2.0F * theme::scale());
        if (circle.filled) list_.AddCircleFilled(at, radius, widgets::packed(circle.colour));
        list_.AddCircle(at, radius, widgets::packed(circle.colour), 0, width);
    }

    void text(const ToolDrawing::Text& text) const {
        const std::string words = lengths_.worded(text.text);
        ImGui::PushFont(theme::small_font());
        const ImVec2 at = to_window(text.at);
        const ImVec2 from(std::round(at.x), std::round(at.y));
        const ImVec2 size = ImGui::CalcTextSize(words.c_str());
        const ImVec2 padding(6.0F * theme::scale(), 3.0F * theme::scale());
        list_.AddRectFilled(from, {from.x + size.x + 2.0F * padding.x, from.y + size.y + 2.0F * padding.y},
                            IM_COL32(14, 16, 19, 205), 3.0F * theme::scale());
        list_.AddText({from.x + padding.x, from.y + padding.y}, widgets::packed(text.colour), words.c_str());
        ImGui::PopFont();
    }

private:
    [[nodiscard]] ImVec2 to_window(glm::dvec2 pixel) const {
        return {static_cast<float>(at_.x + pixel.x), static_cast<float>(at_.y + pixel.y)};
    }
    ImDrawList& list_;
    glm::ivec2 at_, size_; // of the picture
    Lengths lengths_;
};

void draw_in_part(InterfaceContext& context, const ToolDrawing& drawing, const ToolDrawing::Part& part) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const glm::ivec2 at = context.layout.view_at + part.at, to = at + part.size;
    list.PushClipRect({static_cast<float>(at.x), static_cast<float>(at.y)},
                      {static_cast<float>(to.x), static_cast<float>(to.y)});
    const Painter painter(list, at, part.size, context.workspace.document().lengths());
    for (const auto& area : drawing.areas) painter.area(area);
    for (const auto& line : drawing.lines) painter.line(line);
    for (const auto& circle : drawing.circles) painter.circle(circle);
    for (const auto& text : drawing.texts) painter.text(text);
    list.PopClipRect();
}

} // namespace

void draw_tool_drawing(InterfaceContext& context) {
    const ToolDrawing& drawing = context.interface.tool_drawing;
    const Layout& layout = context.layout;
    if (drawing.part) return draw_in_part(context, drawing, *drawing.part);
    // All viewports have the same view, so the drawing appears in each; of plans only in the one that tools act on.
    for (std::size_t n = 0; n < layout.viewports_at.size(); ++n)
        if (layout.current_plan_in.value_or(n) == n)
            draw_in_part(context, drawing, {layout.viewports_at[n], layout.viewport_size});
}

} // namespace ramus::app
