// Ctrl-C and a polite kill, while a command works: the first one cancels the work that runs, so that the command ends
// with a word; where nothing can be cancelled, or at the second one, unfinished files are removed and the process ends
// by the signal, as a shell expects.
#pragma once

#include "core/base/job.h"

namespace ramus::app {

// Once, before any command.
void handle_interrupts();

// While it lives, an interrupt cancels `job`. One at a time.
class CancelOnInterrupt {
public:
    explicit CancelOnInterrupt(Job& job);
    ~CancelOnInterrupt();
    CancelOnInterrupt(const CancelOnInterrupt&) = delete;
    CancelOnInterrupt& operator=(const CancelOnInterrupt&) = delete;
};

} // namespace ramus::app
