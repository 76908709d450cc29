#include "app/reports/pdf.h"

#include "core/base/child_program.h"
#include "core/base/scratch_folder.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <unistd.h>
#include <vector>

namespace ramus::app {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrinter = "weasyprint";
constexpr const char* kBrowsers[] = {"chromium", "chromium-browser", "google-chrome"};

// Prints `page` into `made`; empty: no program is installed.
std::vector<std::string> printing_words(const fs::path& folder, const fs::path& page, const fs::path& made) {
    if (!find_program(kPrinter).empty()) return {kPrinter, "--quiet", page.string(), made.string()};
    for (const char* browser : kBrowsers) {
        if (find_program(browser).empty()) continue;
        std::vector<std::string> words{browser,
                                       "--headless",
                                       "--disable-gpu",
                                       "--user-data-dir=" + (folder / "browser").string(),
                                       "--no-pdf-header-footer",
                                       "--print-to-pdf=" + made.string(),
                                       "file://" + page.string()};
        if (::geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox"); // it refuses to run as root with one
        return words;
    }
    return {};
}

} // namespace

bool is_pdf(const fs::path& path) { return io::lower_case(path.extension().string()) == ".pdf"; }

Result<void> check_pdf_program() {
    if (!printing_words({}, {}, {}).empty()) return {};
    return fail("no program that makes PDF files is installed", {}, "apt install weasyprint, or write .html");
}

Result<void> write_pdf(const std::string& html, const fs::path& target, Job& job) {
    if (auto possible = check_pdf_program(); !possible) return possible;
    RAMUS_TRY(scratch, ScratchFolder::create());
    const fs::path page = scratch.path() / "page.html";
    const fs::path made = scratch.path() / "page.pdf";
    if (auto written = io::write_file(page, html); !written) return written;
    const std::vector<std::string> words = printing_words(scratch.path(), page, made);
    RAMUS_TRY(program, ChildProgram::start(words));
    std::string last; // browsers also write what is no error
    const auto hear = [&](std::string_view line) {
        if (!line.empty()) last = line;
        return true;
    };
    auto ended = program.wait(job, hear);
    if (job.cancelled()) return ended;
    std::error_code missing;
    if (!ended || fs::file_size(made, missing) == 0 || missing)
        return fail("printing with " + words.front() + " failed" + (last.empty() ? "" : ": " + last), target.string(),
                    "write .html, and print it with a browser");
    return io::write_copy(made, target);
}

} // namespace ramus::app
