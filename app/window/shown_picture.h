// ShownPicture: the way of a picture from the thread that draws it to the window. It is copied into one of two
// textures, which both contexts share; the other one is shown meanwhile.
#pragma once

#include "render/renderer/sheet.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <mutex>

namespace ramus::app {

class ShownPicture {
public:
    // On the drawing thread. Copies the picture of `sheets`, of this size, and waits until it is there: it is shown
    // from now on. Throws OutOfGraphicsMemory.
    void keep(render::SheetRenderer& sheets, glm::ivec2 size);
    void let_go(); // of what the drawing thread has of it

    // On the window's. As Renderer::present(); of a picture of another size than `size` what there is, from the top
    // left.
    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size);
    [[nodiscard]] bool any() const; // there is a picture

private:
    struct Kept {
        std::size_t which = 0;
        int made = 0; // how many textures were made before; 0: there is none
        unsigned texture = 0;
        glm::ivec2 size{0};
    };
    [[nodiscard]] Kept shown() const;

    // The drawing thread's.
    std::array<render::PictureTarget, 2> pictures_;
    std::array<int, 2> made_{}; // of each, when
    int count_ = 0;

    // The window's: framebuffers are of one context.
    std::array<render::Framebuffer, 2> framebuffers_;
    std::array<int, 2> of_{}; // the texture that each has

    mutable std::mutex mutex_; // guards what follows
    Kept shown_;
};

} // namespace ramus::app
