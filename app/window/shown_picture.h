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

    // On the window's. A driver compiles what copies a picture into the window when that is done for the first time:
    // before anybody looks. Leaves something in the window's corner.
    static void prepare();
    // As PictureTarget::present().
    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 filled);
    [[nodiscard]] bool any() const; // there is a picture

private:
    struct Kept {
        std::size_t which = 0;
        int number = 0; // of the pictures so far; 0: there is none
        unsigned texture = 0;
        glm::ivec2 size{0};
    };
    [[nodiscard]] Kept shown() const;

    // The drawing thread's.
    std::array<render::PictureTarget, 2> pictures_;

    // The window's: framebuffers are of one context. What another one drew is sure to be seen when it is attached anew.
    render::PictureTarget seen_; // without the texture, which is not its own
    int attached_ = 0;           // the picture that it has

    mutable std::mutex mutex_; // guards what follows
    Kept shown_;
};

} // namespace ramus::app
