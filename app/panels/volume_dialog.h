// VolumeDialog: asks how to open a mask or a scan, and shows what the file contains.
#pragma once

#include "app/workspace/volume_facts.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct VolumeDialog {
    enum class As : std::uint8_t { kTree, kContext, kSurface, kSlices, kOrgan, kLesions };
    std::filesystem::path file; // empty: the dialog is closed
    As as = As::kTree;          // the default action
    bool asked = false;         // a command asked for that action
    // Content of the file; null: being read.
    std::shared_ptr<const VolumeFacts> facts;
    bool scan = false;         // treated as a scan, whose values are no labels
    std::vector<char> labels;  // by label of `facts`: not 0 if chosen
    bool together = false;     // the chosen labels form one tree
    std::size_t threshold = 0; // index into the curve of `facts`, for scans
    float progress = 0.0F;     // of reading the file

    [[nodiscard]] bool open() const { return !file.empty(); }
    void close() { *this = {}; }
    void take(VolumeFacts read);
    // Why the choice cannot be opened; empty: it can.
    [[nodiscard]] std::string why_not() const;
    // Arguments of the commands `open` and `context` in addition to the file: {"--labels", "1+3"}, {"--isovalue",
    // "200"}; empty: the defaults. `context` runs once per list.
    [[nodiscard]] std::vector<std::string> tree_words() const;
    [[nodiscard]] std::vector<std::vector<std::string>> context_words() const;
    // The same for `organ` and `lesion-mask`.
    [[nodiscard]] std::vector<std::string> mask_words() const;

private:
    [[nodiscard]] std::string label_words() const;
    [[nodiscard]] std::string isovalue_text() const;
    [[nodiscard]] std::vector<std::int32_t> chosen() const;
};

} // namespace ramus::app
