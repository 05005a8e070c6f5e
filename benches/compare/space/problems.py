"""The problems: two bodies, `upper` (slave) on `lower` (master), moved by stages. Units are mm and MPa."""

from dataclasses import dataclass, field

import numpy as np

from bodies import crossed_cylinders, curve_bottom, graded, grid


@dataclass
class Stage:
    """`moved` gives displacements of sides at the end of the stage, `{side: {axis: value}}`, in equal `steps`."""

    moved: dict
    steps: int


@dataclass
class Problem:
    name: str
    bodies: dict
    contact: dict  # Side of each body.
    young: dict
    stages: list
    held: dict  # Sides that do not move along axes, in all stages.
    loaded: str  # Side of the upper body whose force is reported.
    friction: float = 0.0
    finite: bool = False
    plastic: tuple = None  # Yield stress, hardening modulus.
    poisson: float = 0.3
    released: float = 1.0  # Distance over which contact is looked for.
    unknowns: int = field(init=False)

    def __post_init__(self):
        self.unknowns = sum(b.unknowns() for b in self.bodies.values())


def blocks(size):
    """A block of 20 x 10 x 20 on one of 30 x 10 x 30, pressed by 0.05 and sheared by 0.02."""
    (nx, ny), (mx, my) = {5: ((12, 6), (10, 3)), 20: ((20, 10), (17, 5)), 80: ((33, 16), (26, 9)), 1: ((5, 3), (4, 2))}[size]
    across, along = np.linspace(5, 25, nx + 1), np.linspace(0, 30, mx + 1)
    return Problem(
        "blocks",
        {"upper": grid(across, np.linspace(0, 10, ny + 1), across), "lower": grid(along, np.linspace(-10, 0, my + 1), along)},
        {"upper": "bottom", "lower": "top"},
        {"upper": 1000.0, "lower": 1000.0},
        [Stage({"upper.top": {"y": -0.05}}, 1), Stage({"upper.top": {"x": 0.02}}, 5)],
        {"lower.bottom": "xyz", "upper.top": "xz"},
        "top",
        friction=0.3,
    )


BALL_RADIUS = 8.0


def ball(size):
    """A ball (paraboloid) on a block without friction, both some ten radii of contact wide."""
    # Fine and coarse cells along and across the surface, of the ball and of the block.
    (n, m, ny, my), (k, l, ky, ly) = {
        5: ((4, 3, 3, 2), (3, 2, 2, 3)),
        20: ((6, 4, 5, 4), (5, 3, 4, 3)),
        80: ((11, 6, 8, 5), (8, 5, 7, 5)),
        1: ((2, 2, 2, 1), (2, 1, 2, 1)),
    }[size]
    across = lambda fine, coarse: (lambda half: np.concatenate([-half[:0:-1], half]))(graded(fine, 0.6, coarse, 5.0))
    x, y = across(n, m), graded(ny, 0.6, my, 5.0)
    upper = curve_bottom(grid(x, y, x), lambda x, z: (x**2 + z**2) / (2 * BALL_RADIUS))
    x, y = across(k, l), -graded(ky, 0.6, ly, 5.0)[::-1]
    return Problem(
        "ball",
        {"upper": upper, "lower": grid(x, y, x)},
        {"upper": "bottom", "lower": "top"},
        {"upper": 1000.0, "lower": 1000.0},
        [Stage({"upper.top": {"y": -0.027}}, 1)],
        {"lower.bottom": "xyz", "upper.top": "xz"},
        "top",
        released=0.5,
    )


def cylinders(size, plastic=False):
    """Crossed cylinders, pressed by 0.02 and slid by 0.01."""
    upper, lower = crossed_cylinders({1: 4.0, 5: 3.0, 20: 1.25, 80: 0.72}[size])
    return Problem(
        "cylinders, plastic" if plastic else "cylinders",
        {"upper": upper, "lower": lower},
        {"upper": "contact", "lower": "contact"},
        {"upper": 210e3, "lower": 210e3},
        [Stage({"upper.far": {"y": -0.02}}, 4), Stage({"upper.far": {"x": 0.01}}, 5)],
        {"lower.far": "xyz", "upper.far": "xz"},
        "far",
        friction=0.4,
        plastic=(400.0, 5000.0) if plastic else None,
    )


def ironing(size):
    """Half of a crowned die, pressed by 0.04 into half of a softer slab and drawn by 2: finite sliding."""
    (nx, ny, nz), (mx, my, mz) = {
        5: ((8, 4, 4), (28, 4, 8)),
        20: ((14, 7, 7), (48, 6, 14)),
        80: ((22, 10, 11), (80, 10, 24)),
        1: ((5, 2, 3), (16, 2, 4)),
    }[size]
    die = grid(np.linspace(0.8, 2.0, nx + 1), np.linspace(0, 0.6, ny + 1), np.linspace(0, 0.6, nz + 1))
    slab = grid(np.linspace(0, 5, mx + 1), np.linspace(-1, 0, my + 1), np.linspace(0, 1.5, mz + 1))
    return Problem(
        "ironing",
        {"upper": curve_bottom(die, lambda x, z: ((x - 1.4) ** 2 + z**2) / 6), "lower": slab},
        {"upper": "bottom", "lower": "top"},
        {"upper": 10.0, "lower": 1.0},
        [Stage({"upper.top": {"y": -0.04}}, 4), Stage({"upper.top": {"x": 2.0}}, 40)],
        {"lower.bottom": "xyz", "upper.top": "xz", "upper.back": "z", "lower.back": "z"},
        "top",
        friction=0.2,
        finite=True,
        released=0.4,
    )


PROBLEMS = {
    "blocks": blocks,
    "ball": ball,
    "cylinders": cylinders,
    "cylinders-plastic": lambda size: cylinders(size, plastic=True),
    "ironing": ironing,
}
