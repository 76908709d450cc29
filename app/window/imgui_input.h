// ImguiInput: passes mouse and keyboard events to ImGui one change at a time. ImGui 1.86 reads only the state at the
// beginning of a frame, so a press and its release within one frame would be lost; here the second change of a key or
// button waits for the next frame.
#pragma once

#include <deque>
#include <imgui.h>

namespace ramus::app {

class ImguiInput {
public:
    void move(float x, float y);
    void button(int index, bool down); // 0 left, 1 right, 2 middle
    void wheel(float dx, float dy);
    void key(int key, bool down); // GLFW's number; a repeat counts as down
    void modifiers(bool ctrl, bool shift, bool alt, bool super);
    void character(unsigned codepoint);
    void leave(); // the pointer left the window

    // Before ImGui::NewFrame(). False: some events wait for another frame.
    bool apply(ImGuiIO& io);

private:
    struct Event {
        enum class Kind { kMove, kButton, kWheel, kKey, kModifiers, kCharacter } kind;
        float x = 0.0F, y = 0.0F;
        int index = 0;
        bool down = false;
        bool ctrl = false, shift = false, alt = false, super = false;
    };
    std::deque<Event> events_;
    Event held_{.kind = Event::Kind::kModifiers}; // the latest modifiers
};

// Whether the interface of the last frame handles the mouse at this position: a window, an open popup, or a drag that
// began in one. ImGui's WantCaptureMouse refers to the pointer's position in the last frame, and would misdirect a
// press that arrives together with a move.
[[nodiscard]] bool interface_takes_mouse(float x, float y);

// ImGui's navigation keys are GLFW's.
void map_keys(ImGuiIO& io);

} // namespace ramus::app
