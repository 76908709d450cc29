// TexelTable: few values of one format that change from picture to picture, read by shaders texel by texel.
#pragma once

#include "render/gl/gl_objects.h"

#include <vector>

namespace ramus::render {

class TexelTable {
public:
    explicit TexelTable(GLenum format) : format_(format) {}
    // Grows as it is needed; of no texels nothing is sent. Throws OutOfGraphicsMemory.
    template <class Texel> void send(const std::vector<Texel>& texels) {
        send(texels.data(), texels.size() * sizeof(Texel));
    }
    operator GLuint() const { return texture_; } // NOLINT: it stands for its texture

private:
    void send(const void* texels, std::size_t bytes) {
        if (bytes == 0) return;
        if (bytes > capacity_) {
            make_buffer_texture(buffer_, texture_, format_, nullptr, 2 * bytes);
            capacity_ = 2 * bytes;
        }
        glNamedBufferSubData(buffer_, 0, static_cast<GLsizeiptr>(bytes), texels);
    }

    GLenum format_;
    Buffer buffer_;
    Texture texture_;
    std::size_t capacity_ = 0; // bytes
};

} // namespace ramus::render
