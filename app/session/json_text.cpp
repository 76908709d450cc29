#include "app/session/json_text.h"

#include <nlohmann/json.hpp>

namespace ramus::app {

Result<std::string> json_text(const nlohmann::json& value, const std::string& where) {
    try {
        return value.dump(1) + "\n";
    } catch (const nlohmann::json::type_error&) {
        return fail("a name in it is not UTF-8 text, so it cannot be written", where,
                    "rename files, folders and branches whose names are in another encoding");
    }
}

} // namespace ramus::app
