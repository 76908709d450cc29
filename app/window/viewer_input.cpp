// What the mouse and the keys do in a Viewer.
#include "app/window/viewer.h"

#include <algorithm>
#include <imgui.h>

namespace ramus::app {

void Viewer::mouse_moved(glm::dvec2 at) {
    pointer_ = at;
    input_.move(static_cast<float>(at.x), static_cast<float>(at.y));
    if (!mouse_.held() && !tool_mouse_.held()) enter_pane();
    if (mouse_.held()) {
        const auto camera = mouse_.move(workspace_.document.session().camera, picture_size(), in_pane(at));
        if (camera) move_camera(*camera);
        if (mouse_.dragging()) {
            interface_.hovered = tree::kNoBranch;
            interface_.tooltip = false;
        }
    } else if (interface_.tool && (tool_mouse_.held() || over_picture(at))) {
        tool_mouse_.move(*interface_.tool, pointing({}));
        perform_tool();
    }
    pick_wanted_ = true;
    shake();
}

void Viewer::mouse_left() {
    pointer_ = {-1.0, -1.0};
    input_.leave();
    pick_wanted_ = true;
    shake();
}

void Viewer::mouse_button(MouseButton button, bool down, Modifiers modifiers, double now) {
    now_ = now;
    // What is pressed is what is seen.
    if (down && glide_ && over_picture(pointer_)) move_camera(render::Camera(shown_camera_));
    const int index = button == MouseButton::kLeft ? 0 : button == MouseButton::kRight ? 1 : 2;
    if (tool_mouse_.held()) { // one button at a time
        if (!down && button == MouseButton::kLeft && interface_.tool) {
            tool_mouse_.release(*interface_.tool, pointing(modifiers));
            perform_tool();
            pick_wanted_ = true;
        }
    } else if (down && button == MouseButton::kLeft && interface_.tool && !mouse_.held() && over_picture(pointer_)) {
        tool_mouse_.press(*interface_.tool, pointing(modifiers), now);
        perform_tool();
    } else if (down && over_picture(pointer_))
        mouse_.press(button, modifiers, in_pane(pointer_));
    else if (!down && mouse_.held()) {
        if (const auto click = mouse_.release(button, in_pane(pointer_), now)) clicked(*click);
        pick_wanted_ = true;
    }
    // A press on the picture is also ImGui's: an open menu closes.
    input_.modifiers(modifiers.ctrl, modifiers.shift, modifiers.alt, false);
    input_.button(index, down);
    shake();
}

void Viewer::mouse_wheel(glm::dvec2 notches) {
    if (over_picture(pointer_) && notches.y != 0.0)
        move_camera(
            ViewportMouse::wheel(workspace_.document.session().camera, picture_size(), in_pane(pointer_), notches.y));
    else
        input_.wheel(static_cast<float>(notches.x), static_cast<float>(notches.y));
    pick_wanted_ = true;
    shake();
}

void Viewer::move_camera(const render::Camera& camera) {
    glide_.reset();
    workspace_.document.set_camera(camera);
}

Pointing Viewer::pointing(Modifiers modifiers) {
    return {.at = in_pane(pointer_),
            .modifiers = modifiers,
            .held = tool_mouse_.held(),
            .size = picture_size(),
            .pixel_ratio = scale_,
            .document = workspace_.document,
            .settings = interface_.tool_settings,
            .pick_at = [this](glm::dvec2 at) { return sheets_.pick(from_pane(at)); }};
}

void Viewer::perform_tool() {
    if (!interface_.tool) return;
    InterfaceContext context{interface_, workspace_, *this, layout_, now_};
    for (const CommandLine& line : interface_.tool->take_commands())
        context.perform(line.front(), {line.begin() + 1, line.end()});
}

Cursor Viewer::cursor() const {
    return interface_.tool && over_picture(pointer_) ? interface_.tool->cursor() : Cursor::kArrow;
}

void Viewer::clicked(const Click& click) {
    if (!workspace_.document.tree()) return;
    if (click.kind == Click::Kind::kSecondary) {
        if (interface_.tool) interface_.tool->right_click(pointing({}));
        perform_tool();
        return;
    }
    const render::Pick pick = sheets_.pick(from_pane(click.at));
    InterfaceContext context{interface_, workspace_, *this, layout_, now_};
    const bool hit = pick.branch >= 0 && pick.branch < workspace_.document.branch_count();
    const std::vector<std::string> id{std::to_string(pick.branch)};
    switch (click.kind) {
    case Click::Kind::kSelect:
        if (hit)
            context.perform("select", id);
        else
            context.perform("select-none", {});
        break;
    case Click::Kind::kSelectWithDependents:
        if (hit) context.perform("select-subtree", id);
        break;
    case Click::Kind::kAdd:
        if (hit) context.perform("select-add", id);
        break;
    case Click::Kind::kToggle:
        if (hit) context.perform("select-toggle", id);
        break;
    case Click::Kind::kCentre:
        if (!hit) break;
        move_camera(render::centred_on(workspace_.document.session().camera, pick.position));
        camera_leapt();
        break;
    case Click::Kind::kSecondary:
        break;
    }
}

void Viewer::run(const Command& command) {
    InterfaceContext context{interface_, workspace_, *this, layout_, now_};
    context.perform(command);
    shake();
}

void Viewer::key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers, double now) {
    now_ = now;
    input_.modifiers(modifiers.ctrl, modifiers.shift, modifiers.alt, false);
    input_.key(number, down);
    shake();
    if (!down || !press) return;
    const Command* command = command_for_key(spelling(*press));
    if (command == nullptr) return;
    const bool typing = ImGui::GetIO().WantTextInput;
    const bool plain = !press->ctrl && press->key.size() <= 1;
    if (typing && (plain || press->key == "Tab" || press->key == "Delete" || press->key == "Z" || press->key == "Y" ||
                   (press->ctrl && (press->key == "C" || press->key == "V"))))
        return;
    if (typing && press->key == "Escape" && !interface_.dialog_open()) return; // leaves the field, no more
    // Under a dialog only what closes it works.
    if (interface_.dialog_open() && command->name != "dismiss" && !(command->name == "help" && interface_.help_open))
        return;
    run(*command);
}

void Viewer::character(unsigned codepoint, double now) {
    now_ = now;
    input_.character(codepoint);
    shake();
    if (codepoint >= 128 || ImGui::GetIO().WantTextInput || interface_.dialog_open()) return;
    const char letter = static_cast<char>(codepoint);
    // Letters and digits came as keys already, with their modifiers.
    if ((letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z'))
        return;
    if (const Command* command = command_for_key(std::string(1, letter))) run(*command);
}

void Viewer::dropped(const std::filesystem::path& path) {
    InterfaceContext context{interface_, workspace_, *this, layout_, now_};
    // A mesh is a lesion for who is planning.
    const bool lesion = interface_.planning && can_be_lesion_mesh(path);
    const bool beside = workspace_.document.tree() && can_be_context(path.string());
    context.perform(lesion ? "lesion-mesh" : beside ? "context" : "open", {path.string()});
}

} // namespace ramus::app
