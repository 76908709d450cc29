// StatusFile: writes what a window shows as a JSON object to a file, for scripts that drive the window and must know
// when it has finished.
#pragma once

#include <cstdint>
#include <string>

namespace ramus::app {

class TickWatch;
class Viewer;
class Workspace;

// The file is rewritten atomically, only if something changed. A script asks by writing a number to the file's name
// with ".ask" appended; the first status that includes all input before the question repeats the number as "answered".
// With an empty path nothing is read or written.
class StatusFile {
public:
    explicit StatusFile(std::string path) : path_(std::move(path)) {}
    void look_for_question(); // call before handling events
    void update(const Viewer& viewer, const Workspace& workspace, const TickWatch& watch);
    [[nodiscard]] double wait_seconds() const; // until the next call of look_for_question()

private:
    std::string path_, written_;
    std::uint64_t asked_ = 0, known_ = 0; // the last question; the last one whose input is included
};

} // namespace ramus::app
