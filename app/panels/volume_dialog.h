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
    bool scan = false;         // it is taken for one, whose values are no labels
    std::vector<char> labels;  // of the facts' labels: not 0 where it is taken
    bool together = false;     // those are one tree
    std::size_t threshold = 0; // of the facts' curve, where it is a scan

    [[nodiscard]] bool open() const { return !file.empty(); }
    void take(VolumeFacts read);
    // Why nothing can be made of it; empty: something can.
    [[nodiscard]] std::string why_not() const;
    // What the commands `open` and `context` get beside the file: {"--labels", "1+3"}, {"--isovalue", "200"}; nothing:
    // as usual. There is one list for each call of `context`.
    [[nodiscard]] std::vector<std::string> tree_words() const;
    [[nodiscard]] std::vector<std::vector<std::string>> context_words() const;

private:
    [[nodiscard]] std::string label_words() const;
    [[nodiscard]] std::string isovalue_text() const;
    [[nodiscard]] std::vector<std::int32_t> chosen() const;
};

} // namespace ramus::app
