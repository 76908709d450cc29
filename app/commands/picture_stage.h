// PictureStage: a document with what `ramus render` needs to draw it without a window. It is the
// PictureHost of the commands in a commands file; the surface follows the options that commands set, computed when a
// picture is next needed.
#pragma once

#include "app/actions/hosts.h"
#include "app/assets/assets.h"
#include "app/commands/surface_flags.h"
#include "app/picture/compose_sheet.h"
#include "app/workspace/compared_surfaces.h"
#include "render/renderer/sheet.h"

#include <memory>
#include <vector>

namespace ramus::app {

class PictureStage final : public PictureHost {
public:
    PictureStage(Document& document, const SurfaceFlags& flags, Viewing viewing)
        : document_(document), flags_(flags), viewing_(std::move(viewing)) {}

    // Computes the surface of the session's options, without its hidden branches, unless it is there already.
    Result<void> make_surface();
    Result<void> complete_assets(); // reads and measures what a picture shows beside the surface
    void draw_with(render::Renderer& renderer) {
        renderer_ = &renderer;
        sheet_renderer_ = std::make_unique<render::SheetRenderer>(renderer);
    }
    [[nodiscard]] Result<render::Frame> frame(); // of the session's own surface
    // With all that it is compared with, computed when it is not there already.
    [[nodiscard]] Result<render::Sheet> sheet() { return sheet(viewing_.size); }
    [[nodiscard]] Result<render::Sheet> sheet(glm::ivec2 size);
    [[nodiscard]] render::SheetRenderer& sheet_renderer() { return *sheet_renderer_; }
    [[nodiscard]] const ReadySurface& surface() const { return surface_; }
    Assets assets; // the document's, complete whenever a picture is made

    // PictureHost
    [[nodiscard]] glm::ivec2 picture_size() const override {
        return viewports_of(document_.marks(), viewing_.size, viewing_.pixel_ratio).front().size;
    }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return surface_.mesh; }
    Result<render::BranchPicture> branch_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<void> write_figure(const FigureRequest& request, Job& job) override;
    [[nodiscard]] glm::ivec2 whole_size() const override { return viewing_.size; }
    Result<render::Image> draw_picture(const render::Camera& camera, glm::ivec2 size,
                                       const FigureOptions& options) override;

private:
    Document& document_;
    const SurfaceFlags& flags_;
    Viewing viewing_;
    render::Renderer* renderer_ = nullptr;
    std::unique_ptr<render::SheetRenderer> sheet_renderer_;
    ReadySurface surface_;
    std::shared_ptr<const tree::VesselTree> tree_; // that the surfaces are of: it may be edited
    std::vector<ComparedSurface> compared_;        // one a kind
    Result<void> measure_deviation();              // of the surface, where colours show it
    Result<void> make_compared_surface(ComparedRequest request);
};

} // namespace ramus::app
