// `ramus page FILE -o HTML`: the whole case as one page that any browser opens.
#include "app/actions/case_pages.h"
#include "app/commands/case_stage.h"
#include "app/commands/output_target.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/session/numbers.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

namespace ramus::app {

namespace {

struct PageFlags {
    CaseFlags of;
    std::filesystem::path output;
    std::string format = ".html"; // of standard output
    PageChoice choice;
    bool json = false;
};

Result<void> check_page_output(const std::filesystem::path& output) {
    const std::string extension = io::lower_case(output.extension().string());
    if (extension != ".html" && extension != ".htm")
        return fail("a page is an .html file", output.string(), "give the name this ending");
    return io::check_output(output);
}

nlohmann::ordered_json page_report(const PageFlags& flags, const CasePage& page) {
    nlohmann::ordered_json report = {{"page", flags.output.string()},
                                     {"bytes", page.html.size()},
                                     {"limit_bytes", flags.choice.most_bytes},
                                     {"triangles", page.triangles},
                                     {"triangles_before", page.triangles_before},
                                     {"largest_deviation_mm", page.largest_deviation_mm},
                                     {"simplified", page.simplified},
                                     {"sizes", nlohmann::ordered_json::array()}};
    for (const auto& [part, bytes] : page.sizes) report["sizes"].push_back({{"part", part}, {"bytes", bytes}});
    return report;
}

void print_page(const PageFlags& flags, const CasePage& page) {
    std::cout << actions::page_sentence(page, output_name(flags.output)) << '\n';
    for (const auto& [part, bytes] : page.sizes)
        if (bytes > 0) std::cout << "  " << part << ": " << grouped((bytes + 999) / 1000) << " kB\n";
}

Result<int> run_page(const PageFlags& flags) {
    if (auto good = check_page_output(flags.output); !good) return tl::unexpected(good.error());
    constexpr glm::ivec2 kPictures{1600, 1200};
    const bool draws = !has_part(flags.choice.left_out, PagePart::kViews) || !flags.of.commands.empty();
    RAMUS_TRY(stage, CaseStage::open(flags.of, kPictures, draws));
    PageChoice choice = flags.choice;
    choice.threads = flags.of.common.surface.threads;
    const auto make = [&](Job& job) { return actions::make_case_page(stage->context(), choice, kPictures, job); };
    RAMUS_TRY(page, with_progress("page", make, kNothingWritten));
    if (auto written = io::write_file(flags.output, page.html); !written) return tl::unexpected(written.error());
    if (flags.json)
        std::cout << printed_report(page_report(flags, page), stage->document().claims()) << '\n';
    else
        print_page(flags, page);
    return kDone;
}

std::string page_parts_help() {
    std::string help = "Leave something out; may be repeated, or a list. ";
    for (const PagePartRow& row : kPageParts)
        help += (row.part == kPageParts.front().part ? "" : "; ") + std::string(row.name) + ": " + row.help;
    return help;
}

} // namespace

void register_page(CLI::App& app, Action& chosen) {
    auto flags = std::make_shared<PageFlags>();
    CLI::App* command =
        add_command(app, "page", "The whole case as one page that any browser opens, without a network");
    add_option(*command, "-o,--output", "HTML", flags->output, "Page to write")->required();
    add_option(*command, "--title", "TEXT", flags->choice.title, "Title of the page (default: the name of the file)");
    add_option_taking<std::string>(
        *command, "--size-limit", "MB",
        [flags](const std::string& word) { flags->choice.most_bytes = *actions::page_bytes_in(word); },
        "The page is no larger than this; the surface is simplified for it, and the page says how much (default 12)")
        ->check(expecting(" is not a size in MB from 0.1 to 2000",
                          [](const std::string& word) { return actions::page_bytes_in(word).has_value(); }));
    command
        ->add_option_function<std::vector<std::string>>(
            "--without",
            [flags](const std::vector<std::string>& words) {
                for (const std::string& word : words) flags->choice.left_out.push_back(*page_part_named(word));
            },
            page_parts_help())
        ->type_name("PART")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(expecting(" is not a part of a page",
                          [](const std::string& word) { return page_part_named(word).has_value(); }));
    command->add_flag("--json", flags->json, "Print what was written as one JSON object");
    add_case_flags(*command, flags->of);
    command->callback([flags, command, &chosen] {
        check_case_flags(flags->of);
        check_output_flags(*command, flags->output, {});
        chosen = [flags] { return with_output(*flags, run_page); };
    });
}

} // namespace ramus::app
