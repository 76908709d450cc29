#include "core/base/child_program.h"
#include "tests/support/temporary_folder.h"

#include <chrono>
#include <doctest/doctest.h>
#include <fstream>
#include <thread>

using namespace ramus;

namespace {

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

TEST_CASE("programs are found where PATH has them") {
    CHECK(find_program("sh").filename() == "sh");
    CHECK(find_program("no such program").empty());
    const auto missing = ChildProgram::start({"no such program"});
    REQUIRE_FALSE(missing);
    CHECK_FALSE(start_and_leave({"no such program"}));
}
