#include "app/window/imgui_renderer.h"

#include "render/gl/bindings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>
#include <glad/gl.h>
#include <glm/vec2.hpp>

namespace ramus::app {

namespace {

void grow(render::Buffer& buffer, std::int64_t& bytes, std::int64_t needed) {
    if (needed <= bytes) return;
    const std::int64_t capacity = std::max(needed, 2 * bytes);
    buffer = render::make_buffer(static_cast<std::size_t>(capacity), nullptr, GL_DYNAMIC_STORAGE_BIT);
    bytes = capacity;
}

// Start of a list in the buffers.
struct First {
    std::int64_t vertex = 0, index = 0;
};

void draw_list(const ImDrawList& list, const ImDrawData& data, glm::ivec2 size, First first) {
    const auto pixel = [](float value, float origin, float scale) {
        return static_cast<int>((value - origin) * scale);
    };
    for (const ImDrawCmd& command : list.CmdBuffer) {
        if (command.UserCallback != nullptr) {
            if (command.UserCallback != ImDrawCallback_ResetRenderState) command.UserCallback(&list, &command);
            continue;
        }
        const int left = std::max(pixel(command.ClipRect.x, data.DisplayPos.x, data.FramebufferScale.x), 0);
        const int top = std::max(pixel(command.ClipRect.y, data.DisplayPos.y, data.FramebufferScale.y), 0);
        const int right = std::min(pixel(command.ClipRect.z, data.DisplayPos.x, data.FramebufferScale.x), size.x);
        const int bottom = std::min(pixel(command.ClipRect.w, data.DisplayPos.y, data.FramebufferScale.y), size.y);
        if (right <= left || bottom <= top) continue;
        glScissor(left, size.y - bottom, right - left, bottom - top);
        glBindTextureUnit(render::kUnitImage,
                          static_cast<unsigned>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
        const auto offset = (first.index + command.IdxOffset) * static_cast<std::int64_t>(sizeof(ImDrawIdx));
        glDrawElementsBaseVertex(GL_TRIANGLES, static_cast<int>(command.ElemCount),
                                 sizeof(ImDrawIdx) == 2 ? GL_UNSIGNED_SHORT : GL_UNSIGNED_INT,
                                 reinterpret_cast<const void*>(offset),
                                 static_cast<int>(first.vertex + command.VtxOffset));
    }
}

} // namespace

Result<std::unique_ptr<ImguiRenderer>> ImguiRenderer::create() {
    RAMUS_TRY(program, render::make_program("interface.vert", "interface.frag"));
    std::unique_ptr<ImguiRenderer> renderer(new ImguiRenderer);
    renderer->program_ = std::move(program);
    renderer->vertex_array_ = render::make_vertex_array();
    const auto attribute = [&](unsigned index, int size, unsigned type, bool normalised, std::size_t offset) {
        glEnableVertexArrayAttrib(renderer->vertex_array_, index);
        glVertexArrayAttribFormat(renderer->vertex_array_, index, size, type, normalised ? GL_TRUE : GL_FALSE,
                                  static_cast<unsigned>(offset));
        glVertexArrayAttribBinding(renderer->vertex_array_, index, 0);
    };
    attribute(render::kAttributePosition, 2, GL_FLOAT, false, offsetof(ImDrawVert, pos));
    attribute(render::kAttributeUv, 2, GL_FLOAT, false, offsetof(ImDrawVert, uv));
    attribute(render::kAttributeColour, 4, GL_UNSIGNED_BYTE, true, offsetof(ImDrawVert, col));
    renderer->upload_fonts();
    renderer->draw_nothing();
    return renderer;
}

void ImguiRenderer::upload_fonts() {
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.GetTexDataAsAlpha8(&pixels, &width, &height);
    font_ = render::make_texture(GL_R8, width, height);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage2D(font_, 0, 0, 0, width, height, GL_RED, GL_UNSIGNED_BYTE, pixels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    const std::array<int, 4> white_with_alpha{GL_ONE, GL_ONE, GL_ONE, GL_RED};
    glTextureParameteriv(font_, GL_TEXTURE_SWIZZLE_RGBA, white_with_alpha.data());
    glTextureParameteri(font_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTextureParameteri(font_, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    fonts.SetTexID(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(GLuint(font_))));
}

// Makes the driver compile the program on its first use, before anything is visible, instead of in the first frame.
void ImguiRenderer::draw_nothing() {
    ImDrawList list(ImGui::GetDrawListSharedData());
    list._ResetForNewFrame();
    list.PushClipRect({0.0F, 0.0F}, {1.0F, 1.0F});
    list.PushTextureID(ImGui::GetIO().Fonts->TexID);
    list.PrimReserve(6, 4);
    list.PrimRect({-2.0F, -2.0F}, {-1.0F, -1.0F}, 0); // outside
    ImDrawList* only = &list;
    ImDrawData data;
    data.CmdLists = &only;
    data.CmdListsCount = 1;
    data.TotalVtxCount = list.VtxBuffer.Size;
    data.DisplaySize = {1.0F, 1.0F};
    data.FramebufferScale = {1.0F, 1.0F};
    draw(data);
}

void ImguiRenderer::draw(const ImDrawData& data) {
    const glm::ivec2 size(static_cast<int>(data.DisplaySize.x * data.FramebufferScale.x),
                          static_cast<int>(data.DisplaySize.y * data.FramebufferScale.y));
    if (size.x <= 0 || size.y <= 0 || data.TotalVtxCount == 0 || !make_buffers(data)) return;
    glViewport(0, 0, size.x, size.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(program_);
    glUniform4f(render::kUniformWindow, data.DisplayPos.x, data.DisplayPos.y, data.DisplaySize.x, data.DisplaySize.y);
    glVertexArrayVertexBuffer(vertex_array_, 0, vertices_, 0, sizeof(ImDrawVert));
    glVertexArrayElementBuffer(vertex_array_, indices_);
    glBindVertexArray(vertex_array_);
    First first;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        glNamedBufferSubData(vertices_, first.vertex * static_cast<std::int64_t>(sizeof(ImDrawVert)),
                             list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data);
        glNamedBufferSubData(indices_, first.index * static_cast<std::int64_t>(sizeof(ImDrawIdx)),
                             list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data);
        draw_list(list, data, size, first);
        first.vertex += list.VtxBuffer.Size;
        first.index += list.IdxBuffer.Size;
    }
    glBindVertexArray(0);
    glUseProgram(0);
    glDisable(GL_BLEND);
    glDisable(GL_SCISSOR_TEST);
}

// False: out of memory; a picture without panels is better than none, and the next frame tries again.
bool ImguiRenderer::make_buffers(const ImDrawData& data) {
    std::int64_t vertex_bytes = 0, index_bytes = 0;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        vertex_bytes += data.CmdLists[i]->VtxBuffer.size_in_bytes();
        index_bytes += data.CmdLists[i]->IdxBuffer.size_in_bytes();
    }
    try {
        grow(vertices_, vertex_bytes_, vertex_bytes);
        grow(indices_, index_bytes_, index_bytes);
    } catch (const render::OutOfGraphicsMemory&) {
        return false;
    }
    return true;
}

std::uint64_t fingerprint(const ImDrawData& data) {
    std::uint64_t hash = 0x9e3779b97f4a7c15ULL;
    const auto mix = [&](const void* bytes, std::size_t count) {
        const auto* at = static_cast<const unsigned char*>(bytes);
        for (; count >= 8; count -= 8, at += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, at, 8);
            hash = (hash ^ word) * 0xff51afd7ed558ccdULL;
            hash ^= hash >> 32;
        }
        for (; count > 0; --count, ++at) hash = (hash ^ *at) * 0x100000001b3ULL;
    };
    mix(&data.DisplaySize, sizeof data.DisplaySize);
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        mix(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        mix(list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.size_in_bytes()));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            mix(&command.ClipRect, sizeof command.ClipRect);
            const ImTextureID texture = command.GetTexID();
            mix(&texture, sizeof texture);
            mix(&command.ElemCount, sizeof command.ElemCount);
        }
    }
    return hash;
}

} // namespace ramus::app
