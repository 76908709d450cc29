// Another program that runs beside this one: it is given words and perhaps bytes, what it says on standard error is
// heard line by line, and it ends when this process does. Nothing goes through a shell.
#pragma once

#include "core/base/error.h"
#include "core/base/job.h"

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace ramus {

// Where PATH has a program of this name; empty: nowhere.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);

class ChildProgram {
public:
    // `words`: the program's path or name, and what it is given. `environment`: "NAME=value" beside what this process
    // has. Fails where it cannot be started.
    [[nodiscard]] static Result<ChildProgram> start(const std::vector<std::string>& words,
                                                    const std::vector<std::string>& environment = {});
    ChildProgram(ChildProgram&& other) noexcept;
    ChildProgram& operator=(ChildProgram&&) = delete;
    ~ChildProgram(); // one that has not ended is stopped

    // On its standard input. Fails once it does not read any more.
    [[nodiscard]] Result<void> write(std::string_view bytes) const;

    // Closes its input and waits until it ends. `hear` gets the lines that it says and returns true for those that are
    // no complaint. Fails with the last complaint, where its status is not 0, or where the job is cancelled: it is then
    // asked to end, and after a while made to.
    using Hear = std::function<bool(std::string_view line)>;
    [[nodiscard]] Result<void> wait(Job& job, const Hear& hear = {});

private:
    ChildProgram(pid_t process, int input, int words) : process_(process), input_(input), words_(words) {}
    void close_input();
    [[nodiscard]] int reap() const; // its status

    pid_t process_;
    int input_, words_; // descriptors; -1: closed
};

// Starts a program and forgets it, as a desktop does: it outlives this process. Fails where it cannot be started.
[[nodiscard]] Result<void> start_and_leave(const std::vector<std::string>& words);

} // namespace ramus
