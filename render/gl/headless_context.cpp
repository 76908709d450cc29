#include "render/gl/headless_context.h"

namespace ramus::render {

std::string_view name_of(Backend backend) { return backend == Backend::kEgl ? "egl" : "osmesa"; }

Result<std::unique_ptr<GlContext>> make_headless_context(Backend backend, std::optional<int> device) {
    return backend == Backend::kEgl ? make_egl_context(device) : make_osmesa_context();
}

} // namespace ramus::render
