"""Largest slip rate of BP1-QD over time through its first three events, computed by cycles.py and plotted on the page of seas_bp1.

    python bp1_largest_rate.py CELLS

CELLS is the number of cells on 40 km. Writes bp1_largest_rate.json: times [yr] and log10 of the largest slip rate [m/s], at steps where
the latter changed by 0.1 or turned. Takes less than a minute with 512 cells.
"""

import json
import sys

import numpy as np
from cycles import WF, YEAR, run

EVENTS = 3


def history(n):
    kept, last = [[0.0, -9.0]], [0.0, -9.0]

    def look(t, y):
        rate = float(y[:n].max() / np.log(10))
        turns = len(kept) > 1 and (last[1] - kept[-1][1]) * (rate - last[1]) < 0
        if turns and abs(last[1] - kept[-1][1]) > 0.01:
            kept.append(list(last))
        if abs(rate - kept[-1][1]) > 0.1 or t - kept[-1][0] * YEAR > 2 * YEAR:
            kept.append([t / YEAR, rate])
        last[:] = [t / YEAR, rate]

    # The last event is over a year after its onset.
    found = run("bp1", n, 351.0, 1e-6, EVENTS + 1, look)
    return {
        "cell [m]": WF / n,
        "onsets [yr]": found["onsets [yr]"],
        "columns": ["time [yr]", "log10 of the largest slip rate [m/s]"],
        "rows": [[round(t, 9), round(v, 4)] for t, v in kept],
    }


if __name__ == "__main__":
    found = history(int(sys.argv[1]))
    rows = ",\n  ".join(json.dumps(row) for row in found.pop("rows"))
    head = json.dumps(found, indent=1)[:-2]
    with open("bp1_largest_rate.json", "w") as file:
        file.write(f'{head},\n "rows": [\n  {rows}\n ]\n}}\n')
