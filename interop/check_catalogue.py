"""Reads the catalogues of a run with ObsPy, and exits non-zero if a check fails.

    python interop/check_catalogue.py out/catalogue

`events.quakeml` is validated against the schema of QuakeML 1.2. Times, positions, moments, tensors and nodal planes of both files are
compared with `events.json`. Planes are compared by tensors rebuilt from their angles, since nearly equal planes may have very different
angles. Copies that are corrupted on purpose must fail.
"""

import json
import re
import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np
from obspy import UTCDateTime, read_events
from obspy.imaging.scripts.mopad import MomentTensor
from obspy.io.quakeml.core import _validate as validate

NAMES = ["m_rr", "m_tt", "m_pp", "m_rt", "m_rp", "m_tp"]


def matrix(values):
    rr, tt, pp, rt, rp, tp = values
    return np.array([[rr, rt, rp], [rt, tt, tp], [rp, tp, pp]])


def of_plane(plane):
    """Tensor of unit moment of a nodal plane, in up, south, east."""
    angles = [float(plane[name]) for name in ("strike", "dip", "rake")]
    return np.array(MomentTensor(angles).get_M(system="USE"))


def of_obspy(plane):
    return of_plane({"strike": plane.strike, "dip": plane.dip, "rake": plane.rake})


class Problems(list):
    def expect(self, condition, message):
        if not condition:
            self.append(message)

    def near(self, found, expected, bound, message):
        self.expect(abs(found - expected) <= bound, f"{message}: {found}, expected {expected}")

    def tensors(self, found, expected, bound, message):
        off = np.abs(np.asarray(found) - np.asarray(expected)).max() / np.abs(expected).max()
        self.expect(off <= bound, f"{message}: off by {off:.1e}")


def tensor_of(event):
    tensor = event.focal_mechanisms[0].moment_tensor.tensor
    return matrix([tensor[name] for name in NAMES])


def check_quakeml(path, truth, problems):
    problems.expect(validate(str(path)), f"{path} does not fit the schema")
    events = read_events(str(path), format="QUAKEML")
    problems.expect(len(events) == len(truth), f"{path}: {len(events)} events, expected {len(truth)}")
    for k, (event, expected) in enumerate(zip(events, truth)):
        where = f"{path}, event {k + 1}"
        origin, focal = event.preferred_origin(), event.preferred_focal_mechanism()
        problems.expect(event.event_type == "other event", f"{where}: type {event.event_type}")
        problems.expect("imulated" in event.event_descriptions[0].text, f"{where} is not said to be simulated")
        problems.near(origin.time - UTCDateTime(expected["time"]), 0.0, 1e-6, f"{where}: time")
        for name in ("latitude", "longitude", "depth"):
            problems.near(getattr(origin, name), expected["hypocentre"][name], 1e-9, f"{where}: {name}")
        scale = 1.0 / np.sqrt(0.5 * (matrix(expected["tensor"]) ** 2).sum())
        double = matrix(expected["tensor"]) * scale
        # Slip on a planar fault is one double couple; slip on a curved fault would not be.
        planes = [focal.nodal_planes.nodal_plane_1, focal.nodal_planes.nodal_plane_2]
        for plane in planes:
            problems.tensors(of_obspy(plane), double, 1e-6, f"{where}: tensor of a plane")
        for angles in MomentTensor(expected["tensor"], system="USE").get_fps():
            names = dict(zip(("strike", "dip", "rake"), angles))
            problems.tensors(of_plane(names), of_obspy(planes[0]), 1e-6, f"{where}: tensor of mopad's plane")
        if expected["moment"] is None:
            problems.expect(not event.magnitudes, f"{where} has a magnitude without a length")
            problems.expect(focal.moment_tensor is None, f"{where} has a tensor without a length")
            continue
        problems.tensors(tensor_of(event), matrix(expected["tensor"]), 1e-12, f"{where}: tensor")
        found = focal.moment_tensor.scalar_moment
        problems.near(found / expected["moment"], 1.0, 1e-12, f"{where}: moment")
        problems.near(event.preferred_magnitude().mag, expected["magnitude"], 1e-9, f"{where}: magnitude")


def check_cmtsolution(path, truth, problems):
    events = read_events(str(path), format="CMTSOLUTION")
    problems.expect(len(events) == len(truth), f"{path}: {len(events)} events, expected {len(truth)}")
    for k, (event, expected) in enumerate(zip(events, truth)):
        where = f"{path}, event {k + 1}"
        centroid = event.preferred_origin()
        problems.near(centroid.time - UTCDateTime(expected["time"]), 0.0, 2e-6, f"{where}: time")
        for name, bound in (("latitude", 6e-5), ("longitude", 6e-5), ("depth", 0.06)):
            problems.near(getattr(centroid, name), expected["centroid"][name], bound, f"{where}: {name}")
        problems.tensors(tensor_of(event), matrix(expected["tensor"]), 1e-6, f"{where}: tensor")
        found = event.focal_mechanisms[0].moment_tensor.scalar_moment
        problems.near(found / expected["moment"], 1.0, 1e-5, f"{where}: moment")


def check(out):
    problems = Problems()
    truth = [event["located"] for event in json.loads((out / "events.json").read_text())]
    problems.expect(truth, f"{out}: no events")
    try:
        check_quakeml(out / "events.quakeml", truth, problems)
        if truth and truth[0]["moment"] is not None:
            check_cmtsolution(out / "CMTSOLUTION", truth, problems)
    except Exception as error:  # Any exception of a reader on a damaged file is another problem to list.
        problems.append(f"{type(error).__name__}: {error}")
    return problems, len(truth)


def changed(text, name, by):
    """The text with another value of the first quantity of this name."""
    start = text.index(f"<{name}>")
    end = text.index(f"</{name}>")
    value = float(text[start:end].split("<value>")[1].split("</value>")[0])
    return text[:start] + f"<{name}><value>{by(value)!r}</value>" + text[end:]


def flip(found):
    """The opposite sign before a number of fixed width."""
    return found[1] if found[2] else found[1][:-1] + "-"


def breaks(truth):
    """Ways to corrupt a file: its name and the change."""
    largest = max(range(6), key=lambda k: abs(truth["tensor"][k]))
    name = ["Mrr", "Mtt", "Mpp", "Mrt", "Mrp", "Mtp"][largest]
    yield "events.quakeml", "another strike", lambda t: changed(t, "strike", lambda v: v + 20)
    yield "events.quakeml", "an unknown element", lambda t: t.replace("<type>other event</type>", "<kind>x</kind>", 1)
    yield "events.quakeml", "half of the file", lambda t: t[: len(t) // 2]
    if truth["moment"] is not None:
        yield "events.quakeml", f"{name} of the other sign", lambda t: changed(t, name, lambda v: -v)
        yield "CMTSOLUTION", f"{name} of the other sign", lambda t: re.sub(f"({name}: *)(-?)", flip, t, count=1)
        yield "CMTSOLUTION", "another year", lambda t: t.replace(" SIM 2", " SIM 3", 1)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    out = Path(sys.argv[1])
    problems, count = check(out)
    tried = 0
    if count:
        truth = json.loads((out / "events.json").read_text())[0]["located"]
        for name, what, change in breaks(truth):
            with tempfile.TemporaryDirectory() as folder:
                copy = Path(folder)
                for file in ("events.json", "events.quakeml", "CMTSOLUTION"):
                    if (out / file).exists():
                        shutil.copy(out / file, copy / file)
                (copy / name).write_text(change((copy / name).read_text()))
                tried += 1
                problems.expect(check(copy)[0], f"{name} broken by {what} is accepted")
    for problem in problems:
        print(problem, file=sys.stderr)
    print(f"{count} events in two formats, {tried} broken files tried, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
