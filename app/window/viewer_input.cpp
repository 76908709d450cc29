#include "app/window/viewer_input.h"

#include "app/panels/branch_list.h"
#include "app/panels/command_palette.h"
#include "app/panels/context_menu.h"
#include "app/panels/help_overlay.h"
#include "app/panels/menu_bar.h"
#include "app/session/numbers.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <span>
#include <utility>

namespace ramus::app {

bool ViewerInput::over_picture(glm::dvec2 at) const {
    const glm::dvec2 in = in_picture(at);
    return in.x >= 0.0 && in.y >= 0.0 && in.x < state_.layout.view_size.x && in.y < state_.layout.view_size.y &&
           !state_.interface.dialog_open() &&
           !interface_takes_mouse(static_cast<float>(at.x), static_cast<float>(at.y));
}

glm::dvec2 ViewerInput::from_viewport(glm::dvec2 at) const {
    const std::vector<Viewport> all = state_.viewports();
    return at + glm::dvec2(all[std::min(viewport_, all.size() - 1)].at);
}

glm::dvec2 ViewerInput::in_viewport(glm::dvec2 at) const { return in_picture(at) - from_viewport(glm::dvec2(0.0)); }

void ViewerInput::enter_viewport() {
    const glm::dvec2 at = in_picture(pointer_);
    const std::vector<Viewport> all = state_.viewports();
    viewport_ = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (at.x >= all[i].at.x && at.y >= all[i].at.y && at.x < all[i].at.x + all[i].size.x &&
            at.y < all[i].at.y + all[i].size.y)
            viewport_ = i;
}

// Tools and menus act on the current plan: that of the pointer's viewport becomes it.
void ViewerInput::use_plan_here() {
    const std::vector<Viewport> all = state_.viewports();
    const auto& plan = all[std::min(viewport_, all.size() - 1)].plan;
    if (plan && *plan != state_.workspace.document().marks().plans.place)
        state_.perform("plan-use", {std::to_string(*plan + 1)});
}

void ViewerInput::aim() {
    if (over_picture(pointer_))
        picture_.point(in_picture(pointer_), in_viewport(pointer_));
    else
        picture_.aim().point_nowhere();
}

void ViewerInput::settle() {
    if (picture_.gliding()) picture_.move_camera(render::Camera(picture_.shown_camera()));
}

// Without a visible point uses the focal point, at a minimum distance.
Grip ViewerInput::grip() {
    const render::Camera& camera = state_.workspace.document().session().camera;
    const auto mesh = picture_.picture_mesh();
    const double scene = mesh ? mesh->bounds().radius() : 1.0;
    const auto target = picture_.aim().target(camera);
    if (!target) {
        const glm::dvec3 forward = render::axes_of(camera).forward;
        const double away = std::max(render::depth_of(camera, camera.focal_point), 0.2 * scene);
        return Grip::at(camera.position + away * forward);
    }
    Grip grip{target->at, picture_.aim().goal(camera).value_or(target->at)};
    const bool vessel = target->on == Aim::On::kPointer && state_.interface.hovered != tree::kNoBranch;
    grip.least_mm = least_distance_mm(state_.workspace.document().tree().get(),
                                      vessel ? state_.interface.hovered : tree::kNoBranch, grip.goal, scene);
    return grip;
}

// Panning moves the point under the pointer along; pivots and targets of zooming stay.
void ViewerInput::drag_view(glm::dvec2 at) {
    const auto camera = mouse_.move(state_.workspace.document().session().camera, picture_.picture_size(), at);
    if (mouse_.dragging()) point_at(tree::kNoBranch, {});
    if (!camera) return;
    picture_.move_camera(*camera);
    if (mouse_.turning() || mouse_.zooming()) {
        picture_.hold_pivot(mouse_.turning() ? mouse_.grip().about : mouse_.grip().goal);
        aim();
    } else {
        picture_.aim().carry(*camera, at);
    }
}

void ViewerInput::take_pick() {
    if (!pick_pending_) return;
    const auto pick = picture_.poll_pick();
    if (!pick) return;
    pick_pending_ = false;
    if (!picture_.shows_tree() || pick->branch >= state_.workspace.document().branch_count()) return;
    plane_under_ = pointer_over_picture_ ? pick->plane : render::kNoPlane;
    if (!pointer_over_picture_ || mouse_.dragging() || !points_at_branches()) return point_at(tree::kNoBranch, {});
    const auto object = object_at(in_viewport(pointer_), *pick);
    point_at(object ? tree::kNoBranch : pick->branch, object);
}

std::optional<ObjectPlace> ViewerInput::object_at(glm::dvec2 in_viewport, const render::Pick& pick) const {
    if (slice_grip()) return {};
    const Document& document = state_.workspace.document();
    return object_under({document.session().camera, picture_.picture_size(), state_.scale, in_viewport, pick},
                        state_.workspace.assets(), document.marks());
}

void ViewerInput::point_at(int branch, const std::optional<ObjectPlace>& object) {
    Interface& interface = state_.interface;
    if (branch != interface.hovered || object != interface.pointed) state_.redraw();
    if (branch == tree::kNoBranch && !object) interface.tooltip = false;
    interface.hovered = branch;
    interface.pointed = object;
}

void ViewerInput::ask_pick() {
    if (!pick_wanted_ || mouse_.held() || state_.interface.wipe_held) return;
    pick_wanted_ = false;
    pointer_over_picture_ = over_picture(pointer_);
    state_.interface.tooltip = pointer_over_picture_ && points_at_branches() && picture_.shows_tree();
    if (!state_.interface.tooltip) return point_at(tree::kNoBranch, {});
    picture_.request_pick(in_picture(pointer_));
    pick_pending_ = true;
}

void ViewerInput::in_order(std::function<void()> event) {
    moves_.reset();
    state_.commands.run_after_awaited(*state_.actions, [this, event = std::move(event)] {
        state_.follow_tree(); // resets the tool for the new tree
        event();
        state_.redraw();
    });
}

// Consecutive moves wait together. They arrive faster than picks: a tool that picks receives only the latest.
void ViewerInput::mouse_moved(glm::dvec2 at) {
    input_.move(static_cast<float>(at.x), static_cast<float>(at.y));
    state_.redraw();
    if (const auto waiting = moves_.lock()) return waiting->push_back(at);
    const auto moves = std::make_shared<std::vector<glm::dvec2>>(1, at);
    in_order([this, moves] {
        const std::vector<glm::dvec2> all = std::exchange(*moves, {});
        const bool of_tool = state_.interface.tool && !mouse_.held() && !state_.interface.wipe_held;
        const bool last_counts = of_tool && state_.interface.tool->picks();
        for (const glm::dvec2& each : std::span(all).last(last_counts ? 1 : all.size())) move_to(each);
    });
    moves_ = moves;
}

void ViewerInput::move_to(glm::dvec2 at) {
    pointer_ = at;
    if (!mouse_.held() && !tool_mouse_.held() && !slice_mouse_.held() && !plane_mouse_.held()) enter_viewport();
    point_at_slice();
    point_at_plane();
    if (plane_mouse_.held()) {
        drag_plane();
    } else if (slice_mouse_.held()) {
        take(slice_mouse_.move(in_viewport(at)));
    } else if (state_.interface.wipe_held) {
        drag_wipe_line();
    } else if (mouse_.held()) {
        drag_view(in_viewport(at));
    } else if (state_.interface.tool && (tool_mouse_.held() || (over_picture(at) && tool_acts_here()))) {
        tool_mouse_.move(tell(), pointing({}));
    }
    if (!mouse_.held()) aim();
    pick_wanted_ = true;
}

void ViewerInput::mouse_left() {
    input_.leave();
    state_.redraw();
    in_order([this] {
        pointer_ = {-1.0, -1.0};
        picture_.aim().point_nowhere();
        point_at_plane();
        pick_wanted_ = true;
    });
}

void ViewerInput::mouse_button(MouseButton button, bool down, Modifiers modifiers, double now) {
    state_.now = now;
    in_order([this, button, down, modifiers, now] {
        if (down)
            press(button, modifiers, now);
        else
            release(button, modifiers, now);
    });
    // Passes presses on the picture to ImGui, too, so that open menus close.
    input_.modifiers(modifiers.ctrl, modifiers.shift, modifiers.alt, false);
    input_.button(button == MouseButton::kLeft ? 0 : button == MouseButton::kRight ? 1 : 2, down);
    state_.redraw();
}

// One button at a time.
void ViewerInput::press(MouseButton button, Modifiers modifiers, double now) {
    const bool over = over_picture(pointer_);
    if (over) {
        settle();
        state_.interface.of<ContextMenu>().wanted = false; // from an earlier click
    }
    if (state_.interface.wipe_held || tool_mouse_.held() || slice_mouse_.held() || plane_mouse_.held()) return;
    const bool left = button == MouseButton::kLeft && !mouse_.held();
    if (const auto slice = over && !mouse_.held() ? slice_grip() : std::nullopt; slice && !(left && tool_acts_here()))
        return press_slice(button, modifiers, *slice, now);
    if (left && on_wipe_line()) {
        const double width = state_.layout.view_size.x;
        wipe_grip_ = in_picture(pointer_).x - state_.workspace.document().marks().comparison.wipe * width;
        state_.interface.wipe_held = true;
        point_at(tree::kNoBranch, {});
    } else if (left && over && grab_plane()) {
        point_at(tree::kNoBranch, {});
    } else if (left && over && tool_acts_here()) {
        use_plan_here();
        tool_mouse_.press(tell(), pointing(modifiers), now);
    } else if (over) {
        mouse_.press(button, modifiers, in_viewport(pointer_), grip());
    }
}

void ViewerInput::release(MouseButton button, Modifiers modifiers, double now) {
    if (plane_mouse_.held()) {
        if (button == MouseButton::kLeft) release_plane();
    } else if (slice_mouse_.held()) {
        release_slice(button);
    } else if (state_.interface.wipe_held) {
        if (button == MouseButton::kLeft) drop_wipe_line();
    } else if (tool_mouse_.held()) {
        if (button != MouseButton::kLeft || !state_.interface.tool) return;
        tool_mouse_.release(tell(), pointing(modifiers));
        pick_wanted_ = true;
    } else if (mouse_.held()) {
        picture_.hold_pivot({});
        if (const auto click = mouse_.release(button, in_viewport(pointer_), now)) clicked(*click);
        pick_wanted_ = true;
    }
}

void ViewerInput::mouse_wheel(glm::dvec2 notches) {
    in_order([this, notches] { turn_wheel(notches); });
}

void ViewerInput::turn_wheel(glm::dvec2 notches) {
    const bool over = over_picture(pointer_) && notches.y != 0.0;
    if (const auto slice = over ? slice_grip() : std::nullopt) {
        turn_wheel_over_slice(*slice, notches.y);
    } else if (over && turn_wheel_over_plane(notches.y)) {
        point_at(tree::kNoBranch, {});
    } else if (over) {
        settle();
        // In empty space zooming in is ignored, zooming out is not.
        if (notches.y < 0.0 || !picture_.aim().sees_nothing()) {
            const render::Camera camera =
                ViewportMouse::wheel(state_.workspace.document().session().camera, grip(), notches.y);
            picture_.move_camera(camera);
            picture_.aim().carry(camera);
        }
    } else
        input_.wheel(static_cast<float>(notches.x), static_cast<float>(notches.y));
    pick_wanted_ = true;
}

Pointing ViewerInput::pointing(Modifiers modifiers) {
    std::optional<SlicePointing> slice = slice_pointing();
    const glm::ivec2 size = slice ? slice->grid.size : picture_.picture_size();
    return {.at = in_viewport(pointer_),
            .modifiers = modifiers,
            .held = tool_mouse_.held(),
            .size = size,
            .pixel_ratio = state_.scale,
            .document = state_.workspace.document(),
            .settings = state_.interface.tool_settings,
            .lesions = lesion_shapes(state_.workspace.assets(), state_.workspace.document().marks()),
            .slice = std::move(slice)};
}

void ViewerInput::look_up(glm::dvec2 in_picture, const std::function<void(const render::Pick&)>& then) {
    if (!picture_.shows_tree())
        return state_.await([this] { return picture_.shows_tree(); },
                            [this, in_picture, then] { look_up(in_picture, then); });
    const Deferred<std::optional<render::Pick>> pick = picture_.pick(in_picture);
    state_.await(pick.ready, [this, pick, then, tree = state_.workspace.document().tree()] {
        if (state_.workspace.document().tree() != tree) return; // an edit changes branch ids
        if (const auto found = pick.take()) return then(*found);
        const bool hovers = state_.interface.tool && !tool_mouse_.held();
        if (!hovers) state_.interface.tell("The picture has changed since: click again", state_.now);
    });
}

void ViewerInput::tell_tool(Tool::Event event, const Pointing& pointing) {
    const auto tell = [this, event, pointing, tool = tools_taken_](const render::Pick& under) {
        if (tool != tools_taken_ || !state_.interface.tool) return;
        Pointing known = pointing;
        known.under = under;
        if (pointing.slice) {
            // A drag may leave the slice.
            const glm::dvec2 at = pointing.at;
            const glm::dvec2 size(pointing.size);
            if (!(at.x >= 0.0 && at.y >= 0.0 && at.x < size.x && at.y < size.y)) known.under = {};
            known.under.position = pointing.slice->grid.place(at - 0.5);
        }
        (state_.interface.tool.get()->*event)(known);
        perform_tool();
    };
    if (state_.interface.tool->picks()) return look_up(from_viewport(pointing.at), tell);
    tell({});
}

void ViewerInput::perform_tool() {
    const bool holds = state_.interface.tool && state_.interface.tool->changes_while_held();
    if (holds && !in_step_) state_.workspace.document().begin_step(), in_step_ = true;
    if (state_.interface.tool) run_commands_of(*state_.interface.tool);
    if (in_step_ && !holds) state_.workspace.document().end_step("drag"), in_step_ = false;
}

void ViewerInput::run_commands_of(Tool& tool) {
    for (const CommandLine& line : tool.take_commands()) state_.perform(line.front(), {line.begin() + 1, line.end()});
}

Cursor ViewerInput::cursor() const {
    if (state_.interface.wipe_held || (!mouse_.held() && !tool_mouse_.held() && on_wipe_line()))
        return Cursor::kSideways;
    if (plane_mouse_.held() || plane_edge_) return Cursor::kHand;
    return over_picture(pointer_) && tool_acts_here() ? state_.interface.tool->cursor() : Cursor::kArrow;
}

void ViewerInput::clicked(const Click& click) {
    if (!state_.workspace.document().has_scene()) return;
    if (click.kind == Click::Kind::kSecondary) use_plan_here();
    look_up(from_viewport(click.at), [this, kind = click.kind, here = pointing({})](const render::Pick& under) {
        Pointing known = here;
        known.under = under;
        if (kind != Click::Kind::kSecondary) return click_on(kind, known);
        right_click_on(known);
    });
}

void ViewerInput::click_on(Click::Kind kind, const Pointing& pointing) {
    const render::Pick& pick = pointing.under;
    const auto object = object_at(pointing.at, pick);
    if (kind == Click::Kind::kCentre && object) return look_at(object->at);
    const bool hit = pick.branch >= 0 && pick.branch < state_.workspace.document().branch_count();
    if (!hit && pick.plane != render::kNoPlane && kind != Click::Kind::kCentre) return show_slices_at(pick.position);
    if (!hit) {
        // A click on a slice moves the crosshair, whatever is selected.
        if (kind == Click::Kind::kSelect && !slice_grip()) state_.perform("select-none", {});
        return;
    }
    if (kind == Click::Kind::kCentre) return look_at(pick.position);
    if (!slice_grip() && !state_.workspace.document().marks().scans.empty()) show_slices_at(pick);
    state_.perform(kind == Click::Kind::kSelect                 ? "select"
                   : kind == Click::Kind::kSelectWithDependents ? "select-subtree"
                   : kind == Click::Kind::kAdd                  ? "select-add"
                                                                : "select-toggle",
                   {std::to_string(pick.branch)});
}

void ViewerInput::look_at(const glm::dvec3& at) {
    picture_.move_camera(render::centred_on(state_.workspace.document().session().camera, at));
    picture_.camera_leapt();
}

void ViewerInput::right_click_on(const Pointing& pointing) {
    const bool taken = state_.interface.tool && state_.interface.tool->right_click(pointing);
    perform_tool();
    if (!taken) open_context_menu(pointing);
}

// Opens the menu for the object or the branch, and selects the branch first if necessary.
void ViewerInput::open_context_menu(const Pointing& pointing) {
    ContextMenu& menu = state_.interface.of<ContextMenu>();
    menu = {.wanted = true, .object = object_at(pointing.at, pointing.under), .slice = slice_spot(pointing.at)};
    state_.redraw();
    if (menu.object) return;
    const int branch = pointing.under.branch;
    const bool hit = branch >= 0 && branch < state_.workspace.document().branch_count();
    if (hit && !is_selected(state_.workspace.document().marks(), branch))
        state_.perform("select", {std::to_string(branch)});
    if (hit) menu.branch = branch;
}

void ViewerInput::run(const Command& command) {
    const bool magnifies = command.name == "zoom" && !command.scripted();
    if (magnifies && step_tool(command.preset.front() == "in" ? 1.0 : -1.0)) return;
    state_.context().perform(command);
}

void ViewerInput::key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers, double now) {
    state_.now = now;
    in_order([this, number, down, press, modifiers] { press_key(number, down, press, modifiers); });
}

void ViewerInput::press_key(int number, bool down, const std::optional<KeyPress>& press, Modifiers modifiers) {
    // ImGui moves between menus only after an entry has the keyboard focus.
    Interface& interface = state_.interface;
    // Arrows also work in menus opened by a click: moves the pointer's hover away, which would reopen the menu.
    if (down && press && !interface.of<BarMenus>().open_name.empty() && !interface.of<BarMenus>().by_keys &&
        (press->key == "Left" || press->key == "Right")) {
        interface.of<BarMenus>().by_keys = true;
        input_.leave();
    }
    if (down && press && interface.of<BarMenus>().steps()) {
        if (press->key == "Left" || press->key == "Right") {
            interface.of<BarMenus>().step += press->key == "Left" ? -1 : 1;
            return;
        }
        interface.of<BarMenus>().entry = press->key == "Down" || press->key == "Up";
    }
    input_.modifiers(modifiers.ctrl, modifiers.shift, modifiers.alt, false);
    input_.key(number, down);
    if (!down || !press) return;
    const Command* command = command_for_key(spelling(*press));
    if (command == nullptr) return;
    const bool typing = ImGui::GetIO().WantTextInput;
    const bool plain = !press->ctrl && press->key.size() <= 1;
    if (typing && (plain || press->key == "Tab" || press->key == "Delete" || press->key == "Z" || press->key == "Y" ||
                   (press->ctrl && (press->key == "C" || press->key == "V"))))
        return;
    // Arrows belong to the focused field, list or menu.
    const bool arrow = press->key == "Left" || press->key == "Right" || press->key == "Up" || press->key == "Down" ||
                       press->key.starts_with("Page");
    if (arrow && (typing || state_.interface.of<BranchList>().focused || state_.interface.of<BarMenus>().have_keys()))
        return;
    if (typing && press->key == "Escape" && !state_.interface.dialog_open()) return; // only leaves the field
    // With an open dialog only keys that close it work.
    if (state_.interface.dialog_open() && command->name != "dismiss" &&
        !(command->name == "help" && state_.interface.of<Help>().open) &&
        !(command->name == "palette" && state_.interface.of<CommandPalette>().open))
        return;
    run(*command);
}

void ViewerInput::character(unsigned codepoint, double now) {
    state_.now = now;
    in_order([this, codepoint] { type(codepoint); });
}

void ViewerInput::type(unsigned codepoint) {
    input_.character(codepoint);
    if (codepoint >= 128 || ImGui::GetIO().WantTextInput || state_.interface.dialog_open()) return;
    const char letter = static_cast<char>(codepoint);
    // Letters and digits came as keys already, with their modifiers.
    if ((letter >= '0' && letter <= '9') || (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z'))
        return;
    if (const Command* command = command_for_key(std::string(1, letter))) run(*command);
}

void ViewerInput::close() {
    in_order([this] { state_.actions->files->quit(); });
}

bool ViewerInput::points_at_branches() const {
    const auto& tool = state_.interface.tool;
    return !tool || tool->points_at_branches();
}

ToolDrawing ViewerInput::tool_drawing() {
    ToolDrawing drawing;
    if (tool_acts_here()) {
        const Pointing here = pointing(tool_mouse_.modifiers());
        drawing = state_.interface.tool->drawing(here);
        if (here.slice) drawing.part = ToolDrawing::Part{glm::ivec2(from_viewport(glm::dvec2(0.0))), here.size};
    }
    add_plane_outline(drawing);
    return drawing;
}

void ViewerInput::use_tool(std::string_view name) {
    const ToolKind* kind = find_tool(name);
    state_.interface.tool_kind = kind;
    state_.interface.tool = kind->make != nullptr ? kind->make() : nullptr;
    tool_mouse_.abandon();
    perform_tool(); // ends the step of what the tool before dragged
    ++tools_taken_;
    pick_wanted_ = true;
    state_.redraw();
}

} // namespace ramus::app
