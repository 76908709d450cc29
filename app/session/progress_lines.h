// The protocol by which a command reports its progress to the window that started it: lines on standard error.
#pragma once

namespace ramus::app {

inline constexpr const char* kProgressVariable = "RAMUS_PROGRESS"; // environment variable
inline constexpr const char* kProgressLines = "lines";             // its value
inline constexpr const char* kProgressLine = "progress ";          // followed by a fraction, a blank, and the activity

} // namespace ramus::app
