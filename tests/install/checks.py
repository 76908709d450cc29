"""What the tests of an installation share. Standard library only."""

import subprocess


def check(truth, what):
    if not truth:
        raise SystemExit("FAILED: " + what)
    print("ok:", what, flush=True)


def run(*words, **options):
    return subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)
