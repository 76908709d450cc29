#include "app/commands/load_tree.h"

#include <cmath>
#include <cstdio>
#include <iostream>

namespace ramus::app {

Result<tree::VesselTree> load_tree(const std::string& file, const SurfaceFlags& flags) {
    auto tree = io::read_tree(file, flags.read);
    if (!tree) return tree;
    // A file that needs many repairs shall not drown what else is said.
    constexpr std::size_t kShown = 5;
    const std::size_t shown = flags.verbose ? tree->repairs.size() : std::min(kShown, tree->repairs.size());
    for (std::size_t i = 0; i < shown; ++i) std::cerr << "ramus: repaired: " << tree->repairs[i] << '\n';
    if (shown < tree->repairs.size())
        std::cerr << "ramus: repaired: " << grouped(tree->repairs.size() - shown)
                  << " more places (ramus info lists them)\n";
    say(flags, file + ": " + counted(tree->points.size(), "point", "points") + ", " +
                   counted(tree->segment_count(), "segment", "segments") + ", " +
                   counted(tree->branches.size(), "branch", "branches"));
    return tree;
}

void say(const SurfaceFlags& flags, const std::string& line) {
    if (flags.verbose) std::cerr << "ramus: " << line << '\n';
}

std::string grouped(std::uint64_t number) {
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0) text.push_back(',');
        text.push_back(digits[i]);
    }
    return text;
}

std::string rounded(double number) {
    char text[32];
    // Four digits, but none of a whole number's lost.
    std::snprintf(text, sizeof text, std::abs(number) >= 1e4 ? "%.0f" : "%.4g", number);
    return text;
}

std::string counted(std::uint64_t number, const std::string& one, const std::string& many) {
    return grouped(number) + " " + (number == 1 ? one : many);
}

} // namespace ramus::app
