// Interface: everything drawn around the picture with ImGui, and what it remembers between frames beside the session.
// It needs an ImGui context and nothing of a window: `ramus render --ui` draws the same one.
#pragma once

#include "app/actions/command_runner.h"
#include "app/panels/branch_list.h"
#include "app/panels/open_dialog.h"
#include "app/panels/overview.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/slider_row.h"
#include "app/panels/volume_dialog.h"
#include "app/panels/widgets.h"
#include "app/picture/lesion_lines.h"
#include "app/session/warnings.h"
#include "app/session/window_words.h"
#include "app/storage/settings.h"
#include "app/tools/tool_kinds.h"
#include "app/workspace/workspace.h"

#include <array>
#include <cstdint>
#include <deque>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ramus::app {

// Where things are, in pixels from the top left.
struct Layout {
    glm::ivec2 window{0};
    int bar_height = 0;
    int status_height = 0;
    int panel_width = 0;                 // 0 when it is closed
    int overview_height = 0;             // likewise; it lies under the picture
    glm::ivec2 view_at{0}, view_size{1}; // the picture
    // Its viewports: their corners in the picture, and the size of each. One, nearly always.
    std::vector<glm::ivec2> viewports_at{glm::ivec2(0)};
    glm::ivec2 viewport_size{1};
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

// What was written last, until it is put away.
struct Written {
    bool open = false;
    std::filesystem::path file;
    std::string sentence;
};

// What an export would look like, as the dialog shows it.
struct FigurePreview {
    // Asked for by the dialog: of a file of this size, drawn in so many pixels.
    bool wanted = false;
    FigureRequest request;
    glm::ivec2 most{1};
    // What the window has made of it: a texture; 0: nothing yet.
    unsigned texture = 0;
    glm::ivec2 size{1};
    std::string trouble;
};

// The field for the name of a branch, of a system, or of an object of the scene.
struct Rename {
    bool open = false;
    bool fresh = false; // the keyboard is not in it yet
    int branch = tree::kNoBranch;
    int system = -1;          // instead of a branch; -1: none
    std::string kind, number; // of an object of the scene, instead; empty: none
    std::array<char, 128> text{};
    bool subtree = false; // what depends on the branch is called so too
    void show(int id, const std::string& name, bool of_subtree = false);
    void show_system(int index, const std::string& name);
    void show_object(const std::string& object_kind, const std::string& object_number, const std::string& name);
};

// Asks for the radii of the selected branches.
struct RadiusDialog {
    bool open = false;
    bool fresh = false;  // the keyboard is not in it yet
    bool scales = false; // the number is a factor
    std::array<char, 32> text{};
};

// The bar for flying along the vessels.
struct Fly {
    bool open = false;
    bool playing = false;
    bool inside = false;
    int branch = tree::kNoBranch; // flies to its end
    double fraction = 0.0;
    double last = 0.0;          // seconds of draw_interface() when it flew last
    render::Camera camera;      // as the flight left it
    std::vector<int> selection; // the one that `branch` is from
};

// What the side panel shows: the tree and what is selected of it, how it is shown, or what is planned on it.
enum class PanelPage : std::uint8_t { kExplore, kSurface, kPlan };
[[nodiscard]] const char* key_of(PanelPage page); // of the command `panel`

// What the side panel's sliders and fields hold while they are being changed: the session hears of it when they are let
// go, so that it is one step of undo.
struct Editing {
    std::map<std::string_view, widgets::Slider<float>> options; // by the key of a SurfaceOption
    std::set<std::string_view> shown_options; // that are seen only when set; once seen they stay, for what is below
    widgets::Slider<float> glass_opacity, glass_grey, blend, wipe;
    // Of one entry of the context, counted from 1, its colour or its opacity.
    struct Context {
        int of = -1;
        ContextItem item;
        int opacity_of = -1; // whose slider the mouse has
        float opacity = 0.0F;
    } context;
    // Of one system, from 0, its colour while the picker is open.
    struct System {
        int of = -1;
        std::array<std::uint8_t, 3> colour{};
    } system;
    // One field for numbers has the keyboard at a time.
    struct Numbers {
        std::string field; // its id; empty: none
        std::array<char, 64> typed{};
    } numbers;
    std::string thin;           // diameter below which vessels are thin, as it was typed; empty: the usual one
    std::string colours_before; // what colours said before they said distances to lesions; empty: the usual
};

// What the import doctor's panel remembers.
struct Doctor {
    bool open = false;
    bool mark = true;    // in the picture
    int current = -1;    // the note that was gone to; -1: none
    bool voxels = false; // the field for a size of voxels is there
    std::array<char, 64> voxel{};
    std::array<char, 32> radius{}; // of what has none; also where a file cannot be opened without
    bool of_mask = false;          // the tree was made of one
    bool place = false;            // the field for the root's place is there
    std::array<char, 64> root{};
    widgets::Slider<float> bulge_size, islands;
};

// The field that finds commands by words.
struct CommandPalette {
    bool open = false;
    bool fresh = false;                // the keyboard is not in it yet
    int chosen = 0;                    // of those found
    const Command* asks_for = nullptr; // whose arguments the field is for; null: it is for words
    std::string trouble;               // with the arguments
    std::array<char, 256> typed{};
    void toggle(); // opens it empty, or closes it
};

// The menu of the right button.
struct ContextMenu {
    bool wanted = false, open = false, close = false; // it shall come; it is there; it shall go
    int branch = tree::kNoBranch;                     // that it is about; kNoBranch: the view
};

// The panel that asks for what a file does not say.
struct UnitsPanel {
    bool open = false;
    std::string unit = "open"; // a name, "voxels", or "open": nobody says it
    std::array<char, 64> voxel{};
    std::array<std::optional<io::Side>, 3> sides{};                   // that x, y, z lead to; never two on one line
    void show(const io::ReadOptions& options);                        // said_of() the document
    [[nodiscard]] std::optional<io::Orientation> orientation() const; // none: not all three are chosen
    // What the picture of a tree that is read so calls its axes while the choice is tried; none: as ever.
    [[nodiscard]] std::optional<render::AxisNames> axes(const tree::Claims& claims,
                                                        const io::ReadOptions& options) const;
};

// What a person has said of the document's file: its reading; without a tree, the unit that all context has been given.
[[nodiscard]] io::ReadOptions said_of(const Document& document);

// The list of what a person should know.
struct WarningsPanel {
    bool open = false;
    WarningList list;
};

// What the list of contacts remembers.
struct ContactList {
    bool open = false;
    int current = -1;                                     // that was gone to; -1: none
    std::shared_ptr<const std::vector<tree::Contact>> of; // what `current` counts in
};

// What the validation's panel remembers.
struct ValidationList {
    bool open = false;
    int current = -1;                               // the finding that was gone to; -1: none
    std::shared_ptr<const std::vector<Finding>> of; // what `current` counts in
};

// What a person waits for, so long that it is told.
enum class Preparing : std::uint8_t { kNothing, kFirstPicture, kPicture, kOtherCase };

// The panel of a first start.
struct Welcome {
    bool open = false, shown = false; // shown: in the last frame
};

struct Interface {
    bool panel_open = true;
    // A menu of the bar: it shall come; it is there; it shall go.
    bool want_menu = false, menu_open = false, close_menu = false;
    int menu_keys = 0;         // frames for which menus have the arrow keys
    bool menu_by_keys = false; // F10 has opened them: the arrows stay theirs between two menus
    bool menu_focused = false; // the bar has the keyboard
    std::string open_menu;     // of the bar; empty: none
    bool menu_entry = false;   // an arrow has gone from the menu into its entries
    int menu_step = 0;         // how many menus further left and right lead
    PanelPage page = PanelPage::kExplore;
    float panel_points = 296.0F;         // how wide it wants to be
    float explore_height = 0.0F;         // of what stands above the table of branches, in pixels, as drawn last
    glm::vec2 card_size{250.0F, 150.0F}; // of the card about the branch under the pointer, as drawn last
    std::vector<Covered> covered;        // in this frame
    bool help_open = false;
    std::array<char, 64> help_search{};
    Settings settings;
    std::vector<std::filesystem::path> recent_files; // newest first
    CommandPalette palette;
    ContextMenu context_menu;
    OpenDialog open_dialog;
    FigurePreview preview;
    RecoveryDialog recovery;
    UnsavedDialog unsaved;
    QuitDialog quit;
    VolumeDialog volume;
    float volume_progress = 0.0F; // of reading what it is about
    std::deque<Error> errors;     // of files, shown one after the other in a dialog
    Notice notice;
    Written written;
    int hovered = tree::kNoBranch; // under the pointer in the picture
    bool nothing_in_view = false;  // of all that there is
    Preparing preparing = Preparing::kNothing;
    std::vector<render::Legend> legends; // of the picture that is shown, which may be of a moment ago
    bool tooltip = false;                // the pointer rests on the picture
    int listed = tree::kNoBranch;        // under the pointer in the list of branches
    PointedLesion listed_lesion;         // under the pointer among the lesions
    BranchList list;
    Rename rename;
    RadiusDialog radius;
    Fly fly;
    // Of these six one is open at the most.
    Welcome welcome;
    Doctor doctor;
    WarningsPanel warnings;
    UnitsPanel units_panel;
    ContactList contacts;
    ValidationList validation;
    std::optional<GlassLook> tried_glass;                  // while a slider is held
    std::optional<std::vector<ContextItem>> tried_context; // likewise
    std::optional<double> tried_blend, tried_wipe;         // likewise
    bool wipe_held = false;                                // the line is dragged in the picture
    Editing editing;
    Overview overview;
    PictureLook picture; // as it was drawn last
    const ToolKind* tool_kind = &tool_kinds().front();
    std::unique_ptr<Tool> tool; // null: the mouse turns the view
    ToolSettings tool_settings;
    ToolDrawing tool_drawing; // of the tool, for this frame
    CommandLine last_command; // that the tool or a panel gave

    void tell(std::string text, double now, bool trouble = false) {
        notice = {window_words(std::move(text)), now + 5.0, trouble};
    }
    // What is about a file or a place stays in the list of warnings, too.
    void tell(const Error& error, const Lengths& lengths, double now) {
        tell(lengths.worded(error.message()), now, true);
        if (!error.where.empty()) warnings.list.add(in_window_words(error));
    }
    void warn(Warning warning, double now) {
        tell(warning.what, now, true);
        warning.what = window_words(std::move(warning.what));
        warning.remedy = window_words(std::move(warning.remedy));
        warnings.list.add(std::move(warning));
    }
    // One panel lies over the picture's left edge at a time; null: none.
    void open_left_panel(bool* panel) {
        for (bool* each :
             {&welcome.open, &doctor.open, &contacts.open, &units_panel.open, &warnings.open, &validation.open})
            *each = each == panel;
    }
    // Whether left and right lead from menu to menu.
    [[nodiscard]] bool steps_menus() const { return menu_by_keys && !open_menu.empty() && !menu_entry; }
    [[nodiscard]] bool menus_have_keys() const { return want_menu || menu_keys > 0; }
    [[nodiscard]] bool between_menus() const { return menu_keys > 0 && !menu_open && !context_menu.open; }
    [[nodiscard]] bool dialog_open() const {
        return help_open || palette.open || rename.open || radius.open || open_dialog.open || recovery.open ||
               unsaved.open() || quit.open() || volume.open() || !errors.empty();
    }
    void note_covered(); // by the window that ImGui is in
    bool dismiss();      // closes what lies on top; false: nothing does
    void forget_tree();  // another one was opened
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

// The parts, one file each.
void draw_menu_bar(InterfaceContext& context);
void draw_welcome(InterfaceContext& context);
void draw_tool_drawing(InterfaceContext& context);
void draw_tool_bar(InterfaceContext& context);
void draw_side_panel(InterfaceContext& context);
void draw_mask_row(InterfaceContext& context, const Comparison& comparison); // its mask
// Returns how far down the section wants to reach, from the upper end of what scrolls, in pixels.
float draw_selection(InterfaceContext& context); // as high for one branch, several and none
void draw_branch_list(InterfaceContext& context);
[[nodiscard]] float least_branch_list_height(const BranchList& list); // with its title, in pixels
void draw_branch_window(InterfaceContext& context);                   // the list in a window of its own
void draw_overview(InterfaceContext& context);
void draw_fly(InterfaceContext& context);
void draw_doctor(InterfaceContext& context);
void draw_units_panel(InterfaceContext& context);
void draw_warnings(InterfaceContext& context);
// The mark in the status bar, left of what begins at `right_edge`; returns where it begins itself.
[[nodiscard]] float draw_warning_mark(InterfaceContext& context, float right_edge);
// How many branches are selected, defocused and hidden, with the way back; likewise.
[[nodiscard]] float draw_state_marks(InterfaceContext& context, float right_edge);
void draw_contacts(InterfaceContext& context);
void draw_validation(InterfaceContext& context);
[[nodiscard]] widgets::Fact
contacts_fact(InterfaceContext& context); // in the side panel: how many there are, and the way there
void draw_mask_reading(InterfaceContext& context, const io::MaskReading& mask); // in the import doctor's panel
[[nodiscard]] widgets::Fact
doctor_fact(InterfaceContext& context); // in the side panel: what there is to see, and the way there
void draw_rename(InterfaceContext& context);
void draw_radius(InterfaceContext& context);
void draw_status_bar(InterfaceContext& context);
void draw_tooltip(InterfaceContext& context);
// Where a card of this size, in pixels, hides neither the pointer's surroundings nor tools, scale bar, cube, panel,
// status line and `covered` parts of the picture: right below the pointer, or on another side of it.
[[nodiscard]] glm::vec2 card_corner(const Layout& layout, const std::vector<Covered>& covered, glm::vec2 pointer,
                                    glm::vec2 size, float scale);
void draw_branch_tooltip(InterfaceContext& context, int id); // at the pointer, wherever that is
void draw_help(InterfaceContext& context);
void draw_command_palette(InterfaceContext& context);
void draw_context_menu(InterfaceContext& context);
void draw_open_dialog(InterfaceContext& context);
// What is exported, and how; the name follows the format. As high for every kind, so that the files below stay.
void draw_export_page(InterfaceContext& context, OpenDialog& dialog);
void draw_error_dialog(InterfaceContext& context);
void draw_recovery_dialog(InterfaceContext& context);
void draw_unsaved_dialog(InterfaceContext& context);
void draw_quit_dialog(InterfaceContext& context);
void draw_volume_dialog(InterfaceContext& context);
void draw_written(InterfaceContext& context);

} // namespace ramus::app
