// How much memory OpenGL has to draw with, as far as the driver tells.
#pragma once

namespace ramus::render {

// Of the current context, in bytes: a graphics card's own where its driver tells (GL_NVX_gpu_memory_info,
// GL_ATI_meminfo), half of the machine's where the processor draws, infinite elsewhere.
[[nodiscard]] double graphics_memory_bytes();

} // namespace ramus::render
