#include "app/commands/picture_stage.h"

#include "app/commands/interrupt.h"
#include "app/commands/load_tree.h"
#include "app/commands/progress_bar.h"
#include "app/session/context_shapes.h"
#include "app/session/numbers.h"

namespace ramus::app {

Result<void> PictureStage::make_surface() {
    SurfaceRequest request = surface_request(document_.marks());
    request.options.threads = flags_.surface.threads; // the machine's business, not the session's
    if (surface_.mesh && surface_.request == request) return {};
    Job job;
    auto surface = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("surface", job);
        return make_ready(*document_.tree(), request, job);
    }();
    if (job.cancelled()) return fail("cancelled; nothing was written");
    if (!surface) return tl::unexpected(surface.error());
    surface_ = std::move(*surface);
    say(counted(surface_.mesh->triangle_count(), "triangle", "triangles") + " in " + rounded(surface_.seconds) + " s");
    return {};
}

Result<render::Frame> PictureStage::frame() {
    if (auto made = make_surface(); !made) return tl::unexpected(made.error());
    Job job;
    auto read = [&] {
        const CancelOnInterrupt cancel(job);
        return read_context(document_.marks().context, job);
    }();
    if (job.cancelled()) return fail("cancelled; nothing was written");
    if (!read) return tl::unexpected(read.error());
    return compose(document_, surface_.mesh, viewing_);
}

Result<render::BranchPicture> PictureStage::branch_picture() {
    const auto wanted = frame();
    if (!wanted) return tl::unexpected(wanted.error());
    if (const auto drawn = renderer_->draw(*wanted); !drawn) return tl::unexpected(drawn.error());
    return renderer_->read_branches();
}

Result<void> PictureStage::write_picture(const std::filesystem::path& path) {
    const auto wanted = frame();
    if (!wanted) return tl::unexpected(wanted.error());
    if (const auto drawn = renderer_->draw(*wanted); !drawn) return tl::unexpected(drawn.error());
    return render::write_png(renderer_->read_image(), path);
}

Result<render::Image> PictureStage::draw_picture(const render::Camera& camera, glm::ivec2 size) {
    auto wanted = frame();
    if (!wanted) return tl::unexpected(wanted.error());
    wanted->camera = camera;
    wanted->size = size;
    if (const auto drawn = renderer_->draw(*wanted); !drawn) return tl::unexpected(drawn.error());
    return renderer_->read_image();
}

void PictureStage::say(const std::string& sentence) { app::say(flags_, sentence); }

} // namespace ramus::app
