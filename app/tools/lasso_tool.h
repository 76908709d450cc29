// Lasso tools, free-hand or as a clicked polygon. They produce one `lasso` command. Shift at the start adds to the
// selection, Ctrl removes from it.
#pragma once

#include "app/tools/tool.h"

namespace ramus::app {

class LassoBase : public Tool {
public:
    bool escape() override;
    [[nodiscard]] bool picks() const override { return false; }
    [[nodiscard]] bool busy() const override { return !points_.empty(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;

protected:
    void begin(const Pointing& pointing);
    void finish(const Pointing& pointing, std::vector<glm::dvec2>&& drawn); // does nothing if it encloses nothing
    [[nodiscard]] glm::vec4 colour() const;

    std::vector<glm::dvec2> points_; // so far
    Modifiers modifiers_;            // at the start
};

class LassoTool final : public LassoBase {
public:
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    void release(const Pointing& pointing) override;
    [[nodiscard]] Cursor cursor() const override { return Cursor::kLasso; }
    [[nodiscard]] std::string hint() const override;
};

class PolygonLassoTool final : public LassoBase {
public:
    void press(const Pointing& pointing) override;
    void double_click(const Pointing& pointing) override;
    bool right_click(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] Cursor cursor() const override { return Cursor::kLassoPolygon; }
    [[nodiscard]] std::string hint() const override;

private:
    static constexpr double kClosingReach = 8.0; // points: a click this near the first corner closes the polygon
    [[nodiscard]] bool closes(const Pointing& pointing) const;
    void close(const Pointing& pointing);
};

} // namespace ramus::app
