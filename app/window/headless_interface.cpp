#include "app/window/headless_interface.h"

#include "app/window/imgui_renderer.h"
#include "app/window/viewer.h"
#include "render/gl/gl_objects.h"

#include <chrono>
#include <optional>
#include <thread>

namespace ramus::app {

Result<WindowPicture> picture_with_interface(Workspace& workspace, render::Renderer& renderer, glm::ivec2 size,
                                             float scale, const std::function<Result<void>(ActionContext&)>& prepare) {
    const ImguiContext imgui;
    if (auto possible = render::check_size(size.x, size.y); !possible) return tl::unexpected(possible.error());
    render::PictureTarget target;
    try {
        target.make(size);
    } catch (const render::OutOfGraphicsMemory& error) {
        return fail(error.what(), {}, "give a smaller --size");
    }
    RAMUS_TRY(viewer, Viewer::create(workspace, renderer, scale));
    viewer->resize(size, scale);
    constexpr double kFrameSeconds = 0.2; // advances the clock, so that a slow picture reaches full quality
    double now = 0.0;
    const auto settle = [&] {
        Job job;
        (void)complete(workspace.assets(), workspace.document(),
                       job); // does synchronously what a window leaves to workers
        const auto more_to_come = [&] {
            workspace.update();
            return workspace.surface_awaited() || workspace.awaited(WorkKind::kComparison) ||
                   workspace.awaited(WorkKind::kContacts) || workspace.awaited(WorkKind::kDeviation) ||
                   workspace.awaited(WorkKind::kValidation);
        };
        while (more_to_come()) std::this_thread::sleep_for(std::chrono::milliseconds(2));
        constexpr int kMostFrames = 20; // five suffice; a slow worker must not prevent the picture
        for (int i = 0; i < kMostFrames; ++i) {
            viewer->draw(now, target.framebuffer);
            now += kFrameSeconds;
            if (viewer->resting()) break;
        }
    };
    settle();
    if (prepare)
        if (auto done = prepare(viewer->actions()); !done) return tl::unexpected(done.error());
    settle();
    return WindowPicture{target.read_premultiplied(), viewer->picture().scale_bar()};
}

} // namespace ramus::app
