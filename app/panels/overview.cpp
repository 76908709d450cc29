// The overview panel: the tree as a dendrogram below the 3D picture. Hover, click and lasso work in both and are shown
// in both.
#include "app/panels/overview.h"

#include "app/panels/parts.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>

namespace ramus::app {

namespace {

std::size_t index(int id) { return static_cast<std::size_t>(id); }

struct Canvas {
    ImVec2 at;
    ImVec2 size;
    ImDrawList* list;
    [[nodiscard]] glm::dvec2 to(const OverviewView& view, glm::dvec2 unit) const {
        return view.to_pixel(unit) + glm::dvec2(at.x, at.y);
    }
};

double line_width(const InterfaceContext& context, const OverviewView& view, const OverviewLine& line, int id) {
    const TreeFacts& facts = *context.workspace.facts();
    const double thickest = 9.0 * theme::scale();
    const double spacing = (line.last - line.first) / (view.most.x - view.least.x) * view.pixels.x;
    const double share =
        facts.branches[index(id)].diameter_mm.mean / std::max(2.0 * facts.statistics.radius_mm.max, 1e-9);
    return std::max(std::round(std::min(thickest * share, 0.75 * spacing)), 1.0);
}

void draw_piece(const InterfaceContext& context, const Canvas& canvas, const OverviewPiece& piece, bool frames) {
    const Overview& overview = context.interface.of<Overview>();
    const OverviewLine& line = overview.layout.lines[index(piece.branch)];
    const Overview::Look look = look_of(overview, piece);
    if (frames && !look.selected) return;
    const auto width = static_cast<float>(piece.merged ? 1.0 : line_width(context, overview.view, line, piece.branch));
    const glm::dvec2 top = canvas.to(overview.view, {line.at, line.from});
    const glm::dvec2 bottom = canvas.to(overview.view, {line.at, piece.merged ? line.mean_end : line.to});
    const float x = std::round(static_cast<float>(top.x) - 0.5F * width);
    const float y0 = std::round(static_cast<float>(top.y));
    const float y1 = std::max(std::round(static_cast<float>(bottom.y)), y0 + 1.0F);
    if (frames) {
        const float edge = std::max(1.0F, std::round(1.2F * theme::scale()));
        const ImU32 colour = widgets::packed({render::Appearance{}.selection, 0.55F});
        canvas.list->AddRectFilled({x - edge, y0}, {x + width + edge, y1}, colour);
        return;
    }
    canvas.list->AddRectFilled({x, y0}, {x + width, y1}, widgets::packed(look.colour));
    const bool cut = !piece.merged && look.lost_from < 1.0F && look.lost_to - look.lost_from < 1.0F;
    if (cut) { // a line marks the cut; the part beyond is lost
        const auto at = [&](float share) { return std::round(y0 + (y1 - y0) * std::clamp(share, 0.0F, 1.0F)); };
        const float edge = 2.0F * theme::scale();
        canvas.list->AddRectFilled({x, at(look.lost_from)}, {x + width, at(look.lost_to)},
                                   widgets::packed({1.25F * render::Appearance{}.lost, look.colour.a}));
        const float y = at(look.lost_from > 0.0F ? look.lost_from : look.lost_to);
        canvas.list->AddRectFilled({x - edge, y - 1.0F}, {x + width + edge, y + 1.0F},
                                   widgets::packed(glm::vec4(0.92F, 0.92F, 0.92F, 1.0F)));
    }
    if (!piece.merged) return;
    const auto deepest = static_cast<float>(canvas.to(overview.view, {line.at, line.deepest}).y);
    glm::vec4 faint = look.colour;
    faint.a *= 0.4F;
    canvas.list->AddRectFilled({x, y1}, {x + width, std::round(deepest)}, widgets::packed(faint));
}

// The horizontal line from the parent's end to the branch.
void draw_joint(const InterfaceContext& context, const Canvas& canvas, const OverviewPiece& piece, double parent_at) {
    const Overview& overview = context.interface.of<Overview>();
    const OverviewLine& line = overview.layout.lines[index(piece.branch)];
    const glm::dvec2 from = canvas.to(overview.view, {std::min(parent_at, line.at), line.from});
    const glm::dvec2 to = canvas.to(overview.view, {std::max(parent_at, line.at), line.from});
    if (to.x - from.x < 1.0) return;
    const float thickness = std::max(1.0F, std::round(theme::scale()));
    const float y = std::round(static_cast<float>(from.y));
    const float left = std::max(std::round(static_cast<float>(from.x) - 0.5F), canvas.at.x - 4.0F);
    const float right = std::min(std::round(static_cast<float>(to.x) + 0.5F), canvas.at.x + canvas.size.x + 4.0F);
    glm::vec4 colour = look_of(overview, piece).colour;
    colour.a *= 0.8F;
    canvas.list->AddRectFilled({left, y}, {right, y + thickness}, widgets::packed(colour));
}

void draw_tree_lines(const InterfaceContext& context, const Canvas& canvas) {
    const Overview& overview = context.interface.of<Overview>();
    const OverviewLayout& layout = overview.layout;
    const std::vector<OverviewPiece> pieces = visible_pieces(layout, overview.view);
    for (const OverviewPiece& piece : pieces) draw_piece(context, canvas, piece, true);
    const tree::VesselTree& tree = *context.workspace.document().tree();
    for (const OverviewPiece& piece : pieces) {
        const int parent = tree.branches[index(piece.branch)].parent;
        if (parent != tree::kNoBranch) draw_joint(context, canvas, piece, layout.lines[index(parent)].at);
    }
    for (std::size_t i = 0; i < layout.roots.size(); ++i)
        draw_joint(context, canvas, {layout.roots[i], false}, layout.root_middle[i]);
    for (const OverviewPiece& piece : pieces) draw_piece(context, canvas, piece, false);
    const float thin = std::max(1.0F, theme::scale());
    for (const OverviewLink& link : layout.links) {
        const Overview::Look& look = overview.looks[index(link.branch)];
        const glm::dvec2 a = canvas.to(overview.view, link.from);
        const glm::dvec2 b = canvas.to(overview.view, link.to);
        const auto point = [](glm::dvec2 p) { return ImVec2(static_cast<float>(p.x), static_cast<float>(p.y)); };
        canvas.list->AddLine(point(a), point(b), widgets::packed(look.colour), look.selected ? 2.0F * thin : thin);
    }
}

// Faint lines at even depths, named at the left.
void draw_scale(const InterfaceContext& context, const Canvas& canvas) {
    const Overview& overview = context.interface.of<Overview>();
    const OverviewView& view = overview.view;
    const double depth = overview.layout.depth;
    const double least_step = 22.0 * theme::scale() * (view.most.y - view.least.y) * depth / view.pixels.y;
    double step = std::pow(10.0, std::ceil(std::log10(std::max(least_step, 1e-9))));
    for (const double share : {0.2, 0.5})
        if (step * share >= least_step) {
            step *= share;
            break;
        }
    const bool generations = overview.layout_depth == OverviewDepth::kGeneration;
    if (generations) step = std::max(1.0, std::ceil(step));
    ImGui::PushFont(theme::small_font());
    const float half = 0.5F * ImGui::GetFontSize();
    for (double value = 0.0; value <= depth * (1.0 + 1e-9); value += step) {
        // A generation is the space between two lines.
        const auto y = std::round(static_cast<float>(canvas.to(view, {0.0, value / depth}).y));
        if (y < canvas.at.y - 1.0F || y > canvas.at.y + canvas.size.y + 1.0F) continue;
        canvas.list->AddLine({canvas.at.x, y + 0.5F}, {canvas.at.x + canvas.size.x, y + 0.5F},
                             ImGui::GetColorU32(theme::kRaised));
        if (generations && value >= depth - 0.5) continue;
        const std::string text = generations ? std::to_string(std::lround(value)) : digits(value, 3);
        const auto middle = static_cast<float>(canvas.to(view, {0.0, (value + (generations ? 0.5 : 0.0)) / depth}).y);
        const float top = std::clamp(middle - half, canvas.at.y - half, canvas.at.y + canvas.size.y - half);
        canvas.list->AddText(
            {std::round(canvas.at.x - 10.0F * theme::scale() - ImGui::CalcTextSize(text.c_str()).x), std::round(top)},
            ImGui::GetColorU32(theme::kQuiet), text.c_str());
    }
    ImGui::PopFont();
}

void pick_with_click(InterfaceContext& context, int id) {
    const ImGuiIO& io = ImGui::GetIO();
    if (id != tree::kNoBranch) {
        context.interface.of<Overview>().shown_selection = id; // already visible
        context.perform(io.KeyCtrl ? "select-toggle" : io.KeyAlt ? "select-subtree" : "select", {std::to_string(id)});
    } else if (!io.KeyCtrl && !io.KeyAlt && !io.KeyShift) {
        context.perform("select-none", {});
    }
}

void finish_lasso(InterfaceContext& context) {
    Overview& overview = context.interface.of<Overview>();
    const std::vector<int> ids = branches_within(overview.layout, overview.lasso);
    overview.lasso.clear();
    const bool adds = ImGui::GetIO().KeyCtrl;
    if (ids.empty()) {
        if (!adds) context.perform("select-none", {});
        return;
    }
    std::vector<std::string> words;
    words.reserve(ids.size());
    for (const int id : ids) words.push_back(std::to_string(id));
    overview.shown_selection = ids.size() == 1 ? ids.front() : tree::kNoBranch;
    context.perform(adds ? "select-add" : "select", words);
}

// Handles the mouse; returns the branch under the pointer.
int handle_mouse(InterfaceContext& context, const Canvas& canvas) {
    Overview& overview = context.interface.of<Overview>();
    const ImGuiIO& io = ImGui::GetIO();
    const bool over = ImGui::IsItemHovered();
    const glm::dvec2 pixel(io.MousePos.x - canvas.at.x, io.MousePos.y - canvas.at.y);
    if (ImGui::IsItemActivated()) {
        overview.drag = io.KeyShift ? Overview::Drag::kLasso : Overview::Drag::kPan;
        overview.dragged = false;
        overview.last = io.MousePos;
        overview.lasso.clear();
    }
    if (ImGui::IsItemActive() && overview.drag != Overview::Drag::kNone) {
        const float far = 4.0F * theme::scale();
        const ImVec2 moved(io.MousePos.x - overview.last.x, io.MousePos.y - overview.last.y);
        if (!overview.dragged && moved.x * moved.x + moved.y * moved.y >= far * far) overview.dragged = true;
        if (overview.dragged && overview.drag == Overview::Drag::kPan) {
            overview.view = panned(overview.view, {moved.x, moved.y});
            overview.last = io.MousePos;
        } else if (overview.drag == Overview::Drag::kLasso) {
            const glm::dvec2 unit = overview.view.to_unit(pixel);
            if (overview.lasso.empty() ||
                glm::distance(overview.view.to_pixel(overview.lasso.back()), pixel) > 2.0 * theme::scale())
                overview.lasso.push_back(unit);
        }
    }
    if (ImGui::IsItemDeactivated() && overview.drag != Overview::Drag::kNone) {
        const bool lasso = overview.drag == Overview::Drag::kLasso;
        overview.drag = Overview::Drag::kNone;
        if (overview.dragged && lasso)
            finish_lasso(context);
        else if (!overview.dragged && over)
            pick_with_click(context, branch_near(overview.layout, overview.view, pixel, 5.0 * theme::scale()));
        overview.lasso.clear();
    }
    if (!over || overview.dragged) {
        if (!ImGui::IsItemActive()) overview.dragged = false;
        if (!over || ImGui::IsItemActive()) return tree::kNoBranch;
    }
    if (io.MouseWheel != 0.0F) {
        const double factor = std::pow(1.25, io.MouseWheel);
        overview.view = zoomed(overview.view, overview.layout, pixel,
                               io.KeyCtrl ? glm::dvec2(1.0, factor) : glm::dvec2(factor, 1.0));
    }
    if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        overview.view.least = glm::dvec2(0.0);
        overview.view.most = glm::dvec2(1.0);
    }
    return branch_near(overview.layout, overview.view, pixel, 5.0 * theme::scale());
}

// Scrolls to a branch selected elsewhere if the view is magnified.
void follow_selection(Overview& overview, const Marks& marks) {
    const int wanted = marks.selection.size() == 1 ? marks.selection.front() : tree::kNoBranch;
    if (wanted == std::exchange(overview.shown_selection, wanted) || wanted == tree::kNoBranch) return;
    const OverviewLine& line = overview.layout.lines[index(wanted)];
    const glm::dvec2 middle(line.at, 0.5 * (line.from + line.to));
    const glm::dvec2 pixel = overview.view.to_pixel(middle);
    if (pixel.x >= 0.0 && pixel.y >= 0.0 && pixel.x < overview.view.pixels.x && pixel.y < overview.view.pixels.y)
        return;
    overview.view = panned(overview.view, 0.5 * overview.view.pixels - pixel);
}

void draw_header(InterfaceContext& context) {
    Overview& overview = context.interface.of<Overview>();
    const float scale = theme::scale();
    ImGui::TextUnformatted("Overview");
    ImGui::SameLine(0.0F, 16.0F * scale);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {8.0F * scale, 0.0F});
    const auto choice = [&](const char* label, OverviewDepth depth, const char* setting, const char* help) {
        const bool chosen = overview.depth == depth;
        const ImVec4 ground = chosen ? ImGui::GetStyleColorVec4(ImGuiCol_ButtonHovered) : theme::kNothing;
        if (widgets::button(label, {}, ground, chosen ? theme::kText : theme::kQuiet))
            context.perform("overview", {setting});
        widgets::tooltip(help);
        ImGui::SameLine(0.0F, 2.0F * scale);
    };
    choice("Generation", OverviewDepth::kGeneration, "generation", "Downwards: branchings from the root");
    choice("Path length", OverviewDepth::kDistance, "distance", "Downwards: mm along the vessels from the root");
    const float close_width = ImGui::CalcTextSize("Close").x + 16.0F * scale;
    const char* hint = "Wheel magnifies, Ctrl+wheel deepens, drag moves, Shift+drag is a lasso, double-click shows all";
    ImGui::PushFont(theme::small_font());
    const float hint_width = ImGui::CalcTextSize(hint).x;
    if (ImGui::GetContentRegionAvail().x > hint_width + close_width + 40.0F * scale) {
        ImGui::SameLine(0.0F, 20.0F * scale);
        widgets::quiet(hint);
        ImGui::SameLine();
    }
    ImGui::PopFont();
    widgets::align_right(close_width);
    if (widgets::button("Close", {close_width, 0.0F}, theme::kNothing, theme::kQuiet))
        context.perform("overview", {"off"});
    widgets::tooltip("Opens again with", "T");
    ImGui::PopStyleVar();
}

// The edge towards the picture can be dragged.
void draw_splitter(InterfaceContext& context, float width) {
    const float grip = 6.0F * theme::scale();
    const ImVec2 at = ImGui::GetWindowPos();
    ImGui::SetCursorScreenPos(at);
    ImGui::InvisibleButton("##edge", {width, grip});
    const bool held = ImGui::IsItemActive();
    if (held || ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeNS);
    if (held) {
        const float bottom = at.y + static_cast<float>(context.layout.overview_height);
        context.interface.of<Overview>().height =
            std::max(90.0F, (bottom - ImGui::GetIO().MousePos.y) / theme::scale());
    }
    ImGui::GetWindowDrawList()->AddLine({at.x, at.y + 0.5F}, {at.x + width, at.y + 0.5F},
                                        ImGui::GetColorU32(held ? theme::kAccentDim : theme::kLine));
}

void lay_out(Overview& overview, const Document& document) {
    const TreeFacts* facts = document.facts().get();
    if (overview.layout_of == facts && overview.layout_depth == overview.depth) return;
    const bool other_tree = overview.layout_of != facts;
    overview.layout = overview_layout(*document.tree(), *facts, overview.depth);
    overview.layout_of = facts;
    overview.layout_depth = overview.depth;
    overview.looks.clear();
    overview.view.least.y = 0.0, overview.view.most.y = 1.0;
    if (other_tree) overview.view = {};
}

void draw_lasso(const Overview& overview, const Canvas& canvas) {
    std::vector<ImVec2> points;
    for (const glm::dvec2& corner : overview.lasso) {
        const glm::dvec2 at = canvas.to(overview.view, corner);
        points.emplace_back(static_cast<float>(at.x), static_cast<float>(at.y));
    }
    if (points.size() > 1)
        canvas.list->AddPolyline(points.data(), static_cast<int>(points.size()), ImGui::GetColorU32(theme::kAccent),
                                 ImDrawFlags_Closed, 1.5F * theme::scale());
}

void draw_canvas(InterfaceContext& context, const Canvas& canvas) {
    Overview& overview = context.interface.of<Overview>();
    const Marks& marks = context.workspace.document().marks();
    ImGui::SetCursorScreenPos(canvas.at);
    ImGui::InvisibleButton("##canvas", canvas.size);
    overview.view.pixels = {canvas.size.x, canvas.size.y};
    const int under = handle_mouse(context, canvas);
    if (under != tree::kNoBranch) context.interface.listed = under;
    follow_selection(overview, marks);
    make_looks(overview, marks, context.interface.picture);
    draw_scale(context, canvas);
    canvas.list->PushClipRect(canvas.at, {canvas.at.x + canvas.size.x, canvas.at.y + canvas.size.y}, true);
    draw_tree_lines(context, canvas);
    draw_lasso(overview, canvas);
    canvas.list->PopClipRect();
    if (under != tree::kNoBranch) draw_branch_tooltip(context, under);
}

} // namespace

void draw_overview(InterfaceContext& context) {
    Overview& overview = context.interface.of<Overview>();
    const Layout& layout = context.layout;
    if (layout.overview_height == 0) return;
    const float scale = theme::scale();
    const auto width = static_cast<float>(layout.view_size.x);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {14.0F * scale, 7.0F * scale});
    widgets::begin_fixed("overview", 0.0F, static_cast<float>(layout.view_at.y + layout.view_size.y), width,
                         static_cast<float>(layout.overview_height),
                         ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    ImGui::PopStyleVar();
    draw_splitter(context, width);
    ImGui::SetCursorPos({14.0F * scale, 8.0F * scale});
    draw_header(context);
    const auto& facts = context.workspace.facts();
    const Document& document = context.workspace.document();
    if (!document.tree() || !facts || document.branch_count() == 0) {
        ImGui::End();
        return;
    }
    lay_out(overview, document);
    const float margin = 40.0F * scale;
    ImGui::SetCursorPosX(margin);
    Canvas canvas{ImGui::GetCursorScreenPos(), ImGui::GetContentRegionAvail(), ImGui::GetWindowDrawList()};
    canvas.at.y += 5.0F * scale;
    canvas.size.y -= 7.0F * scale;
    if (canvas.size.x >= 32.0F && canvas.size.y >= 16.0F) draw_canvas(context, canvas);
    ImGui::End();
}

} // namespace ramus::app
