// `ramus report FILE -o HTML|PDF|CSV`: the report that the window writes.
#include "app/actions/command_runner.h"
#include "app/commands/case_stage.h"
#include "app/commands/output_target.h"
#include "app/commands/picture_flags.h"
#include "app/commands/subcommands.h"
#include "app/reports/table_kinds.h"
#include "core/io/text_numbers.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

namespace {

struct ReportFlags {
    CaseFlags of;
    std::filesystem::path output;
    std::string format; // of standard output
    std::string case_line, table;
    glm::ivec2 size{1600, 1200};
};

bool is_table(const std::filesystem::path& file) { return io::lower_case(file.extension().string()) == ".csv"; }

Result<int> run_report(const ReportFlags& flags) {
    const bool page = !is_table(flags.output);
    RAMUS_TRY(stage, CaseStage::open(flags.of, flags.size, page || !flags.of.commands.empty()));
    std::vector<std::string> words{"report", flags.output.string()};
    if (!flags.table.empty()) words.push_back(flags.table);
    if (!flags.case_line.empty()) words.insert(words.end(), {"--case", flags.case_line});
    if (auto written = run_command(stage->context(), words); !written) return tl::unexpected(written.error());
    return kDone;
}

} // namespace

void register_report(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<ReportFlags>();
    CLI::App* command = add_command(app, "report", "Pictures and tables of a case, to print or to compute with");
    add_option(*command, "-o,--output", "FILE", flags->output,
               "Page (.html, .pdf) or table (.csv) to write; - is standard output")
        ->required();
    add_format_flag(*command, flags->format, {".html", ".pdf", ".csv"});
    add_option(*command, "--case", "TEXT", flags->case_line, "Line at the head of the page, and in no other file");
    add_option(*command, "--table", "NAME", flags->table,
               "Table of a .csv: " + table_names() + " (default: the first that there is)")
        ->check(expecting(" is no table of a report",
                          [](const std::string& word) { return table_kind_named(word) != nullptr; }));
    add_size_flag(*command, flags->size);
    add_case_flags(*command, flags->of);
    command->callback([flags, command, &chosen] {
        check_case_flags(flags->of);
        check_output_flags(*command, flags->output, flags->format);
        const bool table = is_table(flags->output) || io::lower_case(flags->format).ends_with("csv");
        if (!flags->table.empty() && !table)
            throw CLI::ValidationError("--table", "is of a .csv; pages have all tables");
        if (!flags->case_line.empty() && table) throw CLI::ValidationError("--case", "is of a page, not of a .csv");
        chosen = [flags] { return with_output(*flags, run_report); };
    });
}

} // namespace ramus::app
