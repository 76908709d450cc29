#include "core/base/leftovers.h"
#include "core/io/input_file.h"
#include "core/io/output_file.h"
#include "core/io/output_folder.h"
#include "tests/support/temporary_folder.h"

#include <array>
#include <csignal>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

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

TEST_CASE("files that belong together come to their places together, or none does") {
    TemporaryFolder folder;
    REQUIRE(io::write_file(folder.path() / "a", "old"));
    const auto write = [&](const std::vector<fs::path>& targets) {
        std::vector<io::OutputFile> files;
        for (const fs::path& target : targets) {
            auto file = io::OutputFile::create(target);
            REQUIRE(file);
            file->write("new");
            files.push_back(std::move(*file));
        }
        return io::commit_all(files);
    };
    // The second one finds no room on its disk.
    const auto full = write({folder.path() / "a", "/dev/full", folder.path() / "c"});
    REQUIRE_FALSE(full);
    CHECK(full.error().where == "/dev/full");
    CHECK(folder.text("a") == "old");
    CHECK(folder.names() == std::vector<std::string>{"a"});
    REQUIRE(write({folder.path() / "a", folder.path() / "c"}));
    CHECK(folder.text("a") == "new");
    CHECK(folder.text("c") == "new");
    CHECK(folder.names() == std::vector<std::string>{"a", "c"});
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

TEST_CASE("a process that is ended by a signal removes what it had begun") {
    TemporaryFolder folder;
    const pid_t child = ::fork();
    if (child == 0) {
        const auto deep = io::OutputFolder::make(folder.path() / "new" / "folder");
        std::vector<io::OutputFile> files;
        for (const char* name : {"tree.txt", "new/folder/tree.txt"}) {
            auto file = io::OutputFile::create(folder.path() / name);
            file->write(std::string(5'000'000, 'x'));
            files.push_back(std::move(*file));
        }
        const Leftover named(folder.write("named.txt", "text"), LeftoverKind::kFile);
        const auto kept = io::OutputFolder::make(folder.path() / "kept");
        if (!io::write_file(folder.path() / "kept" / "whole.txt", "text")) ::_exit(1);
        end_by_signal(SIGTERM);
    }
    int status = -1;
    REQUIRE(::waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status));
    CHECK(WTERMSIG(status) == SIGTERM);
    CHECK(folder.names() == std::vector<std::string>{"kept"});
    CHECK(folder.text("kept/whole.txt") == "text");
}

TEST_CASE("nothing is left of what a killed process had begun") {
    TemporaryFolder folder;
    REQUIRE(io::write_file(folder.path() / "tree.txt", "old"));
    std::array<int, 2> ends{};
    REQUIRE(::pipe(ends.data()) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
        auto file = io::OutputFile::create(folder.path() / "tree.txt");
        file->write(std::string(5'000'000, 'x'));
        if (::write(ends[1], "x", 1) == 1) ::pause();
        ::_exit(1);
    }
    char begun = 0;
    REQUIRE(::read(ends[0], &begun, 1) == 1);
    const int nameless = ::open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
    REQUIRE(::kill(child, SIGKILL) == 0);
    REQUIRE(::waitpid(child, nullptr, 0) == child);
    for (const int end : ends) ::close(end);
    CHECK(folder.text("tree.txt") == "old");
    if (nameless >= 0)
        CHECK(folder.names() == std::vector<std::string>{"tree.txt"});
    else
        MESSAGE("SKIPPED: this file system has no files without names");
    ::close(nameless);
}

TEST_CASE("a pipe stays where the file that belongs to it fails") {
    TemporaryFolder folder;
    const fs::path pipe = folder.path() / "pipe", taken = folder.path() / "taken";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    auto first = io::OutputFile::create(pipe), second = io::OutputFile::create(taken);
    REQUIRE(first);
    REQUIRE(second);
    fs::create_directories(taken / "full"); // which no file replaces
    CHECK_FALSE(io::commit_both(*first, *second));
    CHECK(fs::is_fifo(pipe));
    CHECK(folder.names() == std::vector<std::string>{"pipe", "taken"});
    ::close(reader);
}

TEST_CASE("what was read is not written over, whatever it is called") {
    TemporaryFolder folder;
    const fs::path input = folder.write("tree.swc", "precious"), session = folder.write("s.json", "session");
    fs::create_symlink("tree.swc", folder.path() / "link.png");
    fs::create_hard_link(input, folder.path() / "hard.png");
    REQUIRE(io::read_file(input));
    io::note_input(session, io::InputKind::kSession);
    for (const char* name : {"tree.swc", "link.png", "hard.png", "s.json"}) {
        CAPTURE(name);
        const auto written = io::write_file(folder.path() / name, "picture");
        REQUIRE_FALSE(written);
        CHECK(written.error().where == (folder.path() / name).string());
        CHECK(written.error().what.find("this run reads it") != std::string::npos);
        CHECK_FALSE(io::check_output(folder.path() / name));
    }
    CHECK(folder.text("tree.swc") == "precious");
    CHECK_FALSE(io::write_file(input, "session", io::InputKind::kSession));
    CHECK(io::write_file(session, "session again", io::InputKind::kSession)); // itself
    CHECK(folder.text("s.json") == "session again");
    io::note_input(session, io::InputKind::kSession);
    io::note_input(session); // a script too
    CHECK_FALSE(io::write_file(session, "once more", io::InputKind::kSession));
}

TEST_CASE("a new file is not taken for one that was read and is gone") {
    TemporaryFolder folder;
    for (int i = 0; i < 20; ++i) { // file systems give away the numbers of removed files soon
        const fs::path input = folder.write("input", "old");
        REQUIRE(io::read_file(input));
        fs::remove(input);
        REQUIRE(io::write_file(folder.path() / "output", "first"));
        CHECK(io::write_file(folder.path() / "output", "second"));
    }
}
