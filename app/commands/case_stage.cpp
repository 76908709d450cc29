#include "app/commands/case_stage.h"

#include "app/actions/script.h"
#include "app/commands/command.h"
#include "app/commands/inputs.h"
#include "app/session/error_context.h"
#include "core/io/run_inputs.h"
#include "render/gl/gl_context.h"
#include "render/renderer/renderer.h"

#include <utility>
#include <vector>

namespace ramus::app {

void add_case_flags(CLI::App& command, CaseFlags& flags) {
    add_input(command, "FILE", "", flags.file, "Vessel tree; may be left out with --session");
    add_option(command, "--session", "FILE", flags.session,
               "This session: its tree, states, plans, measurements and camera");
    add_option(command, "--commands", "FILE", flags.commands,
               "Run these commands first, one per line (`select 12`, `hide`, ...)");
    command.add_flag("--overwrite", flags.overwrite, kOverwriteHelp)->needs("--commands");
    add_method_flag(command, false, [&flags](mesh::Method method) { flags.common.surface.method = method; });
    add_colour_flags(command, flags.colours);
    add_backend_flags(command, flags.backend);
    add_surface_flags(command, flags.common);
    add_system_flag(command, flags.common);
}

void check_case_flags(const CaseFlags& flags) {
    if (flags.file.empty() && flags.session.empty()) throw CLI::RequiredError("FILE or --session");
    check_backend_flags(flags.backend);
}

CaseStage::CaseStage(const CaseFlags& flags, const Viewing& viewing)
    : flags_(flags), stage_(document_, flags.common, viewing), here_{.document = document_,
                                                                     .picture = stage_,
                                                                     .assets = stage_.assets,
                                                                     .tell = [this](const std::string& line) {
                                                                         say(flags_.common, line);
                                                                     }} {}

Result<void> CaseStage::open_document() {
    io::note_input(flags_.file);
    io::note_input(flags_.session, io::InputKind::kSession);
    RAMUS_TRY(opened, open_session(flags_.file.string(), flags_.session, flags_.common));
    if (auto good = apply(flags_.colours, *opened.tree, opened.session.marks); !good) return good;
    document_.open(std::move(opened.tree), std::move(opened.session), nullptr, {}, std::move(opened.base));
    has_camera_ = opened.has_camera;
    return {};
}

Result<void> CaseStage::prepare(bool draws) {
    std::vector<ScriptLine> script;
    if (!flags_.commands.empty()) {
        RAMUS_TRY(read, read_script(flags_.commands));
        script = std::move(read);
    }
    if (auto opened = open_document(); !opened) return opened;
    if (auto made = with_file(stage_.make_surface(), document_.session().tree.path.string()); !made) return made;
    if (!has_camera_)
        document_.set_camera(
            render::camera_for(stage_.surface().mesh->positions(), render::View::kAnterior, stage_.picture_size()));
    if (draws) {
        RAMUS_TRY(gl, open_context(flags_.backend, flags_.common));
        gl_ = std::move(gl);
        RAMUS_TRY(renderer, render::Renderer::create(render::kGlassBytes, 0));
        renderer_ = std::move(renderer);
        stage_.draw_with(*renderer_);
    }
    return run_script(here_, script, flags_.commands, flags_.overwrite);
}

Result<std::unique_ptr<CaseStage>> CaseStage::open(const CaseFlags& flags, glm::ivec2 size, bool draws) {
    Viewing viewing;
    viewing.size = size;
    std::unique_ptr<CaseStage> stage(new CaseStage(flags, viewing));
    if (auto ready = stage->prepare(draws); !ready) return tl::unexpected(ready.error());
    return stage;
}

} // namespace ramus::app
