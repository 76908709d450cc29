// Tools that repair the tree. Each previews what a click would join, cut or remove, or says why nothing can be done
// here.
#pragma once

#include "app/tools/tool.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

// Common base: the branch under the pointer, and the free ends of the tree.
class EditTool : public Tool {
public:
    void move(const Pointing& pointing) override;

protected:
    // A place on a branch. `free_end`: `fraction` is 0 or 1 and no other branch is connected there.
    struct Spot {
        int branch = tree::kNoBranch;
        double fraction = 0.5;
        bool free_end = false;
        bool operator==(const Spot&) const = default;
    };
    // The place under the pointer, snapped to a free end nearby; none: no vessel.
    [[nodiscard]] std::optional<Spot> spot(const Pointing& pointing, const render::Pick& pick) const;
    // The free end of the branch that is nearest to the picked place.
    [[nodiscard]] std::optional<Spot> free_end(const Pointing& pointing, const render::Pick& pick) const;
    [[nodiscard]] render::Pick under(const Pointing& pointing) const; // the pick, if it belongs to the current tree

private:
    void learn(const Pointing& pointing) const;
    render::Pick under_;
    glm::dvec2 under_at_{0.0}; // position of the pointer at that pick
    std::shared_ptr<const tree::VesselTree> under_of_;
    mutable std::shared_ptr<const tree::VesselTree> tree_; // the tree of degrees_
    mutable std::vector<int> degrees_;
};

// Removes a piece of a branch.
class DisconnectTool final : public EditTool {
public:
    void press(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click a false connection: what is marked goes"; }
};

// Joins a free end to another free end or to a place on a vessel.
class JoinTool final : public EditTool {
public:
    void press(const Pointing& pointing) override;
    bool escape() override { return std::exchange(first_, std::nullopt).has_value(); }
    [[nodiscard]] bool busy() const override { return first_.has_value(); }
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override;

private:
    [[nodiscard]] std::optional<Spot> first(const Pointing& pointing) const;
    std::optional<Spot> first_;
    std::shared_ptr<const tree::VesselTree> first_of_;
};

// Removes a branch without children.
class SpurTool final : public EditTool {
public:
    void press(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click a spur to delete it"; }
};

// Moves the root to a free end.
class RootTool final : public EditTool {
public:
    void press(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click the vessel where blood enters, near its end"; }
};

} // namespace ramus::app
