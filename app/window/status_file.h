// What a window shows, as one JSON object in a file: for scripts that drive it from outside and have to know when it is
// done. Written anew (whole or not at all) only when something differs.
#pragma once

#include "app/window/viewer.h"

#include <string>

namespace ramus::app {

class StatusFile {
public:
    explicit StatusFile(std::string path) : path_(std::move(path)) {}
    void update(const Viewer& viewer, const Workspace& workspace); // nothing without a path

private:
    std::string path_, written_;
};

} // namespace ramus::app
