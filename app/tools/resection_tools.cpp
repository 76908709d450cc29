// The tools of resections: a line drawn across the picture becomes a plane, a stroke a sheet, and the control points of
// planes and sheets are dragged. On a slice, lines and strokes are in its plane, planes and sheets stand across it, and
// their section lines are dragged.
#include "app/tools/pixel_polygon.h"
#include "app/tools/resection_on_slice.h"
#include "app/tools/spelling.h"
#include "app/tools/tool.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <memory>

namespace ramus::app {

namespace {

const glm::vec4 kResectionColour{0.98F, 0.92F, 0.78F, 1.0F};
constexpr double kLeastStroke = 8.0;  // points: a shorter one was a click
constexpr double kStrokeStep = 3.0;   // points between those of a stroke
constexpr double kStrokeSlack = 0.7;  // points: how far the line may be from the stroke
constexpr double kHandleReach = 10.0; // points by which a press may miss a control point
constexpr double kHandleRadius = 4.5; // points

std::string pixel_word(const glm::dvec2& pixel) { return spelled(pixel.x, 1) + "," + spelled(pixel.y, 1); }

std::vector<ToolDrawing::Line> with_lines(std::vector<ToolDrawing::Line> lines, std::vector<ToolDrawing::Line> more) {
    std::ranges::move(more, std::back_inserter(lines));
    return lines;
}

// `straight`: a line from press to release; else all that was drawn. On a slice, a stroke that begins on the section
// line of a sheet corrects the sheet.
class StrokeTool final : public Tool {
public:
    explicit StrokeTool(bool straight) : straight_(straight) {}
    [[nodiscard]] bool picks() const override { return false; }
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    void press(const Pointing& pointing) override {
        points_ = {pointing.at};
        corrected_ = sheet_under(pointing);
    }
    void move(const Pointing& pointing) override {
        if (pointing.held) extend(pointing);
        under_ = pointing.held ? corrected_ : sheet_under(pointing);
    }
    void release(const Pointing& pointing) override {
        extend(pointing);
        const std::vector<glm::dvec2> drawn = std::exchange(points_, {});
        double length = 0.0; // 0: cancelled meanwhile
        for (std::size_t n = 1; n < drawn.size(); ++n) length += glm::distance(drawn[n - 1], drawn[n]);
        if (length < kLeastStroke * pointing.pixel_ratio) return;
        const std::vector<glm::dvec2> kept = straight_ ? drawn : simplified(drawn, kStrokeSlack * pointing.pixel_ratio);
        if (pointing.slice) return send_on_slice(pointing.slice->grid, kept);
        CommandLine line{"resect", straight_ ? "line" : "stroke"};
        for (const glm::dvec2& point : kept) line.push_back(pixel_word(point));
        command(std::move(line));
    }
    bool escape() override { return !std::exchange(points_, {}).empty(); }
    [[nodiscard]] bool busy() const override { return !points_.empty(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        if (points_.size() > 1) drawing.lines.push_back({points_, kResectionColour, 2.0F, false});
        const std::vector<Resection>& all = pointing.document.marks().resections;
        if (pointing.slice && under_ && *under_ < all.size())
            drawing.lines =
                with_lines(std::move(drawing.lines),
                           section_lines(pointing, all[*under_], glm::vec4(glm::vec3(kResectionColour), 0.6F)));
        return drawing;
    }
    [[nodiscard]] std::string hint() const override {
        if (!points_.empty() && corrected_) return "Let go to lead the sheet along the line, Escape to leave it";
        if (!points_.empty()) return "Let go to cut along the line, Escape to leave it";
        if (under_) return "Draw from here to lead this sheet along another line";
        return straight_ ? "Draw a line across the organ: a plane behind it divides the organ"
                         : "Draw a stroke across the organ: a sheet behind it divides the organ";
    }

private:
    void extend(const Pointing& pointing) {
        if (points_.empty()) return;
        if (straight_)
            points_ = std::vector<glm::dvec2>{points_.front(), pointing.at};
        else if (glm::distance(points_.back(), pointing.at) >= kStrokeStep * pointing.pixel_ratio)
            points_.push_back(pointing.at);
    }

    // A sheet whose section line is under the pointer, on a slice.
    [[nodiscard]] std::optional<std::size_t> sheet_under(const Pointing& pointing) const {
        if (straight_ || !pointing.slice) return {};
        const auto hold = section_under(pointing, kHandleReach * pointing.pixel_ratio, true);
        return hold ? std::optional(hold->resection) : std::nullopt;
    }

    void send_on_slice(const slice::PixelGrid& grid, const std::vector<glm::dvec2>& pixels) {
        const glm::dvec3 normal = grid.plane().normal + 0.0; // no -0
        const auto words = [&](CommandLine line) {
            for (const glm::dvec2& pixel : pixels) line.push_back(finely_spelled(grid.place(pixel - 0.5)));
            return line;
        };
        if (corrected_) return command(words({"resection-through", std::to_string(*corrected_ + 1)}));
        if (!straight_) return command(words({"resect", "along", finely_spelled(normal)}));
        CommandLine line = words({"resect", "points"});
        line.push_back(finely_spelled(grid.place(pixels.front() - 0.5) +
                                      glm::distance(pixels.front(), pixels.back()) * glm::length(grid.right) * normal));
        command(std::move(line));
    }

    bool straight_;
    std::vector<glm::dvec2> points_;
    std::optional<std::size_t> corrected_, under_; // sheets, by index
};

// Drags control points of sheets along the normal of their base plane, and planes along their normal. On a slice, drags
// the section line of a sheet or a plane to another place.
class HandleTool final : public Tool {
public:
    [[nodiscard]] bool picks() const override { return false; }
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kBoth; }
    void press(const Pointing& pointing) override {
        held_.reset();
        line_.reset();
        if (pointing.slice) {
            if (const auto hold = hold_under(pointing))
                line_ = HeldLine{
                    hold->resection, pointing.document.marks().resections[hold->resection], {}, hold->at, pointing.at};
            return;
        }
        held_ = handle_under(pointing);
        if (held_) before_ = moved_ = along(pointing, *held_);
    }
    void move(const Pointing& pointing) override {
        if (line_ && pointing.slice) return drag_line(pointing);
        if (!held_ || !pointing.held || !is_there(pointing, *held_)) return;
        moved_ = along(pointing, *held_);
        send(*held_, held_->height + moved_ - before_);
    }
    void release(const Pointing& pointing) override {
        held_.reset();
        const auto line = std::exchange(line_, std::nullopt);
        if (!line || !line->now || !is_same(pointing, *line)) return;
        const std::string number = std::to_string(line->resection + 1);
        if (line->before.kind == Resection::Kind::kSheet)
            command({"resection-through", number, finely_spelled(line->at)});
        else
            command({"resection-plane", number, finely_spelled(line->at), finely_spelled(line->before.normal)});
    }
    bool escape() override {
        if (std::exchange(line_, std::nullopt)) return true;
        if (!held_) return false;
        send(*held_, held_->height);
        held_.reset();
        return true;
    }
    [[nodiscard]] bool busy() const override { return held_ || line_; }
    [[nodiscard]] bool changes_while_held() const override { return held_.has_value(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        if (pointing.slice) return drawing_on_slice(pointing);
        ToolDrawing drawing;
        const auto under = held_ ? held_ : handle_under(pointing);
        for_handles(pointing, [&](const Handle& handle) {
            const auto at = render::project(pointing.camera(), pointing.size, handle.at);
            if (!at) return;
            const bool chosen =
                under && handle.resection == under->resection && handle.i == under->i && handle.j == under->j;
            drawing.circles.push_back({glm::dvec2(*at), (chosen ? 1.5 : 1.0) * kHandleRadius * pointing.pixel_ratio,
                                       kResectionColour, 1.5F, chosen});
        });
        return drawing;
    }
    [[nodiscard]] std::string hint() const override {
        return busy() ? "Drag to move it, let go to keep it, Escape to leave it"
                      : "Drag a point of a plane or a sheet to move it, or its line on a slice";
    }

private:
    // A control point of a sheet, or the point of a plane.
    struct Handle {
        std::size_t resection = 0;
        int i = -1, j = -1; // of a sheet
        glm::dvec3 at{0.0}, normal{0.0};
        double height = 0.0; // along the normal, of sheets
    };

    // The section line of a resection that is dragged on a slice.
    struct HeldLine {
        std::size_t resection = 0;
        Resection before;
        std::optional<Resection> now; // none: not moved yet
        glm::dvec3 at{0.0};           // where it was grabbed, or dragged to
        glm::dvec2 pressed_at{0.0};   // pixels
    };

    static std::optional<SectionHold> hold_under(const Pointing& pointing) {
        return section_under(pointing, kHandleReach * pointing.pixel_ratio);
    }

    // May have been changed meanwhile, for example by undo.
    static bool is_same(const Pointing& pointing, const HeldLine& line) {
        const std::vector<Resection>& all = pointing.document.marks().resections;
        return line.resection < all.size() && all[line.resection] == line.before;
    }

    void drag_line(const Pointing& pointing) {
        const glm::dvec3 at = pointing.slice->grid.place(pointing.at - 0.5);
        const double moved = glm::distance(pointing.at, line_->pressed_at);
        if (!line_->now && moved < kLeastStroke * pointing.pixel_ratio) return;
        Resection now = line_->before;
        if (now.kind == Resection::Kind::kSheet) {
            auto bent = organ::bent_through(now.sheet, {&at, 1});
            if (!bent) return;
            now.sheet = std::move(*bent);
        } else {
            now.point = at;
        }
        line_->now = std::move(now);
        line_->at = at;
    }

    [[nodiscard]] ToolDrawing drawing_on_slice(const Pointing& pointing) const {
        ToolDrawing drawing;
        const std::vector<Resection>& all = pointing.document.marks().resections;
        const bool dragged = line_ && line_->now;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (!all[n].visible) continue;
            const bool now = dragged && line_->resection == n;
            drawing.lines = with_lines(std::move(drawing.lines),
                                       section_lines(pointing, now ? *line_->now : all[n],
                                                     glm::vec4(glm::vec3(kResectionColour), now ? 1.0F : 0.6F)));
        }
        const auto mark = [&](const glm::dvec3& at, bool filled) {
            drawing.circles.push_back({pointing.slice->grid.pixel(at) + 0.5, 1.5 * kHandleRadius * pointing.pixel_ratio,
                                       kResectionColour, 1.5F, filled});
        };
        if (line_)
            mark(line_->at, true);
        else if (const auto under = hold_under(pointing))
            mark(under->at, false);
        return drawing;
    }

    template <class Call> static void for_handles(const Pointing& pointing, const Call& call) {
        const std::vector<Resection>& all = pointing.document.marks().resections;
        for (std::size_t n = 0; n < all.size(); ++n) {
            if (!all[n].visible) continue;
            if (all[n].kind == Resection::Kind::kPlane) call(Handle{n, -1, -1, all[n].point, all[n].normal, 0.0});
            if (all[n].kind != Resection::Kind::kSheet) continue;
            const organ::Sheet& sheet = all[n].sheet;
            for (int j = 0; j < sheet.size.y; ++j)
                for (int i = 0; i < sheet.size.x; ++i)
                    call(Handle{n, i, j, sheet.control_point(i, j), sheet.normal(), sheet.heights[sheet.index(i, j)]});
        }
    }

    static std::optional<Handle> handle_under(const Pointing& pointing) {
        std::optional<Handle> found;
        double nearest = kHandleReach * pointing.pixel_ratio;
        for_handles(pointing, [&](const Handle& handle) {
            const auto at = render::project(pointing.camera(), pointing.size, handle.at);
            const double away = at ? glm::distance(glm::dvec2(*at), pointing.at) : nearest;
            if (away < nearest) nearest = away, found = handle;
        });
        return found;
    }

    // May have been removed meanwhile, for example by undo.
    static bool is_there(const Pointing& pointing, const Handle& handle) {
        return handle.resection < pointing.document.marks().resections.size();
    }

    // How far along the handle's normal the pointer is: of the place of that line that is nearest to the line of sight.
    static double along(const Pointing& pointing, const Handle& handle) {
        const render::Camera& camera = pointing.camera();
        const double depth = std::max(glm::dot(handle.at - camera.position, render::axes_of(camera).forward), 1.0);
        const glm::dvec3 near = render::unproject(camera, pointing.size, pointing.at, 0.5 * depth);
        const glm::dvec3 sight = glm::normalize(render::unproject(camera, pointing.size, pointing.at, depth) - near);
        const double across = glm::dot(sight, handle.normal), size = 1.0 - across * across;
        const glm::dvec3 from = near - handle.at;
        if (size < 1e-3) return 0.0; // the normal points at the eye
        return (glm::dot(from, handle.normal) - across * glm::dot(from, sight)) / size;
    }

    void send(const Handle& handle, double height) {
        const std::string number = std::to_string(handle.resection + 1);
        if (handle.i >= 0) {
            command({"resection-control", number, std::to_string(handle.i), std::to_string(handle.j), spelled(height)});
            return;
        }
        const glm::dvec3 at = handle.at + (height - handle.height) * handle.normal;
        command({"resection-plane", number, finely_spelled(at), finely_spelled(handle.normal)});
    }

    std::optional<HeldLine> line_;
    std::optional<Handle> held_; // as it was when pressed
    double before_ = 0.0, moved_ = 0.0;
};

} // namespace

std::unique_ptr<Tool> make_plane_tool() { return std::make_unique<StrokeTool>(true); }
std::unique_ptr<Tool> make_sheet_tool() { return std::make_unique<StrokeTool>(false); }
std::unique_ptr<Tool> make_handle_tool() { return std::make_unique<HandleTool>(); }

} // namespace ramus::app
