#include "core/io/volumes/dicom/dicom_elements.h"

#include "core/io/volumes/header_text.h"

#include <algorithm>
#include <array>

namespace ramus::io {

namespace {

// PS3.6, by number.
constexpr std::array<std::uint32_t, 42> kWanted = {
    0x00080008, 0x00080016, 0x00080060, 0x0008103e, 0x00180050, 0x00180088, 0x00189361, 0x0020000d, 0x0020000e,
    0x00200011, 0x00200032, 0x00200037, 0x00209113, 0x00209116, 0x00280002, 0x00280004, 0x00280008, 0x00280010,
    0x00280011, 0x00280030, 0x00280100, 0x00280101, 0x00280102, 0x00280103, 0x00281050, 0x00281051, 0x00281052,
    0x00281053, 0x00281054, 0x00289110, 0x00289132, 0x00289145, 0x00620001, 0x00620002, 0x00620004, 0x00620005,
    0x0062000a, 0x0062000b, 0x0062000d, 0x0062000e, 0x52009229, 0x52009230};
static_assert(std::ranges::is_sorted(kWanted));

} // namespace

bool DicomSet::wants(std::uint32_t tag) { return std::ranges::binary_search(kWanted, tag); }

// Linear: a set holds a few of the elements that are wanted, each once.
static auto find_tag(auto& pairs, std::uint32_t tag) {
    return std::ranges::find_if(pairs, [&](const auto& each) { return each.first == tag; });
}

void DicomSet::put(std::uint32_t tag, std::string_view value) {
    if (find_tag(values_, tag) == values_.end()) values_.emplace_back(tag, value);
}

std::vector<DicomSet>& DicomSet::sequence(std::uint32_t tag) {
    const auto known = find_tag(sequences_, tag);
    return known != sequences_.end() ? known->second : sequences_.emplace_back(tag, std::vector<DicomSet>()).second;
}

std::string_view DicomSet::value_of(std::uint32_t tag) const {
    const auto found = find_tag(values_, tag);
    return found == values_.end() ? std::string_view() : found->second;
}

std::string DicomSet::text(std::uint32_t tag) const {
    const std::string_view value = value_of(tag);
    return std::string(trimmed(value.substr(0, value.find('\0'))));
}

std::vector<double> DicomSet::decimals(std::uint32_t tag) const {
    std::string numbers = text(tag);
    std::ranges::replace(numbers, '\\', ' ');
    return numbers_in(numbers).value_or(std::vector<double>());
}

std::optional<int> DicomSet::number(std::uint32_t tag, std::size_t place) const {
    const std::string_view value = value_of(tag);
    if (value.size() < 2 * place + 2) return std::nullopt;
    const auto first = static_cast<std::uint8_t>(value[2 * place]),
               second = static_cast<std::uint8_t>(value[2 * place + 1]);
    return big_endian_ ? first * 256 + second : second * 256 + first;
}

const std::vector<DicomSet>& DicomSet::items(std::uint32_t tag) const {
    static const std::vector<DicomSet> none;
    const auto found = find_tag(sequences_, tag);
    return found == sequences_.end() ? none : found->second;
}

} // namespace ramus::io
