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

// Waits asleep for the other process of a message without content. Functions of MPI that wait keep a core busy, which
// processes that still compute may need; so two of them meet before they transfer anything.
void wait_for(MPI_Request request) {
    constexpr int kBusy = 1000; // tests before it sleeps: the other one may come within a fraction of a millisecond
    constexpr std::chrono::microseconds kAsleep(500);
    int done = 0;
    for (int tests = 0; MPI_Test(&request, &done, MPI_STATUS_IGNORE), done == 0; ++tests)
        if (tests >= kBusy) std::this_thread::sleep_for(kAsleep);
}

void wait_for_all() {
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    wait_for(request);
}

constexpr int kMeet = 1; // tag of messages without content; those with content have 0

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

// One broadcast after the other: of any length, and no process has to have room for more than what is told.
std::vector<std::vector<std::byte>> MpiTeam::tell_all(std::span<const std::byte> said) {
    std::vector<unsigned long long> sizes(size_);
    const unsigned long long own = said.size();
    wait_for_all();
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
    MPI_Request met = MPI_REQUEST_NULL;
    MPI_Issend(nullptr, 0, MPI_BYTE, 0, kMeet, MPI_COMM_WORLD, &met);
    wait_for(met);
    in_messages(bytes.size(), [&](std::size_t first, int count) {
        MPI_Send(bytes.data() + first, count, MPI_BYTE, 0, 0, MPI_COMM_WORLD);
    });
}

void MpiTeam::receive(std::size_t from, std::span<std::byte> bytes) {
    MPI_Request met = MPI_REQUEST_NULL;
    MPI_Irecv(nullptr, 0, MPI_BYTE, static_cast<int>(from), kMeet, MPI_COMM_WORLD, &met);
    wait_for(met);
    in_messages(bytes.size(), [&](std::size_t first, int count) {
        MPI_Recv(bytes.data() + first, count, MPI_BYTE, static_cast<int>(from), 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    });
}

void MpiTeam::finish() {
    wait_for_all();
    MPI_Finalize();
}

void MpiTeam::abort(int code) {
    MPI_Abort(MPI_COMM_WORLD, code);
    std::_Exit(code);
}

} // namespace ramus::app
