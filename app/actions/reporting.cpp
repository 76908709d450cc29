// Reports: tables as CSV, and everything on one page with pictures.
#include "app/actions/arguments.h"
#include "app/actions/export_words.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/reports/report_page.h"
#include "app/reports/report_tables.h"
#include "app/reports/table_kinds.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

namespace fs = std::filesystem;

Result<Outcome> write_csv(ActionContext& context, const fs::path& path, std::string_view wanted) {
    const Document& document = context.document;
    const Assets& assets = context.assets;
    const auto there = [&](const TableKind& kind) { return kind.there(document, assets); };
    const auto& kinds = table_kinds();
    const TableKind* const kind = wanted.empty() ? std::ranges::find_if(kinds, there) : table_kind_named(wanted);
    if (kind == nullptr || kind == kinds.end())
        return wanted.empty()
                   ? fail("there is nothing to report", {}, "cut, place a lesion, select or measure first")
                   : fail("a report is of selection, cuts, bands, measurements, systems, contacts or validation");
    if (!there(*kind))
        return fail("there is nothing to report of " + std::string(kind->name), {},
                    "cut, place a lesion, select or measure first");
    return writing_table(context, fs::absolute(path).lexically_normal(), kind->table,
                         "Report of " + std::string(kind->name) + " saved: " + path.string());
}

Result<std::vector<ReportPicture>> take_pictures(ActionContext& context) {
    constexpr glm::ivec2 kLarge{1200, 800}, kSmall{720, 600};
    const render::Camera& current = context.document.session().camera;
    struct Wanted {
        const char* caption;
        render::Camera camera;
        glm::ivec2 size;
    };
    std::vector<Wanted> wanted{{"As it was looked at", current, kLarge}};
    for (const auto& [caption, view] :
         {std::pair{"Anterior", render::View::kAnterior}, std::pair{"Left", render::View::kLeft}}) {
        const render::Camera from = render::looking({.orthographic = current.orthographic}, view);
        if (const auto visible = visible_positions(context, from, kSmall); !visible.empty())
            wanted.push_back({caption, render::fitted(from, visible, kSmall), kSmall});
    }
    std::vector<ReportPicture> pictures;
    for (const Wanted& one : wanted) {
        RAMUS_TRY(image, context.picture.draw_picture(one.camera, one.size));
        RAMUS_TRY(png, render::encode_png(image));
        pictures.push_back({one.caption, std::move(png)});
    }
    return pictures;
}

// Pictures take long to draw: a window does not wait for them.
Result<Outcome> report_page_elsewhere(const std::function<Result<void>(Job&)>& work, const fs::path& path) {
    return Pending{"Writing " + path.filename().string(),
                   [work, path](Job& job) -> Result<Continuation> {
                       if (auto done = work(job); !done) return tl::unexpected(done.error());
                       return has_written(path, "Report saved: " + path.string());
                   },
                   true};
}

Result<void> write_page(ActionContext& context, const fs::path& path) {
    RAMUS_TRY(pictures, take_pictures(context));
    if (auto written = io::write_file(path, report_page(context.document, context.assets, pictures, now_text()));
        !written)
        return written;
    context.say("Report saved: " + path.string());
    return {};
}

Result<Outcome> report(ActionContext& context, Arguments arguments) {
    if (arguments.empty() && context.files != nullptr && context.files->asks()) {
        context.files->ask_for_export("report");
        return Done{};
    }
    if (arguments.size() > 2)
        return fail("report takes a file and what it is of", {}, "put quotes around a name with blanks");
    RAMUS_TRY(path,
              file_argument(context, arguments.first(std::min<std::size_t>(arguments.size(), 1)), "report", ".html"));
    if (!has_tree(context.document)) return fail("there is no tree to report of");
    const std::string extension = io::lower_case(path.extension().string());
    complete_lesions(context.assets, context.document);
    if (context.window == nullptr) complete_contacts(context.assets, context.document); // a window has them soon
    if (extension == ".csv") return write_csv(context, path, arguments.size() == 2 ? arguments[1] : "");
    if (extension != ".html" && extension != ".htm")
        return fail("a report is a .csv or an .html file", path.string(), "give the name one of these endings");
    if (arguments.size() == 2)
        return fail("a report as .html has everything", path.string(), "leave \"" + arguments[1] + "\" out");
    const fs::path full = fs::absolute(path).lexically_normal();
    if (auto possible = io::check_output(full); !possible) return tl::unexpected(possible.error());
    RAMUS_TRY(elsewhere, context.picture.done_elsewhere({"report", full.string()}));
    return elsewhere ? report_page_elsewhere(elsewhere, full) : outcome_of(write_page(context, path));
}

} // namespace

std::vector<Command> report_commands() {
    return {
        Command(
            "report", "[FILE [KIND]]",
            "Writes a report: .html, one page with pictures and all tables; or .csv of selection, cuts, bands or "
            "measurements, systems, contacts, validation (once there is one), the first of them that there is unless "
            "told. A window asks for the file.",
            report)
            .in_menu("Plan", "Report...")
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
