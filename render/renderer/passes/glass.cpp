// Glass, exactly: every pixel has a list of all panes that cover it, whatever order the triangles come in. The lists
// have a bound in bytes. A picture that would need more is made band by band, each of which fits: slower, never wrong.
#include "render/renderer/renderer_impl.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>

namespace ramus::render {

namespace {

constexpr std::size_t kPaneBytes = 16;
constexpr std::size_t kFirstPanes = std::size_t{1} << 20;

Buffer make_storage(std::size_t bytes) { return make_buffer(bytes, nullptr, GL_DYNAMIC_STORAGE_BIT); }

} // namespace

// Makes room for more panes; false: there is as much as there may be. Panes are numbered from 1.
bool Renderer::Impl::make_room_for_panes(std::size_t wanted) {
    GLint64 largest = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &largest);
    const std::size_t most = std::min(glass_bytes_, static_cast<std::size_t>(largest)) / kPaneBytes - 1;
    if (pane_room_ >= most) return false;
    const std::size_t room = std::min(most, std::max(kFirstPanes, wanted + wanted / 4));
    try {
        panes_ = make_storage((room + 1) * kPaneBytes);
    } catch (const OutOfGraphicsMemory&) {
        if (pane_room_ == 0) throw;
        return false; // bands of what there is
    }
    pane_room_ = room;
    return true;
}

void Renderer::Impl::bind_panes(const Program& program, Band band) const {
    glProgramUniform2i(program, kUniformBand, inner_.x, band.first);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageHeads, pane_heads_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageFragments, panes_);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kStorageCount, pane_count_);
}

// Lists the panes of a band's pixels, in no order, and tells how many there are: more than there was room for means
// that they are not all there.
InParts<std::size_t> Renderer::Impl::list_panes(const Frame& frame, const GpuMesh& mesh, Band band,
                                                std::uint64_t& triangles) {
    const std::size_t pixels = std::size_t(inner_.x) * std::size_t(band.count);
    if (head_room_ < pixels) {
        pane_heads_ = make_storage(4 * pixels);
        head_room_ = pixels;
    }
    if (pane_count_ == 0) pane_count_ = make_storage(4);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); // lists of the band before have been sorted and read
    const GLuint zero = 0;
    glClearNamedBufferSubData(pane_heads_, GL_R32UI, 0, static_cast<GLsizeiptr>(4 * pixels), GL_RED_INTEGER,
                              GL_UNSIGNED_INT, &zero);
    glNamedBufferSubData(pane_count_, 0, 4, &zero);

    const auto begin = [&] {
        glBindFramebuffer(GL_FRAMEBUFFER, glass_target_);
        take_front_faces(false);
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, band.first, inner_.x, band.count);
    };
    const auto use = [&](const Program& program) {
        begin();
        glUseProgram(program);
        glUniformMatrix4fv(kUniformToClip, 1, GL_FALSE, glm::value_ptr(glm::mat4(mesh_to_clip_)));
        glUniformMatrix3fv(kUniformToEye, 1, GL_FALSE, glm::value_ptr(glm::mat3(view_matrix(frame.camera))));
        bind_panes(program, band);
        glUniform1ui(kUniformCapacity, static_cast<GLuint>(pane_room_));
    };
    const GpuMesh::Ranges panes = mesh.choose(layers_, Layer::kGlass, mesh_to_clip_);
    for (std::size_t part = 0; part < panes.parts(); ++part) {
        use(fragment_);
        mesh.draw_part(panes, part);
        co_await kPartEnds;
    }
    const GpuMesh::Ranges borders = mesh.choose_borders(layers_, Layer::kGlass, mesh_to_clip_);
    for (std::size_t part = 0; part < borders.parts(); ++part) {
        use(border_fragment_);
        glUniform1i(kUniformSamples, static_cast<GLint>(view_.picture.z));
        glBindTextureUnit(kUnitLayers, layer_texture_);
        mesh.draw_part(borders, part);
        end_borders();
        co_await kPartEnds;
    }
    begin();
    triangles += panes.triangles() + borders.triangles() + list_clear_panes(frame, band);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint count = 0;
    glGetNamedBufferSubData(pane_count_, 0, 4, &count);
    co_return count;
}

// Lists and sorts all panes, in one band if there is room. resolve() goes with it: it sorts.
InParts<Result<std::uint64_t>> Renderer::Impl::draw_glass(const Frame& frame, const GpuMesh& mesh) {
    if (!gl_has_lists()) co_return draw_first_layer(frame, mesh);
    std::uint64_t triangles = 0;
    if (pane_room_ == 0) make_room_for_panes(0);
    bands_.clear();
    std::vector<Band> todo{{0, inner_.y}};
    while (!todo.empty()) {
        const Band band = todo.back();
        std::uint64_t drawn = 0;
        InParts<std::size_t> listed = list_panes(frame, mesh, band, drawn);
        while (listed.resume()) co_await kPartEnds;
        const std::size_t count = listed.result();
        if (count > pane_room_ && make_room_for_panes(count)) continue;
        todo.pop_back();
        triangles += drawn;
        if (count <= pane_room_) {
            resolve(band);
            bands_.push_back(band);
        } else if (band.count > 1) {
            const int half = band.count / 2;
            todo.push_back({band.first + half, band.count - half});
            todo.push_back({band.first, half});
        } else {
            co_return fail("too many layers of glass lie behind each other", {},
                           "give a smaller size, or hide some of it");
        }
    }
    co_return triangles;
}

} // namespace ramus::render
