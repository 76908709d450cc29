#include "app/actions/hosts.h"

namespace ramus::app {

Result<void> PictureHost::write_figure(const FigureRequest& /*request*/, Job& /*job*/) {
    return fail("pictures of another size cannot be drawn here");
}

Result<render::BranchPicture> PictureHost::branch_picture() {
    return fail("what is visible is not known without a picture");
}
Result<render::Image> PictureHost::draw_picture(const Session&, glm::ivec2, const FigureOptions&) {
    return fail("there is no picture here");
}

} // namespace ramus::app
