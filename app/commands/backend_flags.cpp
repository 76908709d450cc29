#include "app/commands/backend_flags.h"

#include "app/commands/command.h"
#include "app/commands/inputs.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

void add_backend_flags(CLI::App& command, BackendFlags& flags) {
    const std::map<std::string, render::Backend> backends{{"osmesa", render::Backend::kOsMesa},
                                                          {"egl", render::Backend::kEgl}};
    add_option(command, "--backend", "NAME", flags.backend,
               "What draws: osmesa, on the processor (default), or egl, on a graphics card where there is one")
        ->transform(CLI::CheckedTransformer(backends).description(""));
    add_option(command, "--device", "N", flags.device,
               "With --backend egl: this one of its devices, from 0; --verbose lists them")
        ->check(CLI::Range(0, 63).description(""));
}

void check_backend_flags(const BackendFlags& flags) {
    if (flags.device >= 0 && flags.backend != render::Backend::kEgl)
        throw CLI::ValidationError("--device", "needs --backend egl");
}

Result<std::unique_ptr<render::GlContext>> open_context(const BackendFlags& flags, const SurfaceFlags& common) {
    if (flags.backend == render::Backend::kEgl && common.verbose) {
        const std::vector<std::string> devices = render::egl_devices();
        for (std::size_t i = 0; i < devices.size(); ++i)
            say(common, "EGL device " + std::to_string(i) + ": " + devices[i]);
    }
    auto context = render::make_headless_context(flags.backend,
                                                 flags.device >= 0 ? std::optional<int>(flags.device) : std::nullopt);
    if (context)
        say(common, "drawing with " + std::string(render::name_of(flags.backend)) + ": " + render::gl_description());
    return context;
}

nlohmann::json opengl_in_use(render::Backend backend) {
    return {{"backend", render::name_of(backend)},
            {"renderer", render::gl_renderer()},
            {"version", render::gl_version().text()}};
}

} // namespace ramus::app
