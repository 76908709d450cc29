#include "app/window/imgui_input.h"

#include <GLFW/glfw3.h>
#include <cfloat>
#include <imgui_internal.h>

namespace ramus::app {

namespace {
bool is_modifier(int key) { return key >= GLFW_KEY_LEFT_SHIFT && key <= GLFW_KEY_RIGHT_SUPER; }
} // namespace

void ImguiInput::move(float x, float y) {
    if (!events_.empty() && events_.back().kind == Event::Kind::kMove) events_.pop_back();
    events_.push_back({.kind = Event::Kind::kMove, .x = x, .y = y});
}
void ImguiInput::button(int index, bool down) {
    if (index < 3) events_.push_back({.kind = Event::Kind::kButton, .index = index, .down = down});
}
void ImguiInput::wheel(float dx, float dy) { events_.push_back({.kind = Event::Kind::kWheel, .x = dx, .y = dy}); }
void ImguiInput::key(int key, bool down) {
    // With a modifier's own key X11 reports the modifiers from before the event.
    const auto hold = [&](bool& modifier) {
        modifier = down;
        events_.push_back(held_);
    };
    if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) hold(held_.shift);
    if (key == GLFW_KEY_LEFT_CONTROL || key == GLFW_KEY_RIGHT_CONTROL) hold(held_.ctrl);
    if (key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT) hold(held_.alt);
    if (key >= 0 && key < 512) events_.push_back({.kind = Event::Kind::kKey, .index = key, .down = down});
}
void ImguiInput::modifiers(bool ctrl, bool shift, bool alt, bool super) {
    held_ = {.kind = Event::Kind::kModifiers, .ctrl = ctrl, .shift = shift, .alt = alt, .super = super};
    events_.push_back(held_);
}
void ImguiInput::character(unsigned codepoint) {
    events_.push_back({.kind = Event::Kind::kCharacter, .index = static_cast<int>(codepoint)});
}
void ImguiInput::leave() { move(-FLT_MAX, -FLT_MAX); }

bool interface_takes_mouse(float x, float y) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.OpenPopupStack.Size > 0) return true;
    for (int i = 0; i < IM_ARRAYSIZE(context.IO.MouseDown); ++i)
        if (context.IO.MouseDown[i] && context.IO.MouseDownOwned[i]) return true;
    for (const ImGuiWindow* window : context.Windows)
        if (window->Active && !window->Hidden && (window->Flags & ImGuiWindowFlags_NoMouseInputs) == 0 &&
            (window->Flags & ImGuiWindowFlags_ChildWindow) == 0 && window->OuterRectClipped.Contains({x, y}))
            return true;
    return false;
}

bool ImguiInput::apply(ImGuiIO& io) {
    bool keys_changed[512] = {};
    bool buttons_changed[3] = {};
    bool any_button = false, any_key = false;
    bool wheeled = false;
    while (!events_.empty()) {
        const Event& event = events_.front();
        switch (event.kind) {
        case Event::Kind::kMove:
            if (any_button || wheeled) return false; // clicks keep their position
            io.MousePos = {event.x, event.y};
            break;
        case Event::Kind::kButton:
            if (buttons_changed[event.index]) return false;
            buttons_changed[event.index] = any_button = true;
            io.MouseDown[event.index] = event.down;
            break;
        case Event::Kind::kWheel:
            wheeled = true;
            io.MouseWheelH += event.x;
            io.MouseWheel += event.y;
            break;
        case Event::Kind::kKey:
            if (keys_changed[event.index]) return false;
            keys_changed[event.index] = true;
            any_key = any_key || !is_modifier(event.index);
            io.KeysDown[event.index] = event.down;
            break;
        case Event::Kind::kModifiers:
            // Keys and buttons keep the modifiers that they came with: a change of modifiers waits for the next frame.
            if ((any_key || any_button) && (event.ctrl != io.KeyCtrl || event.shift != io.KeyShift ||
                                            event.alt != io.KeyAlt || event.super != io.KeySuper))
                return false;
            io.KeyCtrl = event.ctrl;
            io.KeyShift = event.shift;
            io.KeyAlt = event.alt;
            io.KeySuper = event.super;
            break;
        case Event::Kind::kCharacter:
            io.AddInputCharacter(static_cast<unsigned>(event.index));
            break;
        }
        events_.pop_front();
    }
    return true;
}

void map_keys(ImGuiIO& io) {
    io.KeyMap[ImGuiKey_Tab] = GLFW_KEY_TAB;
    io.KeyMap[ImGuiKey_LeftArrow] = GLFW_KEY_LEFT;
    io.KeyMap[ImGuiKey_RightArrow] = GLFW_KEY_RIGHT;
    io.KeyMap[ImGuiKey_UpArrow] = GLFW_KEY_UP;
    io.KeyMap[ImGuiKey_DownArrow] = GLFW_KEY_DOWN;
    io.KeyMap[ImGuiKey_PageUp] = GLFW_KEY_PAGE_UP;
    io.KeyMap[ImGuiKey_PageDown] = GLFW_KEY_PAGE_DOWN;
    io.KeyMap[ImGuiKey_Home] = GLFW_KEY_HOME;
    io.KeyMap[ImGuiKey_End] = GLFW_KEY_END;
    io.KeyMap[ImGuiKey_Insert] = GLFW_KEY_INSERT;
    io.KeyMap[ImGuiKey_Delete] = GLFW_KEY_DELETE;
    io.KeyMap[ImGuiKey_Backspace] = GLFW_KEY_BACKSPACE;
    io.KeyMap[ImGuiKey_Space] = GLFW_KEY_SPACE;
    io.KeyMap[ImGuiKey_Enter] = GLFW_KEY_ENTER;
    io.KeyMap[ImGuiKey_Escape] = GLFW_KEY_ESCAPE;
    io.KeyMap[ImGuiKey_KeyPadEnter] = GLFW_KEY_KP_ENTER;
    io.KeyMap[ImGuiKey_A] = GLFW_KEY_A;
    io.KeyMap[ImGuiKey_C] = GLFW_KEY_C;
    io.KeyMap[ImGuiKey_V] = GLFW_KEY_V;
    io.KeyMap[ImGuiKey_X] = GLFW_KEY_X;
    io.KeyMap[ImGuiKey_Y] = GLFW_KEY_Y;
    io.KeyMap[ImGuiKey_Z] = GLFW_KEY_Z;
}

} // namespace ramus::app
