// CutTool: cuts the branch under the pointer across, at the point of its centerline nearest to the pointer's on
// the surface, which a ring shows before the click.
#pragma once

#include "app/tools/tool.h"

namespace ramus::app {

class CutTool final : public Tool {
public:
    void press(const Pointing& pointing) override;
    void move(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click a vessel to cut it there"; }

private:
    render::Pick under_;
};

} // namespace ramus::app
