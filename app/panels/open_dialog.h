// OpenDialog: a folder, its sub-folders and the files ramus can read, and what the user is typing: to choose a file to
// open, or a name to save or export something under. The folder is listed once.
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
    std::size_t shown = 0; // which files: an index into what the purpose offers; behind its end all files
    std::filesystem::path folder;
    FolderListing listing;         // of the folder
    std::vector<std::size_t> rows; // of its entries, those that are shown
    std::string rows_for;          // what they were found for
    bool take_first = false;       // Enter waits for the listing
    std::array<char, 256> filter{};
    std::array<char, 4096> typed{}; // the path field
    int marked = -1;                // index into the entries
    bool to_marked = false;         // it shall come into sight
    std::array<char, 256> name{};   // to save under
    bool replace_asked = false;     // the user was told that it exists
    bool name_focused = false;      // once, when it opens
    ExportChoice exported;          // of an export; stays as it was the last time

    void show(const std::filesystem::path& start, FilePurpose wanted);
    void show_to_save(const std::filesystem::path& suggestion, FilePurpose wanted = FilePurpose::kSave); // a file
    [[nodiscard]] bool saves() const { return purpose == FilePurpose::kSave || purpose == FilePurpose::kExport; }
    void rename(const std::string& text);              // in the field for the name
    [[nodiscard]] std::filesystem::path named() const; // the file to save, with its ending
    void enter(const std::filesystem::path& where);    // lists another folder
    [[nodiscard]] const std::vector<Entry>& entries() const { return listing.content().entries; }
};

// By which folders are remembered, and the command that gets the file.
[[nodiscard]] const char* key_of(FilePurpose purpose);

// By the ending of its name, in capitals or not.
[[nodiscard]] bool can_be_opened(const std::filesystem::path& path); // a tree or a session
[[nodiscard]] bool can_be_lesion_mesh(const std::filesystem::path& path);
[[nodiscard]] bool can_be_table(const std::filesystem::path& path); // of numbers of branches
[[nodiscard]] bool can_be_mask(const std::filesystem::path& path);

} // namespace ramus::app
