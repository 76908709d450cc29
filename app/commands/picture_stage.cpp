#include "app/commands/picture_stage.h"

#include "app/commands/interrupt.h"
#include "app/commands/load_tree.h"
#include "app/commands/progress_bar.h"
#include "app/numbers.h"

namespace ramus::app {

Result<void> PictureStage::make_surface() {
    mesh::SurfaceOptions options = document_.marks().options;
    options.threads = flags_.surface.threads; // the machine's business, not the session's
    if (mesh_ && made_ == options) return {};
    Job job;
    auto surface = [&] {
        const CancelOnInterrupt cancel(job);
        const ProgressBar bar("surface", job);
        return mesh::make_surface(*document_.tree(), options, job);
    }();
    if (job.cancelled()) return fail("cancelled; nothing was written");
    if (!surface) return tl::unexpected(surface.error());
    mesh_ = std::make_shared<const mesh::TriangleMesh>(std::move(surface->mesh));
    mesh_seconds_ = surface->statistics.seconds;
    made_ = options;
    say(counted(mesh_->triangles.size(), "triangle", "triangles") + " in " + rounded(mesh_seconds_) + " s");
    return {};
}

Result<render::Frame> PictureStage::frame() {
    if (auto made = make_surface(); !made) return tl::unexpected(made.error());
    return compose(document_.session(), document_.tree(), mesh_, viewing_);
}

Result<void> PictureStage::write_picture(const std::filesystem::path& path) {
    const auto wanted = frame();
    if (!wanted) return tl::unexpected(wanted.error());
    if (const auto drawn = renderer_->draw(*wanted); !drawn) return tl::unexpected(drawn.error());
    return render::write_png(renderer_->read_image(), path);
}

void PictureStage::say(const std::string& sentence) { app::say(flags_, sentence); }

} // namespace ramus::app
