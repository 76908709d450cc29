#include "core/organ/roles.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace ramus::organ {

std::vector<Role> roles_by_name(std::span<const tree::System> systems) {
    constexpr std::array<std::string_view, 4> kVein{"vein", "vena", "venous", "drain"};
    std::vector<Role> roles;
    for (const tree::System& system : systems) {
        std::string name = system.name;
        std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        const auto has = [&](std::string_view word) { return name.find(word) != std::string::npos; };
        roles.push_back(std::ranges::any_of(kVein, has) && !has("port") ? Role::kDrains : Role::kSupplies);
    }
    if (roles.empty()) roles.push_back(Role::kSupplies);
    return roles;
}

} // namespace ramus::organ
