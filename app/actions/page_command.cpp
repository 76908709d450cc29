// The page for browsers as a command; `export page` runs it, too.
#include "app/actions/arguments.h"
#include "app/actions/case_pages.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

Result<void> write_page_here(ActionContext& context, const PageChoice& choice, const fs::path& path) {
    Job job;
    RAMUS_TRY(page, make_case_page(context, choice, context.picture.picture_size(), job));
    if (auto written = io::write_file(path, page.html); !written) return written;
    context.say(page_sentence(page, path.string()));
    return {};
}

Result<Outcome> page_command(ActionContext& context, Arguments arguments) {
    if (arguments.empty() && context.files != nullptr && context.files->asks()) {
        context.files->ask_for_export("page");
        return Done{};
    }
    const std::size_t files = std::min<std::size_t>(arguments.size(), 1);
    RAMUS_TRY(choice, page_choice(arguments.subspan(files)));
    RAMUS_TRY(path, file_argument(context, arguments.first(files), "page", ".html"));
    const std::string extension = io::lower_case(path.extension().string());
    if (extension != ".html" && extension != ".htm")
        return fail("a page is an .html file", path.string(), "give the name this ending");
    const fs::path full = fs::absolute(path).lexically_normal();
    if (auto possible = io::check_output(full); !possible) return tl::unexpected(possible.error());
    std::vector<std::string> words{"page", full.string()};
    words.insert(words.end(), arguments.begin() + static_cast<std::ptrdiff_t>(files), arguments.end());
    RAMUS_TRY(detached, context.picture.detached_work(words));
    if (!detached) return outcome_of(write_page_here(context, choice, full));
    return done_in_process("Writing", detached, full, "Page saved: " + full.string());
}

} // namespace

std::vector<Command> page_commands() {
    return {
        Command("page", "[FILE [OPTIONS]]",
                "Writes the whole case as one .html file that any browser opens, without a network: the surface, what "
                "was planned and measured, tables. Options are those of the export. A window asks for the file.",
                page_command)
            .in_menu("Plan", "Page for the browser...")
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
