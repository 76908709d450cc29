// Job: progress and cancellation of slow work. The work reports progress to it and asks it whether to stop; the caller
// reads the progress and cancels. All members may be called from any thread. A default Job has no observer and is never
// cancelled unless cancel() is called. Cancelling only sets a flag: the work has to ask.
#pragma once

#include <atomic>

namespace ramus {

class Job {
public:
    Job() = default;
    // A step of another job, which must outlive it, for a function that takes a Job. Its progress maps to [begin, end]
    // of the other job, and it is cancelled with the other job.
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

// The part [begin, end] of a job's progress, for a step that does not know the other steps. The job must outlive it.
class JobRange {
public:
    JobRange(Job& job, float begin, float end) : job_(job), begin_(begin), share_(end - begin) {}
    // Fraction of this part that is done, 0 to 1.
    void report(float fraction) const { job_.report(begin_ + share_ * fraction); }
    [[nodiscard]] bool cancelled() const { return job_.cancelled(); }
    // The part [begin, end] of this part.
    [[nodiscard]] JobRange part(float begin, float end) const {
        return {job_, begin_ + share_ * begin, begin_ + share_ * end};
    }

private:
    Job& job_;
    float begin_, share_;
};

} // namespace ramus
