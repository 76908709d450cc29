// Team: processes that do one piece of work together, each on a machine of its own or not. Every function must be
// called by all of them, in the same order; receive() and send() in pairs. Implemented over MPI (app/mpi), and by
// threads in tests. If a process ends, its team ends with it.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace ramus {

class Team {
public:
    Team() = default;
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
    virtual ~Team() = default;

    [[nodiscard]] virtual std::size_t size() const = 0;
    [[nodiscard]] virtual std::size_t rank() const = 0; // of this process, below size()
    [[nodiscard]] bool leads() const { return rank() == 0; }

    // What every process says, by rank.
    [[nodiscard]] virtual std::vector<std::vector<std::byte>> tell_all(std::span<const std::byte> said) = 0;
    // From a process to the leader; `bytes` have the size that was sent.
    virtual void send(std::span<const std::byte> bytes) = 0;
    virtual void receive(std::size_t from, std::span<std::byte> bytes) = 0;
};

// The same for lists of plain values: those of all processes, one list behind the other by rank.
template <class T> [[nodiscard]] std::vector<std::vector<T>> lists_of_all(Team& team, std::span<const T> own) {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<std::vector<T>> lists;
    for (const std::vector<std::byte>& bytes : team.tell_all(std::as_bytes(own))) {
        std::vector<T>& list = lists.emplace_back(bytes.size() / sizeof(T));
        if (!bytes.empty()) std::memcpy(list.data(), bytes.data(), bytes.size());
    }
    return lists;
}

} // namespace ramus
