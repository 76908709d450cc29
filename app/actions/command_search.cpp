#include "app/actions/command_search.h"

#include "core/base/closest_word.h"
#include "core/io/text_numbers.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace ramus::app {

namespace {

struct Synonyms {
    std::string_view entry; // name of a command, perhaps with the first preset argument
    std::string_view words; // the most common first
};

// Words that are in no name, label or help of these commands, and that people look for: those of clinics, of other
// programs, and of the paper on convolution surfaces (S. Oeltze and B. Preim, 2005).
constexpr std::array kSynonyms{
    Synonyms{"lesion", "tumour tumor metastasis mass nodule sphere"},
    Synonyms{"lesion-mask", "tumour tumor metastasis segmentation label nifti dicom load import volume"},
    Synonyms{"lesion-mesh", "tumour tumor metastasis stl mesh load import"},
    Synonyms{"lesion-clear", "delete tumour tumor"},
    Synonyms{"bands", "margin resection safety distance band tumour tumor"},
    Synonyms{"cut", "clamp clip resect resection ligate transect"},
    Synonyms{"cut-clear", "undo resection unclip"},
    Synonyms{"export", "print save printing stl glb ply csv image screenshot data share convert"},
    Synonyms{"shot", "screenshot image photo capture export png snapshot"},
    Synonyms{"scan", "ct mr mri image volume dicom load import nifti slices mpr"},
    Synonyms{"layout slices", "mpr multiplanar reformation four-up views"},
    Synonyms{"crosshair", "cursor position jump navigate mpr"},
    Synonyms{"window", "brightness contrast level hounsfield"},
    Synonyms{"slab", "mip minip projection thick maximum intensity"},
    Synonyms{"cut-away", "clip clipping plane crop"},
    Synonyms{"along", "cpr curved planar reformation straightened stretched vessel cross sections follow centerline"},
    Synonyms{"stenosis", "narrowing diameter percent grading nascet plaque"},
    Synonyms{"sections", "cross sections area diameter table profile"},
    Synonyms{"slice-across", "perpendicular oblique cross section orthogonal"},
    Synonyms{"tool region", "threshold segment seed flood fill magic wand growing"},
    Synonyms{"region-grow more", "threshold tolerance level set"},
    Synonyms{"region-cut", "barrier stop leak scissors erase"},
    Synonyms{"region-save", "export nifti nrrd store"},
    Synonyms{"region-tree", "skeletonize centerline extract"},
    Synonyms{"report", "protocol print document html summary"},
    Synonyms{"page", "browser web html share send mail colleague patient"},
    Synonyms{"save", "store keep project"},
    Synonyms{"save-as", "store keep project copy"},
    Synonyms{"open", "load import file dicom nifti mask tree session"},
    Synonyms{"context", "organ liver skin bone load import background mesh"},
    Synonyms{"defocus", "transparency transparent fade grey gray glass ghost"},
    Synonyms{"defocus-others", "fade grey gray glass transparent transparency ghost isolate solo"},
    Synonyms{"glass-opacity", "transparency transparent alpha"},
    Synonyms{"context-opacity", "transparency transparent alpha"},
    Synonyms{"highlight", "emphasize emphasise mark focus colour color"},
    Synonyms{"hide", "remove invisible delete off"},
    Synonyms{"show", "restore visible reset on"},
    Synonyms{"show-all", "restore visible reset unhide everything"},
    Synonyms{"select-dependents", "downstream distal children descendants territory supply subtree"},
    Synonyms{"select-upstream", "proximal parents ancestors feeding inflow"},
    Synonyms{"select-none", "deselect clear unselect"},
    Synonyms{"fit", "home reset centre center zoom all whole recentre"},
    Synonyms{"orthographic", "parallel perspective projection"},
    Synonyms{"view", "side orientation look anatomical"},
    Synonyms{"view-save", "bookmark store keep remember camera angle perspective position scene"},
    Synonyms{"view-go", "bookmark restore return camera angle perspective position scene"},
    Synonyms{"filter-diameter", "thin small twigs threshold"},
    Synonyms{"surface",
             "smooth prune width detail cell quality triangles convolution coefficient isovalue method truncated "
             "cones binomial filter smoothing pruning bounding volume bulging"},
    Synonyms{"blend", "unwanted blending merging"},
    Synonyms{"skeleton", "centerline centerlines centreline centrelines medial axis"},
    Synonyms{"reconstruct", "rebuild graft"},
    Synonyms{"tool lesion", "tumour tumor metastasis mass nodule sphere"},
    Synonyms{"tool cut", "clamp clip resect resection ligate transect"},
    Synonyms{"tool measure-distance", "ruler length caliper calliper measure"},
    Synonyms{"tool measure-path", "route way ruler length measure"},
    Synonyms{"tool measure-diameter", "calibre caliber thickness width measure"},
    Synonyms{"tool measure-angle", "protractor degrees measure"},
    Synonyms{"tool lasso", "freehand region select"},
    Synonyms{"measure", "ruler length caliper calliper distance path"},
    Synonyms{"fly-along", "endoscopy virtual tour travel animation"},
    Synonyms{"overview", "diagram dendrogram map scheme tree"},
    Synonyms{"doctor", "import problems warnings repairs units orientation notes"},
    Synonyms{"contacts", "touching crossing kissing overlap false connections unwanted blending merging"},
    Synonyms{"colour-by", "color map legend thickness calibre caliber"},
    Synonyms{"colour-map", "color palette scale"},
    Synonyms{"depth-cue", "shadow fog halo depth"},
    Synonyms{"compare side-by-side", "versus difference method isosurface truncated cones"},
    Synonyms{"compare blend", "versus difference method isosurface truncated cones"},
    Synonyms{"compare superimposed", "versus difference method isosurface truncated cones"},
    Synonyms{"compare wipe", "versus difference method isosurface truncated cones"},
    Synonyms{"colour-by deviation", "distance distances error accuracy voxdiag2"},
    Synonyms{"deviation-scale", "voxdiag2 voxel diagonal half distance"},
    Synonyms{"validation", "validate accuracy error correctness"},
    Synonyms{"ui-scale", "font text size zoom bigger dpi"},
    Synonyms{"help", "keys shortcuts mouse manual hotkeys"},
    Synonyms{"name", "rename label annotate annotation call"},
    Synonyms{"quit", "exit close leave end"},
    Synonyms{"undo", "back revert"},
    Synonyms{"redo", "forward again repeat"},
    Synonyms{"turn", "rotate spin orbit"},
    Synonyms{"zoom", "closer nearer farther magnify"},
};

std::string synonyms_of(const Command& command) {
    const std::string of_entry = command.name + (command.preset.empty() ? "" : " " + command.preset.front());
    std::string words;
    for (const Synonyms& synonyms : kSynonyms)
        if (synonyms.entry == command.name || synonyms.entry == of_entry) words.append(synonyms.words).append(" ");
    return words;
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 128;
}

std::vector<std::string> words_in(std::string_view text) {
    constexpr std::string_view kPunctuation = "\xE2\x80"; // and a third byte: ellipsis, dashes and the like in UTF-8
    std::vector<std::string> words(1);
    const std::string lower = io::lower_case(text);
    for (std::size_t at = 0; at < lower.size(); ++at) {
        const char c = lower[at];
        const bool punctuation = lower.compare(at, kPunctuation.size(), kPunctuation) == 0;
        if (punctuation) at += kPunctuation.size();
        if (!punctuation && is_letter(c))
            words.back().push_back(c);
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

// The searchable words of a command, from the most to the least specific.
struct Entry {
    const Command* command;
    std::array<std::vector<std::string>, 4> words; // label, name and menu, synonyms, help
};
constexpr std::size_t kSynonymKind = 2;

std::vector<Entry> make_entries() {
    std::vector<Entry> entries;
    for (const Command& command : command_table()) {
        if (command.name == "dismiss" || command.name == "palette") continue; // these close and open the palette
        // In menus the entry without preset arguments represents its command.
        const bool shown_with_arguments =
            command.menu.empty() && command.keys.empty() && std::ranges::any_of(command_table(), [&](const Command& o) {
                return &o != &command && o.name == command.name && !o.menu.empty() && o.preset.empty();
            });
        if (shown_with_arguments) continue;
        Entry entry{&command, {}};
        entry.words[0] = words_in(command.label);
        entry.words[1] = words_in(command.name + " " + command.menu + " " + command.submenu);
        entry.words[kSynonymKind] = words_in(synonyms_of(command));
        entry.words[3] = words_in(command.help);
        entries.push_back(std::move(entry));
    }
    return entries;
}

const std::vector<Entry>& all_entries() {
    static const std::vector<Entry> entries = make_entries();
    return entries;
}

// How well a word matches: 0 is best; none: no match.
std::optional<int> fit_of(const Entry& entry, const std::string& word) {
    for (std::size_t kind = 0; kind < entry.words.size(); ++kind) {
        bool begins = false, within = false;
        for (const std::string& candidate : entry.words[kind]) {
            const auto after = kind == kSynonymKind ? &candidate - entry.words[kind].data() : 0;
            if (candidate == word)
                return static_cast<int>(3 * kind) + static_cast<int>(std::min<std::ptrdiff_t>(after, 2));
            begins = begins || candidate.starts_with(word);
            within = within || (word.size() > 2 && candidate.find(word) != std::string::npos);
        }
        if (begins) return static_cast<int>(3 * kind + 1);
        if (within && kind < 3) return static_cast<int>(3 * kind + 2);
    }
    return std::nullopt;
}

// Exact names of an entry: as typed in a script (name and preset arguments), its label alone or after its menu, the
// words of the typed form, or its command's name.
enum class Named { kAsTyped, kByLabel, kByWords, kByCommand, kNot };
Named named_by(const Command& command, std::string_view typed, const std::vector<std::string>& wanted) {
    const auto is = [&](const std::string& text) { return wanted == words_in(text); };
    std::string entry = command.name;
    for (const std::string& given : command.preset) entry += " " + given;
    if (typed == entry) return Named::kAsTyped;
    const std::string menu = command.menu + " " + (command.submenu.empty() ? "" : command.submenu + " ");
    if (is(command.label) || is(menu + command.label)) return Named::kByLabel;
    if (is(entry)) return Named::kByWords;
    return is(command.name) ? Named::kByCommand : Named::kNot;
}

std::string nearest_known(const std::string& word) {
    static const std::vector<std::string> known = [] {
        std::set<std::string> words;
        for (const Entry& entry : all_entries())
            for (std::size_t kind = 0; kind < 3; ++kind)
                words.insert(entry.words[kind].begin(), entry.words[kind].end());
        return std::vector<std::string>(words.begin(), words.end());
    }();
    return closest_word(word, known);
}

// Whether `word` is one of the words that the first argument may be: "surface" of "[explore|surface|plan]".
bool is_choice(const std::string& arguments, std::string_view word) {
    const std::string_view first = std::string_view(arguments).substr(0, arguments.find(' '));
    for (std::size_t at = 0; at < first.size();) {
        const std::size_t from = first.find_first_not_of("[]|", at);
        if (from == std::string_view::npos) return false;
        at = std::min(first.find_first_of("[]|", from), first.size());
        if (first.substr(from, at - from) == word) return true;
    }
    return false;
}

// Whether an entry presets exactly these arguments: "view left".
bool is_entry(std::string_view line) {
    return std::ranges::any_of(all_entries(), [&](const Entry& entry) {
        return named_by(*entry.command, line, words_in(line)) == Named::kAsTyped;
    });
}

} // namespace

const Command* command_given_by(std::string_view line) {
    const std::size_t end = line.find(' ');
    const std::size_t given = end == std::string_view::npos ? end : line.find_first_not_of(' ', end);
    if (given == std::string_view::npos) return nullptr;
    const Command* command = find_command(line.substr(0, end));
    if (command == nullptr || command->arguments.empty()) return nullptr;
    const bool number =
        line[given] >= '0' && line[given] <= '9'; // numbers occur in search words as well: "within 10 mm"
    const std::string_view word = line.substr(given, line.find(' ', given) - given);
    const bool choice = is_choice(command->arguments, word) && !is_entry(line);
    // Names with hyphens, files and lists of numbers are not search words.
    const bool typed = line.substr(0, end).find('-') != std::string_view::npos ||
                       line.find_first_of("/.,_\"=", given) != std::string_view::npos;
    return number || choice || (typed && !is_entry(line)) || search_commands(line).empty() ? command : nullptr;
}

std::vector<const Command*> search_commands(std::string_view words) {
    const std::vector<std::string> given = words_in(words);
    std::vector<std::string> wanted = given;
    for (std::string& word : wanted) {
        const auto is_found = [&](const Entry& entry) { return fit_of(entry, word).has_value(); };
        if (std::ranges::any_of(all_entries(), is_found)) continue;
        if (std::string meant = nearest_known(word); !meant.empty()) word = std::move(meant);
    }
    struct Found {
        const Command* command;
        Named named;
        int fit;
    };
    std::vector<Found> found;
    for (const Entry& entry : all_entries()) {
        std::optional<int> sum = 0;
        for (const std::string& word : wanted) {
            const auto fit = fit_of(entry, word);
            sum = sum && fit ? std::optional(*sum + *fit) : std::nullopt;
        }
        const Named named = named_by(*entry.command, words, given);
        if (sum || named != Named::kNot) found.push_back({entry.command, named, sum.value_or(0)});
    }
    // Exact names first; then entries of menus, since others need arguments.
    std::ranges::stable_sort(found, {}, [](const Found& one) {
        return std::tuple(one.named, one.fit, one.command->menu.empty() && one.command->keys.empty());
    });
    std::vector<const Command*> commands;
    commands.reserve(found.size());
    for (const Found& one : found) commands.push_back(one.command);
    return commands;
}

std::string title_of(const Command& command, const Document& document) {
    if (!command.menu.empty()) {
        const std::string submenu = command.submenu.empty() ? "" : command.submenu + " \xE2\x80\xBA ";
        return command.menu + " \xE2\x80\xBA " + submenu + label_of(command, document);
    }
    std::string title = command.name;
    std::ranges::replace(title, '-', ' ');
    return title;
}

bool needs_arguments(const Command& command) {
    return command.preset.empty() && !command.arguments.empty() && command.arguments.front() != '[' &&
           command.menu.empty();
}

} // namespace ramus::app
