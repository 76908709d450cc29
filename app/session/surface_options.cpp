#include "app/session/surface_options.h"

#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace ramus::app {

namespace {

using Options = mesh::SurfaceOptions;

constexpr double kLarge = 1e300;

// Reads and writes one member.
template <auto Member> double value_of(const Options& options) { return static_cast<double>(options.*Member); }
template <auto Member> void set_to(Options& options, double value) {
    options.*Member = static_cast<std::remove_reference_t<decltype(options.*Member)>>(value);
}

// In the order of mesh::Blend.
constexpr auto kBlendWords = [] {
    std::array<OptionWord, mesh::kBlends.size()> words{};
    for (std::size_t n = 0; n < words.size(); ++n) words[n] = {mesh::kBlends[n].key, mesh::kBlends[n].label};
    return words;
}();

// In the order of tree::Centerline.
constexpr std::array<OptionWord, 2> kCenterlineWords = {{
    {tree::name_of(tree::Centerline::kSmooth), "Round"},
    {tree::name_of(tree::Centerline::kLines), "Lines"},
}};

// In the order of mesh::Radii.
constexpr std::array<OptionWord, 2> kRadiiWords = {{
    {mesh::name_of(mesh::Radii::kPlain), "Plain"},
    {mesh::name_of(mesh::Radii::kExact), "Exact"},
}};

// In the order of field::KernelKind.
const std::vector<OptionWord> kKernelWords = [] {
    std::vector<OptionWord> words;
    for (const field::KernelRow& row : field::kernel_rows()) words.push_back({row.key, row.label});
    return words;
}();

const std::array<SurfaceOption, 10> kSurfaceOptions = {{
    {.key = "smooth",
     .unit = "N",
     .help = "Smoothing passes over points that are voxels, by half a voxel at most; others stay (default 1)",
     .domain = "a whole number from 0 to 100",
     .least = 0,
     .most = 100,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::smooth_passes>,
     .set = set_to<&Options::smooth_passes>,
     .label = "Smooth",
     .tooltip = "Passes against the steps of voxels: no point moves by more than half a voxel",
     .slider_most = 10},
    {.key = "prune",
     .unit = "RATIO",
     .help = "Drop end branches shorter than RATIO x their parent (default 0)",
     .domain = "a ratio of 0 or more",
     .least = 0.0,
     .most = kLarge,
     .of_session = true,
     .value = value_of<&Options::prune_ratio>,
     .set = set_to<&Options::prune_ratio>,
     .label = "Prune",
     .tooltip = "Leaf branches shorter than this many lengths of their parent are left out",
     .slider_most = 1.0,
     .zero_is_off = true},
    // Beyond these, the isovalue 2^-width leaves single precision, or the support (10 radii) covers the whole tree.
    {.key = "width",
     .unit = "WIDTH",
     .help = "Kernel width; 5 follows the vessels (default), 1 blends as Bloomenthal did",
     .domain = "a width from 0.1 to 100",
     .least = 0.1,
     .most = 100.0,
     .of_session = true,
     .value = value_of<&Options::width>,
     .set = set_to<&Options::width>,
     .label = "Width",
     .tooltip = "Kernel width: 5 follows the vessels closely, 1 blends them broadly",
     .slider_least = 1.0,
     .slider_most = 10.0},
    {.key = "kernel",
     .unit = "KERNEL",
     .help = "What the centerline is convolved with: gaussian (default), or, to compare with it, inverse-cubic, "
             "inverse-square (both without a --width), cauchy or polynomial (--width to 10)",
     .domain = "gaussian, inverse-cubic, inverse-square, cauchy or polynomial",
     .least = 0,
     .most = 4,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::kernel>,
     .set = set_to<&Options::kernel>,
     .label = "Kernel",
     .tooltip = "What the centerline is convolved with: the Gaussian is the paper's choice",
     .slider_most = 4,
     .only_when_set = true,
     .words = kKernelWords},
    {.key = "blend",
     .unit = "tree|paper",
     .help =
         "Where vessels blend: tree, along the tree alone, so that vessels that only press on each other stay apart "
         "(default); paper, wherever they come close",
     .domain = "tree or paper",
     .least = 0,
     .most = kBlendWords.size() - 1,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::blend>,
     .set = set_to<&Options::blend>,
     .label = "Blend",
     .tooltip = "Vessels stay apart where they only press on each other, or merge wherever they come close",
     .slider_most = kBlendWords.size() - 1,
     .words = kBlendWords,
     .before_it_was = static_cast<double>(mesh::Blend::kPaper)},
    {.key = "centerline",
     .unit = "smooth|lines",
     .help = "How centerlines run from point to point: smooth, with round corners and radii that change smoothly "
             "(default); "
             "lines, straight, as in the paper",
     .domain = "smooth or lines",
     .least = 0,
     .most = 1,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::centerline>,
     .set = set_to<&Options::centerline>,
     .label = "Centerline",
     .tooltip = "Round corners and radii that change smoothly, or straight lines, as in the paper",
     .slider_most = 1,
     .words = kCenterlineWords,
     .before_it_was = static_cast<double>(tree::Centerline::kLines)},
    {.key = "radii",
     .unit = "plain|exact",
     .help =
         "Which radii the surface has: plain, what the kernel makes of those of the tree, as in the paper (default); "
         "exact, those of the tree, also in short stenoses",
     .domain = "plain or exact",
     .least = 0,
     .most = 1,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::radii>,
     .set = set_to<&Options::radii>,
     .label = "Radii",
     .tooltip = "What the kernel makes of the radii, or exactly those of the tree, also in short stenoses",
     .slider_most = 1,
     .only_when_set = true,
     .words = kRadiiWords},
    {.key = "detail",
     .unit = "N",
     .help = "Triangles around a vessel, thick or thin (default 16)",
     .domain = "a whole number from 4 to 512",
     .least = 4,
     .most = 512,
     .whole = true,
     .of_session = true,
     .value = value_of<&Options::detail>,
     .set = set_to<&Options::detail>,
     .label = "Detail",
     .tooltip = "Triangles around a vessel",
     .slider_least = 6,
     .slider_most = 48},
    {.key = "cell",
     .unit = "MM",
     .help = "One cell size everywhere, in mm, instead of --detail",
     .domain = "a length above 0",
     .least = std::numeric_limits<float>::min(),
     .most = kLarge,
     .of_session = true,
     .value = value_of<&Options::cell_mm>,
     .set = set_to<&Options::cell_mm>,
     .instead = "detail",
     .only_when_set = true},
    {.key = "threads",
     .unit = "N",
     .help = "Threads to work with (default 0: one for each core)",
     .domain = "a whole number from 0 to 1024",
     .least = 0,
     .most = 1024,
     .whole = true,
     .value = value_of<&Options::threads>,
     .set = set_to<&Options::threads>},
}};

} // namespace

std::span<const SurfaceOption> surface_options() { return kSurfaceOptions; }

const SurfaceOption* surface_option(std::string_view key) {
    const auto* found = std::ranges::find(kSurfaceOptions, key, &SurfaceOption::key);
    return found == kSurfaceOptions.end() ? nullptr : found;
}

bool takes(const SurfaceOption& option, double value) {
    return std::isfinite(value) && value >= option.least && value <= option.most &&
           (!option.whole || value == std::floor(value));
}

std::string spelled(const SurfaceOption& option, double value) {
    if (!option.words.empty()) return std::string(option.words[static_cast<std::size_t>(value)].key);
    return option.whole ? std::to_string(static_cast<int>(value)) : digits(value, 4);
}

std::optional<double> value_in(const SurfaceOption& option, const std::string& text) {
    if (!option.words.empty()) {
        const auto word = std::ranges::find(option.words, text, &OptionWord::key);
        if (word == option.words.end()) return std::nullopt;
        return static_cast<double>(word - option.words.begin());
    }
    const auto value = parsed<double>(text);
    return value && takes(option, *value) ? value : std::nullopt;
}

std::string surface_command_help() {
    std::string text;
    for (const SurfaceOption& option : kSurfaceOptions) {
        if (option.label.empty()) continue;
        if (!option.words.empty()) {
            text.append(option.key).append(" ").append(option.domain).append(", ");
            continue;
        }
        text.append(option.key).append(option.most < kLarge ? " " : " from ").append(rounded(option.least));
        if (option.most < kLarge) text += " to " + rounded(option.most);
        text += ", ";
    }
    text += "method ";
    bool first = true;
    for (const mesh::MethodRow& row : mesh::kMethods)
        if (row.of_tree) text.append(std::exchange(first, false) ? "" : " or ").append(row.key);
    return text;
}

} // namespace ramus::app
