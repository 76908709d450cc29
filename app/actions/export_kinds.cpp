#include "app/actions/export_kinds.h"

#include "core/io/meshes/mesh_file.h"
#include "core/io/trees/tree_file.h"

#include <algorithm>

namespace ramus::app {

namespace {

template <class Format> ExportFormat written_as(const Format& format) {
    const std::string extension(format.extensions.front());
    return {std::string(format.name) + " (" + extension + ")", extension, std::string(format.help)};
}

std::vector<ExportFormat> surface_formats() {
    std::vector<ExportFormat> formats;
    for (const io::MeshFormat& format : io::mesh_formats()) {
        if (!io::is_written(format) || format.in_files) continue;
        formats.push_back(written_as(format));
        formats.back().has_parts = format.has_parts;
        formats.back().for_printing = format.unit_mm == 1.0;
    }
    return formats;
}

std::vector<ExportFormat> tree_formats() {
    std::vector<ExportFormat> formats;
    for (const io::TreeFormat& format : io::tree_formats())
        if (io::is_written(format)) formats.push_back(written_as(format));
    return formats;
}

std::vector<ExportFormat> table_formats() {
    return {{"CSV (.csv)", ".csv", "A row for each branch: length, diameters, what depends on it; for spreadsheets."}};
}

std::vector<ExportFormat> territory_formats() {
    std::vector<ExportFormat> formats{
        {"NIfTI labels (.nii.gz)", ".nii.gz", "A mask with a label for each part, on the grid of the organ's mask."},
        {"3D Slicer segmentation (.seg.nrrd)", ".seg.nrrd",
         "The same, with the names and colours that 3D Slicer shows."}};
    for (ExportFormat& format : surface_formats()) {
        format.has_parts = format.for_printing = false;
        formats.push_back(std::move(format));
    }
    return formats;
}

std::vector<ExportFormat> picture_formats() { return {{"PNG (.png)", ".png", "Every pixel as it is drawn."}}; }

std::vector<ExportFormat> turntable_formats() {
    return {{"PNG pictures (.png)", ".png", "name_001.png and so on, for any program that makes videos."},
            {"Video (.mp4)", ".mp4", "H.264, which all programs play; ffmpeg makes it where it is installed."}};
}

std::vector<ExportFormat> report_formats() {
    return {{"HTML (.html)", ".html", "One page with pictures and all tables, to read and to print."},
            {"PDF (.pdf)", ".pdf", "The same on A4; weasyprint or Chromium makes it where one is installed."}};
}

std::vector<ExportFormat> page_formats() {
    return {{"HTML (.html)", ".html", "One file that any browser opens, without a network."}};
}

} // namespace

const std::array<ExportKind, kExportKinds>& export_kinds() {
    static const std::array<ExportKind, kExportKinds> kinds{
        {{ExportWhat::kPicture, "picture", "Picture", "What the window shows.", false, false, picture_formats()},
         {ExportWhat::kSheet, "sheet", "Sheet", "Four views on one sheet, all at one scale.", false, false,
          picture_formats()},
         {ExportWhat::kTurntable, "turntable", "Turntable", "Once around, as pictures or as a video.", false, false,
          turntable_formats()},
         {ExportWhat::kReport, "report", "Report", "A page with pictures and tables of the plan.", false, true,
          report_formats()},
         {ExportWhat::kPage, "page", "Page for the browser",
          "The whole case in one file: a colleague, or the patient, turns the tree, asks and measures in a browser, "
          "without ramus and without a network.",
          false, true, page_formats()},
         {ExportWhat::kTable, "table", "Table", "The figures of each branch.", true, true, table_formats()},
         {ExportWhat::kSurface, "surface", "Surface", "The smooth surface, as triangles.", true, true,
          surface_formats()},
         {ExportWhat::kTree, "tree", "Tree", "Centerlines and radii, as they were read.", true, true, tree_formats()},
         {ExportWhat::kTerritories, "territories", "Territories",
          "The parts of the organ that are shown, as a mask with names and colours, or as closed surfaces.", false,
          true, territory_formats()}}};
    return kinds;
}

std::optional<ExportWhat> export_kind_named(std::string_view key) {
    const auto* const found = std::ranges::find(export_kinds(), key, &ExportKind::key);
    return found == export_kinds().end() ? std::nullopt : std::optional(found->what);
}

std::vector<std::uint8_t> exported_branches(const Document& document, ExportOf of) {
    const Marks& marks = document.marks();
    std::vector<std::uint8_t> exported(static_cast<std::size_t>(document.branch_count()), 0);
    for (int id = 0; id < document.branch_count(); ++id)
        exported[static_cast<std::size_t>(id)] =
            of == ExportOf::kAll || (of == ExportOf::kSelected && is_selected(marks, id)) ||
            (of == ExportOf::kVisible && state_of(marks, id) != tree::BranchState::kHidden);
    return exported;
}

} // namespace ramus::app
