#include "app/window/status_file.h"

#include "app/panels/branch_list.h"
#include "app/panels/command_palette.h"
#include "app/panels/contacts_panel.h"
#include "app/panels/context_menu.h"
#include "app/panels/doctor_panel.h"
#include "app/panels/error_dialog.h"
#include "app/panels/help_overlay.h"
#include "app/panels/menu_bar.h"
#include "app/panels/open_dialog.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/rename_dialog.h"
#include "app/panels/units_panel.h"
#include "app/panels/validation_panel.h"
#include "app/panels/volume_dialog.h"
#include "app/panels/warnings_panel.h"
#include "app/panels/written_notice.h"
#include "app/session/session_file.h"
#include "app/window/tick_watch.h"
#include "app/window/viewer.h"
#include "core/io/json_text.h"
#include "core/io/output_file.h"
#include "render/gl/gl_objects.h"

#include <filesystem>
#include <fstream>
#include <imgui.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

constexpr double kQuestionSeconds = 0.02;

// The lists of notes and contacts with their current entries, and the measurements.
void add_lists(nlohmann::json& status, const Interface& interface, const Workspace& workspace) {
    status["doctor"] = {{"open", interface.left_is<Doctor>()}, {"note", interface.of<Doctor>().current + 1}};
    status["units_panel"] = interface.left_is<UnitsPanel>();
    status["warnings"] = {{"open", interface.left_is<WarningsPanel>()},
                          {"unread", interface.of<WarningsPanel>().list.unread()},
                          {"count", interface.of<WarningsPanel>().list.all().size()}};
    const tree::Claims& claims = workspace.document().claims();
    if (workspace.document().has_scene())
        status["claims"] = {{"units", claims.unit_word()}, {"orientation", claims.axes_word()}};
    const auto& contacts = workspace.assets().contacts.list;
    status["contacts"] = {{"open", interface.left_is<ContactList>()},
                          {"contact", interface.of<ContactList>().current + 1},
                          {"count", contacts ? static_cast<int>(contacts->size()) : -1}};
    const auto& findings = workspace.assets().validation.findings;
    status["validation"] = {
        {"open", interface.left_is<ValidationList>()},
        {"finding", interface.of<ValidationList>().current + 1},
        {"count", findings && !workspace.awaited(WorkKind::kValidation) ? static_cast<int>(findings->size()) : -1}};
    const SurfaceDeviation& deviation = workspace.assets().deviation;
    status["deviation_measured"] = deviation.valued_mesh != nullptr && !workspace.awaited(WorkKind::kDeviation);
    status["deviation_most_mm"] = deviation.most_mm;
    status["measured"] = nlohmann::json::array();
    if (workspace.assets().measurements)
        for (const Result<Measured>& found : workspace.assets().measurements->found)
            status["measured"].push_back(found ? found->sentence() : found.error().message());
    status["lesion_vessels"] = nlohmann::json::array();
    if (const auto& plan = workspace.assets().plan)
        for (const measure::LesionVessels& one : plan->vessels)
            status["lesion_vessels"].push_back({{"lesion", one.lesion + 1},
                                                {"branch", one.nearest.branch},
                                                {"distance", one.nearest.distance_mm},
                                                {"overlap", one.nearest.overlap_mm},
                                                {"contact_angle", one.contact.angle_deg},
                                                {"contact_length", one.contact.length_mm}});
    if (const auto& facts = workspace.document().facts()) {
        status["radius_mm"] = {facts->statistics.radius_mm.min, facts->statistics.radius_mm.max};
        status["notes"] = workspace.document().tree()->notes.size();
    }
}

// Which dialogs are open.
void add_dialogs(nlohmann::json& status, const Interface& interface) {
    status["help"] = interface.of<Help>().open;
    const CommandPalette& palette = interface.of<CommandPalette>();
    status["palette"] = {{"open", palette.open},
                         {"typed", palette.typed.data()},
                         {"chosen", palette.chosen},
                         {"trouble", palette.trouble}};
    status["menu"] = interface.of<BarMenus>().open || interface.of<ContextMenu>().open;
    status["open_menu"] = interface.of<BarMenus>().open_name;
    status["light_theme"] = interface.settings.light_theme;
    status["open_dialog"] = interface.of<OpenDialog>().open;
    status["rename"] = interface.of<Rename>().open && !interface.of<Rename>().fresh;
    status["save_dialog"] = interface.of<OpenDialog>().open && interface.of<OpenDialog>().purpose == FilePurpose::kSave;
    const ExportChoice& choice = interface.of<OpenDialog>().exported;
    const bool exporting =
        interface.of<OpenDialog>().open && interface.of<OpenDialog>().purpose == FilePurpose::kExport;
    status["export"] = exporting ? std::string(choice.kind().key) + " " + choice.format().extension : "";
    status["unsaved_dialog"] = interface.of<UnsavedDialog>().open();
    status["quit_dialog"] = interface.of<QuitDialog>().open();
    status["volume_dialog"] = {{"open", interface.of<VolumeDialog>().open()},
                               {"read", interface.of<VolumeDialog>().facts != nullptr}};
    status["recovery_dialog"] = interface.of<RecoveryDialog>().open;
    status["recoveries"] = interface.of<RecoveryDialog>().entries.size();
    const auto& written = interface.of<Written>();
    status["written"] = written.open ? written.file.string() : "";
    const auto& errors = interface.of<ErrorDialog>().errors;
    status["error"] = errors.empty() ? "" : errors.front().message();
}

// Unsaved work and the undo history.
void add_document(nlohmann::json& status, const Document& document) {
    status["modified"] = document.modified();
    status["session_file"] = document.file().string();
    status["branch_count"] = document.branch_count();
    status["pieces"] = document.tree() ? document.tree()->roots.size() : 0;
    status["undo"] = document.can_undo() ? document.step_name(document.position() - 1) : "";
    status["redo"] = document.can_redo() ? document.step_name(document.position()) : "";
}

// Where the parts of the picture are.
void add_layout(nlohmann::json& status, const Layout& layout) {
    status["window"] = {layout.window.x, layout.window.y};
    status["viewport"] = {layout.view_at.x, layout.view_at.y, layout.view_size.x, layout.view_size.y};
    status["viewports"] = nlohmann::json::array();
    for (const glm::ivec2 at : layout.viewports_at)
        status["viewports"].push_back(
            {layout.view_at.x + at.x, layout.view_at.y + at.y, layout.viewport_size.x, layout.viewport_size.y});
    status["slices_at"] = nlohmann::json::object();
    for (const Layout::SliceAt& part : layout.slices_at)
        status["slices_at"][part.along ? "along" : slice::name_of(part.direction)] = {
            layout.view_at.x + part.at.x, layout.view_at.y + part.at.y, part.size.x, part.size.y};
}

nlohmann::json to_json(const TickWatch::Gap& gap) {
    return {{"ended", gap.ended}, {"seconds", gap.seconds}, {"processor_seconds", gap.processor_seconds},
            {"doing", gap.doing}, {"waiting", gap.waiting}, {"command", gap.command}};
}

} // namespace

void StatusFile::look_for_question() {
    if (path_.empty()) return;
    std::ifstream file(path_ + ".ask");
    if (std::uint64_t asked = 0; file >> asked) asked_ = asked;
}

double StatusFile::wait_seconds() const {
    return path_.empty() ? std::numeric_limits<double>::infinity() : kQuestionSeconds;
}

void StatusFile::update(const Viewer& viewer, const Workspace& workspace, const TickWatch& watch) {
    if (path_.empty()) return;
    const Layout& layout = viewer.layout();
    const Interface& interface = viewer.interface();
    nlohmann::json status = to_json(workspace.document().session(), "/");
    add_layout(status, layout);
    if (const auto& place = interface.slice_place) status["slice_place"] = {place->x, place->y, place->z};
    status["surface_ready"] = workspace.surface_ready();
    status["all_shown"] = workspace.all_shown();
    const ReadySurface& shown = workspace.shown();
    status["triangles"] = shown.mesh ? shown.mesh->triangle_count() : 0;
    const bool cones = shown.request.options.method == mesh::Method::kTruncatedCones;
    status["shown"] = !shown.mesh ? "nothing" : cones ? "cones" : shown.provisional ? "preview" : "surface";
    status["picture"] = {{"of", viewer.picture().cast() ? "centerlines" : "mesh"},
                         {"width", viewer.picture().pictured_width()},
                         {"refined", viewer.refined()},
                         {"shown", viewer.picture().pictures()},
                         {"under_way", viewer.picture().under_way()}};
    status["waits_for_drawing"] = viewer.picture().waits();
    status["programs_made_here"] = render::gl_programs_made(); // by the window's own thread
    status["problem"] = workspace.surface_problem();
    status["resting"] = viewer.resting() && !viewer.script_left();
    status["script_left"] = viewer.script_left();
    status["hovered"] = interface.hovered;
    status["nothing_in_view"] = interface.nothing_in_view;
    if (const auto& bar = viewer.picture().scale_bar())
        status["scale_bar"] = {{"mm", bar->length_mm}, {"pixels", bar->pixels}, {"at", render::name_of_place(bar->at)}};
    else
        status["scale_bar"] = nullptr;
    status["tooltip"] = interface.tooltip && interface.hovered != tree::kNoBranch;
    status["tool"] = interface.tool_kind->name;
    status["tool_busy"] = interface.tool && interface.tool->busy();
    status["last_command"] = interface.last_command;
    status["lasso"] = {{"mode", interface.tool_settings.lasso_any_part ? "any" : "half"},
                       {"depth", interface.tool_settings.lasso_visible ? "visible" : "through"}};
    status["tool_texts"] = nlohmann::json::array();
    for (const auto& text : interface.tool_drawing.texts) status["tool_texts"].push_back(text.text);
    status["planning"] = interface.page == PanelPage::kPlan;
    status["page"] = key_of(interface.page);
    status["branch_window"] = interface.of<BranchList>().apart;
    add_lists(status, interface, workspace);
    add_dialogs(status, interface);
    add_document(status, workspace.document());
    status["typing"] = ImGui::GetIO().WantTextInput; // a field has the keyboard
    status["notice"] = interface.notice.text;
    status["longest_gap"] = to_json(watch.longest());
    status["gaps"] = nlohmann::json::array();
    for (const TickWatch::Gap& gap : watch.latest()) status["gaps"].push_back(to_json(gap));
    if (!viewer.commands().awaits()) known_ = asked_; // a click takes effect only after its pick
    status["answered"] = known_;
    if (viewer.controls()) status["controls"] = *viewer.controls();
    std::string text = io::printed_json(status, -1) + "\n";
    if (text == written_) return;
    written_ = std::move(text);
    (void)io::write_file(path_, written_); // a script will notice a missing file
}

} // namespace ramus::app
