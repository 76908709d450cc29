// CaseStage: a tree or a session as a command without a window opens it to write the whole case: with its surface, a
// camera, commands of a file, and a renderer for pictures.
#pragma once

#include "app/actions/action.h"
#include "app/commands/backend_flags.h"
#include "app/commands/colour_flags.h"
#include "app/commands/picture_stage.h"
#include "app/commands/surface_flags.h"

#include <filesystem>
#include <memory>
#include <string>

namespace ramus::app {

struct CaseFlags {
    SurfaceFlags common;
    std::filesystem::path file;    // empty: the session's tree
    std::string session, commands; // files; empty: none
    bool overwrite = false;        // the commands may replace files
    ColourFlags colours;
    BackendFlags backend;
};

// Adds FILE, --session, --commands and the options of surfaces, colours and OpenGL. The objects that parsing writes to
// must live as long as the command.
void add_case_flags(CLI::App& command, CaseFlags& flags);
// Throws CLI::Error for options that are missing or cannot be combined.
void check_case_flags(const CaseFlags& flags);

class CaseStage {
public:
    // Computes the surface and runs the commands. Without a camera in the session, all is seen from the front. `size`:
    // of pictures, pixels. `draws`: commands and callers may draw; otherwise there is no OpenGL. `flags` must outlive
    // the object.
    [[nodiscard]] static Result<std::unique_ptr<CaseStage>> open(const CaseFlags& flags, glm::ivec2 size, bool draws);

    [[nodiscard]] Document& document() { return document_; }
    [[nodiscard]] ActionContext& context() { return here_; }

private:
    CaseStage(const CaseFlags& flags, const Viewing& viewing);
    Result<void> open_document();
    Result<void> prepare(bool draws);

    const CaseFlags& flags_;
    std::unique_ptr<render::GlContext> gl_;
    std::unique_ptr<render::Renderer> renderer_;
    Document document_;
    bool has_camera_ = false;
    PictureStage stage_;
    ActionContext here_;
};

} // namespace ramus::app
