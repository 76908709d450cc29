// OpenDialog: state of the file dialogs: a folder with the files that ramus can read, and the user's input: a file to
// open, or a name for saving or exporting. A folder is listed once.
#pragma once

#include "app/actions/hosts.h"
#include "app/panels/export_choice.h"
#include "app/panels/folder_listing.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ramus::app {

struct OpenDialog {
    using Entry = FolderListing::Entry;
    FilePurpose purpose = FilePurpose::kOpen;
    bool open = false;
    std::size_t shown = 0; // file filter: an index into the purpose's filters; beyond the end: all files
    std::filesystem::path folder;
    FolderListing listing;         // content of the folder
    std::vector<std::size_t> rows; // indices of the entries shown
    std::string rows_for;          // the input of `rows`
    bool take_first = false;       // Enter waits for the listing
    std::array<char, 256> filter{};
    std::array<char, 4096> typed{}; // the path field
    int marked = -1;                // index into the entries
    bool to_marked = false;         // scroll to it
    std::array<char, 256> name{};   // file name for saving
    bool replace_asked = false;     // the user was asked whether to replace an existing file
    bool name_focused = false;      // set once, when the dialog opens
    ExportChoice exported;          // for exports; kept for the next time

    void show(const std::filesystem::path& start, FilePurpose wanted);
    void show_to_save(const std::filesystem::path& suggestion, FilePurpose wanted = FilePurpose::kSave); // a file
    [[nodiscard]] bool saves_region() const {
        return purpose == FilePurpose::kRegion || purpose == FilePurpose::kRegionTree;
    }
    [[nodiscard]] bool saves() const {
        return purpose == FilePurpose::kSave || purpose == FilePurpose::kExport || saves_region();
    }
    void rename(const std::string& text);              // sets the text of the name field
    [[nodiscard]] std::filesystem::path named() const; // the file to save, with its extension
    void enter(const std::filesystem::path& where);    // lists another folder
    [[nodiscard]] const std::vector<Entry>& entries() const { return listing.content().entries; }
};

// Key under which the folder is remembered, and the command that receives the file.
[[nodiscard]] const char* key_of(FilePurpose purpose);

// By extension, ignoring case.
[[nodiscard]] bool can_be_opened(const std::filesystem::path& path); // a tree or a session
[[nodiscard]] bool can_be_lesion_mesh(const std::filesystem::path& path);
[[nodiscard]] bool can_be_table(const std::filesystem::path& path); // of numbers of branches
[[nodiscard]] bool can_be_mask(const std::filesystem::path& path);

} // namespace ramus::app
