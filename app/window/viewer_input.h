// ViewerInput: handles mouse and keys: they move the camera, drive tools, select by clicks, run commands by keys, or go
// to the interface. Also tracks what is under the pointer. Positions are framebuffer pixels from the top left of the
// window.
//
// Guarantee: actions of the user take effect in order. A click may need a pick first (look_up()); later keys and mouse
// events then wait.
#pragma once

#include "app/actions/keys.h"
#include "app/panels/context_menu.h"
#include "app/tools/plane_mouse.h"
#include "app/tools/slice_mouse.h"
#include "app/tools/tool_mouse.h"
#include "app/tools/viewport_mouse.h"
#include "app/window/imgui_input.h"
#include "app/window/picture_view.h"

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace ramus::app {

class ViewerInput final : public ToolHost {
public:
    ViewerInput(ViewerState& state, PictureView& picture) : state_(state), picture_(picture) {}

    void set_pixel_ratio(double ratio) {
        mouse_.set_pixel_ratio(ratio);
        slice_mouse_.set_pixel_ratio(ratio);
    }
    void mouse_moved(glm::dvec2 at);
    void mouse_left();
    void mouse_button(MouseButton button, bool down, Modifiers modifiers, double now);
    void mouse_wheel(glm::dvec2 notches);
    // `number`: GLFW's key; `press`: none for releases and for keys without a name.
    void key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers, double now);
    void character(unsigned codepoint, double now);
    void close(); // like the command quit

    // Before ImGui::NewFrame(). False: some events wait for another frame.
    bool apply(ImGuiIO& io) { return input_.apply(io); }
    [[nodiscard]] ToolDrawing tool_drawing();
    [[nodiscard]] bool dragging() const { return mouse_.dragging(); }
    [[nodiscard]] Cursor cursor() const;

    // Updates Interface::hovered, the branch under the pointer: requested after the picture or the pointer changed,
    // available a frame or two later.
    void look_again() { pick_wanted_ = true; }
    void ask_pick();
    void take_pick();
    // Not while a button is held: the window then waits for the mouse.
    [[nodiscard]] bool pick_wanted() const { return pick_wanted_ && !mouse_.held() && !state_.interface.wipe_held; }
    [[nodiscard]] bool pick_pending() const { return pick_pending_; }

    // ToolHost
    void use_tool(std::string_view name) override;
    [[nodiscard]] std::string_view tool() const override { return state_.interface.tool_kind->name; }
    [[nodiscard]] ToolSettings& tool_settings() override { return state_.interface.tool_settings; }

private:
    void in_order(std::function<void()> event);
    void move_to(glm::dvec2 at);
    void press(MouseButton button, Modifiers modifiers, double now);
    void release(MouseButton button, Modifiers modifiers, double now);
    void turn_wheel(glm::dvec2 notches);
    void press_key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers);
    void type(unsigned codepoint);
    [[nodiscard]] bool over_picture(glm::dvec2 at) const;
    [[nodiscard]] glm::dvec2 in_picture(glm::dvec2 at) const { return at - glm::dvec2(state_.layout.view_at); }
    // Relative to the viewport under the pointer, or under it when a button was pressed.
    [[nodiscard]] glm::dvec2 in_viewport(glm::dvec2 at) const;
    [[nodiscard]] glm::dvec2 from_viewport(glm::dvec2 at) const; // relative to the picture
    void enter_viewport();
    void use_plan_here();
    // Updates Aim with the pointer, and the pivot of a drag.
    void aim();
    void settle(); // stops an animation, so that a press refers to what is visible
    [[nodiscard]] Grip grip();
    void drag_view(glm::dvec2 at);
    [[nodiscard]] bool points_at_branches() const;
    // Whether the tool has the left button here: some tools leave it to the crosshair on slices.
    [[nodiscard]] bool tool_acts_here() const;
    // The slice under the pointer, or under it when a button was pressed; none: the pointer is over the tree.
    [[nodiscard]] std::optional<SliceGrip> slice_grip() const;
    [[nodiscard]] std::optional<SliceSpot> slice_spot(glm::dvec2 in_viewport) const;
    [[nodiscard]] std::optional<SlicePointing> slice_pointing() const; // the same for tools
    void take(const SliceChange& change);
    void press_slice(MouseButton button, Modifiers modifiers, const SliceGrip& grip, double now);
    void release_slice(MouseButton button);
    void turn_wheel_over_slice(const SliceGrip& grip, double notches);
    void point_at_slice();
    // Slices among the vessels. The edge under the pointer; none: it is elsewhere, or before it is a vessel.
    [[nodiscard]] PlaneSight plane_sight() const;
    void point_at_plane();
    [[nodiscard]] bool grab_plane();
    void drag_plane();
    void release_plane();
    // Steps the slice whose edge is under the pointer; with Ctrl, the slice under the pointer.
    [[nodiscard]] bool turn_wheel_over_plane(double notches);
    void show_slices_at(const glm::dvec3& place);
    void add_plane_outline(ToolDrawing& drawing) const;
    // Passes a notch to the tool in hand. False: not used.
    bool step_tool(double notches);
    // The line of a wipe: whether it is under the pointer; dragging it; releasing it.
    [[nodiscard]] bool on_wipe_line() const;
    void drag_wipe_line();
    void drop_wipe_line();
    [[nodiscard]] Pointing pointing(Modifiers modifiers);
    // Picks at a pixel of the picture shown now and calls `then` with the result; later actions wait.
    void look_up(glm::dvec2 in_picture, const std::function<void(const render::Pick&)>& then);
    // Passes an event to the tool, after a pick if the tool needs it.
    void tell_tool(Tool::Event event, const Pointing& pointing);
    [[nodiscard]] ToolMouse::Tell tell() {
        return [this](Tool::Event event, const Pointing& pointing) { tell_tool(event, pointing); };
    }
    void perform_tool();
    void run_commands_of(Tool& tool);
    void clicked(const Click& click);
    void click_on(Click::Kind kind, const Pointing& pointing);
    void right_click_on(const Pointing& pointing);
    void open_context_menu(const Pointing& pointing);
    void look_at(const glm::dvec3& at);
    void show_slices_at(const render::Pick& pick);
    [[nodiscard]] std::optional<ObjectPlace> object_at(glm::dvec2 in_viewport, const render::Pick& pick) const;
    // Sets what is under the pointer; kNoBranch and no object: nothing.
    void point_at(int branch, const std::optional<ObjectPlace>& object);
    void run(const Command& command);

    ViewerState& state_;
    PictureView& picture_;
    ImguiInput input_;
    ViewportMouse mouse_;
    ToolMouse tool_mouse_;
    SliceMouse slice_mouse_;
    PlaneMouse plane_mouse_;
    std::optional<PlaneEdge> plane_edge_;              // under the pointer
    int plane_under_ = render::kNoPlane;               // the plane under the pointer, by the last pick
    SliceLayout layout_before_ = SliceLayout::kSlices; // of a slice that a double click made large
    bool windows_ = false;                             // a step of undo of the window in which a scan is shown
    std::weak_ptr<std::vector<glm::dvec2>> moves_;     // waiting moves that are still last in the queue
    std::size_t viewport_ = 0;                         // see in_viewport()
    glm::dvec2 pointer_{-1.0};
    double wipe_grip_ = 0.0; // distance from the line to where it was grabbed, pixels
    bool pointer_over_picture_ = false;
    bool pick_wanted_ = false, pick_pending_ = false;
    bool in_step_ = false; // of undo: what a tool drags changes on the way
    int tools_taken_ = 0;  // counts selected tools: events from before a selection are not passed to the new tool
};

} // namespace ramus::app
