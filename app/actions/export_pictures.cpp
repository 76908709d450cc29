// Export of pictures, sheets, turntables, reports and tables. Slow drawing runs where no window waits for it.
#include "app/actions/arguments.h"
#include "app/actions/command_runner.h"
#include "app/actions/export_words.h"
#include "app/assets/assets.h"
#include "app/picture/video_file.h"
#include "app/reports/pdf.h"
#include "app/reports/table_kinds.h"

namespace ramus::app::actions {

namespace {

// Writes synchronously on this thread.
Result<Outcome> written_now(ActionContext& context, const Export& wanted, const std::string& sentence) {
    return outcome_of(has_written(wanted.file, sentence)(context));
}

std::vector<int> ids_of(const std::vector<std::uint8_t>& exported) {
    std::vector<int> ids;
    for (std::size_t id = 0; id < exported.size(); ++id)
        if (exported[id] != 0) ids.push_back(static_cast<int>(id));
    return ids;
}

Result<Outcome> write_figure_here(ActionContext& context, const Export& wanted, const FigureRequest& request,
                                  const std::string& sentence) {
    Job job;
    if (auto written = context.picture.write_figure(request, job); !written) return tl::unexpected(written.error());
    return written_now(context, wanted, sentence);
}

} // namespace

Result<Outcome> export_table(ActionContext& context, const Export& wanted) {
    if (auto fits = expect_extension(wanted, ".csv", "a table"); !fits) return tl::unexpected(fits.error());
    complete_lesions(context.assets, context.document);
    const Document& document = context.document;
    const TableKind* const kind = wanted.table.empty() ? nullptr : table_kind_named(wanted.table);
    if (kind != nullptr && !kind->there(document, context.assets)) return tl::unexpected(nothing_to_report(kind->name));
    const auto table = [kind, of = wanted.of](const Document& then, const Assets& assets) {
        return kind != nullptr ? kind->table(then, assets)
                               : branches_table(then, assets, ids_of(exported_branches(then, of)));
    };
    return writing_table(context, wanted.file, table, saved_text("Table", wanted));
}

Result<Outcome> export_report(ActionContext& context, const Export& wanted) {
    if (auto fits = is_pdf(wanted.file) ? Result<void>() : expect_extension(wanted, ".html", "a report"); !fits)
        return tl::unexpected(fits.error());
    std::vector<std::string> words{wanted.file.string()};
    if (!wanted.case_line.empty()) words.insert(words.end(), {"--case", wanted.case_line});
    return find_command("report")->action(context, words);
}

Result<Outcome> export_page(ActionContext& context, const Export& wanted) {
    std::vector<std::string> words{wanted.file.string()};
    words.insert(words.end(), wanted.page.begin(), wanted.page.end());
    return find_command("page")->action(context, words);
}

Result<Outcome> export_figure(ActionContext& context, const Export& wanted) {
    const bool turns = wanted.what == ExportWhat::kTurntable;
    if (!turns || !is_video(wanted.file))
        if (auto fits = expect_extension(wanted, ".png", "a picture"); !fits) return tl::unexpected(fits.error());
    if (turns && is_video(wanted.file) && !can_make_videos())
        return fail(kNoVideos, {}, "install it, or choose PNG pictures");
    const std::string sentence = saved_text(wanted.kind().label, wanted);
    FigureRequest request{wanted.file, wanted.size, wanted.figure};
    if (!request.size) request.size = context.picture.whole_size();
    std::vector<std::string> words{"export", std::string(wanted.kind().key), wanted.file.string()};
    const auto options = figure_words(request);
    words.insert(words.end(), options.begin(), options.end());
    RAMUS_TRY(detached, context.picture.detached_work(words));
    if (!detached) return write_figure_here(context, wanted, request, sentence);
    return done_in_process("Drawing", detached, wanted.file, sentence);
}

} // namespace ramus::app::actions
