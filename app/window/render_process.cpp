#include "app/window/render_process.h"

#include "app/session/progress_lines.h"
#include "app/session/session_file.h"
#include "core/base/child_program.h"
#include "core/base/scratch_folder.h"
#include "core/base/words.h"
#include "core/io/output_file.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

constexpr float kSurfacesShare = 0.3F; // share of the progress before drawing

// A line of a commands file.
std::string script_line(const std::vector<std::string>& words) {
    std::string line;
    for (const std::string& word : words) {
        line += line.empty() ? "\"" : " \"";
        for (const char c : word) {
            if (c == '"' || c == '\\') line += '\\';
            line += c == '\n' || c == '\r' ? ' ' : c;
        }
        line += '"';
    }
    return line + "\n";
}

// Handles a progress line; false: another line.
bool follow(std::string_view line, Job& job) {
    if (!line.starts_with(kProgressLine)) return false;
    line.remove_prefix(std::string_view(kProgressLine).size());
    const std::size_t blank = line.find(' ');
    const auto done = parsed<float>(line.substr(0, blank));
    if (!done || blank == std::string_view::npos) return true;
    const float share = std::clamp(*done, 0.0F, 1.0F);
    const bool draws = line.substr(blank + 1) == "pictures";
    job.report(
        std::max(job.progress(), draws ? kSurfacesShare + (1.0F - kSurfacesShare) * share : kSurfacesShare * share));
    return true;
}

// Removes references to the temporary script, which mean nothing to the user.
Error without_script(Error error, const fs::path& script) {
    const std::string before = "ramus: ", line = script.string() + ":1: ";
    if (error.what.starts_with(before)) error.what.erase(0, before.size());
    if (error.what.starts_with(line)) error.what.erase(0, line.size());
    return error;
}

} // namespace

Result<std::function<Result<void>(Job&)>> render_process_work(const Session& session,
                                                              const std::vector<std::string>& words, bool software) {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (error) return fail("the program's own file is not known: " + error.message());
    return [program, session, script = script_line(words), software](Job& job) -> Result<void> {
        RAMUS_TRY(scratch, ScratchFolder::create());
        const fs::path file = scratch.path() / "session.ramus.json", commands = scratch.path() / "commands";
        if (auto written = write_session(session, file); !written) return written;
        if (auto written = io::write_file(commands, script); !written) return written;
        std::vector<std::string> run{program.string(),  "render", "--session", file.string(), "--commands",
                                     commands.string(), "--size", "64x64",     "--overwrite"};
        if (!software) run.insert(run.end(), {"--backend", "egl"});
        if (const std::uint64_t memory = session.marks.options.memory_bytes; memory > 0)
            run.insert(run.end(), {"--memory", std::to_string(memory)});
        RAMUS_TRY(child, ChildProgram::start(run, {std::string(kProgressVariable) + "=" + kProgressLines}));
        if (auto done = child.wait(job, [&job](std::string_view line) { return follow(line, job); }); !done)
            return tl::unexpected(without_script(done.error(), commands));
        return {};
    };
}

} // namespace ramus::app
