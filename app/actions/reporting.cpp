// Reports: tables as CSV, and everything on one page with pictures.
#include "app/actions/arguments.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "app/actions/report_pictures.h"
#include "app/assets/assets.h"
#include "app/reports/pdf.h"
#include "app/reports/report_tables.h"
#include "app/reports/table_kinds.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <optional>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

Result<Outcome> write_csv(ActionContext& context, const fs::path& path, std::string_view wanted) {
    const Document& document = context.document;
    const Assets& assets = context.assets;
    const auto there = [&](const TableKind& kind) { return kind.there(document, assets); };
    const auto first = std::ranges::find_if(table_kinds(), there);
    const TableKind* const kind = !wanted.empty()                ? table_kind_named(wanted)
                                  : first == table_kinds().end() ? nullptr
                                                                 : &*first;
    if (kind == nullptr)
        return wanted.empty() ? fail("there is nothing to report", {}, "cut, place a lesion, select or measure first")
                              : fail("there is no table called " + std::string(wanted), {}, "one of " + table_names());
    if (!there(*kind)) return tl::unexpected(nothing_to_report(kind->name));
    return writing_table(context, fs::absolute(path).lexically_normal(), kind->table,
                         "Report of " + std::string(kind->name) + " saved: " + path.string());
}

// The arguments after the file.
struct ReportWords {
    std::string kind;               // kind of table; empty: the first available
    std::string case_line;          // of a page
    std::optional<glm::ivec2> size; // of the user's picture, for its shape; none: the current
};

constexpr int kFinerInPrint = 2; // 300 pixels an inch of the large picture on A4
constexpr const char* kReportUsage =
    "report FILE.html or FILE.pdf [--case TEXT] [--size WxH], or report FILE.csv [KIND]";

Result<ReportWords> report_words(Arguments words) {
    ReportWords found;
    for (std::size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const bool option = word == "--case" || word == "--size";
        if (option && i + 1 == words.size()) return fail(word + " takes a value", {}, kReportUsage);
        if (word == "--case") {
            found.case_line = words[++i];
        } else if (word == "--size") {
            RAMUS_TRY(size, size_in(words[++i]));
            found.size = size;
        } else if (word.starts_with("--") || !found.kind.empty()) {
            return fail("report takes a file and what it is of", {}, "put quotes around a name with blanks");
        } else {
            found.kind = word;
        }
    }
    return found;
}

Result<void> write_page(ActionContext& context, const fs::path& path, const ReportWords& words) {
    const bool printed = is_pdf(path);
    RAMUS_TRY(pictures, take_report_pictures(context, words.size.value_or(context.picture.picture_size()),
                                             printed ? kFinerInPrint : 1));
    const std::string page =
        report_page(context.document, context.assets, pictures, {.made = now_text(), .case_line = words.case_line});
    Job job;
    if (auto written = printed ? write_pdf(page, path, job) : io::write_file(path, page); !written) return written;
    context.say("Report saved: " + path.string());
    return {};
}

Result<Outcome> report(ActionContext& context, Arguments arguments) {
    if (arguments.empty() && context.files != nullptr && context.files->asks()) {
        context.files->ask_for_export("report");
        return Done{};
    }
    RAMUS_TRY(words, report_words(arguments.subspan(std::min<std::size_t>(arguments.size(), 1))));
    RAMUS_TRY(path,
              file_argument(context, arguments.first(std::min<std::size_t>(arguments.size(), 1)), "report", ".html"));
    if (!has_tree(context.document)) return fail("there is no tree to report of");
    const std::string extension = io::lower_case(path.extension().string());
    complete_lesions(context.assets, context.document);
    if (context.window == nullptr)
        complete_contacts(context.assets, context.document); // a window computes them in the background
    const bool of_page = !words.case_line.empty() || words.size;
    if (extension == ".csv" && of_page)
        return fail("--case and --size are of a report as a page", path.string(), kReportUsage);
    if (extension == ".csv") return write_csv(context, path, words.kind);
    if (extension != ".html" && extension != ".htm" && extension != ".pdf")
        return fail("a report is a .csv, .html or .pdf file", path.string(), "give the name one of these endings");
    if (!words.kind.empty())
        return fail("a report as " + extension + " has everything", path.string(), "leave \"" + words.kind + "\" out");
    if (auto possible = is_pdf(path) ? check_pdf_program() : Result<void>(); !possible)
        return tl::unexpected(possible.error());
    const fs::path full = fs::absolute(path).lexically_normal();
    if (auto possible = io::check_output(full); !possible) return tl::unexpected(possible.error());
    const glm::ivec2 shape = words.size.value_or(context.picture.picture_size());
    std::vector<std::string> there{"report", full.string(), "--size",
                                   std::to_string(shape.x) + "x" + std::to_string(shape.y)};
    if (!words.case_line.empty()) there.insert(there.end(), {"--case", words.case_line});
    RAMUS_TRY(detached, context.picture.detached_work(there));
    if (!detached) return outcome_of(write_page(context, path, words));
    return done_in_process("Writing", detached, full, "Report saved: " + full.string());
}

} // namespace

std::vector<Command> report_commands() {
    return {
        Command(
            "report", "[FILE [KIND] [OPTIONS]]",
            "Writes a report: .html or .pdf with pictures and all tables, and a case line at its head that is in no "
            "other file; or .csv of one of " +
                table_names() + ", the first of them that there is unless told. A window asks for the file.",
            report)
            .in_menu("Plan", "Report...")
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
