// The tools that mend the tree: each shows before the click what would be joined, cut or taken away, or why nothing can
// be done at this place.
#pragma once

#include "app/tools/tool.h"

#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

// What all of them know: the branch under the pointer and the free ends of the tree.
class EditTool : public Tool {
public:
    void move(const Pointing& pointing) override;

protected:
    // A place on a branch. `free_end`: 0 or 1, where nothing else is.
    struct Spot {
        int branch = tree::kNoBranch;
        double fraction = 0.5;
        bool free_end = false;
        bool operator==(const Spot&) const = default;
    };
    // Of the vessel under the pointer; none: there is no vessel. Near a free end it is that.
    [[nodiscard]] std::optional<Spot> spot(const Pointing& pointing, const render::Pick& pick) const;
    // The free end of this branch nearest to the place that was picked.
    [[nodiscard]] std::optional<Spot> free_end(const Pointing& pointing, const render::Pick& pick) const;
    [[nodiscard]] render::Pick under(const Pointing& pointing) const; // of the tree as it is now

private:
    void learn(const Pointing& pointing) const;
    render::Pick under_;
    glm::dvec2 under_at_{0.0}; // the pointer then: it may have left the picture since
    std::shared_ptr<const tree::VesselTree> under_of_;
    mutable std::shared_ptr<const tree::VesselTree> tree_; // that the degrees are of
    mutable std::vector<int> degrees_;
};

// Takes a piece out of a branch.
class DisconnectTool final : public EditTool {
public:
    void press(const Pointing& pointing) override;
    [[nodiscard]] ToolDrawing drawing(const Pointing& pointing) const override;
    [[nodiscard]] std::string hint() const override { return "Click a false connection: what is marked goes"; }
};

// A free end first, then another or a place of a vessel.
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

// Takes away a branch that carries no others.
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
    [[nodiscard]] std::string hint() const override {
        return "Click the vessel that blood shall enter by, near its end";
    }
};

} // namespace ramus::app
