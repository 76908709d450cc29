// The report folder of `ramus validate --report`: a self-contained page (index.html), validation.json, tables as CSV
// and box plots as SVG. All files are written, or none. No file of the report replaces an input file.
#pragma once

#include "app/commands/validate_data_set.h"
#include "app/reports/validation/data_set.h"
#include "core/base/error.h"
#include "core/io/output_folder.h"

#include <span>
#include <string>
#include <utility>

namespace ramus::app {

class ReportFolder {
public:
    // Creates the folder if it does not exist. Must be called before long computations: fails if the folder cannot be
    // written, or if a file of the report would replace an input file of `flags`.
    [[nodiscard]] static Result<ReportFolder> make(const ValidateFlags& flags);
    // Writes all files. `json`: the text of validation.json. Fails, without any file, if cancelled or if a file cannot
    // be written.
    [[nodiscard]] Result<void> write(const ValidateFlags& flags, std::span<const ValidatedDataSet> sets,
                                     const std::string& json) const;

private:
    explicit ReportFolder(io::OutputFolder folder) : folder_(std::move(folder)) {}
    io::OutputFolder folder_;
};

} // namespace ramus::app
