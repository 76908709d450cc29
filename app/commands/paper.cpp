// `ramus paper -o FOLDER`: reproduces the figures and tables of the paper: pictures, plots, tables and a page that
// shows them. Writes all files or none.
#include "app/commands/picture_flags.h"
#include "app/commands/printed_report.h"
#include "app/commands/progress.h"
#include "app/commands/subcommands.h"
#include "app/commands/validate_data_set.h"
#include "app/paper/figure_rows.h"
#include "app/paper/paper_page.h"
#include "app/session/numbers.h"
#include "core/base/words.h"
#include "core/io/output_file.h"
#include "core/io/output_folder.h"
#include "core/io/standard_input.h"
#include "core/io/volumes/volume_file.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

namespace ramus::app {

namespace {

constexpr const char* kPage = "index.html";
constexpr const char* kMeasurements = "measurements.csv";

struct PaperFlags {
    ValidateFlags inputs; // trees, masks, and how they are read
    std::vector<const paper::FigureRow*> rows;
    std::filesystem::path folder;
    bool json = false;
};

Result<io::OutputFolder> make_folder(const PaperFlags& flags) {
    RAMUS_TRY(folder, io::OutputFolder::make(flags.folder));
    for (std::size_t n = 0; n < flags.inputs.count(); ++n)
        for (const std::string& file : flags.inputs.files(n)) io::note_input(file);
    std::vector<std::string_view> names{kPage, kMeasurements};
    for (const paper::FigureRow* row : flags.rows) names.insert(names.end(), row->files.begin(), row->files.end());
    for (const std::string_view name : names)
        if (auto can = io::check_output(flags.folder / name); !can) return tl::unexpected(can.error());
    return std::move(folder);
}

std::vector<paper::InputTree> inputs_of(const PaperFlags& flags, std::vector<tree::VesselTree> trees) {
    std::vector<paper::InputTree> inputs;
    for (std::size_t n = 0; n < trees.size(); ++n) {
        const std::filesystem::path path = io::input_name(flags.inputs.trees[n]);
        inputs.push_back({path.filename().string(), std::make_shared<const tree::VesselTree>(std::move(trees[n])),
                          flags.inputs.mask(n), flags.inputs.labels.units, flags.inputs.labels.labels, std::nullopt});
    }
    return inputs;
}

Facts facts_of(const std::vector<paper::InputTree>& inputs) {
    Facts facts;
    if (inputs.empty()) {
        facts = paper::grown_trees();
        facts.emplace_back("Masks", "made of the trees");
    }
    for (const paper::InputTree& input : inputs) {
        const std::string mask = std::filesystem::path(io::input_name(input.mask)).filename().string();
        facts.emplace_back(input.name, mask.empty() ? "mask made of the tree" : mask);
    }
    return facts;
}

Result<std::vector<paper::MadeFigure>> make_figures(const PaperFlags& flags, std::vector<paper::InputTree> inputs) {
    paper::Workbench bench(std::move(inputs));
    std::vector<paper::MadeFigure> made;
    for (const paper::FigureRow* row : flags.rows) {
        const auto make = [&](Job& job) { return row->make(bench, job); };
        RAMUS_TRY(figure, with_progress(row->name(), make, kNothingWritten));
        if (flags.inputs.surface.verbose) std::cerr << "ramus: " << row->name() << " is made\n";
        made.push_back({row, std::move(figure)});
    }
    return made;
}

// Names and contents of the files in the folder.
using Files = std::vector<std::pair<std::string, std::string>>;

Files files_of(const paper::Figure& figure) {
    Files files;
    for (const paper::Picture& picture : figure.pictures) files.emplace_back(picture.file, picture.png);
    for (const paper::Plot& plot : figure.plots) files.emplace_back(plot.file, plot.svg.file());
    for (const paper::SavedTable& saved : figure.tables) files.emplace_back(saved.file, csv_of(saved.table));
    return files;
}

Result<void> write(const PaperFlags& flags, const std::vector<paper::MadeFigure>& made, const Facts& facts) {
    return write_with_progress("files", [&](Job& job) -> Result<void> {
        io::OutputSet together;
        Files all;
        for (const paper::MadeFigure& one : made)
            for (auto& file : files_of(one.figure)) all.push_back(std::move(file));
        all.emplace_back(kMeasurements, csv_of(paper::measured_table(made)));
        all.emplace_back(kPage, paper::paper_page(made, facts, now_text())); // last: it links to all others
        for (const auto& [name, content] : all)
            if (auto added = together.add(flags.folder / name, content); !added) return added;
        if (job.cancelled()) return fail(kNothingWritten);
        return together.commit();
    });
}

nlohmann::ordered_json json_of(const paper::MadeFigure& made) {
    nlohmann::ordered_json files = nlohmann::json::array(), measured = nlohmann::json::array();
    for (const auto& [name, content] : files_of(made.figure)) files.push_back(name);
    for (const paper::Measured& one : made.figure.measured) {
        nlohmann::ordered_json entry{{"what", one.what}, {"value", one.value}, {"unit", one.unit}};
        if (one.formula) entry["formula"] = *one.formula;
        if (!one.paper.empty()) entry["paper"] = one.paper;
        measured.push_back(std::move(entry));
    }
    return {{"number", made.row->number}, {"title", made.row->title}, {"files", files}, {"measured", measured}};
}

Result<int> run_paper(const PaperFlags& flags) {
    const auto folder = make_folder(flags); // removes a new folder again if nothing is written
    if (!folder) return tl::unexpected(folder.error());
    RAMUS_TRY(trees, read_all(flags.inputs));
    std::vector<paper::InputTree> inputs = inputs_of(flags, std::move(trees));
    const Facts facts = facts_of(inputs);
    RAMUS_TRY(made, make_figures(flags, std::move(inputs)));
    if (auto written = write(flags, made, facts); !written) return tl::unexpected(written.error());
    const std::string page = (flags.folder / kPage).string();
    if (!flags.json) {
        std::cout << page << ": " << joined(made, ", ", [](const auto& one) { return one.row->name(); }) << '\n';
        return kDone;
    }
    nlohmann::ordered_json report{{"page", page}, {"figures", nlohmann::json::array()}};
    for (const paper::MadeFigure& one : made) report["figures"].push_back(json_of(one));
    std::cout << printed_report(std::move(report)) << '\n';
    return kDone;
}

} // namespace

void register_paper(CLI::App& app, Action& chosen) {
    const auto flags = std::make_shared<PaperFlags>();
    for (const paper::FigureRow& row : paper::figure_rows()) flags->rows.push_back(&row);
    ValidateFlags& inputs = flags->inputs;
    CLI::App* command =
        add_command(app, "paper", "Reproduce the figures and tables of the paper by Oeltze and Preim (2005)");
    command->footer("No file is needed: artificial vessels are built, and trees are grown unless --tree is given.");
    add_option(*command, "-o,--output", "FOLDER", flags->folder,
               "Folder for index.html, pictures (.png), plots (.svg) and tables (.csv); created if it does not exist")
        ->required();
    add_option_taking<std::string>(
        *command, "--figures", "LIST", [flags](const std::string& list) { flags->rows = *paper::rows_in(list); },
        "Only these, as 1,4 or 5-7,III (default: all, " + paper::all_numbers() + ")")
        ->check(expecting(" is no list of " + paper::all_numbers(),
                          [](const std::string& list) { return paper::rows_in(list).has_value(); }));
    CLI::Option* trees =
        add_input(*command, "--tree", "TREE", inputs.trees,
                  "Vessel tree for figures 5 and 8 to 13 and the tables, in place of grown ones; may be "
                  "repeated: figures of one tree are of the first")
            ->allow_extra_args(false);
    CLI::Option* masks = add_input(*command, "--mask", "MASK", inputs.masks,
                                   "Segmentation mask of the same vessels (" + io::readable_volume_extensions() +
                                       "); of several trees once for each, in the same order")
                             ->allow_extra_args(false)
                             ->needs(trees);
    add_mask_units_flag(*command, inputs.labels.units, "--mask")->needs(masks);
    add_label_flag(*command, inputs.labels.labels, "Labels of the mask that are these vessels (default: all)")
        ->needs(masks);
    command->add_flag("--json", flags->json, "Print what was made and measured as one JSON object");
    add_reading_flags(*command, inputs.surface);
    command->callback([flags, &chosen] {
        check_one_for_each("--mask", flags->inputs.masks.size(), flags->inputs.count());
        chosen = [flags] { return run_paper(*flags); };
    });
}

} // namespace ramus::app
