// ShownPicture: passes pictures from the drawing thread to the window by double buffering: a picture is copied into one
// of two textures that both contexts share, while the other is shown.
#pragma once

#include "render/renderer/sheet.h"

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <mutex>

namespace ramus::app {

class ShownPicture {
public:
    // Drawing thread: copies the picture of `sheets`, of this size, waits for the copy, and makes it the shown picture.
    // Throws OutOfGraphicsMemory.
    void keep(render::SheetRenderer& sheets, glm::ivec2 size);
    void release(); // drawing thread: releases its textures

    // Window's thread: makes the driver compile the shaders of the copy, before anything is visible. Draws into the
    // window's corner.
    static void prepare();
    // Window's thread: see PictureTarget::present().
    void present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 filled);
    [[nodiscard]] bool any() const; // whether there is a picture

private:
    struct Kept {
        std::size_t which = 0;
        int number = 0; // counts pictures; 0: none
        unsigned texture = 0;
        glm::ivec2 size{0};
    };
    [[nodiscard]] Kept shown() const;

    // Belongs to the drawing thread.
    std::array<render::PictureTarget, 2> pictures_;

    // Belongs to the window's thread, since framebuffers are not shared. Attaching a texture anew makes another
    // context's drawing visible.
    render::PictureTarget seen_; // without a texture of its own
    int attached_ = 0;           // number of the attached picture

    mutable std::mutex mutex_; // guards what follows
    Kept shown_;
};

} // namespace ramus::app
