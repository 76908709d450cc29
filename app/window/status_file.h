// StatusFile: what a window shows, as one JSON object in a file, for scripts that drive it from outside and have to
// know when it is done.
#pragma once

#include <cstdint>
#include <string>

namespace ramus::app {

class LoopWatch;
class Viewer;
class Workspace;

// Written anew (whole or not at all) only when something differs. A script asks by a number in the file beside it (its
// name and ".ask"); the first status that knows all input that came before the question says the same number
// ("answered"). With an empty path nothing is read or written.
class StatusFile {
public:
    explicit StatusFile(std::string path) : path_(std::move(path)) {}
    void look_for_question(); // before the events are looked at
    void update(const Viewer& viewer, const Workspace& workspace, const LoopWatch& watch);
    [[nodiscard]] double wait_seconds() const; // until the next look for a question

private:
    std::string path_, written_;
    std::uint64_t asked_ = 0, known_ = 0; // the last question; whose input is known
};

} // namespace ramus::app
