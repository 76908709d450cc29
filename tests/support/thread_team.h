// A team of threads of this process, in place of processes on several machines.
#pragma once

#include "core/base/team.h"

#include <algorithm>
#include <barrier>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace ramus::test {

class ThreadTeam final : public Team {
public:
    // Calls work(team) on `size` threads at once, and returns when all are done.
    static void run(std::size_t size, const std::function<void(Team&)>& work) {
        Shared shared(size);
        std::vector<std::jthread> threads;
        for (std::size_t rank = 0; rank < size; ++rank)
            threads.emplace_back([&shared, &work, rank] {
                ThreadTeam team(shared, rank);
                work(team);
            });
    }

    [[nodiscard]] std::size_t size() const override { return shared_.said.size(); }
    [[nodiscard]] std::size_t rank() const override { return rank_; }

    [[nodiscard]] std::vector<std::vector<std::byte>> tell_all(std::span<const std::byte> said) override {
        shared_.said[rank_].assign(said.begin(), said.end());
        shared_.all_said.arrive_and_wait();
        std::vector<std::vector<std::byte>> all = shared_.said;
        shared_.all_said.arrive_and_wait();
        return all;
    }
    void send(std::span<const std::byte> bytes) override {
        const std::lock_guard lock(shared_.mutex);
        shared_.sent[rank_].emplace_back(bytes.begin(), bytes.end());
        shared_.changed.notify_all();
    }
    void receive(std::size_t from, std::span<std::byte> bytes) override {
        std::unique_lock lock(shared_.mutex);
        shared_.changed.wait(lock, [&] { return !shared_.sent[from].empty(); });
        std::ranges::copy(shared_.sent[from].front(), bytes.begin());
        shared_.sent[from].pop_front();
    }

private:
    struct Shared {
        explicit Shared(std::size_t size) : said(size), sent(size), all_said(static_cast<std::ptrdiff_t>(size)) {}
        std::vector<std::vector<std::byte>> said;
        std::vector<std::deque<std::vector<std::byte>>> sent;
        std::barrier<> all_said;
        std::mutex mutex;
        std::condition_variable changed;
    };
    ThreadTeam(Shared& shared, std::size_t rank) : shared_(shared), rank_(rank) {}

    Shared& shared_;
    std::size_t rank_;
};

} // namespace ramus::test
