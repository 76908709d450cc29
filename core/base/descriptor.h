// Owns file descriptors, opens files without a name, and writes whole texts to files and sockets.
#pragma once

#include <filesystem>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace ramus {

// Closes its descriptor when it goes out of scope. A negative number is no descriptor.
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

// Opens a new file without a name in `folder`, readable and writable by this user only. Nothing is left of it once the
// process ends. Returns -1 on failure, with errno set.
[[nodiscard]] int open_without_name(const std::filesystem::path& folder);

// Writes all bytes. False: not all of them could be written; errno says why.
[[nodiscard]] bool write_all(int descriptor, std::string_view bytes);

// Sends all bytes, and waits as long as the socket does not take them. False: the other end is closed, or `socket` is
// no socket. Raises no SIGPIPE.
[[nodiscard]] bool send_all(int socket, std::string_view bytes);

} // namespace ramus
