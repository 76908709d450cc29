#include "render/gl/graphics_memory.h"

#include "core/base/memory.h"
#include "render/gl/gl_context.h"

#include <array>
#include <glad/gl.h>
#include <limits>
#include <string_view>

namespace ramus::render {

namespace {

// Names of the two extensions, which no core loader has. What they tell is in KiB.
constexpr GLenum kDedicatedMemory = 0x9047;  // GPU_MEMORY_INFO_DEDICATED_VIDMEM_NVX
constexpr GLenum kFreeBufferMemory = 0x87FB; // VBO_FREE_MEMORY_ATI: of the pool in all, and three more

bool has_extension(std::string_view name) {
    GLint count = 0;
    glGetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; ++i)
        if (reinterpret_cast<const char*>(glGetStringi(GL_EXTENSIONS, static_cast<GLuint>(i))) == name) return true;
    return false;
}

} // namespace

double graphics_memory_bytes() {
    if (is_software_rasteriser()) return memory_limit(0.0);
    std::array<GLint, 4> kilobytes{};
    if (has_extension("GL_NVX_gpu_memory_info"))
        glGetIntegerv(kDedicatedMemory, kilobytes.data());
    else if (has_extension("GL_ATI_meminfo"))
        glGetIntegerv(kFreeBufferMemory, kilobytes.data());
    return kilobytes[0] > 0 ? 1024.0 * kilobytes[0] : std::numeric_limits<double>::infinity();
}

} // namespace ramus::render
