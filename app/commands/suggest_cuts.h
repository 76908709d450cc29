// `ramus territories --fewest-cuts MM`: the cuts that take the supply of the lesions and a margin around them, with the
// least loss.
#pragma once

#include "app/commands/organ_case.h"
#include "core/base/error.h"
#include "core/organ/fewest_cuts.h"

#include <CLI/CLI.hpp>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace ramus::app {

struct CutWish {
    std::optional<double> margin_mm; // none: no cuts are wanted
    std::size_t most_cuts = 6;
};

// Adds --fewest-cuts and --most-cuts.
void add_cut_options(CLI::App& command, CutWish& wish);

struct CutAnswer {
    int system = 0; // whose vessels are cut
    double margin_mm = 0.0;
    std::size_t targets = 0; // voxels of lesions and margin in the organ
    organ::CutSuggestions suggestions;
};

// The system is that of --system, or else the one that supplies. Fails without --lesions, if no lesion is in the organ,
// and if several systems could be meant.
[[nodiscard]] Result<CutAnswer> suggest_cuts(const OrganCase& read, const OrganFlags& flags, const CutWish& wish);

[[nodiscard]] nlohmann::ordered_json json_of(const OrganCase& read, const CutAnswer& answer);
void print_cuts(const OrganCase& read, const CutAnswer& answer);

} // namespace ramus::app
