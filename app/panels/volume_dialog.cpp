// The dialog for an opened or dropped mask or scan: make a tree of it, or show its surface.
#include "app/panels/volume_dialog.h"

#include "app/panels/error_dialog.h"
#include "app/panels/parts.h"
#include "app/panels/recovery_dialogs.h"
#include "app/panels/theme.h"
#include "app/panels/widgets.h"
#include "app/session/numbers.h"
#include "core/base/words.h"

#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <optional>
#include <utility>
#include <vector>

namespace ramus::app {

std::vector<std::int32_t> VolumeDialog::chosen() const {
    std::vector<std::int32_t> found;
    for (std::size_t i = 0; facts && i < facts->labels.size(); ++i)
        if (labels[i] != 0) found.push_back(facts->labels[i].label);
    return found;
}

void VolumeDialog::take(VolumeFacts read) {
    labels.assign(read.labels.size(), 1);
    scan = !read.mask;
    if (scan && !asked) as = As::kSlices;
    threshold = read.curve ? read.curve->otsu : 0;
    facts = std::make_shared<const VolumeFacts>(std::move(read));
}

std::string VolumeDialog::why_not() const {
    if (!facts) return {};
    if (scan && !facts->curve) return "All its values are equal: there is nothing to tell apart";
    if (!scan && !facts->labels.empty() && chosen().empty()) return "No label is chosen";
    return {};
}

// "1+3", "1,2"; empty: each label separately, the default.
std::string VolumeDialog::label_words() const {
    const std::vector<std::int32_t> some = chosen();
    const bool all = !facts || some.size() == facts->labels.size();
    if (all && (some.size() < 2 || !together)) return {};
    if (all) return "together";
    return joined(some, together ? "+" : ",", [](std::int32_t label) { return std::to_string(label); });
}

std::string VolumeDialog::isovalue_text() const {
    return facts && facts->curve ? exact_text(facts->curve->thresholds[threshold]) : std::string();
}

std::vector<std::string> VolumeDialog::tree_words() const {
    if (scan) return {"--isovalue", isovalue_text()};
    if (const std::string words = label_words(); !words.empty()) return {"--labels", words};
    return {};
}

std::vector<std::string> VolumeDialog::mask_words() const {
    const std::vector<std::int32_t> some = chosen();
    if (!facts || some.size() == facts->labels.size()) return {};
    return {"--label", joined(some, ",", [](std::int32_t label) { return std::to_string(label); })};
}

std::vector<std::vector<std::string>> VolumeDialog::context_words() const {
    if (scan) return {{"--isovalue", isovalue_text()}};
    const std::vector<std::int32_t> some = chosen();
    // Named labels are separate objects, unless there are too many.
    constexpr std::size_t kMostNamed = 16;
    const bool named = facts && some.size() > 1 && some.size() <= kMostNamed &&
                       std::ranges::any_of(facts->labels, [](const LabelFacts& label) { return !label.name.empty(); });
    if (!facts || (some.size() == facts->labels.size() && facts->all_at_once && !named)) return {{}};
    std::vector<std::vector<std::string>> words;
    for (const std::int32_t label : some) words.push_back({"--label", std::to_string(label)});
    return words;
}

namespace {

using As = VolumeDialog::As;

struct Choice {
    As as;
    const char *label, *key;
    std::string words;
    std::string why_not; // empty: it can be done
};

// A button with an explanation below, or the reason why it is unavailable. `key`: a letter that presses it. `share`: of
// the dialog's width.
bool draw_choice(const Choice& choice, bool marked, float share) {
    const float scale = theme::scale();
    const float height = 2.0F * ImGui::GetTextLineHeight() + 18.0F * scale;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float gap = ImGui::GetStyle().ItemSpacing.x;
    const float width = std::floor(share * (ImGui::GetContentRegionAvail().x + gap) - gap);
    const bool can = choice.why_not.empty();
    const ImVec4 ground = marked && can ? theme::kAccentDim : ImGui::GetStyleColorVec4(ImGuiCol_Button);
    ImGui::BeginDisabled(!can);
    ImGui::PushID(choice.label);
    const bool pressed = widgets::button("##choice", {width, height}, ground);
    ImGui::PopID();
    ImGui::EndDisabled();
    widgets::note_item(choice.label);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float left = std::round(at.x + 12.0F * scale), top = std::round(at.y + 8.0F * scale);
    list.AddText({left, top}, ImGui::GetColorU32(can ? theme::kText : theme::kQuiet), choice.label);
    const ImU32 quiet = ImGui::GetColorU32(marked && can ? theme::kText : theme::kQuiet);
    const std::string words = widgets::fitted(can ? choice.words : choice.why_not, width - 24.0F * scale);
    list.AddText({left, top + ImGui::GetTextLineHeight() + 2.0F * scale}, quiet, words.c_str());
    list.AddText({std::round(at.x + width - 12.0F * scale - ImGui::CalcTextSize(choice.key).x), top}, quiet,
                 choice.key);
    return pressed;
}

// The key that opened the dialog does not answer it.
bool pressed(int key) { return !ImGui::IsWindowAppearing() && ImGui::IsKeyPressed(key, false); }

std::string sizes(const glm::dvec3& v) { return digits(v.x) + " x " + digits(v.y) + " x " + digits(v.z); }

void draw_facts(const VolumeFacts& facts) {
    const Lengths lengths(facts.claims);
    widgets::fact("Size", std::to_string(facts.size.x) + " x " + std::to_string(facts.size.y) + " x " +
                              std::to_string(facts.size.z) + " voxels");
    widgets::fact("Spacing", sizes(facts.spacing_mm) + " " + lengths.unit());
    widgets::fact("Axes lead to", facts.orientation.empty() ? "not said" : facts.orientation);
    widgets::fact("File", facts.type);
}

// The choice of labels; nothing with a single label.
void draw_labels(VolumeDialog& dialog, float height) {
    const VolumeFacts& facts = *dialog.facts;
    const Lengths lengths(facts.claims);
    const bool several = facts.labels.size() > 1;
    ImGui::BeginChild("labels", {0.0F, height});
    if (ImGui::BeginTable("labels", 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY)) {
        ImGui::TableSetupScrollFreeze(0, 1);
        ImGui::TableSetupColumn("label", 0, 2.0F);
        ImGui::TableSetupColumn("volume", 0, 1.0F);
        ImGui::TableSetupColumn("voxels", 0, 1.0F);
        ImGui::TableNextRow(ImGuiTableRowFlags_Headers);
        ImGui::TableNextColumn();
        widgets::column_heading("Label", "The number and the name of the label");
        ImGui::TableNextColumn();
        widgets::column_heading("Volume", "The volume of its voxels", widgets::HeadingAt::kRight);
        ImGui::TableNextColumn();
        widgets::column_heading("Voxels", "How many voxels have it", widgets::HeadingAt::kRight);
        widgets::clipped(facts.labels.size(), [&](std::size_t i) {
            const LabelFacts& label = facts.labels[i];
            const std::string number = "Label " + std::to_string(label.label);
            const std::string name = number + (label.name.empty() ? "" : ", " + label.name);
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            bool taken = dialog.labels[i] != 0;
            if (several && ImGui::Checkbox(name.c_str(), &taken)) dialog.labels[i] = taken ? 1 : 0;
            if (!several) ImGui::TextUnformatted(name.c_str());
            widgets::note_item(number.c_str());
            ImGui::TableNextColumn();
            widgets::text_right(lengths.volume(label.volume_mm3));
            ImGui::TableNextColumn();
            widgets::quiet_right(grouped(label.voxels));
        });
        ImGui::EndTable();
    }
    ImGui::EndChild();
    ImGui::BeginDisabled(!several);
    ImGui::Checkbox("As a tree, the labels are one vessel system", &dialog.together);
    ImGui::EndDisabled();
    widgets::note_item("Labels together");
}

// A histogram of this many columns with logarithmic heights; values inside are highlighted.
void draw_histogram(const volume::ThresholdCurve& curve, std::size_t threshold, const ImVec2& size) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImGui::Dummy(size);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::size_t bins = curve.thresholds.size();
    const std::size_t columns = std::min(bins, static_cast<std::size_t>(size.x / (2.0F * theme::scale())));
    const auto first_of = [&](std::size_t column) { return column * bins / columns; };
    const auto voxels_of = [&](std::size_t column) {
        const std::size_t next = first_of(column + 1);
        return curve.voxels[first_of(column)] - (next < bins ? curve.voxels[next] : 0);
    };
    double most = 1.0;
    for (std::size_t c = 0; c < columns; ++c) most = std::max(most, std::log1p(static_cast<double>(voxels_of(c))));
    for (std::size_t c = 0; c < columns; ++c) {
        const float share = static_cast<float>(std::log1p(static_cast<double>(voxels_of(c))) / most);
        const float left = at.x + size.x * static_cast<float>(c) / static_cast<float>(columns);
        const float right = at.x + size.x * static_cast<float>(c + 1) / static_cast<float>(columns);
        list.AddRectFilled({left, at.y + size.y * (1.0F - share)}, {right, at.y + size.y},
                           ImGui::GetColorU32(first_of(c) >= threshold ? theme::kAccent : theme::kLine));
    }
    list.AddLine({at.x, at.y + size.y}, {at.x + size.x, at.y + size.y}, ImGui::GetColorU32(theme::kLine));
}

// The number of pieces in the subsampled volume, which approximates the true number.
std::string pieces_text(const volume::ThresholdCurve& curve, std::size_t threshold) {
    const std::string number = counted(curve.pieces[threshold], "piece", "pieces");
    return curve.step == 1 ? number : "about " + number;
}

// The threshold of a scan with its effect. Uses all remaining space.
void draw_threshold(VolumeDialog& dialog) {
    const VolumeFacts& facts = *dialog.facts;
    const volume::ThresholdCurve& curve = *facts.curve;
    const float below = ImGui::GetFrameHeightWithSpacing() + 3.0F * ImGui::GetTextLineHeightWithSpacing();
    const ImVec2 room = ImGui::GetContentRegionAvail();
    draw_histogram(curve, dialog.threshold, {room.x, room.y - below - ImGui::GetStyle().ItemSpacing.y});
    int place = static_cast<int>(dialog.threshold);
    const int last = static_cast<int>(curve.thresholds.size()) - 1;
    ImGui::SetNextItemWidth(room.x);
    ImGui::SliderInt("##threshold", &place, 0, last, "", ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_NoInput);
    widgets::note_item("Threshold");    // no tooltip over the values it changes
    constexpr int kFew = 1, kMany = 16; // of the curve's thresholds
    const int step = ImGui::GetIO().KeyShift ? kMany : kFew;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_LeftArrow))) place -= step;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_RightArrow))) place += step;
    dialog.threshold = static_cast<std::size_t>(std::clamp(place, 0, last));
    const std::uint64_t voxels = curve.voxels[dialog.threshold];
    widgets::fact("Threshold (arrows make it finer)", "at least " + rounded(curve.thresholds[dialog.threshold]));
    widgets::fact("Inside", grouped(voxels) + " voxels, " +
                                Lengths(facts.claims).volume(static_cast<double>(voxels) * facts.voxel_mm3) + ", " +
                                pieces_text(curve, dialog.threshold));
    widgets::quiet("A threshold is no segmentation: whatever is as bright is inside.");
}

// Equally high before and after the file is read, so that nothing moves under the pointer.
void draw_contents(InterfaceContext& context, VolumeDialog& dialog) {
    const float line = ImGui::GetTextLineHeightWithSpacing(), row = ImGui::GetFrameHeightWithSpacing();
    const bool low = static_cast<float>(context.layout.window.y) < 720.0F * theme::scale();
    const float labels = (low ? 3.0F : 5.0F) * row;
    ImGui::BeginChild("contents", {0.0F, 5.0F * line + labels + 2.0F * row + 8.0F * theme::scale()}, false,
                      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    if (!dialog.facts) {
        widgets::quiet("Reading what the file holds\xE2\x80\xA6");
        ImGui::ProgressBar(context.interface.of<VolumeDialog>().progress, {-1.0F, 6.0F * theme::scale()}, "");
    } else {
        widgets::quiet(words_for(*dialog.facts).c_str());
        draw_facts(*dialog.facts);
        if (dialog.facts->may_be_either()) {
            ImGui::Checkbox("Its values are greys, no labels", &dialog.scan);
            widgets::note_item("Values are greys");
        }
        if (dialog.scan && dialog.facts->curve) draw_threshold(dialog);
        if (!dialog.scan && !dialog.facts->labels.empty()) draw_labels(dialog, labels);
        for (const std::string& suspicion : dialog.facts->suspicions) widgets::trouble(window_words(suspicion).c_str());
    }
    ImGui::EndChild();
}

// In the order of As. The last two plan in a tree, and are left out for scans and without a tree.
std::vector<Choice> choices_for(const InterfaceContext& context, const VolumeDialog& dialog) {
    const Document& document = context.workspace.document();
    const bool tree = document.branch_count() > 0;
    const std::string shown = document.session().tree.path.filename().string(), why_not = dialog.why_not();
    const std::string place = tree ? "beside " + shown : std::string("alone in the picture");
    std::vector<Choice> choices{
        {As::kTree, "Open as a new tree", "T",
         "Centerlines and radii are made of it" + (tree ? ", in the place of " + shown : std::string()), why_not},
        {As::kContext, tree ? "Show beside the tree" : "Show as context", "B",
         tree ? "Smooth and clear, around " + shown : "Smooth and clear; a tree that is opened comes in among it",
         why_not},
        {As::kSurface, "Show as the surface it is", "S",
         (dialog.scan ? "Solid, where the scan reaches the threshold, " : "Solid, with every step of its voxels, ") +
             place,
         why_not},
        {As::kSlices, "Show in slices", "I",
         dialog.scan ? "Axial, coronal and sagittal, with the vessels drawn on them"
                     : "Its labels, as tints over a scan and the vessels",
         ""}};
    if (!tree || dialog.scan) return choices;
    choices.push_back({As::kOrgan, "Plan in it as the organ", "O", "What vessels supply, what cuts cost", why_not});
    choices.push_back({As::kLesions, "Take its parts as lesions", "L", "With volumes, margins, vessels near", why_not});
    return choices;
}

void move_choice(VolumeDialog& dialog, const std::vector<Choice>& choices, int step) {
    const auto count = static_cast<int>(choices.size());
    auto at = static_cast<int>(dialog.as);
    for (int tries = 0; tries < count; ++tries) {
        at = (at + step + count) % count;
        if (choices[static_cast<std::size_t>(at)].why_not.empty()) break;
    }
    dialog.as = static_cast<As>(at);
}

std::optional<As> chosen_by_key(const VolumeDialog& dialog, const std::vector<Choice>& choices) {
    // By their letters, which GLFW numbers as ASCII does.
    for (const Choice& choice : choices)
        if (pressed(choice.key[0])) return choice.as;
    if (pressed(ImGui::GetKeyIndex(ImGuiKey_Enter)) || pressed(ImGui::GetKeyIndex(ImGuiKey_KeyPadEnter)))
        return dialog.as;
    return {};
}

void carry_out(InterfaceContext& context, const VolumeDialog& dialog, As as) {
    const std::string file = dialog.file.string();
    if (as == As::kOrgan || as == As::kLesions) {
        std::vector<std::string> words = dialog.mask_words();
        words.insert(words.begin(), file);
        return context.perform(as == As::kOrgan ? "organ" : "lesion-mask", words);
    }
    if (as == As::kSlices) return context.perform("scan", {file, dialog.scan ? "--grey" : "--labels"});
    context.interface.settings.drop_beside = as != As::kTree;
    if (as == As::kTree) {
        std::vector<std::string> words = dialog.tree_words();
        words.insert(words.begin(), {file, "--tree"});
        return context.perform("open", words);
    }
    for (std::vector<std::string> words : dialog.context_words()) {
        words.insert(words.begin(), file);
        if (as == As::kSurface) words.insert(words.end(), {"--exact", "--opacity", "1"});
        context.perform("context", words);
    }
}

} // namespace

void draw_volume_dialog(InterfaceContext& context) {
    VolumeDialog& dialog = context.interface.of<VolumeDialog>();
    if (!dialog.open() || !context.interface.of<ErrorDialog>().errors.empty() ||
        context.interface.of<UnsavedDialog>().open())
        return;
    if (!widgets::begin_dialog("volume", 520.0F, 0.0F)) return;
    const float scale = theme::scale(), width = ImGui::GetContentRegionAvail().x;
    ImGui::PushFont(theme::title_font());
    const std::string title = widgets::fitted(dialog.file.filename().string(), width);
    ImGui::PopFont();
    widgets::heading(title.c_str());
    ImGui::Dummy({0.0F, 2.0F * scale});
    draw_contents(context, dialog);
    const auto choices = choices_for(context, dialog);
    const std::optional<As> by_key = chosen_by_key(dialog, choices);
    bool decided = by_key.has_value();
    As as = by_key.value_or(dialog.as);
    for (const Choice& choice : choices) {
        if (choice.as == As::kLesions) ImGui::SameLine(); // next to the organ, which takes half
        if (draw_choice(choice, dialog.as == choice.as, choice.as == As::kOrgan ? 0.5F : 1.0F))
            decided = true, as = choice.as;
    }
    decided = decided && static_cast<std::size_t>(as) < choices.size() &&
              choices[static_cast<std::size_t>(as)].why_not.empty();
    ImGui::Dummy({0.0F, 4.0F * scale});
    const float cancel_width = 90.0F * scale;
    widgets::align_right(cancel_width);
    const bool cancelled = ImGui::Button("Cancel", {cancel_width, 0.0F});
    widgets::tooltip("Nothing is opened", "Escape");
    if (pressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) move_choice(dialog, choices, -1);
    for (const ImGuiKey key : {ImGuiKey_DownArrow, ImGuiKey_Tab})
        if (pressed(ImGui::GetKeyIndex(key))) move_choice(dialog, choices, 1);
    if (decided || cancelled) {
        ImGui::CloseCurrentPopup();
        const VolumeDialog answered = std::exchange(dialog, {});
        if (decided) carry_out(context, answered, as);
    }
    widgets::end_dialog();
}

} // namespace ramus::app
