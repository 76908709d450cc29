#include "app/session/window_words.h"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace ramus::app {

namespace {

using Words = std::pair<std::string_view, std::string_view>;

// Of two entries with a common prefix, the longer is first.
constexpr auto kWindowWords = std::to_array<Words>({
    {"say which of them are vessels with --labels N,M, or take all that is at least X with --isovalue X",
     "File, Open asks which of them are vessels, or for a threshold"},
    {"take all that is at least X with --isovalue X", "take all above a threshold (File, Open asks for it)"},
    {"give it to --session of ramus render, mesh or convert, or name its tree's file", "open its tree's file"},
    {"as ramus info --branches lists them", "as the table of branches has them"},
    {"those of ramus info --branches", "those of the table of branches"},
    {"repair with --repair or edit the file", "choose more repairs (Shift+D) or edit the file"},
    {"allow it with --repair usual or --repair ", "allow all repairs when the file is read (Shift+D), such as "},
    {"allow it with --repair all or --repair ", "allow all repairs when the file is read (Shift+D), such as "},
    {"--repair all makes it a root", "with all repairs (Shift+D) it is a root"},
    {"--repair all takes", "a repair (Shift+D) takes"},
    {"prune with --prune", "prune"},
    {"say which are vessels: --label N,M", "choose a threshold where File, Open asks what becomes of it"},
    {"choose one of them with --channel N", "type open FILE --tree --channel N, or scan FILE --channel N (Ctrl+K)"},
    {"choose one of them with --time N", "type open FILE --tree --time N, or scan FILE --time N (Ctrl+K)"},
    {"choose an --isovalue, or a --label", "choose a threshold where File, Open asks what becomes of it"},
    {"choose an --isovalue", "choose a mask of whole numbers"},
    {"leave out --label", "choose no label"},
    {"--label chooses one of a mask's", "a label is one of a mask's"},
    {"ramus info lists the labels of a mask", "the dialog that opens a mask lists its labels"},
    {"ramus info lists the labels", "the dialog that opens a mask lists its labels"},
    {"ramus mesh --method iso makes the surface of a mask", "open it as the surface of a mask"},
    {"use a file that `ramus convert` wrote", "use a file that File, Export wrote"},
    {"or write it anew with `ramus convert`", "or write it anew with the program that made it"},
    {"as a surface, --context of ramus render shows it", "as a surface, File, Add context shows it"},
    {", or give all points the same radius with --radius MM", ", or give all points the same radius"},
    {"leave out --orientation, or ", ""},
    {"say which one it is with --units", "say which one it is: View, What the file does not say"},
    {"say which they are with --units", "say which they are: View, What the file does not say"},
    {"--units um, or the size of a voxel, may be what is meant",
     "the unit may be um, or the size of a voxel: choose it in the row Unit"},
    {"--units with the size of a voxel in mm (0.5 or 0.5x0.5x1.2) may be what is meant",
     "the unit may be the size of a voxel: choose Voxels in the row Unit"},
    {"--units um may be what is meant", "the unit may be um: choose it in the row Unit"},
    {"--units cm is likely what is meant", "the unit is likely cm: choose it in the row Unit"},
    {"--units cm is what is meant", "the unit is cm: choose it in the row Unit"},
    {"--units m is what is meant", "the unit is m: choose it in the row Unit"},
    {"--units takes", "the unit takes"},
    {"--units with the size", "the unit with the size"},
    {"--units um", "the unit um"},
    {"--units cm", "the unit cm"},
    {"--units m", "the unit m"},
    {"correct --units", "correct the unit"},
    {"allow more with --memory", "close other programs"},
    {"raise --cell or --memory", "lower the detail"},
    {"more --memory", "more memory"},
    {"raise --memory", "close other programs"},
    {"raise --cell", "raise the size of cells"},
    {"lower --cell", "lower the size of cells"},
    {"set --cell", "lower the detail"},
    {"hide or prune branches, or raise --graphics-memory", "or hide or prune branches"},
    {"a coarser --detail", "a lower detail"},
    {"--detail", "the detail"},
    {"a lower the detail", "a lower detail"},
    {"give --blend paper", "choose Blend, Wherever close"},
    {"give a smaller size, or use another driver: ramus render --backend osmesa", "make the window smaller"},
    {"give key.json as `ramus study` wrote it", "give key.json as it was written"},
    {"--islands", "Islands (Shift+D)"},
    {"a --width", "a width"},
    {"another --kernel", "another kernel"},
});

} // namespace

std::string window_words(std::string text) {
    for (const auto& [words, instead] : kWindowWords)
        for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + instead.size()))
            text.replace(at, words.size(), instead);
    // Any other flag becomes its word.
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at)) {
        const bool flag = at + 2 < text.size() && std::islower(static_cast<unsigned char>(text[at + 2])) != 0 &&
                          (at == 0 || text[at - 1] == ' ' || text[at - 1] == '(');
        if (flag)
            text.erase(at, 2);
        else
            at += 2;
    }
    return text;
}

std::string capitalised(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

Error in_window_words(Error error) {
    error.what = window_words(std::move(error.what));
    error.hint = window_words(std::move(error.hint));
    return error;
}

} // namespace ramus::app
