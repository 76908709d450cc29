#include "app/actions/script.h"

#include "core/io/input_file.h"
#include "core/io/run_inputs.h"

namespace ramus::app {

namespace {

// Position after the brace that closes the one at `at`.
std::size_t end_of_object(std::string_view line, std::size_t at) {
    int depth = 0;
    bool quoted = false;
    for (; at < line.size(); ++at) {
        if (quoted && line[at] == '\\')
            ++at;
        else if (line[at] == '"')
            quoted = !quoted;
        else if (!quoted && line[at] == '{')
            ++depth;
        else if (!quoted && line[at] == '}' && --depth == 0)
            return at + 1;
    }
    return std::string_view::npos;
}

Result<std::vector<std::string>> words_of(std::string_view line, const std::string& where) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < line.size();) {
        if (line[i] == ' ' || line[i] == '\t' || line[i] == '\r') {
            ++i;
            continue;
        }
        if (line[i] == '#') break;
        std::string word;
        if (line[i] == '{') { // JSON, as it stands
            const std::size_t end = end_of_object(line, i);
            if (end == std::string_view::npos) return fail("a brace is not closed", where, "close it on the same line");
            words.emplace_back(line.substr(i, end - i));
            i = end;
            continue;
        }
        bool quoted = false;
        for (; i < line.size(); ++i) {
            const char c = line[i];
            if (c == '"')
                quoted = !quoted;
            else if (quoted && c == '\\' && i + 1 < line.size() && (line[i + 1] == '"' || line[i + 1] == '\\'))
                word += line[++i];
            else if (!quoted && (c == ' ' || c == '\t' || c == '\r'))
                break;
            else
                word += c;
        }
        if (quoted) return fail("a double quote is not closed", where, "close it on the same line");
        words.push_back(std::move(word));
    }
    return words;
}

std::string location(const std::string& file, int number) { return file + ":" + std::to_string(number); }

} // namespace

Result<std::vector<ScriptLine>> parse_script(std::string_view text, const std::string& file) {
    std::vector<ScriptLine> lines;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = text.find('\n');
        RAMUS_TRY(words, words_of(text.substr(0, end), location(file, number)));
        if (!words.empty()) lines.push_back({number, std::move(words)});
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    }
    return lines;
}

Result<std::vector<ScriptLine>> read_script(const std::filesystem::path& path) {
    constexpr std::uintmax_t kMostBytes = std::uintmax_t{64} << 20;
    RAMUS_TRY(text, io::read_file(path, kMostBytes));
    return parse_script(text, path.string());
}

Result<void> run_line(ActionContext& context, const ScriptLine& line, const std::string& file, bool overwrite) {
    const io::KeepExistingFiles keep(!overwrite);
    auto done = run_command(context, line.words);
    if (done) return {};
    Error error = done.error();
    if (!error.where.empty()) error.what = error.where + ": " + error.what;
    error.where = location(file, line.number);
    return tl::unexpected(error);
}

Result<void> run_script(ActionContext& context, const std::vector<ScriptLine>& lines, const std::string& file,
                        bool overwrite) {
    for (const ScriptLine& line : lines)
        if (auto done = run_line(context, line, file, overwrite); !done) return done;
    return {};
}

} // namespace ramus::app
