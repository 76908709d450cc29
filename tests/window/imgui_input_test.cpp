#include "app/window/imgui_input.h"

#include <GLFW/glfw3.h>
#include <doctest/doctest.h>

using namespace ramus::app;

TEST_CASE("a key keeps the modifiers that it was pressed with, whichever is let go first") {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    ImguiInput input;
    input.modifiers(false, false, false, false);
    input.key(GLFW_KEY_LEFT_CONTROL, true);
    input.modifiers(true, false, false, false);
    input.key(GLFW_KEY_A, true);
    input.modifiers(true, false, false, false);
    input.key(GLFW_KEY_LEFT_CONTROL, false);
    input.modifiers(false, false, false, false);
    input.key(GLFW_KEY_A, false);
    CHECK_FALSE(input.apply(io)); // some wait
    CHECK(io.KeysDown[GLFW_KEY_A]);
    CHECK(io.KeyCtrl);
    CHECK(input.apply(io));
    CHECK_FALSE(io.KeysDown[GLFW_KEY_A]);
    CHECK_FALSE(io.KeyCtrl);
    ImGui::DestroyContext();
}
