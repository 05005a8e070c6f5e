"""Reads the seismograms of a run with ObsPy, and exits non-zero if a check fails.

    python interop/check_seismograms.py out/rupture/seismograms

Every table `STATION.csv` has its samples in `STATION.mseed` to the last bit, and in `STATION.CHANNEL.sac` to the precision of
32-bit floats, at the same times. Copies that are corrupted on purpose must fail.
"""

import csv
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np
from obspy import UTCDateTime, read

# Time zero of scenes that do not say theirs.
EPOCH = UTCDateTime(2000, 1, 1)
# ObsPy rounds the intervals of SAC files to microseconds.
ROUNDING = 0.5e-6


class Problems(list):
    def expect(self, condition, message):
        if not condition:
            self.append(message)


def table(path):
    """Times and the velocities by axis."""
    with path.open() as file:
        head, *rows = list(csv.reader(file))
    values = np.array(rows, dtype=float)
    axes = {name.split("_")[1][0].upper(): k for k, name in enumerate(head) if name.startswith("velocity_")}
    return values[:, 0], {axis: values[:, k] for axis, k in axes.items()}


def check_trace(trace, times, expected, epoch, where, problems, rounding=0.0):
    """Compares a trace with a table; `rounding` is that of the reader's interval [s]."""
    interval = (times[-1] - times[0]) / (len(times) - 1)
    problems.expect(trace.stats.npts == len(times), f"{where}: {trace.stats.npts} samples, expected {len(times)}")
    off = abs(trace.stats.delta - interval)
    problems.expect(off < 1e-6 * interval + rounding, f"{where}: interval {trace.stats.delta}")
    off = abs(trace.stats.starttime - (epoch + times[0]))
    problems.expect(off < 2e-6, f"{where}: starts {off} s off")
    off = abs(trace.stats.endtime - (epoch + times[-1]))
    problems.expect(off < 0.01 * interval + rounding * len(times), f"{where}: ends {off} s off")
    problems.expect(np.array_equal(trace.data, expected), f"{where}: other samples")


def check_station(path, epoch, problems):
    times, axes = table(path)
    names = set()
    stream = read(str(path.with_suffix(".mseed")), format="MSEED")
    problems.expect(len(stream) == len(axes), f"{path.stem}: {len(stream)} traces, expected {len(axes)}")
    for trace in stream:
        where, stats = f"{path.stem}.mseed, {trace.id}", trace.stats
        problems.expect(stats.mseed.encoding == "FLOAT64", f"{where}: {stats.mseed.encoding}")
        problems.expect(stats.mseed.record_length == 4096, f"{where}: {stats.mseed.record_length}")
        problems.expect(stats.channel[1] == "X", f"{where}: not said to be synthetic")
        check_trace(trace, times, axes[stats.channel[-1]], epoch, where, problems)
        names.add(trace.id)
    for axis, expected in axes.items():
        for file in path.parent.glob(f"{path.stem}.*{axis}.sac"):
            (trace,) = read(str(file), format="SAC")
            problems.expect(trace.id in names, f"{file.name}: {trace.id} is no trace of the other file")
            names.discard(trace.id)
            check_trace(trace, times, expected.astype(np.float32), epoch, file.name, problems, ROUNDING)
    problems.expect(not names, f"{path.stem}: no SAC file of {sorted(names)}")


def check(out, epoch):
    problems = Problems()
    stations = sorted(out.glob("*.csv"))
    problems.expect(stations, f"{out}: no seismograms")
    for path in stations:
        try:
            check_station(path, epoch, problems)
        except Exception as error:  # Any exception of a reader on a damaged file is another problem to list.
            problems.append(f"{path.stem}: {type(error).__name__}: {error}")
    return problems, len(stations)


def changed(data, at, by):
    return data[:at] + bytes([data[at] ^ by]) + data[at + 1 :]


def breaks(stem, sac):
    """Ways to corrupt a file: its name and the change."""
    mseed = f"{stem}.mseed"
    yield mseed, "another sample", lambda d: changed(d, 128 + 8 * 2 + 7, 1)
    yield mseed, "another day", lambda d: changed(d, 23, 2)
    yield mseed, "another encoding", lambda d: changed(d, 52, 1)
    yield mseed, "another station", lambda d: changed(d, 8, 1)
    yield mseed, "half of the file", lambda d: d[: len(d) // 2]
    yield sac, "another sample", lambda d: changed(d, 632 + 4 * 2, 1)
    yield sac, "another interval", lambda d: changed(d, 2, 1)
    yield sac, "another channel", lambda d: changed(d, 600, 1)
    yield sac, "half of the file", lambda d: d[: len(d) // 2]


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    epoch = UTCDateTime(sys.argv[2]) if len(sys.argv) == 3 else EPOCH
    problems, count = check(out, epoch)
    tried = 0
    for path in sorted(out.glob("*.csv"))[:1]:
        sac = sorted(out.glob(f"{path.stem}.*.sac"))[0].name
        for name, what, change in breaks(path.stem, sac):
            with tempfile.TemporaryDirectory() as folder:
                copy = Path(folder) / "copy"
                shutil.copytree(out, copy)
                (copy / name).write_bytes(change((copy / name).read_bytes()))
                tried += 1
                problems.expect(check(copy, epoch)[0], f"{name} broken by {what} is accepted")
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{count} stations in three formats, {tried} broken files tried, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
