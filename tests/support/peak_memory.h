// How much more memory this process has had since a moment, for tests that give it files which lie about their size.
#pragma once

#include <fstream>
#include <string>

namespace ramus::test {

class PeakMemory {
public:
    PeakMemory() {
        std::ofstream("/proc/self/clear_refs") << "5"; // forget the highest so far
        start_ = value("VmRSS:");
    }
    [[nodiscard]] double grown_mib() const { return (value("VmHWM:") - start_) / 1024.0; }

private:
    static double value(const std::string& name) {
        std::ifstream status("/proc/self/status");
        for (std::string word; status >> word;)
            if (double kib = 0.0; word == name && status >> kib) return kib;
        return 0.0;
    }

    double start_ = 0.0;
};

} // namespace ramus::test
