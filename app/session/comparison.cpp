#include "app/session/comparison.h"

#include "core/base/sort_unique.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <filesystem>

namespace ramus::app {

std::string_view name_of(Comparison::Mode mode) {
    constexpr std::array<std::string_view, 5> kNames{"off", "side-by-side", "blend", "superimposed", "wipe"};
    return kNames[static_cast<std::size_t>(mode)];
}

std::optional<Comparison::Mode> comparison_mode_named(std::string_view name) {
    const auto found =
        std::ranges::find_if(kComparisonModes, [&](Comparison::Mode mode) { return name_of(mode) == name; });
    return found == kComparisonModes.end() ? std::nullopt : std::optional(*found);
}

std::string compared_names() {
    std::string names;
    for (const ComparedRow& row : kCompared) names.append(names.empty() ? "" : ", ").append(row.key);
    return names;
}

bool is_own(Compared kind, const mesh::SurfaceOptions& options) {
    const ComparedRow& row = row_of(kind);
    return row.method == options.method && row.blend.value_or(options.blend) == options.blend;
}

std::vector<Compared> compared_surfaces(const Comparison& comparison) {
    if (comparison.mode == Comparison::Mode::kOff) return {};
    std::vector<Compared> surfaces = comparison.surfaces;
    if (comparison.mode != Comparison::Mode::kSideBySide) surfaces.resize(2);
    return surfaces;
}

std::string title_of(Compared kind, const Comparison& comparison) {
    std::string title(row_of(kind).label);
    if (kind != Compared::kIsosurface) return title;
    if (comparison.mask.empty()) return title + " of the tree's voxels";
    title += " of " + std::filesystem::path(comparison.mask).filename().string();
    for (std::size_t i = 0; i < comparison.labels.size(); ++i)
        title += (i > 0                          ? ", "
                  : comparison.labels.size() > 1 ? ", labels "
                                                 : ", label ") +
                 volume::spelled(comparison.labels[i]);
    return title;
}

std::optional<std::vector<Compared>> surface_list(std::string_view text) {
    std::vector<Compared> kinds;
    for (const std::string_view part : parts_of(text)) {
        const auto* row = std::ranges::find(kCompared, part, &ComparedRow::key);
        if (row == kCompared.end() || std::ranges::find(kinds, row->kind) != kinds.end()) return std::nullopt;
        kinds.push_back(row->kind);
    }
    if (kinds.size() < 2 || kinds.size() > 3) return std::nullopt;
    return kinds;
}

namespace {

// Parts between these separators; none within double quotes.
std::vector<std::string_view> label_words(std::string_view text, char separator) {
    std::vector<std::string_view> words;
    bool quoted = false;
    std::size_t from = 0;
    for (std::size_t at = 0; at <= text.size(); ++at) {
        if (at < text.size() && text[at] == '"') quoted = !quoted;
        if (at < text.size() && (quoted || text[at] != separator)) continue;
        words.push_back(text.substr(from, at - from));
        from = at + 1;
    }
    return words;
}

std::optional<volume::LabelChoice> label_choice(std::string_view word) {
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (word.size() > 2 && word.starts_with('"') && word.ends_with('"'))
        return volume::LabelChoice(std::string(word.substr(1, word.size() - 2)));
    if (word.empty() || word.find('"') != std::string_view::npos) return std::nullopt;
    const auto number = parsed<std::int32_t>(word);
    if (!number) return volume::LabelChoice(std::string(word));
    return *number == 0 ? std::nullopt : std::optional(volume::LabelChoice(*number));
}

std::optional<std::vector<volume::LabelChoice>> label_choices(std::string_view text, char separator) {
    std::vector<volume::LabelChoice> labels;
    for (const std::string_view word : label_words(text, separator)) {
        auto choice = label_choice(word);
        if (!choice) return std::nullopt;
        labels.push_back(std::move(*choice));
    }
    sort_unique(labels);
    return labels;
}

} // namespace

std::optional<std::vector<volume::LabelChoice>> label_list(std::string_view text) { return label_choices(text, ','); }

std::optional<std::vector<std::vector<volume::LabelChoice>>> label_groups(std::string_view text) {
    std::vector<std::vector<volume::LabelChoice>> groups;
    for (const std::string_view part : label_words(text, ',')) {
        auto labels = label_choices(part, '+');
        if (!labels) return std::nullopt;
        groups.push_back(std::move(*labels));
    }
    return groups;
}

} // namespace ramus::app
