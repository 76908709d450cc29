// Waits for a workspace as the window does, without its waiting.
#pragma once

#include "app/workspace/workspace.h"

#include <chrono>
#include <thread>

namespace ramus::test {

// Until `condition` holds; false: it did not within a minute.
template <class Condition> bool settle(app::Workspace& workspace, const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (std::chrono::steady_clock::now() < end) {
        workspace.update();
        if (condition()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

} // namespace ramus::test
