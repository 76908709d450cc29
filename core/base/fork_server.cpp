#include "core/base/fork_server.h"

#include "core/base/descriptor.h"
#include "core/base/process_answer.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <type_traits>
#include <unistd.h>

namespace ramus {

namespace {

std::atomic<int> server_socket{-1}; // this process's end; the server ends when no process holds it open

// A request to the server. It comes with the socket that carries the input and the answer. The address of the function
// is valid in both processes, because one is a fork of the other.
struct Request {
    OwnWork work = nullptr;
    ProcessLimits limits;
    std::uint64_t input = 0; // bytes
};
static_assert(std::is_trivially_copyable_v<Request>);

// A message of one request and one descriptor.
class Message {
public:
    explicit Message(Request& request) : part_{&request, sizeof(request)} {
        header_.msg_iov = &part_;
        header_.msg_iovlen = 1;
        header_.msg_control = space_.data();
        header_.msg_controllen = space_.size();
    }
    Message(const Message&) = delete;
    Message& operator=(const Message&) = delete;

    [[nodiscard]] bool send(int to, int descriptor) {
        cmsghdr* with = CMSG_FIRSTHDR(&header_);
        with->cmsg_level = SOL_SOCKET;
        with->cmsg_type = SCM_RIGHTS;
        with->cmsg_len = CMSG_LEN(sizeof(int));
        std::memcpy(CMSG_DATA(with), &descriptor, sizeof(int));
        ssize_t sent = -1;
        do sent = ::sendmsg(to, &header_, MSG_NOSIGNAL);
        while (sent < 0 && errno == EINTR);
        return sent == static_cast<ssize_t>(sizeof(Request));
    }

    // The descriptor that came with it; -1: there will be no more requests.
    [[nodiscard]] int receive(int from) {
        ssize_t received = -1;
        do received = ::recvmsg(from, &header_, MSG_CMSG_CLOEXEC);
        while (received < 0 && errno == EINTR);
        const cmsghdr* with = CMSG_FIRSTHDR(&header_);
        if (received != static_cast<ssize_t>(sizeof(Request)) || with == nullptr || with->cmsg_type != SCM_RIGHTS)
            return -1;
        int descriptor = -1;
        std::memcpy(&descriptor, CMSG_DATA(with), sizeof(int));
        return descriptor;
    }

private:
    iovec part_;
    msghdr header_{};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> space_{};
};

std::string receive_all(int from, std::uint64_t bytes) {
    std::string input(bytes, '\0');
    std::size_t at = 0;
    while (at < input.size()) {
        const ssize_t count = ::read(from, input.data() + at, input.size() - at);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) std::_Exit(EXIT_FAILURE); // the requesting process is gone
        at += static_cast<std::size_t>(count);
    }
    return input;
}

[[noreturn]] void answer(const Request& request, int socket, pid_t server) {
    try {
        const std::string input = receive_all(socket, request.input);
        work_and_end(request.work, input, request.limits, socket, server);
    } catch (const std::exception&) { // out of memory
        std::_Exit(EXIT_FAILURE);
    }
}

// Closes all descriptors of the parent first: a program that reads the parent's output must see its end.
[[noreturn]] void serve(int socket) {
    constexpr int kSocket = 3;
    ::prctl(PR_SET_NAME, "ramus-readers");
    for (const int number : {SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGCHLD}) std::signal(number, SIG_IGN);
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    if (socket != kSocket) ::dup2(socket, kSocket);
    ::close_range(kSocket + 1, ~0U, 0);
    const pid_t self = ::getpid();
    while (true) {
        Request request;
        const int asked = Message(request).receive(kSocket);
        if (asked < 0) std::_Exit(EXIT_SUCCESS);
        if (::fork() == 0) {
            ::close(kSocket);
            answer(request, asked, self);
        }
        ::close(asked); // if fork() failed, the requesting process sees an incomplete answer
    }
}

} // namespace

void start_fork_server() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return;
    const pid_t server = ::fork();
    if (server == 0) serve(ends[1]);
    ::close(ends[1]);
    if (server < 0)
        ::close(ends[0]);
    else
        server_socket = ends[0];
}

std::optional<Result<std::string>> run_at_fork_server(OwnWork work, std::string_view input,
                                                      const ProcessLimits& limits) {
    const int server = server_socket;
    std::array<int, 2> ends{};
    if (server < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return std::nullopt;
    const Descriptor own(ends[0]);
    Descriptor other(ends[1]);
    Request request{work, limits, input.size()};
    if (!Message(request).send(server, other.number())) return std::nullopt;
    other.close();
    (void)send_all(own.number(), input); // if this fails, the answer is incomplete too
    return read_answer(own.number(), limits);
}

} // namespace ramus
