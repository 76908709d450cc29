// Commands files: one command per line; `#` starts a comment; double quotes hold words with blanks (\" and \\ inside
// them); a word that begins with a brace is JSON up to the matching brace. A failing line stops the run, and the
// error's location is file:line.
#pragma once

#include "app/actions/command_runner.h"

namespace ramus::app {

struct ScriptLine {
    int number = 0; // from 1
    std::vector<std::string> words;
    bool operator==(const ScriptLine&) const = default;
};

// Skips lines without words. Fails on an unclosed quote.
[[nodiscard]] Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& file);
[[nodiscard]] Result<std::vector<ScriptLine>> read_script(const std::filesystem::path& path);

// `overwrite`: whether existing files are replaced (io::KeepExistingFiles).
[[nodiscard]] Result<void> run_line(ActionContext& context, const ScriptLine& line, const std::string& file,
                                    bool overwrite = true);
[[nodiscard]] Result<void> run_script(ActionContext& context, const std::vector<ScriptLine>& lines,
                                      const std::string& file, bool overwrite = true);

} // namespace ramus::app
