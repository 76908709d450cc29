#include "core/base/instruction_sets.h"

#include "core/base/words.h"

#include <cstdint>
#include <hwy/targets.h>

namespace ramus {

std::vector<std::string> instruction_sets() {
    std::vector<std::string> names;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) names.emplace_back(hwy::TargetName(target));
    return names;
}

Result<void> limit_instructions(const std::string& name) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        if (name != hwy::TargetName(target)) continue;
        hwy::DisableTargets(target - 1); // a better one has a lower bit
        return {};
    }
    return fail(name + " is not an instruction set of this processor and this program", kInstructionsVariable,
                "it has " + joined(instruction_sets()));
}

} // namespace ramus
