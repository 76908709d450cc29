// A Team of the processes of an MPI job.
#pragma once

#include "core/base/team.h"

namespace ramus::app {

class MpiTeam final : public Team {
public:
    // Starts MPI. Must be the first call of a process, and its last call must be finish() or abort(). Functions of MPI
    // are called by one thread at a time, not always the same.
    MpiTeam(int& argc, char**& argv);

    [[nodiscard]] std::size_t size() const override { return size_; }
    [[nodiscard]] std::size_t rank() const override { return rank_; }
    [[nodiscard]] std::vector<std::vector<std::byte>> tell_all(std::span<const std::byte> said) override;
    void send(std::span<const std::byte> bytes) override;
    void receive(std::size_t from, std::span<std::byte> bytes) override;

    void finish();                     // waits for all processes
    [[noreturn]] void abort(int code); // ends all processes

private:
    void meet() const;

    std::size_t size_ = 1, rank_ = 0;
};

} // namespace ramus::app
