// VolumePart: which volume of a file a person chooses, where a file holds several: channels (stains) and time points of
// a microscope. core/io/volumes/spatial_claims.h has what such a file states about space.
#pragma once

#include "core/base/error.h"

#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ramus::io {

struct VolumePart {
    std::optional<int> channel, time;                    // numbered from 1; none: the only one
    auto operator<=>(const VolumePart&) const = default; // NOLINT(modernize-use-nullptr): the rule mistakes it
};

// The volumes that a file holds.
struct VolumeParts {
    std::uint64_t channels = 1, times = 1;
    std::vector<std::string> channel_names; // those that the file names; may be shorter than `channels`
};

struct ChosenPart {
    std::uint64_t channel = 0, time = 0; // numbered from 0
    std::string words;                   // for Volume::type: "channel 2 (CD31)"; empty: there is only one
};

// The choice of a person among the volumes of a file. Fails, listing what is there, if there are several channels or
// times and none is chosen, and if the chosen one is not there.
[[nodiscard]] Result<ChosenPart> chosen_part(const VolumeParts& parts, const VolumePart& asked,
                                             const std::string& name);

} // namespace ramus::io
