// How a command tells the window that has started it how far it is: lines on standard error.
#pragma once

namespace ramus::app {

inline constexpr const char* kProgressVariable = "RAMUS_PROGRESS"; // in the environment
inline constexpr const char* kProgressLines = "lines";             // its value
inline constexpr const char* kProgressLine = "progress ";          // then a fraction, a blank, and what

} // namespace ramus::app
