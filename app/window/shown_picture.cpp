#include "app/window/shown_picture.h"

#include <glad/gl.h>
#include <glm/common.hpp>

namespace ramus::app {

void ShownPicture::keep(render::SheetRenderer& sheets, glm::ivec2 size) {
    const Kept before = shown();
    Kept next{.which = before.made > 0 ? 1 - before.which : 0, .size = size};
    render::PictureTarget& picture = pictures_.at(next.which);
    if (picture.size != size) {
        picture.make(size);
        made_.at(next.which) = ++count_;
    }
    next.made = made_.at(next.which);
    next.texture = picture.colour;
    sheets.present(picture.framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glFinish(); // the other context must find it whole
    const std::lock_guard lock(mutex_);
    shown_ = next;
}

void ShownPicture::let_go() {
    pictures_ = {};
    const std::lock_guard lock(mutex_);
    shown_ = {};
}

ShownPicture::Kept ShownPicture::shown() const {
    const std::lock_guard lock(mutex_);
    return shown_;
}

bool ShownPicture::any() const { return shown().made > 0; }

void ShownPicture::present(unsigned framebuffer, glm::ivec2 at, glm::ivec2 size) {
    const Kept picture = shown();
    if (picture.made == 0) return;
    render::Framebuffer& from = framebuffers_.at(picture.which);
    if (of_.at(picture.which) != picture.made) {
        from = render::make_framebuffer({picture.texture});
        of_.at(picture.which) = picture.made;
    }
    const glm::ivec2 seen = glm::min(size, picture.size);
    const int below = picture.size.y - seen.y, y = at.y + size.y - seen.y;
    glDisable(GL_SCISSOR_TEST);
    glBlitNamedFramebuffer(from, framebuffer, 0, below, seen.x, picture.size.y, at.x, y, at.x + seen.x, y + seen.y,
                           GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, framebuffer);
}

} // namespace ramus::app
