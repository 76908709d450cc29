#include "app/actions/export_words.h"

#include "app/actions/arguments.h"
#include "app/actions/case_pages.h"
#include "app/assets/assets.h"
#include "app/picture/surface_names.h"
#include "app/reports/table_kinds.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

bool is_figure(ExportWhat what) {
    return what == ExportWhat::kPicture || what == ExportWhat::kSheet || what == ExportWhat::kTurntable;
}

// Parses the options.
Result<void> read_options(Export& wanted, Arguments words) {
    if (is_figure(wanted.what)) {
        FigureRequest request;
        request.options.sheet = wanted.what == ExportWhat::kSheet;
        if (wanted.what == ExportWhat::kTurntable) request.options.turntable = kUsualTurntable;
        if (auto read = read_figure_words(words, request); !read) return read;
        if (wanted.what != ExportWhat::kTurntable && request.options.turntable != 0)
            return fail("only a turntable has several pictures", {}, kExportUsage);
        wanted.size = request.size;
        wanted.figure = std::move(request.options);
        return {};
    }
    if (wanted.what == ExportWhat::kPage) {
        if (auto good = page_choice(words); !good) return tl::unexpected(good.error());
        wanted.page.assign(words.begin(), words.end());
        return {};
    }
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        if (word == "--for-printing") {
            wanted.for_printing = true;
            continue;
        }
        if (word != "--of" && word != "--parts" && word != "--rows" && word != "--case")
            return fail("export takes what, and one file", {}, kExportUsage);
        const std::string value = i + 1 < words.size() ? words[++i] : std::string();
        const auto* const scope = std::ranges::find(kExportScopes, value, &ExportScope::key);
        if (word == "--of" && scope == kExportScopes.end())
            return fail("--of takes visible, selected or all", {}, kExportUsage);
        if (word == "--rows" && value != "branches" && table_kind_named(value) == nullptr)
            return fail("--rows takes branches, or one of " + table_names(), {}, kExportUsage);
        if (word == "--case") wanted.case_line = value;
        if (word == "--of") wanted.of = scope->of;
        if (word == "--rows") wanted.table = value == "branches" ? "" : value;
        if (word == "--parts" && !(wanted.parts = parts_named(value)))
            return fail("--parts takes branch, system or none", {}, kExportUsage);
    }
    if (wanted.what != ExportWhat::kSurface && (wanted.parts || wanted.for_printing))
        return fail("only a surface has parts, or is printed", {}, kExportUsage);
    if (wanted.what != ExportWhat::kReport && !wanted.case_line.empty())
        return fail("only a report has a case line", {}, kExportUsage);
    if (wanted.what != ExportWhat::kTable && !wanted.table.empty())
        return fail("only a table has rows of a kind", {}, kExportUsage);
    return {};
}

} // namespace

// The file may be between the options, as on a command line.
Result<Export> export_in(ActionContext& context, Arguments arguments) {
    Export wanted;
    const auto kind = export_kind_named(arguments[0]);
    if (!kind) return fail("there is no export of \"" + arguments[0] + "\"", {}, kExportUsage);
    wanted.what = *kind;
    std::vector<std::string> options;
    std::string file;
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word.starts_with("--")) {
            options.push_back(word);
            const bool alone = word == "--for-printing" || word == "--as-near";
            if (!alone && i + 1 < arguments.size()) options.push_back(arguments[++i]);
        } else if (word.empty() || !file.empty()) {
            return fail("export takes what, and one file", {}, kExportUsage);
        } else {
            file = word;
        }
    }
    if (file.empty()) return fail("export takes a file", {}, kExportUsage);
    if (auto read = read_options(wanted, options); !read) return tl::unexpected(read.error());
    RAMUS_TRY(path, file_argument(context, Arguments(&file, 1), "export", ""));
    wanted.file = fs::absolute(path).lexically_normal();
    return wanted;
}

std::string saved_text(const char* what, const Export& wanted) {
    return std::string(what) + " saved: " + wanted.file.string();
}

Result<void> expect_extension(const Export& wanted, std::string_view extension, const char* what) {
    if (io::lower_case(wanted.file.extension().string()) == extension) return {};
    return fail(std::string(what) + " is a file of type " + std::string(extension), wanted.file.string(),
                "give the name this ending");
}

Continuation has_written(fs::path file, std::string sentence) {
    return [file = std::move(file), sentence = std::move(sentence)](ActionContext& then) {
        then.say(sentence);
        if (then.window != nullptr) then.window->wrote(file, sentence);
        return Result<void>{};
    };
}

Pending done_in_process(const char* verb, std::function<Result<void>(Job&)> work, const fs::path& file,
                        std::string sentence) {
    return {std::string(verb) + " " + file.filename().string(),
            [work = std::move(work), file, sentence = std::move(sentence)](Job& job) -> Result<Continuation> {
                if (auto done = work(job); !done) return tl::unexpected(done.error());
                return has_written(file, sentence);
            },
            true};
}

Pending writing_table(const ActionContext& context, fs::path file, TableOf table, std::string sentence) {
    const auto now = std::make_shared<const std::pair<Document, Assets>>(context.document, context.assets);
    const std::string activity = "Writing " + file.filename().string();
    const auto work = [now, file = std::move(file), table = std::move(table),
                       sentence = std::move(sentence)](Job&) -> Result<Continuation> {
        const auto& [document, assets] = *now;
        if (auto written = io::write_file(file, csv_of(table(document, assets))); !written)
            return tl::unexpected(written.error());
        return has_written(file, sentence);
    };
    return {activity, work};
}

} // namespace ramus::app::actions
