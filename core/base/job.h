// A Job is how slow work talks to whoever waits for it: it reports progress and learns that it should stop.
// All members may be called from any thread. A default Job is silent and never cancelled.
#pragma once

#include <atomic>

namespace ramus {

class Job {
public:
    Job() = default;
    // A step of another job, which outlives it, for what takes a Job: its progress is this part of the other's, and it
    // is cancelled with it.
    Job(Job& whole, float begin, float end) : whole_(&whole), begin_(begin), share_(end - begin) {}

    // Fraction of the whole job that is done, 0 to 1.
    void report(float fraction) {
        progress_.store(fraction, std::memory_order_relaxed);
        if (whole_ != nullptr) whole_->report(begin_ + share_ * fraction);
    }
    [[nodiscard]] float progress() const { return progress_.load(std::memory_order_relaxed); }

    void cancel() { cancelled_.store(true, std::memory_order_relaxed); }
    [[nodiscard]] bool cancelled() const {
        return cancelled_.load(std::memory_order_relaxed) || (whole_ != nullptr && whole_->cancelled());
    }

private:
    Job* whole_ = nullptr;
    float begin_ = 0.0F, share_ = 1.0F;
    std::atomic<float> progress_{0.0F};
    std::atomic<bool> cancelled_{false};
};

// A part of a job's progress, for a step that does not know what else the job does.
class JobRange {
public:
    JobRange(Job& job, float begin, float end) : job_(job), begin_(begin), share_(end - begin) {}
    void report(float fraction) const { job_.report(begin_ + share_ * fraction); } // of this part
    [[nodiscard]] bool cancelled() const { return job_.cancelled(); }
    // A part of this part.
    [[nodiscard]] JobRange part(float begin, float end) const {
        return {job_, begin_ + share_ * begin, begin_ + share_ * end};
    }

private:
    Job& job_;
    float begin_, share_;
};

} // namespace ramus
