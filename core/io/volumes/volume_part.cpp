#include "core/io/volumes/volume_part.h"

#include "core/base/printable.h"

#include <algorithm>

namespace ramus::io {

namespace {

std::string named_channel(const VolumeParts& parts, std::uint64_t channel) {
    const std::string number = std::to_string(channel + 1);
    const bool named = channel < parts.channel_names.size() && !parts.channel_names[channel].empty();
    return named ? number + " (" + printable(parts.channel_names[channel]) + ")" : number;
}

std::string listed_channels(const VolumeParts& parts) {
    constexpr std::uint64_t kMost = 20;
    std::string list;
    for (std::uint64_t n = 0; n < std::min(parts.channels, kMost); ++n)
        list += (n == 0 ? "" : ", ") + named_channel(parts, n);
    return list + (parts.channels > kMost ? ", ..." : "");
}

Result<std::uint64_t> chosen(const char* option, const std::string& there, std::uint64_t count,
                             const std::optional<int>& asked, const std::string& name) {
    const std::string hint = std::string("choose one of them with ") + option + " N";
    if (!asked && count > 1) return fail("it holds " + there, name, hint);
    if (asked && (*asked < 1 || static_cast<std::uint64_t>(*asked) > count))
        return fail("it has no " + std::string(option).substr(2) + " " + std::to_string(*asked) + ", it holds " + there,
                    name, count > 1 ? hint : std::string("leave out ") + option);
    return static_cast<std::uint64_t>(asked.value_or(1) - 1);
}

std::string count_text(std::uint64_t count, const std::string& noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

} // namespace

Result<ChosenPart> chosen_part(const VolumeParts& parts, const VolumePart& asked, const std::string& name) {
    const std::string channels =
        count_text(parts.channels, "channel") + (parts.channels > 1 ? ": " + listed_channels(parts) : "");
    RAMUS_TRY(channel, chosen("--channel", channels, parts.channels, asked.channel, name));
    RAMUS_TRY(time, chosen("--time", count_text(parts.times, "time point"), parts.times, asked.time, name));
    ChosenPart part{channel, time, {}};
    if (parts.channels > 1) part.words = "channel " + named_channel(parts, channel);
    if (parts.times > 1)
        part.words += (part.words.empty() ? "time point " : ", time point ") + std::to_string(time + 1);
    return part;
}

} // namespace ramus::io
