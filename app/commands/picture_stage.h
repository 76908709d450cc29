// PictureStage: a document with what `ramus render` needs to draw it without a window. It is the Host of the commands
// in a commands file; the surface follows the options that commands set, computed when a picture is next needed.
#pragma once

#include "app/actions/command_table.h"
#include "app/commands/surface_flags.h"
#include "app/picture/compose.h"
#include "app/workspace/surface_maker.h"
#include "render/renderer.h"

namespace ramus::app {

class PictureStage final : public Host {
public:
    PictureStage(Document& document, const SurfaceFlags& flags, Viewing viewing)
        : document_(document), flags_(flags), viewing_(viewing) {}

    // Computes the surface of the session's options, without its hidden branches, unless it is there already.
    Result<void> make_surface();
    void draw_with(render::Renderer& renderer) { renderer_ = &renderer; }
    [[nodiscard]] Result<render::Frame> frame();
    [[nodiscard]] const ReadySurface& surface() const { return surface_; }

    // Host
    [[nodiscard]] glm::ivec2 picture_size() const override { return viewing_.size; }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return surface_.mesh; }
    Result<render::BranchPicture> branch_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size) override;
    void say(const std::string& sentence) override;

private:
    Document& document_;
    const SurfaceFlags& flags_;
    Viewing viewing_;
    render::Renderer* renderer_ = nullptr;
    ReadySurface surface_;
};

} // namespace ramus::app
