"""Reads report.html of output directories with Python's HTML parser, and exits non-zero if a check fails.

    python interop/check_page.py out/sandwich out/strike_slip ...

A page must be well nested, hold the pictures of its directory, and load nothing: it is mailed and archived alone. Damaged copies
must be noticed.
"""

import sys
from html.parser import HTMLParser
from pathlib import Path

VOID = {"meta", "br", "hr", "img", "link", "input"}


class Page(HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.problems, self.pictures, self.headings, self.links = [], [], 0, [], []

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag in {"script", "link", "iframe"} or (attributes.get("src") or "").split(":")[0] not in {"", "data"}:
            self.problems.append(f"<{tag}> loads something")
        if tag == "a":
            self.links.append(attributes.get("href"))
        self.pictures += tag == "svg"
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attributes):
        pass

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.problems.append(f"</{tag}> closes another element, line {self.getpos()[0]}")

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


def check(text, out):
    """Problems of a page, and the number of its pictures."""
    page = Page()
    page.feed(text)
    page.close()
    problems = page.problems + [f"<{tag}> is not closed" for tag in page.open]
    drawn = len(list((out / "plots").glob("*.svg")))
    if page.pictures != drawn:
        problems.append(f"{page.pictures} pictures, plots/ has {drawn}")
    for heading in ["Costs", "Plan and checks", "Scene", "Files"]:
        if heading not in page.headings:
            problems.append(f"no section {heading}")
    problems += [f"a link to {link}, which is not there" for link in page.links if not (out / link).exists()]
    return problems, page.pictures


def damages(text):
    yield "an element not closed", text.replace("</table>", "", 1)
    yield "a script", text.replace("</body>", "<script></script></body>")
    yield "a picture less", text[: text.index("<figure>")] + text[text.index("</figure>") + 9 :]
    yield "a section less", text.replace("<h2>Plan and checks</h2>", "", 1)
    yield "a broken link", text.replace('href="report.json"', 'href="report.jsonl"', 1)


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    problems, pictures, tried = [], 0, 0
    for out in map(Path, sys.argv[1:]):
        text = (out / "report.html").read_text(encoding="utf-8")
        found, count = check(text, out)
        pictures += count
        problems += [f"{out}: {problem}" for problem in found]
        for what, damaged in damages(text):
            tried += 1
            if not check(damaged, out)[0]:
                problems.append(f"{out}: {what} is not noticed")
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{len(sys.argv) - 1} pages with {pictures} pictures, {tried} damaged copies tried, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
