// How much memory may be used, and how much of it this process has. In bytes.
#pragma once

namespace ramus {

[[nodiscard]] double memory_limit(double asked); // what is asked for, or half of the machine's when that is 0
[[nodiscard]] double process_memory(); // in use now, without kept pages (pages.h); 0 where the system does not tell

} // namespace ramus
