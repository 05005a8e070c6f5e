"""Reads all tables of output directories with pandas, and exits non-zero if a check fails.

    python interop/check_tables.py out/sandwich out/strike_slip ...

pandas fills short rows and turns a column with one bad value into text, so types and shapes are checked, and numbers
are compared with those of Python's own reader. Damaged copies must be noticed.
"""

import csv
import json
import re
import sys
import tempfile
from pathlib import Path

import numpy as np
import pandas

# Columns that hold text.
TEXT = {"stage", "name", "fault", "surface", "interface", "slider", "station", "receiver", "kind", "set"}


def read(path):
    return pandas.read_csv(path)


def check(path):
    """Problems of one table."""
    problems = []

    def expect(condition, message):
        if not condition:
            problems.append(f"{path}: {message}")
        return bool(condition)

    table = read(path)
    with open(path, newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    expect(list(table.columns) == head, "pandas sees other columns, or two have one name")
    expect(len(table) == len(rows), f"pandas sees {len(table)} rows, there are {len(rows)}")
    expect(all(len(row) == len(head) for row in rows), "rows of different length")
    for k, name in enumerate(head):
        if name in TEXT:
            continue
        # Columns of profiles are named by positions.
        named = re.fullmatch(r"\S.* \[[^\[\]]+\]( (at|of) .*)?|[a-z0-9_]+|-?[0-9.]+(e-?[0-9]+)?", name)
        expect(named, f"column `{name}` is neither a name with a unit, nor a plain name, nor a number")
        if not len(table) or not expect(pandas.api.types.is_numeric_dtype(table[name]), f"`{name}` is not numeric"):
            continue
        given = np.array([float(row[k]) if row[k] else np.nan for row in rows if len(row) == len(head)])
        same = len(given) == len(table) and np.array_equal(given, table[name].to_numpy(float), equal_nan=True)
        expect(same, f"`{name}` has other numbers in pandas")
        # Tables of points have a time per point.
        if name == "time [s]" and "event" not in path.name and path.name != "rupture_times.csv":
            expect(table[name].is_monotonic_increasing, "time decreases")
    return problems


def check_events(out):
    """Problems of the table of events beside the report."""
    report = json.loads((out / "report.json").read_text(encoding="utf-8"))
    path = out / "events.csv"
    if not path.exists():
        return []
    found, expected = len(read(path)), len(report.get("events", []))
    return [] if found == expected else [f"{path}: {found} events, the report has {expected}"]


def damages(text):
    lines = text.splitlines(keepends=True)
    cells = lines[-1].rstrip("\n").split(",")
    yield "a short row", "".join(lines[:-1]) + ",".join(cells[:-1]) + "\n"
    yield "a word for a number", "".join(lines[:-1]) + ",".join(["x", *cells[1:]]) + "\n"
    yield "a column twice", ",".join([lines[0].split(",")[0], lines[0].split(",")[0], *lines[0].split(",")[2:]]) + "".join(lines[1:])
    yield "half of the last row", text[: len(text) - len(lines[-1]) // 2]


def refuses(path):
    """Ways to damage a table that go unnoticed, and the number tried."""
    problems, tried = [], 0
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "damaged.csv"
        for what, text in damages(path.read_text(encoding="utf-8")):
            copy.write_text(text, encoding="utf-8")
            tried += 1
            try:
                found = check(copy)
            except (pandas.errors.ParserError, ValueError) as error:
                found = [str(error)]
            if not found:
                problems.append(f"{path}: {what} is not noticed")
    return problems, tried


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    problems, tables, tried = [], 0, 0
    for out in map(Path, sys.argv[1:]):
        paths = sorted(out.rglob("*.csv"))
        if not paths:
            problems.append(f"{out} has no tables")
        for path in paths:
            tables += 1
            problems += check(path)
        problems += check_events(out)
        numeric = [p for p in paths if (t := read(p)).shape[0] > 1 and t.shape[1] > 2 and t.columns[0] not in TEXT]
        if numeric:
            found, count = refuses(numeric[0])
            problems, tried = problems + found, tried + count
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{tables} tables, {tried} damaged copies tried, {len(problems)} problems")
    sys.exit(1 if problems or not tried else 0)


if __name__ == "__main__":
    main()
