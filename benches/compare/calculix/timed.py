"""Runs a program on one thread with a limit of CPU time, and measures time and memory of its process.

    python3 timed.py LIMIT COMMAND ..

runs the command with the text it says going to standard output, and ends with a line of JSON on standard error. LIMIT is CPU
time [s], so that other work on the machine does not matter; wall time may be four times as long.
"""

import json
import math
import os
import resource
import signal
import subprocess
import sys
import threading
import time
from dataclasses import dataclass


@dataclass
class Run:
    """`ended` is false where the limit came first."""

    said: str
    ended: bool
    code: int
    user: float  # s
    wall: float  # s
    peak: float  # MB


def measured(command, folder, limit):
    """Runs a command in a folder for at most `limit` [s] of CPU time; what it says stays in said.txt of the folder.

    It is started by a process of its own, since the peak memory of a process is never below that of its parent at the start.
    """
    threads = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "CCX_NPROC_EQUATION_SOLVER", "RAYON_NUM_THREADS")
    environment = dict(os.environ, **dict.fromkeys(threads, "1"))
    starter = [sys.executable, "-I", "-S", __file__, str(limit), *map(str, command)]
    with open(folder / "said.txt", "w") as said:
        done = subprocess.run(starter, cwd=folder, env=environment, stdout=said, stderr=subprocess.PIPE, text=True)
    return Run((folder / "said.txt").read_text(errors="replace"), **json.loads(done.stderr.splitlines()[-1]))


def run(command, folder, limit):
    """What the program says, user CPU time and wall time [s]; says "stopped" where it does not end within `limit` [s]."""
    done = measured(command, folder, limit)
    return done.said if done.ended else "stopped", done.user, done.wall


def main():
    start, late, limit = time.time(), threading.Event(), float(sys.argv[1])
    resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(limit), math.ceil(limit) + 5))
    child = subprocess.Popen(sys.argv[2:], stderr=subprocess.STDOUT)

    def stop():
        late.set()
        child.kill()

    timer = threading.Timer(4 * limit, stop)
    timer.start()
    _, status, usage = os.wait4(child.pid, 0)
    timer.cancel()
    wall, code = time.time() - start, os.waitstatus_to_exitcode(status)
    ended = not late.is_set() and code not in (-signal.SIGXCPU, -signal.SIGKILL)
    result = {"ended": ended, "code": code, "user": usage.ru_utime, "wall": wall, "peak": usage.ru_maxrss / 1024}
    print(json.dumps(result), file=sys.stderr)


if __name__ == "__main__":
    main()
