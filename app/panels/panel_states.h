// What panels and dialogs remember between frames: one value of each type, which the panel's own header declares. A
// new panel is its own file and a row of parts.h or sections.h.
#pragma once

#include <memory>
#include <typeindex>
#include <unordered_map>

namespace ramus::app {

class PanelStates {
public:
    // The value of that type; default-constructed on first use.
    template <class T> [[nodiscard]] T& of() { return state<T>(); }
    template <class T> [[nodiscard]] const T& of() const { return state<T>(); }

private:
    template <class T> T& state() const {
        std::shared_ptr<void>& value = states_[typeid(T)];
        if (!value) value = std::make_shared<T>();
        return *static_cast<T*>(value.get());
    }

    mutable std::unordered_map<std::type_index, std::shared_ptr<void>> states_;
};

} // namespace ramus::app
