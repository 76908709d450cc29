#include "app/commands/validate_report.h"

#include "app/commands/progress.h"
#include "app/reports/report_tables.h"
#include "app/reports/surface_facts.h"
#include "app/reports/validation/branch_radii.h"
#include "app/reports/validation/validation_page.h"
#include "app/reports/validation/validation_tables.h"
#include "app/session/reading_json.h"
#include "core/base/words.h"
#include "core/io/checksum.h"
#include "core/io/output_file.h"
#include "core/io/run_inputs.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace ramus::app {

namespace {

namespace fs = std::filesystem;

// Registers the inputs, so that no file of the report replaces one of them.
void note_inputs(const ValidateFlags& flags) {
    for (std::size_t n = 0; n < flags.count(); ++n)
        for (const std::string& input : flags.files(n))
            for (const fs::path& read : io::files_read_with(input)) io::note_input(read);
}

Facts settings_of(const ValidateFlags& flags) {
    Facts facts = surface_facts(flags.surface.surface);
    if (!flags.meshes.empty()) facts.front().second = "given; the rest is how the tree is taken";
    const nlohmann::json reading = session_json::reading_json(flags.surface.read, {});
    facts.emplace_back("Reading", reading.empty() ? "as usual" : reading.dump());
    if (!flags.masks.empty()) {
        const std::string labels = joined(flags.labels.labels, ", ", [](const auto& label) { return spelled(label); });
        facts.emplace_back("Labels of masks", labels.empty() ? "all" : labels);
        facts.emplace_back("Unit of masks", flags.labels.units.empty() ? "as they say" : flags.labels.units);
    }
    return facts;
}

struct Contents {
    const ValidateFlags& flags;
    std::span<const ValidatedDataSet> sets;
    const std::string& json;
};

struct ReportFile {
    const char* name;
    void (*write)(io::BufferedFile&, const Contents&);
    bool of_masks = false; // written only if a data set has a mask
};

// All files of a report. The page is the last, since it links to the others.
constexpr std::array<ReportFile, 13> kReportFiles{{
    {"validation.json", [](io::BufferedFile& file, const Contents& c) { file.write(c.json); }},
    {"questions.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(questions_table(c.sets))); }},
    {"fidelity.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(fidelity_table(c.sets))); }},
    {"volumes.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(volumes_table(c.sets))); }, true},
    {"shapes.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(shape_table(c.sets))); }},
    {"distances.csv",
     [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(all_distances_table(c.sets))); }},
    {"places.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(all_places_table(c.sets))); }},
    {"radii.csv", [](io::BufferedFile& file, const Contents& c) { write_radii(file, c.sets, c.sets.size() > 1); }},
    {"files.csv", [](io::BufferedFile& file, const Contents& c) { file.write(csv_of(files_table(c.sets))); }},
    {"boxes_to_cones.svg",
     [](io::BufferedFile& file, const Contents& c) { file.write(boxes_of(c.sets, Held::kToCones).file()); }},
    {"boxes_to_mask.svg",
     [](io::BufferedFile& file, const Contents& c) { file.write(boxes_of(c.sets, Held::kToMask).file()); }, true},
    {"boxes_from_mask.svg",
     [](io::BufferedFile& file, const Contents& c) { file.write(boxes_of(c.sets, Held::kFromMask).file()); }, true},
    {"index.html", [](io::BufferedFile& file,
                      const Contents& c) { file.write(validation_page(c.sets, settings_of(c.flags), now_text())); }},
}};

} // namespace

Result<ReportFolder> ReportFolder::make(const ValidateFlags& flags) {
    RAMUS_TRY(folder, io::OutputFolder::make(flags.report));
    ReportFolder report(std::move(folder));
    note_inputs(flags);
    for (const ReportFile& file : kReportFiles)
        if (auto can = io::check_output(flags.report / file.name); !can) return tl::unexpected(can.error());
    return report;
}

Result<void> ReportFolder::write(const ValidateFlags& flags, std::span<const ValidatedDataSet> sets,
                                 const std::string& json) const {
    return write_with_progress("report", [&](Job& job) -> Result<void> {
        std::vector<io::OutputFile> files;
        for (const ReportFile& one : kReportFiles) {
            if (one.of_masks && !has_mask(sets)) continue;
            RAMUS_TRY(file, io::OutputFile::create(folder_.path() / one.name));
            one.write(file, {flags, sets, json});
            files.push_back(std::move(file));
        }
        if (job.cancelled()) return fail("cancelled");
        return io::commit_all(files);
    });
}

} // namespace ramus::app
