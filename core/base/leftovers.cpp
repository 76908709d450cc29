#include "core/base/leftovers.h"

#include <csignal>
#include <cstdlib>
#include <map>
#include <pthread.h>
#include <utility>

namespace ramus {

namespace {

namespace fs = std::filesystem;

struct Registry {
    struct One {
        fs::path path;
        LeftoverKind what;
    };
    std::recursive_mutex mutex;
    std::map<std::size_t, One> all; // by age
    std::size_t made = 0;
};

// Never destroyed, because a thread may end the process while another one removes its leftovers.
Registry& registry() {
    static Registry& one = *new Registry;
    return one;
}

void remove_now(const fs::path& path, LeftoverKind what) {
    std::error_code ignored;
    if (what == LeftoverKind::kFile)
        fs::remove(path, ignored);
    else
        fs::remove_all(path, ignored);
}

} // namespace

// Absolute, because the working directory may change.
Leftover::Leftover(const fs::path& path, LeftoverKind what) : path_(fs::absolute(path)), what_(what) {
    const auto held = hold_leftovers();
    number_ = ++registry().made;
    registry().all.emplace(number_, Registry::One{path_, what});
}

Leftover::Leftover(Leftover&& other) noexcept { *this = std::move(other); }

Leftover& Leftover::operator=(Leftover&& other) noexcept {
    if (this == &other) return *this;
    remove();
    path_ = std::exchange(other.path_, {});
    number_ = other.number_;
    what_ = other.what_;
    return *this;
}

Leftover::~Leftover() { remove(); }

void Leftover::keep() {
    const auto held = hold_leftovers();
    registry().all.erase(number_);
    path_.clear();
}

void Leftover::remove() {
    if (path_.empty()) return;
    const auto held = hold_leftovers();
    remove_now(path_, what_);
    keep();
}

std::unique_lock<std::recursive_mutex> hold_leftovers() { return std::unique_lock(registry().mutex); }

void end_by_signal(int number) {
    registry().mutex.lock(); // never unlocked: no leftover is created or kept from now on
    for (auto one = registry().all.rbegin(); one != registry().all.rend(); ++one)
        remove_now(one->second.path, one->second.what);
    std::signal(number, SIG_DFL);
    sigset_t this_one;
    sigemptyset(&this_one);
    sigaddset(&this_one, number);
    ::pthread_sigmask(SIG_UNBLOCK, &this_one, nullptr);
    std::raise(number);
    std::_Exit(EXIT_FAILURE); // only if the signal does not end a process by default
}

} // namespace ramus
