#!/usr/bin/env python3
"""Says whether a job of SLURM runs, has succeeded or has failed, as snakemake 7 asks: status.py JOB."""

import subprocess
import sys
import time

RUNNING = {"PENDING", "CONFIGURING", "COMPLETING", "RUNNING", "SUSPENDED", "PREEMPTED", "REQUEUED", "RESIZING"}


def state_of(job):
    """Empty while the accounting of SLURM does not know the job."""
    said = subprocess.run(["sacct", "--noheader", "--parsable2", "--allocations", "--format=State", "--jobs", job],
                          capture_output=True, text=True, check=False).stdout.split()
    return said[0] if said else ""


def main():
    for _ in range(5):
        state = state_of(sys.argv[1])
        if state:
            break
        time.sleep(2)
    print("success" if state == "COMPLETED" else "running" if state in RUNNING or not state else "failed")


if __name__ == "__main__":
    main()
