// WindowParts: lets commands show and hide parts of the window, and use the clipboard.
#pragma once

#include "app/panels/written_notice.h"
#include "app/window/viewer_state.h"

namespace ramus::app {

class WindowParts final : public WindowHost, public Clipboard {
public:
    explicit WindowParts(ViewerState& state) : state_(state) {}

    void toggle(std::string_view part) override;
    [[nodiscard]] bool shows(std::string_view part) const override;
    void set_overview(std::string_view setting) override;
    void open_flight(int branch) override;
    void close_flight() override;
    void ask_for_name(int branch) override;
    void ask_for_object_name(const std::string& kind, const std::string& number, const std::string& now) override;
    void ask_for_view_name(const std::string& now) override;
    void ask_for_radius() override;
    void show_note(int note) override;
    void show_contact(int contact) override;
    void wrote(const std::filesystem::path& file, const std::string& sentence) override;
    [[nodiscard]] std::filesystem::path written() const override { return state_.interface.of<Written>().file; }
    void read_warnings() override;
    void show_finding(int finding) override;
    bool dismiss() override;
    void set_ui_scale(double pixels_per_point) override;
    [[nodiscard]] double ui_scale() const override { return state_.scale; }
    void set_light_theme(bool light) override;
    [[nodiscard]] bool light_theme() const override { return state_.interface.settings.light_theme; }
    void set_ground(Ground ground) override;
    [[nodiscard]] Ground ground() const override { return state_.interface.settings.ground; }

    void copy_text(const std::string& text) override;
    [[nodiscard]] Result<std::string> pasted_text() const override;

private:
    void show_contacts(bool open);
    void open_page(std::string_view name);
    void show_units_panel(bool open);
    void show_validation(bool open);

    ViewerState& state_;
};

} // namespace ramus::app
