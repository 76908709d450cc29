// ImguiRenderer: draws Dear ImGui's draw lists with OpenGL 4.5 through glad, into whatever framebuffer is bound. The
// window and headless pictures with the interface (`ramus render --ui`) use the same one. It leaves GL's state as the
// scene renderer expects it: blending, scissor and culling off, no program, no vertex array.
#pragma once

#include "core/base/error.h"

#include <cstdint>
#include <imgui.h>
#include <memory>

namespace ramus::app {

class ImguiRenderer {
public:
    // Needs a current context, and an ImGui context whose fonts upload_fonts() then takes.
    [[nodiscard]] static Result<std::unique_ptr<ImguiRenderer>> create();
    ~ImguiRenderer();
    ImguiRenderer(const ImguiRenderer&) = delete;
    ImguiRenderer& operator=(const ImguiRenderer&) = delete;

    // Makes the atlas of ImGui's fonts a texture; again after the fonts changed.
    void upload_fonts();
    void draw(const ImDrawData& data);

private:
    ImguiRenderer() = default;
    unsigned program_ = 0, vertex_array_ = 0, vertices_ = 0, indices_ = 0, font_ = 0;
    std::int64_t vertex_bytes_ = 0, index_bytes_ = 0;
};

// Differs when the pictures differ: an interface that looks as before need not be drawn again.
[[nodiscard]] std::uint64_t fingerprint(const ImDrawData& data);

} // namespace ramus::app
