// Descriptors of the operating system: one that is closed with its owner, files without a name, and all of a text at
// once.
#pragma once

#include <filesystem>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace ramus {

class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { close(); }
    void close() {
        if (number_ >= 0) ::close(std::exchange(number_, -1));
    }
    void reset(int number) {
        close();
        number_ = number;
    }
    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

// A file without a name in a folder, for reading and writing by this user: however the process ends, nothing is left of
// it. -1: errno says why.
[[nodiscard]] int open_without_name(const std::filesystem::path& folder);

// False: not all of it could be written; errno says why.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes);

// Waits until the socket has taken all. False: its other end is closed, or it is none; no signal is raised then.
[[nodiscard]] bool send_all(int socket, std::string_view bytes);

} // namespace ramus
