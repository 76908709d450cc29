"""Starts snakemake on the folder of a cohort: one run at a time, and ended as by Ctrl-C.

Usage: run.py OUT [OPTIONS OF SNAKEMAKE...]

Holds OUT/.lock while snakemake runs; another run.py on the same folder fails with status 75. Since the lock ends with the
process, a lock that snakemake itself left behind is stale then, and is removed. TERM and INT interrupt snakemake and its
jobs. What snakemake says goes to standard error.
"""

import fcntl
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

BUSY = 75
POLITE_S = 8  # between an interrupt and SIGKILL


def hold(out):
    """The lock, which snakemake inherits: it stays locked if this process is killed and snakemake is not."""
    if "RAMUS_COHORT_LOCK" in os.environ:  # `ramus cohort` has taken it
        return int(os.environ.pop("RAMUS_COHORT_LOCK"))
    lock = os.open(out / ".lock", os.O_RDWR | os.O_CREAT, 0o666)
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        print("another run works in this folder; wait for it, or end it", file=sys.stderr)
        sys.exit(BUSY)
    return lock


def main():
    out, options = Path(sys.argv[1]), sys.argv[2:]
    plans = "--dry-run" in options
    locks = [] if plans else [hold(out)]
    snakefile = Path(__file__).resolve().parent.parent / "Snakefile"
    words = ["snakemake", "--snakefile", str(snakefile), "--directory", str(out)]
    if not plans and any((out / ".snakemake" / "locks").glob("*")):
        subprocess.run([*words, "--unlock", "--cores", "1"], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
    interrupted = []
    environment = os.environ | {"PYTHONDONTWRITEBYTECODE": "1"}
    child = None

    def interrupt(*_):
        interrupted.append(time.monotonic())
        if child is not None and len(interrupted) == 1:
            os.killpg(child.pid, signal.SIGINT)

    signal.signal(signal.SIGTERM, interrupt)
    signal.signal(signal.SIGINT, interrupt)
    child = subprocess.Popen([*words, *options], stdin=subprocess.DEVNULL, stdout=sys.stderr.fileno(),
                             pass_fds=locks, start_new_session=True, env=environment)
    if interrupted:
        os.killpg(child.pid, signal.SIGINT)
    while True:
        try:
            status = child.wait(timeout=0.2)
            break
        except subprocess.TimeoutExpired:
            if interrupted and time.monotonic() > interrupted[0] + POLITE_S:
                os.killpg(child.pid, signal.SIGKILL)
    sys.exit(130 if interrupted else 1 if status else 0)


if __name__ == "__main__":
    main()
