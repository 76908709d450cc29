// Names and colours of labels that stand elsewhere than among the voxels: in tables that programs write into a header
// or next to a mask.
#pragma once

#include "core/volume/volume.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ramus::io {

// Of the first LabelTable of an XML text, as TotalSegmentator and Connectome Workbench write it into a NIfTI header:
// <Label Key="1" Red="1" Green="0" Blue="0" Alpha="1">aorta</Label>. Ascending, each label once. Empty: there is no
// such table, or the text is not XML.
[[nodiscard]] std::vector<volume::LabelName> label_table_names(std::string_view xml);

// Of a text whose lines are all those of an ITK-SNAP label description (IDX R G B A VIS MSH "LABEL") or all those of a
// colour table of 3D Slicer (IDX NAME R G B A); empty lines and those that begin with # are left out. Ascending, each
// label once. None: it is another text.
[[nodiscard]] std::optional<std::vector<volume::LabelName>> described_names(std::string_view text);

// Takes names from a label description next to the mask, if its file names none: liver.label, liver.txt,
// liver_labels.txt and others for liver.nii.gz. A note says which file it was. Files that are not a label description
// are passed over.
void take_described_names(const std::filesystem::path& mask, volume::Volume& volume);

} // namespace ramus::io
