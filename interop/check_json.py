"""Validates scenes and reports against the schemas that asperity prints, and exits non-zero if one is refused.

    python interop/check_json.py target/release/asperity scenes out/sandwich out/strike_slip ...

The validator is `jsonschema`; scenes are read by Python's `tomllib`. Damaged copies must be refused.
"""

import copy
import json
import subprocess
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft202012Validator

problems: list[str] = []


def expect(condition, message):
    """Records a problem and continues, so that one run shows all of them."""
    if not condition:
        problems.append(message)


def validator(program, of):
    schema = json.loads(subprocess.run([program, "schema", of], check=True, capture_output=True).stdout)
    Draft202012Validator.check_schema(schema)
    return Draft202012Validator(schema)


def check(valid, name, value):
    for error in valid.iter_errors(value):
        where = "/".join(str(key) for key in error.absolute_path)
        expect(False, f"{name}: {where}: {error.message[:200]}")


def changed(value, change):
    value = copy.deepcopy(value)
    change(value)
    return value


def misspelt(value, key):
    value[key + "e"] = value.pop(key)


def damages(value):
    """Damaged copies of a scene or a report."""
    yield "an unknown key", changed(value, lambda v: v.update({"tittle": "x"}))
    yield "no title", changed(value, lambda v: v.pop("title"))
    yield "a list for the title", changed(value, lambda v: v.update({"title": ["x"]}))
    yield "a text for the schema", changed(value, lambda v: v.update({"schema": "one"}))
    if isinstance(value.get("time"), dict):
        yield "a misspelt key of a table", changed(value, lambda v: misspelt(v["time"], next(iter(v["time"]))))
    if isinstance(value.get("counts"), dict):
        yield "a count below zero", changed(value, lambda v: v["counts"].update({"steps": -1}))
        yield "no counts", changed(value, lambda v: v.pop("counts"))


def refuses(valid, name, value):
    """Tries the damaged copies; returns their number."""
    tried = 0
    for what, damaged in damages(value):
        tried += 1
        expect(not valid.is_valid(damaged), f"{name}: {what} is accepted")
    return tried


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    program, scenes, *outputs = sys.argv[1:]
    files = [(validator(program, "scene"), path, tomllib.loads(path.read_text(encoding="utf-8")))
             for path in sorted(Path(scenes).glob("*.toml"))]
    of_reports = validator(program, "report")
    for out in outputs:
        path = Path(out) / "report.json"
        files.append((of_reports, path, json.loads(path.read_text(encoding="utf-8"))))
    tried = 0
    for valid, path, value in files:
        check(valid, path, value)
        tried += refuses(valid, path, value)
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(files)} files valid or listed, {tried} damaged copies tried, {len(problems)} problems")
    sys.exit(1 if problems or not files else 0)


if __name__ == "__main__":
    main()
