// PictureStage: a document with what `ramus render` needs to draw it without a window. It is the Host of the commands
// in a commands file; the surface follows the options that commands set, computed when a picture is next needed.
#pragma once

#include "app/command_table.h"
#include "app/commands/surface_flags.h"
#include "app/compose.h"
#include "render/renderer.h"

namespace ramus::app {

class PictureStage final : public Host {
public:
    PictureStage(Document& document, const SurfaceFlags& flags, Viewing viewing)
        : document_(document), flags_(flags), viewing_(viewing) {}

    // Computes the surface of the session's options unless it is there already.
    Result<void> make_surface();
    void draw_with(render::Renderer& renderer) { renderer_ = &renderer; }
    [[nodiscard]] Result<render::Frame> frame();
    [[nodiscard]] const std::shared_ptr<const mesh::TriangleMesh>& mesh() const { return mesh_; }
    [[nodiscard]] double mesh_seconds() const { return mesh_seconds_; }

    // Host
    [[nodiscard]] glm::ivec2 picture_size() const override { return viewing_.size; }
    [[nodiscard]] std::shared_ptr<const mesh::TriangleMesh> picture_mesh() const override { return mesh_; }
    Result<void> write_picture(const std::filesystem::path& path) override;
    void say(const std::string& sentence) override;

private:
    Document& document_;
    const SurfaceFlags& flags_;
    Viewing viewing_;
    render::Renderer* renderer_ = nullptr;
    std::shared_ptr<const mesh::TriangleMesh> mesh_;
    mesh::SurfaceOptions made_;
    double mesh_seconds_ = 0.0;
};

} // namespace ramus::app
