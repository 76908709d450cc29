// How much memory there is, and how much of it this process has. In bytes.
#pragma once

namespace ramus {

[[nodiscard]] double machine_memory();
[[nodiscard]] double process_memory(); // in use now, not at the peak; 0 where the system does not tell

} // namespace ramus
