// VolumeDialog: what becomes of a mask or a scan that is opened, with what the file holds.
#pragma once

#include "app/workspace/volume_facts.h"

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ramus::app {

struct VolumeDialog {
    enum class As : std::uint8_t { kTree, kContext, kSurface };
    std::filesystem::path file; // empty: the dialog is closed
    As as = As::kTree;          // what Return does
    // What the file holds; null: it is being read.
    std::shared_ptr<const VolumeFacts> facts;
    std::vector<char> labels; // of the facts' labels: not 0 where it is taken
    bool together = false;    // those are one tree

    [[nodiscard]] bool open() const { return !file.empty(); }
    void take(VolumeFacts read);
    // Of the command `open`: "1+3", "1,2"; empty: each label by itself, as usual.
    [[nodiscard]] std::string label_words() const;
    // One for each call of the command `context`; 0: all labels.
    [[nodiscard]] std::vector<std::int32_t> context_labels() const;

private:
    [[nodiscard]] std::vector<std::int32_t> chosen() const;
};

} // namespace ramus::app
