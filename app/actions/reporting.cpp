// Reports: tables as CSV, and everything on one page with pictures.
#include "app/actions/arguments.h"
#include "app/actions/groups.h"
#include "app/assets/assets.h"
#include "app/reports/report_page.h"
#include "app/reports/report_tables.h"
#include "core/io/output_file.h"
#include "core/io/text_numbers.h"

#include <algorithm>

namespace ramus::app::actions {

namespace {

struct Kind {
    std::string_view name;
    Table (*table)(const Document&, const Assets&);
    bool (*there)(const Document&, const Assets&); // what its rows are about
};

// In the order of what is written when no kind is named.
constexpr std::array<Kind, 7> kKinds{
    {{"cuts", cuts_table, [](const Document& d, const Assets&) { return !d.marks().cuts.empty(); }},
     {"bands", bands_table, [](const Document&, const Assets& a) { return !a.plan->bands.empty(); }},
     {"selection", selection_table, [](const Document& d, const Assets&) { return !d.marks().selection.empty(); }},
     {"measurements", measurements_table,
      [](const Document& d, const Assets&) { return !d.marks().measurements.empty(); }},
     {"systems", systems_table, [](const Document& d, const Assets&) { return !d.tree()->systems.empty(); }},
     {"contacts", contacts_table,
      [](const Document& d, const Assets& a) {
          return a.contacts.fits(d.marks().options) && !a.contacts.list->empty();
      }},
     {"validation", validation_table,
      [](const Document& d, const Assets& a) { return a.validation.fits(validation_of(d.tree(), d.marks())); }}}};

Result<void> write_csv(ActionContext& context, const std::filesystem::path& path, std::string_view wanted) {
    const Document& document = context.document;
    const Assets& assets = context.assets;
    const auto there = [&](const Kind& kind) { return kind.there(document, assets); };
    const auto* kind =
        std::ranges::find_if(kKinds, [&](const Kind& k) { return wanted.empty() ? there(k) : k.name == wanted; });
    if (kind == kKinds.end())
        return wanted.empty()
                   ? fail("there is nothing to report", {}, "cut, place a lesion, select or measure first")
                   : fail("a report is of selection, cuts, bands, measurements, systems, contacts or validation");
    if (!there(*kind))
        return fail("there is nothing to report of " + std::string(kind->name), {},
                    "cut, place a lesion, select or measure first");
    if (auto written = io::write_file(path, csv_of(kind->table(document, assets))); !written) return written;
    context.say("Report of " + std::string(kind->name) + " saved: " + path.string());
    return {};
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
    if (const auto visible = visible_positions(context); !visible.empty())
        for (const auto& [caption, view] :
             {std::pair{"Anterior", render::View::kAnterior}, std::pair{"Left", render::View::kLeft}})
            wanted.push_back({caption, render::camera_for(visible, view, kSmall, current.orthographic), kSmall});
    std::vector<ReportPicture> pictures;
    for (const Wanted& one : wanted) {
        RAMUS_TRY(image, context.picture.draw_picture(one.camera, one.size));
        RAMUS_TRY(png, render::encode_png(image));
        pictures.push_back({one.caption, std::move(png)});
    }
    return pictures;
}

Result<void> report(ActionContext& context, Arguments arguments) {
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
    if (auto possible = io::check_output(path); !possible) return possible;
    RAMUS_TRY(pictures, take_pictures(context));
    if (auto written = io::write_file(path, report_page(context.document, context.assets, pictures, now_text()));
        !written)
        return written;
    context.say("Report saved: " + path.string());
    return {};
}

} // namespace

std::vector<Command> report_commands() {
    return {
        Command(
            "report", "[FILE [KIND]]",
            "Writes a report: .html, one page with pictures and all tables; or .csv of selection, cuts, bands or "
            "measurements, systems, contacts, validation (once there is one), the first of them that there is unless "
            "told.",
            report)
            .in_menu("Plan", "Save report")
            .when(has_tree),
    };
}

} // namespace ramus::app::actions
