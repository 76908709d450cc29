#include "app/window/shown_picture.h"

#include <glad/gl.h>
#include <utility>

namespace ramus::app {

void ShownPicture::keep(render::SheetRenderer& sheets, glm::ivec2 size) {
    const Kept before = shown();
    const std::size_t which = 1 - before.which;
    render::PictureTarget& picture = pictures_.at(which);
    if (picture.size != size) picture.make(size);
    sheets.present(picture.framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glFinish(); // it must be complete for the other context
    const std::lock_guard lock(mutex_);
    shown_ = {which, before.number + 1, picture.colour, size};
}

void ShownPicture::prepare() {
    render::PictureTarget picture;
    picture.make({3, 3}); // not a power of two: Mesa compiles other code for those
    for (const int side : {3, 5}) picture.present(0, 0, 0, {side, side}); // unscaled and scaled
}

void ShownPicture::release() {
    pictures_ = {};
    const std::lock_guard lock(mutex_);
    shown_ = {};
}

ShownPicture::Kept ShownPicture::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

bool ShownPicture::any() const { return shown().number > 0; }

void ShownPicture::present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 filled) {
    const Kept picture = shown();
    if (picture.number == 0) return;
    if (std::exchange(attached_, picture.number) != picture.number) {
        seen_.framebuffer = render::make_framebuffer({picture.texture});
        seen_.size = picture.size;
    }
    seen_.present(framebuffer, at.x, at.y, filled);
}

} // namespace ramus::app
