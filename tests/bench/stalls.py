"""When the machine itself stood still, as virtual machines do whose host has something else to do: no thread of a core
runs then, and the kernel counts the time as that of whichever thread was there.
A process for each core sleeps for two milliseconds again and again, before all other threads in the order in which they
get the core. What it oversleeps by is a stall of that core. This needs the right to set such an order.

    stalls = Stalls(folder)    begins to look
    stalls.within(from, to)    seconds of the longest-standing core, between two moments of time.monotonic()
    stalls.end()
"""

import os
import subprocess
import sys
import time
from pathlib import Path

NAP, NOTICED = 0.002, 0.006  # seconds


def watch(core, file):
    os.sched_setaffinity(0, {core})
    os.sched_setscheduler(0, os.SCHED_FIFO, os.sched_param(50))
    before = os.getppid()
    with open(file, "w", buffering=1) as out:
        while os.getppid() == before:
            begun = time.monotonic()
            time.sleep(NAP)
            ended = time.monotonic()
            if ended - begun - NAP > NOTICED:
                print(begun + NAP, ended, file=out)


class Stalls:
    def __init__(self, folder):
        cores = sorted(os.sched_getaffinity(0))
        self.files = [Path(folder) / f"stalls_of_core_{core}" for core in cores]
        self.watchers = [subprocess.Popen([sys.executable, __file__, str(core), file], stderr=subprocess.DEVNULL)
                         for core, file in zip(cores, self.files)]
        time.sleep(0.5)
        self.seen = all(watcher.poll() is None for watcher in self.watchers)  # it is allowed

    def within(self, since, until):
        def of_core(file):
            spans = [tuple(map(float, line.split())) for line in file.read_text().splitlines()]
            return sum(max(0.0, min(ended, until) - max(begun, since)) for begun, ended in spans)
        return max(map(of_core, self.files)) if self.seen else 0.0

    def end(self):
        for watcher in self.watchers:
            watcher.terminate()
            watcher.wait()


if __name__ == "__main__":
    watch(int(sys.argv[1]), sys.argv[2])
