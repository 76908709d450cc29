#include "core/io/output_file.h"
#include "tests/support/temporary_folder.h"

#include <csignal>
#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace ramus;
namespace fs = std::filesystem;

TEST_CASE("an output appears only when it is complete") {
    TemporaryFolder folder;
    const fs::path target = folder.path() / "tree.txt";
    {
        auto file = io::OutputFile::create(target);
        REQUIRE(file);
        file->write("half of it");
        CHECK_FALSE(fs::exists(target));
    }
    CHECK(folder.names().empty());

    auto file = io::OutputFile::create(target);
    REQUIRE(file);
    const std::string large(3'000'001, 'x'); // beyond the buffer, in odd pieces
    file->write("start ");
    file->write(large);
    file->write(" end");
    REQUIRE(file->commit());
    CHECK(folder.text("tree.txt") == "start " + large + " end");
    CHECK(folder.names() == std::vector<std::string>{"tree.txt"});
}

TEST_CASE("an older file stays until the new one is complete, and keeps its permissions") {
    TemporaryFolder folder;
    const fs::path target = folder.path() / "tree.txt";
    REQUIRE(io::write_file(target, "old"));
    fs::permissions(target, fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
    {
        auto file = io::OutputFile::create(target);
        REQUIRE(file);
        file->write("new");
        CHECK(folder.text("tree.txt") == "old");
    }
    CHECK(folder.text("tree.txt") == "old");
    REQUIRE(io::write_file(target, "new"));
    CHECK(folder.text("tree.txt") == "new");
    CHECK(fs::status(target).permissions() == (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
}

TEST_CASE("a link to an output stays a link") {
    TemporaryFolder folder;
    REQUIRE(io::write_file(folder.path() / "real.txt", "old"));
    fs::create_symlink("real.txt", folder.path() / "link.txt");
    REQUIRE(io::write_file(folder.path() / "link.txt", "new"));
    CHECK(fs::is_symlink(folder.path() / "link.txt"));
    CHECK(folder.text("real.txt") == "new");
}

TEST_CASE("an output that cannot be made is refused with its name and a remedy") {
    TemporaryFolder folder;
    for (const fs::path& target : {folder.path() / "missing" / "tree.txt", folder.path(), folder.path() / ""}) {
        CAPTURE(target.string());
        const auto possible = io::check_output(target);
        REQUIRE_FALSE(possible);
        CHECK(possible.error().where == target.string());
        CHECK_FALSE(possible.error().hint.empty());
        CHECK_FALSE(io::write_file(target, "text"));
    }
    CHECK(folder.names().empty());
}

TEST_CASE("devices are written as they are") {
    CHECK(io::write_file("/dev/null", "text"));
    const auto full = io::write_file("/dev/full", "text");
    REQUIRE_FALSE(full);
    CHECK(full.error().what == "the disk is full");
}

TEST_CASE("a file beyond the system's limit leaves nothing behind") {
    TemporaryFolder folder;
    const fs::path target = folder.path() / "tree.txt";
    REQUIRE(io::write_file(target, "old"));
    // The limit cannot be raised again, so a child meets it.
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{100'000, 100'000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const auto written = io::write_file(target, std::string(5'000'000, 'x'));
        ::_exit(!written && written.error().message().find("ulimit -f") != std::string::npos ? 0 : 1);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(folder.text("tree.txt") == "old");
    CHECK(folder.names() == std::vector<std::string>{"tree.txt"});
}

TEST_CASE("an interrupted process removes what it had begun") {
    TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        auto file = io::OutputFile::create(folder.path() / "tree.txt");
        file->write(std::string(5'000'000, 'x'));
        const bool begun = !folder.names().empty();
        io::remove_unfinished_files();
        const bool refused = !io::OutputFile::create(folder.path() / "other.txt");
        ::_exit(begun && refused && folder.names().empty() ? 0 : 1);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(status == 0);
    CHECK(folder.names().empty());
}
