// Surfaces of the same vessels in one picture: the options of `ramus render` that say which, and how.
#pragma once

#include "app/session/session.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ramus::app {

struct ComparisonFlags {
    std::optional<Comparison::Mode> mode;
    std::optional<std::vector<mesh::Method>> surfaces;
    std::string mask; // empty: the session's, or the tree's own voxels
    std::vector<std::int32_t> labels;
    std::optional<double> blend;
    bool skeleton = false;
};

void add_comparison_flags(CLI::App& command, ComparisonFlags& flags);
// Throws CLI::ValidationError for what has no meaning without the other.
void check_comparison_flags(const CLI::App& command, const ComparisonFlags& flags);
// What was not given stays as it is.
void apply(const ComparisonFlags& flags, Marks& marks);

} // namespace ramus::app
