#include "app/commands/validate_report.h"

#include "app/commands/progress.h"
#include "app/reports/report_tables.h"
#include "app/reports/surface_facts.h"
#include "app/reports/validation/branch_radii.h"
#include "app/reports/validation/validation_page.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/reading_json.h"
#include "core/io/checksum.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"

#include <array>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace ramus::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kRadii = "radii.csv";

// All that may be written; the page last, so that whoever finds it finds the rest.
constexpr std::array kReportNames{"validation.json",    "questions.csv",     "distances.csv",
                                  "places.csv",         "radii.csv",         "files.csv",
                                  "boxes_to_cones.svg", "boxes_to_mask.svg", "index.html"};

// So that no file of the report takes the place of one.
void note_inputs(const ValidateFlags& flags) {
    for (std::size_t n = 0; n < flags.count(); ++n)
        for (const std::string& input : flags.files(n))
            for (const fs::path& read : io::files_read_with(input)) io::note_input(read);
}

Facts settings_of(const ValidateFlags& flags) {
    Facts facts = surface_facts(flags.surface.surface);
    if (!flags.meshes.empty()) facts.front().second = "given; the rest is how the tree is taken";
    const nlohmann::json reading = session_json::reading_json(flags.surface.read);
    facts.emplace_back("Reading", reading.empty() ? "as usual" : reading.dump());
    if (!flags.masks.empty()) {
        std::string labels;
        for (const std::int32_t label : flags.labels.labels)
            labels += (labels.empty() ? "" : ", ") + std::to_string(label);
        facts.emplace_back("Labels of masks", labels.empty() ? "all" : labels);
        facts.emplace_back("Unit of masks", flags.labels.units.empty() ? "as they say" : flags.labels.units);
    }
    return facts;
}

std::vector<NamedText> contents_of(const ValidateFlags& flags, std::span<const ValidatedDataSet> sets,
                                   const std::string& json) {
    std::vector<NamedText> files{{"validation.json", json},
                                 {"questions.csv", csv_of(questions_table(sets))},
                                 {"distances.csv", csv_of(all_distances_table(sets))},
                                 {"places.csv", csv_of(all_places_table(sets))},
                                 {kRadii, ""}, // written piece by piece
                                 {"files.csv", csv_of(files_table(sets))}};
    for (NamedText& plot : box_plot_files(sets)) files.push_back(std::move(plot));
    files.push_back({"index.html", validation_page(sets, settings_of(flags), now_text())});
    return files;
}

} // namespace

Result<std::unique_ptr<ReportFolder>> ReportFolder::make(const ValidateFlags& flags) {
    std::unique_ptr<ReportFolder> report(new ReportFolder);
    report->folder_ = flags.report;
    std::error_code error;
    for (fs::path folder = fs::absolute(flags.report, error).lexically_normal();
         !folder.empty() && !fs::exists(folder, error) && folder != folder.parent_path(); folder = folder.parent_path())
        if (folder.has_filename()) report->made_.push_back(folder);
    fs::create_directories(flags.report, error);
    if (error || !fs::is_directory(flags.report))
        return fail("the folder cannot be made", flags.report.string(), "give the name of a folder");
    note_inputs(flags);
    for (const char* name : kReportNames)
        if (auto can = io::check_output(flags.report / name); !can) return tl::unexpected(can.error());
    return report;
}

ReportFolder::~ReportFolder() {
    std::error_code not_empty;
    for (const fs::path& folder : made_) fs::remove(folder, not_empty);
}

Result<void> ReportFolder::write(const ValidateFlags& flags, std::span<const ValidatedDataSet> sets,
                                 const std::string& json) const {
    return with_progress("report", [&](Job& job) -> Result<void> {
        std::vector<io::OutputFile> files;
        for (const NamedText& content : contents_of(flags, sets, json)) {
            RAMUS_TRY(file, io::OutputFile::create(folder_ / content.name));
            if (content.name == kRadii)
                write_radii(file, sets, sets.size() > 1);
            else
                file.write(content.text);
            files.push_back(std::move(file));
        }
        if (job.cancelled()) return fail("cancelled");
        return io::commit_all(files);
    });
}

} // namespace ramus::app
