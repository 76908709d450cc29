// PictureStage: draws a document without a window, for `ramus render`. It is the PictureHost of the commands in a file
// of --commands. When commands change the options of the surface, the surface is computed again for the next picture.
#pragma once

#include "app/actions/hosts.h"
#include "app/assets/assets.h"
#include "app/commands/surface_flags.h"
#include "app/picture/compose_sheet.h"
#include "app/picture/plane_pictures.h"
#include "app/workspace/compared_surfaces.h"
#include "render/renderer/sheet.h"

#include <memory>
#include <vector>

namespace ramus::app {

class PictureStage final : public PictureHost {
public:
    // `document` and `flags` must outlive the object.
    PictureStage(Document& document, const SurfaceFlags& flags, Viewing viewing)
        : document_(document), flags_(flags), viewing_(std::move(viewing)) {}

    // Computes the surface with the options of the session, without hidden branches. Does nothing if the tree, the
    // options and the hidden branches are unchanged. Shows a progress bar; fails if cancelled.
    Result<void> make_surface();
    // Reads and computes what a picture shows in addition to the surface, such as context shapes and lesions.
    Result<void> complete_assets();
    // Must be called before pictures are drawn. The renderer must outlive the object.
    void draw_with(render::Renderer& renderer) {
        renderer_ = &renderer;
        sheet_renderer_ = std::make_unique<render::SheetRenderer>(renderer);
    }
    // The frame of the session's own surface. Computes what is missing.
    [[nodiscard]] Result<render::Frame> frame();
    // The frames of this surface and of all surfaces that it is compared with. Computes what is missing. `size`:
    // pixels.
    [[nodiscard]] Result<render::Sheet> sheet() { return sheet(viewing_.size); }
    [[nodiscard]] Result<render::Sheet> sheet(glm::ivec2 size);
    [[nodiscard]] render::SheetRenderer& sheet_renderer() { return *sheet_renderer_; }
    // The slices among the vessels are of the document's current state.
    [[nodiscard]] Viewing viewing_of(glm::ivec2 size);
    [[nodiscard]] const ReadySurface& surface() const { return surface_; }
    Assets assets; // of the document; complete whenever a picture is drawn

    // PictureHost
    [[nodiscard]] glm::ivec2 picture_size() const override {
        return viewports_of(document_.session(), viewing_.size, viewing_.pixel_ratio).front().size;
    }
    [[nodiscard]] std::shared_ptr<const render::PagedMesh> picture_mesh() const override { return surface_.mesh; }
    [[nodiscard]] Result<std::shared_ptr<const render::PagedMesh>> current_mesh() override;
    Result<render::BranchPicture> branch_picture() override;
    Result<void> write_picture(const std::filesystem::path& path) override;
    Result<void> write_figure(const FigureRequest& request, Job& job) override;
    [[nodiscard]] glm::ivec2 whole_size() const override { return viewing_.size; }
    Result<render::Image> draw_picture(const Session& session, glm::ivec2 size, const FigureOptions& options) override;

private:
    Document& document_;
    const SurfaceFlags& flags_;
    Viewing viewing_;
    render::Renderer* renderer_ = nullptr;
    std::unique_ptr<render::SheetRenderer> sheet_renderer_;
    ReadySurface surface_;
    PlanePictures planes_;
    std::shared_ptr<const tree::VesselTree> tree_; // the tree of the surfaces; the document's may have been edited
    std::vector<ComparedSurface> compared_;        // one per kind
    Result<void> measure_deviation();              // if colours show the deviation
    Result<void> measure_sections();               // if slices follow a vessel
    Result<void> make_compared_surface(ComparedRequest request);
};

} // namespace ramus::app
