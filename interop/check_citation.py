"""Validates CITATION.cff with cffconvert, and exits non-zero if it is refused or if a damaged copy is accepted.

    python interop/check_citation.py CITATION.cff

cffconvert needs an older `jsonschema` than the other checks, so it has an environment of its own.
"""

import sys
from pathlib import Path

from cffconvert import Citation


def refused(text):
    """Reason why the text is no valid citation; none if it is."""
    try:
        Citation(text).validate()
    except Exception as error:  # Any exception of the reader is a refusal.
        return f"{type(error).__name__}: {error}".splitlines()[0]
    return None


def damages(text):
    lines = text.splitlines(keepends=True)
    yield "no title", "".join(line for line in lines if not line.startswith("title:"))
    yield "another version of the format", "".join("cff-version: 0.1\n" if line.startswith("cff-version:") else line for line in lines)
    yield "an unknown key", text + "autors: []\n"


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    text = Path(sys.argv[1]).read_text(encoding="utf-8")
    problems = [f"refused: {why}" for why in [refused(text)] if why]
    tried = list(damages(text))
    problems += [f"{what} is accepted" for what, damaged in tried if not refused(damaged)]
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"1 citation, {len(tried)} damaged copies tried, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
