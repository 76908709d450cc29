// The table of methods that make a surface of vessels, for sessions, commands, the command line and the window.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ramus::mesh {

enum class Method : std::uint8_t { kConvolutionSurface, kTruncatedCones, kIsosurface };

struct MethodRow {
    Method method;
    std::string_view key;   // in files, commands and on the command line
    std::string_view label; // for a list or a heading
    std::string_view noun;  // for a sentence
    std::string_view help;
    bool of_tree; // the input is a tree, not a mask
};

// In the order of `Method`.
inline constexpr std::array<MethodRow, 3> kMethods = {{
    {Method::kConvolutionSurface, "cs", "Convolution surface", "convolution surface", "convolution surface (default)",
     true},
    {Method::kTruncatedCones, "cones", "Truncated cones", "truncated cones", "truncated cones", true},
    {Method::kIsosurface, "iso", "Isosurface", "isosurface", "isosurface of a mask", false},
}};

[[nodiscard]] constexpr const MethodRow& row_of(Method method) { return kMethods[static_cast<std::size_t>(method)]; }
[[nodiscard]] constexpr std::string_view name_of(Method method) { return row_of(method).key; }

[[nodiscard]] inline std::optional<Method> method_named(std::string_view key) {
    const auto* found = std::ranges::find(kMethods, key, &MethodRow::key);
    return found == kMethods.end() ? std::nullopt : std::optional(found->method);
}

// "cs: convolution surface (default); cones: truncated cones"; with the methods for masks if `with_masks`.
[[nodiscard]] inline std::string method_help(bool with_masks) {
    std::string text;
    for (const MethodRow& row : kMethods)
        if (row.of_tree || with_masks)
            text.append(text.empty() ? "" : "; ").append(row.key).append(": ").append(row.help);
    return text;
}

} // namespace ramus::mesh
