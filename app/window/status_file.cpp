#include "app/window/status_file.h"

#include "app/session/session_file.h"
#include "core/io/output_file.h"

#include <nlohmann/json.hpp>

namespace ramus::app {

void StatusFile::update(const Viewer& viewer, const Workspace& workspace) {
    if (path_.empty()) return;
    const Layout& layout = viewer.layout();
    const Interface& interface = viewer.interface();
    nlohmann::json status = to_json(workspace.document.session(), "/");
    status["window"] = {layout.window.x, layout.window.y};
    status["viewport"] = {layout.view_at.x, layout.view_at.y, layout.view_size.x, layout.view_size.y};
    status["surface_ready"] = workspace.surface_ready();
    const ReadySurface& shown = workspace.shown();
    status["triangles"] = shown.mesh ? shown.mesh->triangle_count() : 0;
    const bool cones = shown.request.options.method == mesh::Method::kTruncatedCones;
    status["shown"] = !shown.mesh ? "nothing" : cones ? "cones" : shown.provisional ? "preview" : "surface";
    status["picture"] = {{"of", viewer.picture().cast() ? "centerlines" : "mesh"},
                         {"width", viewer.picture().pictured_width()},
                         {"refined", viewer.refined()}};
    status["problem"] = workspace.surface_problem();
    status["resting"] = viewer.resting();
    status["hovered"] = interface.hovered;
    status["tooltip"] = interface.tooltip && interface.hovered != tree::kNoBranch;
    status["tool"] = interface.tool_kind->name;
    status["tool_busy"] = interface.tool && interface.tool->busy();
    status["last_command"] = interface.last_command;
    status["lasso"] = {{"mode", interface.tool_settings.lasso_any_part ? "any" : "half"},
                       {"depth", interface.tool_settings.lasso_visible ? "visible" : "through"}};
    status["planning"] = interface.planning;
    status["help"] = interface.help_open;
    status["open_dialog"] = interface.open_dialog.open;
    const Document& document = workspace.document;
    status["modified"] = document.modified();
    status["undo"] = document.can_undo() ? document.step_name(document.position() - 1) : "";
    status["redo"] = document.can_redo() ? document.step_name(document.position()) : "";
    status["save_dialog"] = interface.open_dialog.open && interface.open_dialog.purpose == FilePurpose::kSave;
    status["unsaved_dialog"] = interface.unsaved.open();
    status["recovery_dialog"] = interface.recovery.open;
    status["recoveries"] = interface.recovery.entries.size();
    status["error"] = interface.errors.empty() ? "" : interface.errors.front().message();
    status["notice"] = interface.notice.text;
    if (viewer.controls()) status["controls"] = *viewer.controls();
    std::string text = status.dump() + "\n";
    if (text == written_) return;
    written_ = std::move(text);
    (void)io::write_file(path_, written_); // a script that misses its file will say so
}

} // namespace ramus::app
