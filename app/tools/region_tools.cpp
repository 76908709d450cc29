// The tools of the region of a scan: one begins and extends it by clicks on slices, the other cuts it: a click by a
// ball, a drag across a vessel by a disc that stands on the slice.
#include "app/tools/spelling.h"
#include "app/tools/tool.h"
#include "app/tools/tool_kinds.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

namespace ramus::app {

namespace {

const glm::vec4 kSeedInk{0.25F, 0.84F, 0.88F, 1.0F};
const glm::vec4 kCutInk{0.98F, 0.55F, 0.30F, 1.0F};
constexpr double kLeastDrag = 4.0; // points: less is a click
constexpr double kRadiusStep = 1.15;

// A grid counts from the middle of its first pixel.
glm::dvec3 slice_place(const slice::PixelGrid& grid, const glm::dvec2& at) { return grid.place(at - 0.5); }

class RegionTool final : public Tool {
public:
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kSlices; }
    [[nodiscard]] bool picks() const override { return false; }

    void press(const Pointing& pointing) override {
        if (!pointing.slice) return;
        const std::string place = finely_spelled(slice_place(pointing.slice->grid, pointing.at));
        command({"crosshair", place});
        command({pointing.modifiers.shift ? "region-add" : "region", place});
    }

    bool step(double notches, const ToolSettings& /*settings*/) override {
        command({"region-grow", notches > 0.0 ? "more" : "less"});
        return true;
    }

    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        if (pointing.slice) drawing.circles.push_back({pointing.at, 6.0 * pointing.pixel_ratio, kSeedInk});
        return drawing;
    }

    [[nodiscard]] std::string hint() const override {
        return "Click in a vessel on a slice: similar values around it are tinted; Shift+click adds a place; + and - "
               "widen and narrow the range; no segmentation";
    }
};

class RegionCutTool final : public Tool {
public:
    [[nodiscard]] WorksOn works_on() const override { return WorksOn::kSlices; }
    [[nodiscard]] bool picks() const override { return false; }

    void press(const Pointing& pointing) override {
        if (pointing.slice) from_ = pointing.at;
    }

    void release(const Pointing& pointing) override {
        const auto from = std::exchange(from_, std::nullopt);
        if (!from || !pointing.slice) return;
        const slice::PixelGrid& grid = pointing.slice->grid;
        if (glm::distance(*from, pointing.at) < kLeastDrag * pointing.pixel_ratio) {
            command({"region-cut", finely_spelled(slice_place(grid, *from)),
                     finely_spelled(pointing.settings.cut_radius_mm)});
            return;
        }
        const glm::dvec3 a = slice_place(grid, *from);
        const glm::dvec3 b = slice_place(grid, pointing.at);
        const glm::dvec3 across = glm::normalize(glm::cross(b - a, grid.plane().normal));
        command({"region-cut", finely_spelled(0.5 * (a + b)), finely_spelled(across),
                 finely_spelled(0.5 * glm::distance(a, b))});
    }

    bool escape() override { return std::exchange(from_, std::nullopt).has_value(); }
    [[nodiscard]] bool busy() const override { return from_.has_value(); }

    bool step(double notches, const ToolSettings& settings) override {
        command({"region-radius", finely_spelled(settings.cut_radius_mm * std::pow(kRadiusStep, notches))});
        return true;
    }

    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override {
        ToolDrawing drawing;
        if (!pointing.slice) return drawing;
        if (from_ && glm::distance(*from_, pointing.at) >= kLeastDrag * pointing.pixel_ratio) {
            drawing.lines.push_back({{*from_, pointing.at}, kCutInk, 2.0F});
            return drawing;
        }
        drawing.circles.push_back(
            {pointing.at, pointing.settings.cut_radius_mm / glm::length(pointing.slice->grid.right), kCutInk});
        return drawing;
    }

    [[nodiscard]] std::string hint() const override {
        return "Drag across a vessel on a slice to cut the region there; a click cuts by a ball, + and - change its "
               "radius";
    }

private:
    std::optional<glm::dvec2> from_; // where the button was pressed
};

} // namespace

std::unique_ptr<Tool> make_region_tool() { return std::make_unique<RegionTool>(); }
std::unique_ptr<Tool> make_region_cut_tool() { return std::make_unique<RegionCutTool>(); }

} // namespace ramus::app
