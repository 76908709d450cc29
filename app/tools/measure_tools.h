// The measuring tools: distances between two points of the surface, paths along the tree between two branches,
// diameters at a point, angles at a branching. What they find stays in the session until it is removed.
#pragma once

#include "app/tools/tool.h"

#include <optional>

namespace ramus::app {

class MeasureTool final : public Tool {
public:
    explicit MeasureTool(Measurement::Kind kind) : kind_(kind) {}
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    bool escape() override { return std::exchange(first_, std::nullopt).has_value(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override;
    [[nodiscard]] bool points_at_branches() const override { return kind_ != Measurement::Kind::kDistance; }

private:
    Measurement::Kind kind_;
    std::optional<render::Pick> first_; // of two
    render::Pick under_;
};

} // namespace ramus::app
