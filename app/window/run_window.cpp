#include "app/window/run_window.h"

#include <iostream>

namespace ramus::app {

int run_window(const std::vector<std::string>&, const mesh::SurfaceOptions&) {
    std::cerr << "ramus: this build has no window; draw a picture with `ramus render FILE -o PNG`\n";
    return 1;
}

} // namespace ramus::app
