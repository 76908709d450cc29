// ImguiRenderer: draws Dear ImGui's draw lists with OpenGL into the bound framebuffer, for the window and for headless
// pictures (`ramus render --ui`). Leaves the GL state that the scene renderer expects: blending, scissor and culling
// off, no program, no vertex array.
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
    // Needs a current GL context and an ImGui context with loaded fonts, which upload_fonts() then uploads.
    [[nodiscard]] static Result<std::unique_ptr<ImguiRenderer>> create();
    ImguiRenderer(const ImguiRenderer&) = delete;
    ImguiRenderer& operator=(const ImguiRenderer&) = delete;

    // Uploads ImGui's font atlas as a texture; call again after fonts changed.
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

// A hash of the draw data: while it is equal, the interface looks the same and need not be drawn again.
[[nodiscard]] std::uint64_t fingerprint(const ImDrawData& data);

} // namespace ramus::app
