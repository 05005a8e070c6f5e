"""Runs a program on one thread with a limit, and times it."""

import os
import resource
import subprocess
import time


def run(command, folder, limit):
    """What the program says, user CPU time and wall time [s]; says "stopped" where it does not end within `limit` [s]."""
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime, time.time()
    environment = dict(os.environ, OMP_NUM_THREADS="1", CCX_NPROC_EQUATION_SOLVER="1", RAYON_NUM_THREADS="1")
    try:
        done = subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=limit)
        text = done.stdout + done.stderr
    except subprocess.TimeoutExpired:
        text = "stopped"
    return text, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, time.time() - start
