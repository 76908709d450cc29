#include "app/session/document.h"
#include "app/storage/autosave.h"
#include "app/workspace/workspace.h"
#include "tests/support/temporary_folder.h"

#include <chrono>
#include <csignal>
#include <doctest/doctest.h>
#include <fcntl.h>
#include <fstream>
#include <sys/resource.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

using namespace ramus;
using namespace ramus::app;
using autosave::find_abandoned;
using autosave::Slot;
using autosave::Snapshot;
namespace fs = std::filesystem;

namespace {

Snapshot snapshot_of(const fs::path& tree) {
    Snapshot snapshot;
    snapshot.session.tree = {tree, "0123456789abcdef"};
    snapshot.session.marks.selection = {2, 5};
    snapshot.session.marks.lesions = {{.sphere = {1.5, -2.25, 1.0 / 3.0, 10.0}}};
    number_objects(snapshot.session.marks);
    snapshot.session.camera.position = {0.1, 1.0 / 3.0, -7e-5};
    snapshot.file = tree.parent_path() / "plan.ramus.json";
    snapshot.changes = 14;
    snapshot.saved = std::chrono::system_clock::time_point(std::chrono::seconds(1'700'000'000));
    return snapshot;
}

// Runs `work` in a process of its own, which then is killed as kill -9 does.
template <class Work> void in_killed_process(const Work& work) {
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        if (!work()) ::_exit(1);
        ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
}

void leave_behind(const fs::path& folder, const Snapshot& snapshot) {
    in_killed_process([&] {
        auto slot = Slot::take(folder);
        return slot && slot->write(snapshot);
    });
}

void hide(Document& document, int branch) {
    Marks next = document.marks();
    set_state(next, std::vector<int>{branch}, tree::BranchState::kHidden);
    document.change(std::move(next));
}

// As the window does, with a clock of its own.
struct Run {
    Document document;
    Autosaver saver;
    double now = 0.0;
    std::vector<Error> errors;
    explicit Run(const fs::path& folder) : saver(folder, {}) {
        Session session;
        session.tree.path = "/data/liver.swc";
        document.open(nullptr, session);
        step(0.0);
    }
    void step(double seconds) {
        now += seconds;
        if (auto error = saver.update(document, now)) errors.push_back(*error);
        while (saver.busy()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            if (auto error = saver.update(document, now)) errors.push_back(*error);
        }
    }
    [[nodiscard]] bool due() const { return saver.wait_seconds(now) <= 0.0; }
};

std::vector<fs::path> files_in(const fs::path& folder, const std::string& ending) {
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator each(folder, error), end; !error && each != end; each.increment(error))
        if (each->path().extension() == ending) found.push_back(each->path());
    return found;
}

} // namespace

TEST_CASE("the recovery file of a killed process is found, restored exactly, and can be discarded") {
    const TemporaryFolder folder;
    const Snapshot snapshot = snapshot_of("/data/liver.swc");
    leave_behind(folder.path(), snapshot);
    {
        auto found = find_abandoned(folder.path());
        REQUIRE(found.size() == 1);
        const auto read = found[0].read();
        REQUIRE_MESSAGE(read, read.error().message());
        CHECK(*read == snapshot);
    }
    // Nobody decided: it is offered again.
    auto again = find_abandoned(folder.path());
    REQUIRE(again.size() == 1);
    again[0].remove();
    CHECK(folder.names().empty());
    CHECK(find_abandoned(folder.path()).empty());
}

TEST_CASE("recovery files of running processes are not offered, and each file is offered to one process only") {
    const TemporaryFolder folder;
    auto living = Slot::take(folder.path());
    REQUIRE(living);
    REQUIRE(living->write(snapshot_of("/data/a.swc")));
    CHECK(find_abandoned(folder.path()).empty());
    leave_behind(folder.path(), snapshot_of("/data/b.swc"));
    const auto first = find_abandoned(folder.path());
    REQUIRE(first.size() == 1);
    CHECK(find_abandoned(folder.path()).empty()); // another that starts while the first one asks
    auto other = Slot::take(folder.path());
    REQUIRE(other);
    CHECK(other->file() != living->file());
    CHECK(other->file() != first[0].file());
}

TEST_CASE("several recovery files are offered separately, the newest first") {
    const TemporaryFolder folder;
    for (const char* tree : {"/data/a.swc", "/data/b.swc", "/data/c.swc"})
        leave_behind(folder.path(), snapshot_of(tree));
    const auto files = files_in(folder.path(), ".json");
    REQUIRE(files.size() == 3);
    auto found = find_abandoned(folder.path());
    REQUIRE(found.size() == 3);
    for (std::size_t i = 1; i < found.size(); ++i)
        CHECK(fs::last_write_time(found[i - 1].file()) >= fs::last_write_time(found[i].file()));
    found[1].remove();
    CHECK(files_in(folder.path(), ".json").size() == 2);
}

TEST_CASE("a damaged recovery file is kept and reported, not opened") {
    const TemporaryFolder folder;
    const auto reads = [&](const std::string& text) {
        std::ofstream(folder.path() / "7-0.json") << text;
        auto found = find_abandoned(folder.path());
        REQUIRE(found.size() == 1);
        const auto read = found[0].read();
        REQUIRE_FALSE(read);
        CHECK(read.error().where.ends_with("7-0.json"));
        return read.error().what;
    };
    CHECK(reads("") == "this recovery file is damaged");
    CHECK(reads("\x7f"
                "ELF") == "this recovery file is damaged");
    CHECK(reads("[]") == "this recovery file is damaged");
    CHECK(reads(R"({"ramus_autosave": 1, "saved": -5, "changes": 1, "file": "", "session": {}})") ==
          "this recovery file is damaged");
    CHECK(reads(R"({"ramus_autosave": 1, "saved": 5, "changes": "x", "file": "", "session": {}})") ==
          "this recovery file is damaged");
    CHECK(reads(R"({"ramus_autosave": 2, "saved": 5, "changes": 1, "file": "", "session": {}})") ==
          "another version of ramus wrote this recovery file");
    CHECK(reads(R"({"ramus_autosave": 1, "saved": 5, "changes": 1, "file": "", "session": {"version": 1}})") ==
          "no tree");
    CHECK(fs::exists(folder.path() / "7-0.json"));
}

TEST_CASE("locks without a file, and incomplete files of ended processes, are removed") {
    const TemporaryFolder folder;
    pid_t dead = 0;
    in_killed_process([&] { return bool(Slot::take(folder.path())); });
    dead = ::fork();
    if (dead == 0) ::_exit(0);
    ::waitpid(dead, nullptr, 0);
    std::ofstream(folder.path() / (".ramus-" + std::to_string(dead) + "-0.part")) << "half";
    std::ofstream(folder.path() / (".ramus-" + std::to_string(::getpid()) + "-0.part")) << "at work";
    CHECK(find_abandoned(folder.path()).empty());
    CHECK(folder.names() == std::vector<std::string>{".ramus-" + std::to_string(::getpid()) + "-0.part"});
    CHECK(find_abandoned(folder.path() / "not there").empty());
    CHECK(find_abandoned({}).empty());
}

TEST_CASE("a modified session is kept once changes pause, and also during long changes") {
    const TemporaryFolder folder;
    Run run(folder.path() / "autosave");
    run.step(10.0);
    CHECK(folder.names().empty()); // nothing to keep
    render::Camera turned;
    turned.view_angle = 10.0;
    run.document.set_camera(turned);
    Marks coloured = run.document.marks();
    coloured.colour_by = ColourBy::kSystem;
    run.document.change(std::move(coloured));
    run.step(10.0);
    CHECK(folder.names().empty()); // a view is no work: nothing would be offered but "0 changes"

    hide(run.document, 3);
    run.step(0.0);
    CHECK_FALSE(run.due());
    run.step(Autosaver::kSettleSeconds);
    const auto files = files_in(folder.path() / "autosave", ".json");
    REQUIRE(files.size() == 1);
    CHECK(fs::status(folder.path() / "autosave").permissions() == fs::perms::owner_all);

    // Changes without a pause: it is written all the same.
    const auto first = fs::last_write_time(files[0]);
    double waited = 0.0;
    for (int i = 0; fs::last_write_time(files[0]) == first && waited < 60.0; ++i, waited += 0.1) {
        render::Camera camera;
        camera.view_angle = 10.0 + 0.01 * i;
        run.document.set_camera(camera);
        run.step(0.1);
        std::this_thread::sleep_for(std::chrono::milliseconds(1)); // for another time of the file
    }
    CHECK(waited < Autosaver::kLatestSeconds + 0.3); // looked at every 0.2 s
    CHECK(waited >= Autosaver::kBetweenSeconds - 0.8);

    // Saved, or undone to what was saved: nothing is left to recover.
    run.document.mark_saved("/data/plan.ramus.json");
    run.step(0.0);
    CHECK(files_in(folder.path() / "autosave", ".json").empty());
    hide(run.document, 4);
    run.step(0.0);
    run.step(10.0);
    CHECK(files_in(folder.path() / "autosave", ".json").size() == 1);
    run.document.undo();
    run.step(0.0);
    CHECK(files_in(folder.path() / "autosave", ".json").empty());

    hide(run.document, 5);
    run.step(0.0);
    run.step(10.0);
    run.saver.leave();
    CHECK(fs::is_empty(folder.path() / "autosave"));
    CHECK(run.errors.empty());
}

TEST_CASE("a folder that cannot be written is reported once, and work continues") {
    const TemporaryFolder folder;
    const fs::path blocked = folder.path() / "a file" / "autosave";
    std::ofstream(folder.path() / "a file") << "in the way";
    for (const fs::path& nowhere : {blocked, fs::path()}) {
        Run run(nowhere);
        for (int i = 0; i < 4; ++i) {
            hide(run.document, i);
            run.step(0.0);
            run.step(10.0);
        }
        CHECK(run.errors.size() == 1);
        CHECK(run.document.unsaved_changes() == 4);
    }
    // When it can be written again, it is; and the next trouble is told again.
    Run run(blocked);
    hide(run.document, 1);
    run.step(0.0);
    run.step(10.0);
    CHECK(run.errors.size() == 1);
    fs::remove(folder.path() / "a file");
    hide(run.document, 2);
    run.step(0.0);
    run.step(10.0);
    CHECK(files_in(blocked, ".json").size() == 1);
    CHECK(run.errors.size() == 1);
}

TEST_CASE("a full disk is reported once, and the last complete file is kept") {
    const TemporaryFolder folder;
    const pid_t child = ::fork(); // the limit is for good
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        Run run(folder.path());
        hide(run.document, 3);
        run.step(0.0);
        run.step(10.0);
        if (!run.errors.empty()) ::_exit(2);
        const rlimit none{16, 16}; // bytes in a file
        ::setrlimit(RLIMIT_FSIZE, &none);
        for (int i = 4; i < 7; ++i) {
            hide(run.document, i);
            run.step(0.0);
            run.step(10.0);
        }
        ::_exit(run.errors.size() == 1 ? 0 : 3);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    CHECK(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 0);
    const auto found = find_abandoned(folder.path());
    REQUIRE(found.size() == 1);
    const auto read = found[0].read();
    REQUIRE(read);
    CHECK(branches_in_state(read->session.marks, tree::BranchState::kHidden) == std::vector<int>{3});
}

TEST_CASE("a recovered file is replaced, and exists at every moment") {
    const TemporaryFolder folder;
    leave_behind(folder.path(), snapshot_of("/data/liver.swc"));
    auto found = find_abandoned(folder.path());
    REQUIRE(found.size() == 1);
    const fs::path file = found[0].file();
    Run run(folder.path());
    hide(run.document, 1);
    run.step(0.0);
    run.step(10.0);
    CHECK(files_in(folder.path(), ".json").size() == 2);
    run.saver.take_over(std::move(found[0]));
    CHECK(files_in(folder.path(), ".json") == std::vector<fs::path>{file});
    run.document.mark_unsaved(14);
    hide(run.document, 2);
    run.step(0.0);
    run.step(10.0);
    CHECK(files_in(folder.path(), ".json") == std::vector<fs::path>{file});
    CHECK(find_abandoned(folder.path()).empty()); // it is ours
    run.document.mark_saved("/data/plan.ramus.json");
    run.step(0.0);
    CHECK(folder.names().empty());
}

TEST_CASE("recovering restores all unsaved work, and refuses another tree") {
    const TemporaryFolder folder;
    const fs::path tree = folder.path() / "fork.swc";
    const auto write = [&](const char* text) { std::ofstream(tree) << text; };
    constexpr const char* kFork = "1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n3 3 10 0 30 1 2\n4 3 -10 0 30 1.5 2\n";
    write(kFork);
    Snapshot snapshot;
    snapshot.session.tree = {tree, *checksum_of(tree)};
    snapshot.session.marks.selection = {1};
    snapshot.session.marks.names = {{2, "left"}};
    snapshot.session.camera.position = {1.0, 2.0, 3.0};
    snapshot.changes = 3;
    Job job;
    const auto loaded = load(snapshot, job);
    REQUIRE_MESSAGE(loaded, loaded.error().message());
    CHECK(loaded->session == snapshot.session);
    CHECK(loaded->has_camera);
    CHECK(loaded->unsaved_changes == 3);

    Workspace workspace({});
    io::ReadOptions said;
    said.unit = io::length_unit("um"); // of what the program was started with, not of what is recovered
    workspace.say_reading(said);
    workspace.recover(snapshot);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!workspace.document().tree() && std::chrono::steady_clock::now() < end) {
        workspace.update();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    CHECK(workspace.document().session() == snapshot.session);
    CHECK(workspace.document().modified());
    CHECK(workspace.document().has_unsaved_work());
    CHECK(workspace.document().unsaved_changes() == 3);
    const auto opened = workspace.take_opened();
    REQUIRE(opened);
    CHECK(opened->recovered);

    write("1 3 0 0 0 2 -1\n2 3 0 0 20 2 1\n");
    const auto changed = load(snapshot, job);
    REQUIRE_FALSE(changed);
    CHECK(changed.error().message() == tree.string() + ": fork.swc has changed since the session was saved; its "
                                                       "recovery file is kept until you discard it");
    fs::remove(tree);
    const auto gone = load(snapshot, job);
    REQUIRE_FALSE(gone);
    CHECK(gone.error().message().find("fork.swc") != std::string::npos);
    CHECK(gone.error().hint == "its recovery file is kept until you discard it");
}
