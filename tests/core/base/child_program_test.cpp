#include "core/base/child_program.h"
#include "tests/support/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <doctest/doctest.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace ramus;

namespace {

#ifdef __SANITIZE_ADDRESS__
constexpr pid_t kNoneToWaitFor = 0; // the fork server runs on (tests/support/doctest_main.cpp)
#else
constexpr pid_t kNoneToWaitFor = -1; // there is no child
#endif

Result<void> run_shell(const std::string& line, Job& job, const ChildProgram::Hear& hear = {}) {
    auto child = ChildProgram::start({"sh", "-c", line}, {"RAMUS_TEST_WORD=a b"});
    if (!child) return tl::unexpected(child.error());
    return child->wait(job, hear);
}

} // namespace

TEST_CASE("a program's lines are heard, and its status and last complaint told") {
    Job job;
    std::vector<std::string> lines;
    const auto hear = [&](std::string_view line) {
        lines.emplace_back(line);
        return line.starts_with("progress ");
    };
    CHECK(run_shell("echo out; echo progress 0.5 >&2; echo \"$RAMUS_TEST_WORD\" >&2", job, hear));
    CHECK(lines == std::vector<std::string>{"progress 0.5", "a b"});
    const auto failed = run_shell("echo wrong >&2; echo progress 1 >&2; exit 3", job, hear);
    REQUIRE_FALSE(failed);
    CHECK(failed.error().what == "wrong");
    const auto silent = run_shell("exit 3", job);
    REQUIRE_FALSE(silent);
    CHECK(silent.error().what.find("status 3") != std::string::npos);
}

TEST_CASE("a program reads what is written to it, and one that has ended is no signal") {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "read").string();
    Job job;
    auto reader = ChildProgram::start({"sh", "-c", "cat > \"$0\"", file});
    REQUIRE(reader);
    REQUIRE(reader->write("one\n"));
    REQUIRE(reader->write("two\n"));
    REQUIRE(reader->wait(job));
    CHECK(folder.text("read") == "one\ntwo\n");
    auto deaf = ChildProgram::start({"true"});
    REQUIRE(deaf);
    bool refused = false;
    for (int i = 0; i < 10000 && !refused; ++i) refused = !deaf->write(std::string(4096, 'x'));
    CHECK(refused);
}

TEST_CASE("a program that is not needed any more ends") {
    const TemporaryFolder folder;
    Job job;
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        job.cancel();
    });
    const auto done = run_shell("exec sleep 600", job); // and this test would not end
    later.join();
    REQUIRE_FALSE(done);
    CHECK(done.error().what == "cancelled");
}

TEST_CASE("a program begins with no signal blocked, and whoever starts it keeps what it blocks") {
    sigset_t usr1, before, after;
    sigemptyset(&usr1);
    sigaddset(&usr1, SIGUSR1);
    pthread_sigmask(SIG_BLOCK, &usr1, &before);
    Job job;
    std::string blocked;
    const auto done = run_shell("grep SigBlk /proc/self/status >&2", job, [&](std::string_view line) {
        blocked = line;
        return true;
    });
    pthread_sigmask(SIG_SETMASK, &before, &after);
    CHECK(done);
    CHECK(blocked == "SigBlk:\t0000000000000000");
    CHECK(sigismember(&after, SIGUSR1) == 1);
    CHECK(sigismember(&after, SIGTERM) == 0);
}

TEST_CASE("a program that is left goes on, as nobody's") {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "parent").string();
    REQUIRE(start_and_leave({"sh", "-c", "echo $PPID > \"$0.part\"; mv \"$0.part\" \"$0\"", file}));
    while (!std::filesystem::exists(file)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(std::stoi(folder.text("parent")) != getpid());
    CHECK(waitpid(-1, nullptr, WNOHANG) == kNoneToWaitFor);
}

TEST_CASE("programs are found where PATH has them") {
    CHECK(find_program("sh").filename() == "sh");
    CHECK(find_program("no such program").empty());
    const auto missing = ChildProgram::start({"no such program"});
    REQUIRE_FALSE(missing);
    CHECK_FALSE(start_and_leave({"no such program"}));
}
