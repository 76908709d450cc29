// The folder that ramus validate --report writes: index.html, a page that needs nothing beside it; validation.json;
// tables as CSV; box plots as SVG. All files come to their places together, or none does, and none takes the place of a
// file that is read.
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
    // Makes the folder if need be. Fails where it cannot be made or written to, and where a file of the report would
    // take the place of one that `flags` name: before long work starts.
    [[nodiscard]] static Result<ReportFolder> make(const ValidateFlags& flags);
    // `json`: the text of validation.json.
    [[nodiscard]] Result<void> write(const ValidateFlags& flags, std::span<const ValidatedDataSet> sets,
                                     const std::string& json) const;

private:
    explicit ReportFolder(io::OutputFolder folder) : folder_(std::move(folder)) {}
    io::OutputFolder folder_;
};

} // namespace ramus::app
