// ImguiRenderer: draws Dear ImGui's draw lists with OpenGL through glad, into whatever framebuffer is bound. The
// window and headless pictures with the interface (`ramus render --ui`) use the same one. It leaves GL's state as the
// scene renderer expects it: blending, scissor and culling off, no program, no vertex array.
#pragma once

#include "core/base/error.h"
#include "render/gl/gl_objects.h"

#include <cstdint>
#include <imgui.h>
#include <memory>

namespace ramus::app {

struct ImguiContext {
    ImguiContext() { ImGui::CreateContext(); }
    ~ImguiContext() { ImGui::DestroyContext(); }
    ImguiContext(const ImguiContext&) = delete;
    ImguiContext& operator=(const ImguiContext&) = delete;
};

class ImguiRenderer {
public:
    // Needs a current context, and an ImGui context whose fonts upload_fonts() then takes.
    [[nodiscard]] static Result<std::unique_ptr<ImguiRenderer>> create();
    ImguiRenderer(const ImguiRenderer&) = delete;
    ImguiRenderer& operator=(const ImguiRenderer&) = delete;

    // Makes the atlas of ImGui's fonts a texture; again after the fonts changed.
    void upload_fonts();
    void draw(const ImDrawData& data);

private:
    ImguiRenderer() = default;
    void draw_nothing();
    [[nodiscard]] bool make_buffers(const ImDrawData& data);
    render::Program program_;
    render::VertexArray vertex_array_;
    render::Buffer vertices_, indices_;
    render::Texture font_;
    std::int64_t vertex_bytes_ = 0, index_bytes_ = 0;
};

// Differs when the pictures differ: an interface that looks as before need not be drawn again.
[[nodiscard]] std::uint64_t fingerprint(const ImDrawData& data);

} // namespace ramus::app
