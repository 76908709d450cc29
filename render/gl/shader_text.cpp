#include "render/gl/shader_text.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <tuple>

namespace ramus::render {

namespace {

constexpr const char* kInAllShaders[] = {"bindings.glsl", "limits.glsl", "ids.glsl", "look/lanes.glsl",
                                         "look/octahedral.glsl"};
constexpr int kDeepestInclude = 8; // a file that includes itself would never end

class Assembler {
public:
    Assembler(ShaderText& text, int version) : text_(text), version_(version) {}

    // Appends the file's lines, including those of included files.
    void add(std::string_view name, int depth = 0) {
        const auto found = kShaderSources.find(name);
        const std::size_t file = number_of(name);
        if (found == kShaderSources.end() || depth > kDeepestInclude) {
            out_ << "#line 1 " << file << "\n#error no shader file of this name\n";
            return;
        }
        out_ << "#line 1 " << file << '\n';
        std::istringstream lines{std::string(found->second)};
        int line_number = 1;
        for (std::string line; std::getline(lines, line); ++line_number) {
            constexpr std::string_view kInclude = "#include \"";
            if (line.starts_with(kInclude)) {
                const std::size_t end = line.find('"', kInclude.size());
                add(std::string_view(line).substr(kInclude.size(), end - kInclude.size()), depth + 1);
                out_ << "#line " << line_number + 1 << ' ' << file << '\n';
            } else {
                note_constant(line);
                if (line.starts_with("layout(")) line = with_number(line);
                out_ << (version_ < 430 ? without_number(line) : line) << '\n';
            }
        }
    }

    [[nodiscard]] std::string finish() const { return out_.str(); }

private:
    std::size_t number_of(std::string_view name) {
        const auto found = std::ranges::find(text_.files, name);
        if (found != text_.files.end()) return static_cast<std::size_t>(found - text_.files.begin());
        text_.files.emplace_back(name);
        return text_.files.size() - 1;
    }

    // "const int kName = 7;"
    void note_constant(const std::string& line) {
        constexpr std::string_view kBegins = "const int ", kIs = " = ";
        const std::size_t is = line.find(kIs);
        if (line.starts_with(kBegins) && is != std::string::npos)
            constants_.try_emplace(line.substr(kBegins.size(), is - kBegins.size()),
                                   line.substr(is + kIs.size(), line.find(';') - is - kIs.size()));
    }

    // Replaces the name in "layout(binding = kName)..." by its number: not every version accepts a constant there.
    [[nodiscard]] std::string with_number(const std::string& line) const {
        const std::size_t end = line.find(')'), is = line.rfind(' ', end) + 1;
        const auto found = constants_.find(line.substr(is, end - is));
        return found == constants_.end() ? line : line.substr(0, is) + found->second + line.substr(end);
    }

    std::string without_number(const std::string& line) {
        using Named = std::vector<ShaderText::Numbered>;
        static const std::tuple<std::regex, Named ShaderText::*, const char*> kinds[] = {
            {std::regex(R"(^layout\(location = (\d+)\) uniform (\w+ (\w+).*)$)"), &ShaderText::uniforms, "uniform "},
            {std::regex(R"(^layout\(binding = (\d+)\) uniform (\w+ (\w+).*)$)"), &ShaderText::samplers, "uniform "},
            {std::regex(R"(^layout\(std140, binding = (\d+)\) uniform ((\w+).*)$)"), &ShaderText::blocks,
             "layout(std140) uniform "}};
        std::smatch match;
        for (const auto& [numbered, named, unnumbered] : kinds) {
            if (!std::regex_match(line, match, numbered)) continue;
            (text_.*named).push_back({match[3], std::stoi(match[1])});
            return unnumbered + match[2].str();
        }
        return line;
    }

    ShaderText& text_;
    int version_;
    std::map<std::string, std::string> constants_; // by name, from the files so far
    std::ostringstream out_;
};

} // namespace

ShaderText shader_text(std::string_view name, std::string_view defines, int version, bool full_depth) {
    ShaderText text;
    text.files.emplace_back(name); // number 0: messages without a number refer to this file
    Assembler assembler(text, version);
    const bool wrapped = full_depth && name.ends_with(".vert");
    std::string head = "#version " + std::to_string(version) + " core\n";
    if (version < 430) head += "#define FALLBACK\n";
    if (full_depth) head += "#define FULL_DEPTH\n";
    head += defines;
    if (wrapped) head += "#define main place_vertex\n";
    if (version < 430) assembler.add("fallback.glsl");
    for (const char* common : kInAllShaders) assembler.add(common);
    assembler.add(name);
    text.glsl = head + assembler.finish();
    if (wrapped)
        text.glsl += "#undef main\nvoid main() {\n    place_vertex();\n"
                     "    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;\n}\n";
    return text;
}

std::string with_file_names(const std::string& log, const std::vector<std::string>& files) {
    // Mesa "2:13(5): error: ...", NVIDIA "2(13) : error C1008: ...", AMD, Intel and Apple "ERROR: 2:13: ...".
    static const std::regex position(R"(^((?:ERROR: |WARNING: )?)(\d+)(?::(\d+)(?:\((\d+)\))?|\((\d+)\)) ?:)");
    std::istringstream lines(log);
    std::string result;
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_search(line, match, position)) {
            const std::size_t file = match[2].length() < 6 ? std::stoul(match[2]) : files.size();
            const std::string number = match[3].matched ? match[3] : match[5];
            if (file < files.size()) line = match[1].str() + files[file] + ":" + number + ":" + match.suffix().str();
        }
        if (!result.empty()) result += '\n';
        result += line;
    }
    while (!result.empty() && (result.back() == '\n' || result.back() == '\0')) result.pop_back();
    return result;
}

} // namespace ramus::render
