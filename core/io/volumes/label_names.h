// Reads names and colours of labels from tables in a header or in a file next to a mask.
#pragma once

#include "core/volume/volume.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// The first LabelTable of an XML text, as TotalSegmentator and Connectome Workbench write it into a NIfTI header:
// <Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">aorta</Label>. Ascending, each label once. Empty: there is no
// such table, or the text is not XML.
[[nodiscard]] std::vector<volume::LabelName> label_table_names(std::string_view xml);

// Parses an ITK-SNAP label description (IDX R G B A VIS MSH "LABEL" on each line) or a colour table of 3D Slicer
// (IDX NAME R G B A). Skips empty lines and lines that begin with #. Ascending, each label once. None: other text.
[[nodiscard]] std::optional<std::vector<volume::LabelName>> described_names(std::string_view text);

// If `volume` has no names of labels, reads them from a label description next to the mask: liver.label, liver.txt,
// liver_labels.txt and others for liver.nii.gz. Adds a note with the file. Ignores files that are no label description.
void take_described_names(const std::filesystem::path& mask, volume::Volume& volume);

} // namespace ramus::io
