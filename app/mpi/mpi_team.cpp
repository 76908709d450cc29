#include "app/mpi/mpi_team.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mpi.h>
#include <thread>

namespace ramus::app {

namespace {

// Counts of MPI are int.
constexpr std::size_t kMostInMessage = std::size_t{1} << 30;

// Calls call(first, count) for pieces that fit into a message.
template <class Call> void in_messages(std::size_t size, const Call& call) {
    for (std::size_t first = 0; first < size; first += kMostInMessage)
        call(first, static_cast<int>(std::min(kMostInMessage, size - first)));
}

// Functions of MPI that wait keep a core busy, which processes that still compute may need. So processes meet by
// messages without content, for which they wait asleep, before they transfer anything.
constexpr int kMeet = 1; // tag of these; messages with content have 0

void call_to(int rank) { MPI_Send(nullptr, 0, MPI_BYTE, rank, kMeet, MPI_COMM_WORLD); }

void wait_for_call(int rank) {
    constexpr int kBusy = 1000; // looks before it sleeps: the call may come within a fraction of a millisecond
    constexpr std::chrono::microseconds kAsleep(500);
    int there = 0;
    for (int looks = 0; MPI_Iprobe(rank, kMeet, MPI_COMM_WORLD, &there, MPI_STATUS_IGNORE), there == 0; ++looks)
        if (looks >= kBusy) std::this_thread::sleep_for(kAsleep);
    MPI_Recv(nullptr, 0, MPI_BYTE, rank, kMeet, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

} // namespace

MpiTeam::MpiTeam(int& argc, char**& argv) {
    int provided = 0;
    MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
    int size = 1, rank = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    size_ = static_cast<std::size_t>(size);
    rank_ = static_cast<std::size_t>(rank);
}

// The leader waits for all, then all go on.
void MpiTeam::meet() const {
    if (!leads()) {
        call_to(0);
        wait_for_call(0);
        return;
    }
    for (std::size_t rank = 1; rank < size_; ++rank) wait_for_call(static_cast<int>(rank));
    for (std::size_t rank = 1; rank < size_; ++rank) call_to(static_cast<int>(rank));
}

// One broadcast after the other: of any length, and no process has to have room for more than what is told.
std::vector<std::vector<std::byte>> MpiTeam::tell_all(std::span<const std::byte> said) {
    std::vector<unsigned long long> sizes(size_);
    const unsigned long long own = said.size();
    meet();
    MPI_Allgather(&own, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, MPI_COMM_WORLD);
    std::vector<std::vector<std::byte>> all(size_);
    for (std::size_t rank = 0; rank < size_; ++rank) {
        all[rank].resize(sizes[rank]);
        if (rank == rank_) std::ranges::copy(said, all[rank].begin());
        in_messages(all[rank].size(), [&](std::size_t first, int count) {
            MPI_Bcast(all[rank].data() + first, count, MPI_BYTE, static_cast<int>(rank), MPI_COMM_WORLD);
        });
    }
    return all;
}

void MpiTeam::send(std::span<const std::byte> bytes) {
    wait_for_call(0);
    in_messages(bytes.size(), [&](std::size_t first, int count) {
        MPI_Send(bytes.data() + first, count, MPI_BYTE, 0, 0, MPI_COMM_WORLD);
    });
}

void MpiTeam::receive(std::size_t from, std::span<std::byte> bytes) {
    call_to(static_cast<int>(from));
    in_messages(bytes.size(), [&](std::size_t first, int count) {
        MPI_Recv(bytes.data() + first, count, MPI_BYTE, static_cast<int>(from), 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    });
}

void MpiTeam::finish() {
    meet();
    MPI_Finalize();
}

void MpiTeam::abort(int code) {
    MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
}

} // namespace ramus::app
