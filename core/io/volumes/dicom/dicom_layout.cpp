#include "core/io/volumes/dicom/dicom_layout.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <vector>

namespace ramus::io {

namespace {

constexpr std::uint64_t kPreamble = 128, kMark = 4;
constexpr std::uint64_t kMostHeader = std::uint64_t{1} << 28; // bytes; useful headers are shorter
constexpr std::uint32_t kUndefined = 0xffffffff;
constexpr std::uint32_t kItem = 0xfffee000, kItemEnd = 0xfffee00d, kSequenceEnd = 0xfffee0dd;
constexpr std::uint32_t kTransferSyntax = 0x00020010, kPixelData = 0x7fe00010;
constexpr std::uint32_t kFloatPixels = 0x7fe00008, kDoublePixels = 0x7fe00009;
constexpr std::string_view kImplicit = "1.2.840.10008.1.2", kDeflated = "1.2.840.10008.1.2.1.99",
                           kExplicit = "1.2.840.10008.1.2.1";

struct Element {
    std::uint32_t tag = 0, length = 0;
    std::array<char, 2> vr{}; // zeros: implicit
    std::uint64_t value = 0;  // offset of its first byte
};

struct Order {
    bool implicit = false, big = false;
};

// Random access to a stream with a buffer, because elements are close together.
class Window {
public:
    Window(std::istream& stream, std::uint64_t size) : stream_(stream), size_(size) {}
    [[nodiscard]] std::uint64_t size() const { return size_; }

    // None: there are fewer bytes.
    std::optional<std::string_view> at(std::uint64_t place, std::size_t bytes) {
        if (place > size_ || bytes > size_ - place) return std::nullopt;
        if (place < begin_ || place + bytes > begin_ + kept_.size()) {
            kept_.resize(std::min<std::uint64_t>(std::max<std::size_t>(bytes, kAtOnce), size_ - place));
            stream_.clear();
            stream_.seekg(static_cast<std::streamoff>(place));
            stream_.read(kept_.data(), static_cast<std::streamsize>(kept_.size()));
            begin_ = place;
            if (static_cast<std::size_t>(stream_.gcount()) < kept_.size()) {
                kept_.clear();
                return std::nullopt;
            }
        }
        return std::string_view(kept_).substr(place - begin_, bytes);
    }

private:
    static constexpr std::size_t kAtOnce = 4096;
    std::istream& stream_;
    std::uint64_t size_, begin_ = 0;
    std::string kept_;
};

std::uint32_t number(std::string_view bytes, bool big) {
    std::uint32_t value = 0;
    for (std::size_t n = 0; n < bytes.size(); ++n)
        value = value << 8 | static_cast<std::uint8_t>(bytes[big ? n : bytes.size() - 1 - n]);
    return value;
}

bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

// Value representations with a length of four bytes, after two reserved bytes.
bool has_long_length(const std::array<char, 2>& vr) {
    constexpr std::array<std::string_view, 13> kLong = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                        "SV", "UC", "UN", "UR", "UT", "UV"};
    return std::ranges::find(kLong, std::string_view(vr.data(), vr.size())) != kLong.end();
}

bool is_known(const std::array<char, 2>& vr) {
    constexpr std::array<std::string_view, 21> kShort = {"AE", "AS", "AT", "CS", "DA", "DS", "DT",
                                                         "FL", "FD", "IS", "LO", "LT", "PN", "SH",
                                                         "SL", "SS", "ST", "TM", "UI", "UL", "US"};
    return has_long_length(vr) || std::ranges::find(kShort, std::string_view(vr.data(), vr.size())) != kShort.end();
}

// The element at `place`. None: the file ends before, or there is no element.
std::optional<Element> element_at(Window& file, std::uint64_t place, const Order& order) {
    const auto start = file.at(place, 8);
    if (!start) return std::nullopt;
    Element element;
    element.tag = number(start->substr(0, 2), order.big) << 16 | number(start->substr(2, 2), order.big);
    if (order.implicit || element.tag >> 16 == 0xfffe) {
        element.length = number(start->substr(4, 4), order.big);
        element.value = place + 8;
        return element;
    }
    element.vr = {(*start)[4], (*start)[5]};
    if (!is_known(element.vr)) return std::nullopt;
    if (!has_long_length(element.vr)) {
        element.length = number(start->substr(6, 2), order.big);
        element.value = place + 8;
        return element;
    }
    const auto length = file.at(place + 8, 4);
    if (!length) return std::nullopt;
    element.length = number(*length, order.big);
    element.value = place + 12;
    return element;
}

// An open sequence or item: its end, the encoding of the enclosing element, and the set that keeps its content (null:
// it is not kept).
struct Level {
    std::uint64_t end; // kOpen: at its delimiter
    Order outside;
    std::vector<DicomSet>* sequence = nullptr;
    DicomSet* item = nullptr;
};
constexpr std::uint64_t kOpen = std::numeric_limits<std::uint64_t>::max();

class Walk {
public:
    Walk(Window& file, std::string name) : file_(file), name_(std::move(name)) {}

    Result<DicomLayout> run() {
        if (auto begun = begin(); !begun) return tl::unexpected(begun.error());
        layout_.elements = DicomSet(order_.big);
        while (true) {
            close_levels();
            if (at_ == file_.size() && levels_.empty()) break;
            const auto element = element_at(file_, at_, order_);
            if (!element) return cut_short();
            if (at_ > kMostHeader) return fail("its header has more than 256 MB", name_, "export it again");
            if (levels_.empty() && is_pixels(element->tag)) {
                if (auto found = take_pixels(*element); !found) return tl::unexpected(found.error());
                return layout_;
            }
            if (auto past = pass(*element); !past) return tl::unexpected(past.error());
        }
        return layout_;
    }

private:
    [[nodiscard]] tl::unexpected<Error> damaged() const {
        return fail("the file is damaged: an element of its header makes no sense, at byte " + std::to_string(at_),
                    name_, "copy or export it again");
    }
    [[nodiscard]] tl::unexpected<Error> cut_short() const {
        const auto rest = file_.size() - std::min(at_, file_.size());
        if (rest >= 12) return damaged();
        return fail("the file ends before all that its header promises", name_, "copy or export it again");
    }
    [[nodiscard]] std::uint64_t innermost_end() const {
        std::uint64_t end = file_.size();
        for (const Level& level : levels_) end = std::min(end, level.end);
        return end;
    }
    static bool is_pixels(std::uint32_t tag) {
        return tag == kPixelData || tag == kFloatPixels || tag == kDoublePixels;
    }

    // The file meta information, which states the encoding of all other elements.
    Result<void> begin() {
        const auto mark = file_.at(kPreamble, kMark);
        at_ = mark && *mark == "DICM" ? kPreamble + kMark : 0;
        while (true) {
            const auto start = file_.at(at_, 2);
            if (!start || number(*start, false) != 2) break;
            const auto element = element_at(file_, at_, {});
            if (!element || element->length > file_.size() - element->value) return cut_short();
            if (element->tag == kTransferSyntax && element->length <= 64) {
                layout_.transfer_syntax = *file_.at(element->value, element->length);
                while (!layout_.transfer_syntax.empty() && layout_.transfer_syntax.back() <= ' ')
                    layout_.transfer_syntax.pop_back();
            }
            at_ = element->value + element->length;
        }
        if (layout_.transfer_syntax.empty()) { // not stated: one of two is possible
            const auto start = file_.at(at_, 6);
            layout_.transfer_syntax =
                start && is_capital((*start)[4]) && is_capital((*start)[5]) ? kExplicit : kImplicit;
        }
        if (layout_.transfer_syntax == kDeflated)
            return fail("its data set is compressed as a whole (deflated)", name_,
                        "export it in another transfer syntax, for example explicit little endian");
        order_ = {layout_.transfer_syntax == kImplicit, layout_.transfer_syntax == kDicomBigEndian};
        return {};
    }

    void close_levels() {
        while (!levels_.empty() && levels_.back().end == at_) close();
    }
    void close() {
        order_ = levels_.back().outside;
        levels_.pop_back();
    }

    Result<void> open(const Element& element, Order inside) {
        constexpr std::size_t kDeepest = 64;
        if (levels_.size() >= kDeepest) return damaged();
        Level level{element.length == kUndefined ? kOpen : element.value + element.length, order_};
        if (element.tag == kItem) {
            constexpr std::size_t kMostItems = std::size_t{1} << 20; // limits memory; an image has a few for each frame
            std::vector<DicomSet>* sequence = levels_.empty() ? nullptr : levels_.back().sequence;
            if (sequence != nullptr && ++items_ > kMostItems)
                return fail("its header has more than a million items", name_, "export it again");
            if (sequence != nullptr) level.item = &sequence->emplace_back(inside.big);
        } else if (DicomSet* set = innermost(); set != nullptr && DicomSet::wants(element.tag)) {
            level.sequence = &set->sequence(element.tag);
        }
        levels_.push_back(level);
        order_ = inside;
        at_ = element.value;
        return {};
    }

    // One element, or the beginning or end of a sequence or item.
    Result<void> pass(const Element& element) {
        if (element.tag == kItemEnd || element.tag == kSequenceEnd) {
            if (levels_.empty() || levels_.back().end != kOpen) return damaged();
            close();
            at_ = element.value;
            return {};
        }
        const bool undefined = element.length == kUndefined;
        if (!undefined && (element.value > innermost_end() || element.length > innermost_end() - element.value)) {
            if (element.length > file_.size() - std::min(element.value, file_.size()))
                return fail("the file ends before all that its header promises", name_, "copy or export it again");
            return damaged();
        }
        const bool unknown = element.vr[0] == 'U' && element.vr[1] == 'N';
        if (element.tag == kItem || (element.vr[0] == 'S' && element.vr[1] == 'Q')) return open(element, order_);
        if (undefined) return open(element, {order_.implicit || unknown, order_.big && !unknown});
        // Without a value representation, an item at its beginning shows that it is a sequence.
        if ((order_.implicit || unknown) && element.length >= 8) {
            const auto start = file_.at(element.value, 4);
            if (start && number(start->substr(0, 2), order_.big) == 0xfffe &&
                number(start->substr(2, 2), order_.big) == 0xe000)
                return open(element, {true, order_.big});
        }
        keep(element);
        at_ = element.value + element.length;
        return {};
    }

    [[nodiscard]] DicomSet* innermost() { return levels_.empty() ? &layout_.elements : levels_.back().item; }

    // Keeps only values of useful length: texts and numbers are short.
    void keep(const Element& element) {
        constexpr std::uint32_t kLongest = 1024;
        DicomSet* set = innermost();
        if (set == nullptr || element.length > kLongest || !DicomSet::wants(element.tag)) return;
        if (const auto value = file_.at(element.value, element.length)) set->put(element.tag, *value);
    }

    Result<void> take_pixels(const Element& element) {
        if (element.tag != kPixelData)
            return fail("its pixels are fractions (float pixel data)", name_, "convert it to NIfTI");
        layout_.has_pixels = true;
        layout_.pixel_begin = element.value;
        layout_.encapsulated = element.length == kUndefined;
        if (!layout_.encapsulated) {
            layout_.pixel_bytes = element.length;
            if (element.length > file_.size() - element.value)
                return fail("the file ends before all that its header promises", name_, "copy or export it again");
            return {};
        }
        // An offset table, which may be empty, and fragments.
        for (at_ = element.value;;) {
            const auto fragment = element_at(file_, at_, {true, false});
            if (!fragment) return cut_short();
            if (fragment->tag == kSequenceEnd) return {};
            if (fragment->tag != kItem) return damaged();
            if (fragment->length > file_.size() - fragment->value)
                return fail("the file ends before all that its header promises", name_, "copy or export it again");
            layout_.pixel_bytes += fragment->length;
            at_ = fragment->value + fragment->length;
        }
    }

    Window& file_;
    std::string name_;
    DicomLayout layout_;
    Order order_;
    std::uint64_t at_ = 0;
    std::vector<Level> levels_;
    std::size_t items_ = 0;
};

} // namespace

bool is_dicom(std::string_view head) {
    if (head.size() >= kPreamble + kMark && head.substr(kPreamble, kMark) == "DICM") return true;
    // A file without the magic number begins with group 8: its length, the character set, or the image type.
    return head.size() > 16 && head[0] == 8 && head[1] == 0 && head[3] == 0 &&
           (head[2] == 0 || head[2] == 1 || head[2] == 5 || head[2] == 8 || head[2] == 0x16) &&
           ((is_capital(head[4]) && is_capital(head[5])) || (head[6] == 0 && head[7] == 0));
}

Result<DicomLayout> dicom_layout(const StoredBytes& file) {
    RAMUS_TRY(size, file.size());
    RAMUS_TRY(stream, file.open());
    Window window(*stream, size);
    return Walk(window, file.name).run();
}

} // namespace ramus::io
