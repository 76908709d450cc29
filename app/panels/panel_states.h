// What panels and dialogs remember between frames: one value of each type, which the panel's own header declares. A
// new panel is its own file and a row of parts.h or sections.h.
#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace ramus::app {

class PanelStates {
public:
    // The value of that type; default-constructed when it is first asked for.
    template <class T> [[nodiscard]] T& of() const {
        std::shared_ptr<void>& state = states_[typeid(T)];
        if (!state) state = std::make_shared<T>();
        return *static_cast<T*>(state.get());
    }

private:
    mutable std::unordered_map<std::type_index, std::shared_ptr<void>> states_;
};

} // namespace ramus::app
