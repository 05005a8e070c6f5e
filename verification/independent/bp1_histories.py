"""Histories of the first three events of BP1-QD for four cell sizes, computed by cycles.py: benchmark seas-bp1-quick/v1.

Writes bp1_histories.json: onsets, largest slip rates, time above 1 mm/s, and log10 of the slip rate [m/s] at three depths and some
times between events. Takes some minutes.
"""

import json
import pathlib

import numpy as np
from cycles import WF, YEAR, run

DEPTHS = [10e3, 16e3, 20e3]
TIMES = [25.0 * k for k in range(1, 14)]
EVENTS = 3


def histories(n):
    middles = (np.arange(n) + 0.5) * WF / n
    before, samples, above = [0.0, None], {}, []

    def look(t, y):
        log_rate = y[:n] / np.log(10)
        was, last = before
        for year in TIMES:
            if last is not None and was < year * YEAR <= t:
                share = (year * YEAR - was) / (t - was)
                samples[year] = np.interp(DEPTHS, middles, last + share * (log_rate - last)).tolist()
        # Time above 1 mm/s, with ln V linear within a step.
        if last is not None:
            low, high = last.max() + 3, log_rate.max() + 3
            if low < 0 <= high:
                above.append([was + (t - was) * -low / (high - low), None])
            elif low >= 0 > high:
                above[-1][1] = was + (t - was) * low / (low - high)
        before[0], before[1] = t, log_rate

    # The last event is over a year after its onset.
    found = run("bp1", n, 351.0, 1e-6, EVENTS + 1, look)
    return {
        "cell [m]": WF / n,
        "onsets [yr]": found["onsets [yr]"],
        "peaks [m/s]": found["peaks [m/s]"],
        "above 1 mm/s [s]": [end - start for start, end in above if end],
        "times [yr]": TIMES,
        "depths [m]": DEPTHS,
        "log10 V, rows times, columns depths": [samples[t] for t in TIMES],
    }


def main():
    runs = [histories(n) for n in (256, 512, 1024, 2048)]
    pathlib.Path(__file__).with_name("bp1_histories.json").write_text(json.dumps(runs, indent=1) + "\n")


if __name__ == "__main__":
    main()
