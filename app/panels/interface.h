// Interface: everything drawn around the picture with ImGui, and what it remembers between frames beside the session.
// It needs an ImGui context and nothing of a window: `ramus render --ui` draws the same one.
#pragma once

#include "app/actions/command_runner.h"
#include "app/panels/overview.h"
#include "app/panels/panel_states.h"
#include "app/panels/widgets.h"
#include "app/picture/lesion_lines.h"
#include "app/picture/scene_objects.h"
#include "app/session/warnings.h"
#include "app/session/window_words.h"
#include "app/storage/settings.h"
#include "app/tools/tool_kinds.h"
#include "app/workspace/workspace.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <typeindex>
#include <utility>
#include <vector>

namespace ramus::app {

// Where things are, in pixels from the top left.
struct Layout {
    glm::ivec2 window{0};
    int bar_height = 0;
    int status_height = 0;
    int panel_width = 0;                 // 0 when it is closed
    int overview_height = 0;             // 0 when it is closed; below the picture
    glm::ivec2 view_at{0}, view_size{1}; // the picture
    // Its viewports without slices: their corners in the picture, and the size of each. One, nearly always.
    std::vector<glm::ivec2> viewports_at{glm::ivec2(0)};
    glm::ivec2 viewport_size{1};
    std::optional<std::size_t> current_plan_in{}; // the viewport of the current plan, where plans are compared
    // Its slices, in the order of their viewports.
    struct SliceAt {
        slice::Direction direction = slice::Direction::kAxial;
        bool along = false; // the picture along a vessel instead
        glm::ivec2 at{0}, size{1};
    };
    std::vector<SliceAt> slices_at{};
};
// How high and wide these want to be; `overview_points` 0: closed.
[[nodiscard]] Layout layout_of(glm::ivec2 window, float scale, bool panel_open, float overview_points = 0.0F,
                               float panel_points = 296.0F);

// A part of the picture that a panel lies over, in pixels of the window.
struct Covered {
    glm::vec2 from{0.0F}, to{0.0F};
};

struct Notice {
    std::string text;
    double until = 0.0; // in the seconds of draw_interface()
    bool trouble = false;
};

// What the side panel shows: the tree and what is selected of it, how it is shown, or what is planned on it.
enum class PanelPage : std::uint8_t { kExplore, kSurface, kSlices, kPlan };
inline constexpr std::array kPanelPages{PanelPage::kExplore, PanelPage::kSurface, PanelPage::kSlices, PanelPage::kPlan};
[[nodiscard]] const char* key_of(PanelPage page); // of the command `panel`

// What a person waits for, so long that it is told.
enum class Preparing : std::uint8_t { kNothing, kFirstPicture, kPicture, kOtherCase };

struct Interface {
    PanelStates states;
    bool panel_open = true;
    PanelPage page = PanelPage::kExplore;
    float panel_points = 296.0F;         // how wide it wants to be
    float explore_height = 0.0F;         // of what stands above the table of branches, in pixels, as drawn last
    glm::vec2 card_size{250.0F, 150.0F}; // of the card about the branch under the pointer, as drawn last
    std::vector<Covered> covered;        // in this frame
    Settings settings;
    std::vector<std::filesystem::path> recent_files; // newest first
    Notice notice;
    int hovered = tree::kNoBranch; // under the pointer in the picture
    bool nothing_in_view = false;  // of all that there is
    Preparing preparing = Preparing::kNothing;
    std::vector<render::Legend> legends;           // of the picture that is shown, which may be of a moment ago
    bool tooltip = false;                          // the pointer rests on the picture
    int listed = tree::kNoBranch;                  // under the pointer in the list of branches
    std::optional<ObjectPlace> pointed;            // object of the scene under the pointer in the picture
    std::optional<glm::dvec3> slice_place;         // under the pointer on a slice, mm
    PointedLesion listed_lesion;                   // under the pointer among the lesions
    std::optional<GlassLook> tried_glass;          // while a slider is held
    std::optional<double> tried_territories;       // their opacity, while its slider is held
    std::optional<SceneObjects> tried_objects;     // while a slider is held or a colour is chosen
    std::optional<double> tried_blend, tried_wipe; // while a slider is held
    bool wipe_held = false;                        // the line is dragged in the picture
    PictureLook picture;                           // as it was drawn last
    const ToolKind* tool_kind = &tool_kinds().front();
    std::unique_ptr<Tool> tool; // null: the mouse turns the view
    ToolSettings tool_settings;
    ToolDrawing tool_drawing; // of the tool, for this frame
    CommandLine last_command; // that the tool or a panel gave

    template <class State> [[nodiscard]] State& of() { return states.of<State>(); }
    template <class State> [[nodiscard]] const State& of() const { return states.of<State>(); }
    // One panel at a time lies over the picture's left edge: that of this state.
    template <class State> [[nodiscard]] bool left_is() const { return left_panel == typeid(State); }
    template <class State> void show_left(bool shown = true) {
        if (shown)
            left_panel = typeid(State);
        else if (left_is<State>())
            close_left();
    }
    void close_left() { left_panel = typeid(void); }

    void tell(std::string text, double now, bool trouble = false);
    // What is about a file or a place stays in the list of warnings, too.
    void tell(const Error& error, const Lengths& lengths, double now);
    void warn(Warning warning, double now);
    [[nodiscard]] bool between_menus() const;
    [[nodiscard]] bool dialog_open() const;
    void note_covered(); // by the window that ImGui is in
    bool dismiss();      // closes what lies on top; false: nothing does
    void forget_tree();  // another one was opened

    std::type_index left_panel = typeid(void); // void: none
};

struct InterfaceContext {
    Interface& interface;
    Workspace& workspace;
    ActionContext& actions;
    CommandRunner& commands;
    const Layout& layout;
    double now; // seconds, any origin

    // As the menus do; a refusal becomes a notice.
    void perform(const Command& command);
    void perform(std::string_view name, const std::vector<std::string>& arguments);
};

// Between ImGui::NewFrame() and ImGui::Render().
void draw_interface(InterfaceContext& context);

// A title of the panel with buttons that run commands.
void draw_title(InterfaceContext& context, const char* title, std::initializer_list<widgets::TitleButton> buttons);
// The same for a section that a click on its title closes. False: it is closed.
[[nodiscard]] bool draw_section(InterfaceContext& context, const char* title,
                                std::initializer_list<widgets::TitleButton> buttons);
[[nodiscard]] bool is_closed(InterfaceContext& context, const char* title);

// Where a card of this size, in pixels, hides neither the pointer's surroundings nor tools, scale bar, cube, panel,
// status line and `covered` parts of the picture: right below the pointer, or on another side of it.
[[nodiscard]] glm::vec2 card_corner(const Layout& layout, const std::vector<Covered>& covered, glm::vec2 pointer,
                                    glm::vec2 size, float scale);

} // namespace ramus::app
