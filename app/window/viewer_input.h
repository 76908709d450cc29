// ViewerInput: what the mouse and the keys do: they turn the camera, work with tools, select by clicks, press the keys
// of commands, or go to the interface; and what the pointer is over. Positions are framebuffer pixels from the top left
// of the window.
//
// What a person does takes effect in the order in which it was done. It may have to be looked up what a click is on
// (look_up()); what is done meanwhile, with keys or the mouse, waits.
#pragma once

#include "app/actions/keys.h"
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

    void set_pixel_ratio(double ratio) { mouse_.set_pixel_ratio(ratio); }
    void mouse_moved(glm::dvec2 at);
    void mouse_left();
    void mouse_button(MouseButton button, bool down, Modifiers modifiers, double now);
    void mouse_wheel(glm::dvec2 notches);
    // `number` is GLFW's; `press` is empty for releases and for keys without a name.
    void key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers, double now);
    void character(unsigned codepoint, double now);
    void close(); // as the command quit does

    // Before ImGui::NewFrame(). False: some events wait for another frame.
    bool apply(ImGuiIO& io) { return input_.apply(io); }
    [[nodiscard]] ToolDrawing tool_drawing();
    [[nodiscard]] bool dragging() const { return mouse_.dragging(); }
    [[nodiscard]] Cursor cursor() const;

    // The branch under the pointer, in Interface::hovered: asked for after the picture or the pointer changed, and
    // there a frame or two later.
    void look_again() { pick_wanted_ = true; }
    void ask_pick();
    void take_pick();
    // While a button is held nobody asks: the window waits for the mouse.
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
    // From the corner of the viewport that the pointer is in, or was in when a button was pressed.
    [[nodiscard]] glm::dvec2 in_viewport(glm::dvec2 at) const;
    [[nodiscard]] glm::dvec2 from_viewport(glm::dvec2 at) const; // to the picture's corner
    void enter_viewport();
    // Tells what is pointed at of the pointer, and of what a drag turns about.
    void aim();
    void settle(); // what is pressed is what is seen, should the view be on its way
    [[nodiscard]] Grip grip();
    void drag_view(glm::dvec2 at);
    [[nodiscard]] bool points_at_branches() const;
    // The line between two surfaces that are wiped: whether the pointer is on it; it follows the pointer, and stays.
    [[nodiscard]] bool on_wipe_line() const;
    void drag_wipe_line();
    void drop_wipe_line();
    [[nodiscard]] Pointing pointing(Modifiers modifiers);
    // `then` gets what the picture shows there now, once that is known; what is done after it takes effect after it.
    void look_up(glm::dvec2 in_picture, const std::function<void(const render::Pick&)>& then);
    // What the pointer did, once it is known what lies under it where the tool picks.
    void tell_tool(Tool::Event event, const Pointing& pointing);
    [[nodiscard]] ToolMouse::Tell tell() {
        return [this](Tool::Event event, const Pointing& pointing) { tell_tool(event, pointing); };
    }
    void perform_tool();
    void clicked(const Click& click);
    void click_on(Click::Kind kind, const render::Pick& pick);
    void right_click_on(const Pointing& pointing);
    void open_context_menu(const render::Pick& pick);
    void run(const Command& command);

    ViewerState& state_;
    PictureView& picture_;
    ImguiInput input_;
    ViewportMouse mouse_;
    ToolMouse tool_mouse_;
    std::weak_ptr<std::vector<glm::dvec2>> moves_; // that wait, nothing else after them
    std::size_t viewport_ = 0;                     // see in_viewport()
    glm::dvec2 pointer_{-1.0};
    double wipe_grip_ = 0.0; // from the line to where it was taken, pixels
    bool pointer_over_picture_ = false;
    bool pick_wanted_ = false, pick_pending_ = false;
    int tools_taken_ = 0; // another tool is told nothing of what was done before it was taken
};

} // namespace ramus::app
