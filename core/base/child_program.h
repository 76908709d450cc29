// Runs another program as a child process: arguments and standard input go in, standard error comes back line by line,
// standard output is discarded. The child gets SIGTERM when the thread that started it ends. No shell is involved.
//
//     auto program = ChildProgram::start({"ffmpeg", "-i", "-", "film.mp4"});
//     program->write(bytes);
//     program->wait(job);
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

// The absolute path of the first executable of this name in PATH. Empty: there is none.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);

class ChildProgram {
public:
    // `words`: the program's path, or its name in PATH, and its arguments. `environment`: "NAME=value", in addition to
    // or instead of the variables of this process. Fails if there is no such program or no process can be created.
    [[nodiscard]] static Result<ChildProgram> start(const std::vector<std::string>& words,
                                                    const std::vector<std::string>& environment = {});
    ChildProgram(ChildProgram&& other) noexcept;
    ChildProgram& operator=(ChildProgram&&) = delete;
    ~ChildProgram(); // kills the program if it has not ended

    // Writes to its standard input, and waits until it takes all bytes. Fails once the program has closed its input.
    [[nodiscard]] Result<void> write(std::string_view bytes) const;

    // Closes its input and waits until it ends. `hear` gets each line of its standard error, and returns true for a
    // line that is not an error. Fails if its exit status is not 0, with the last error line, and if `job` is
    // cancelled. A cancelled program gets SIGTERM, and SIGKILL 3 s later.
    using Hear = std::function<bool(std::string_view line)>;
    [[nodiscard]] Result<void> wait(Job& job, const Hear& hear = {});

private:
    ChildProgram(pid_t process, int input, int words) : process_(process), input_(input), words_(words) {}
    void close_input();
    [[nodiscard]] int reap() const; // as waitpid() gives it

    pid_t process_;
    int input_, words_; // descriptors; -1: closed
};

// Starts a program that outlives this process, in a session of its own, as a desktop does. Fails if there is no such
// program or no process can be created. Does not tell whether the program then runs.
[[nodiscard]] Result<void> start_and_leave(const std::vector<std::string>& words);

} // namespace ramus
