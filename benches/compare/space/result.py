"""What a code found: forces at the end of each stage and on the way, tractions of slave nodes, cost."""

from dataclasses import dataclass, field


@dataclass
class Result:
    code: str
    user: float  # s
    wall: float  # s
    peak: float  # MB
    iterations: int = 0
    why: str = ""  # Reason of a failure; empty where the run reached its end.
    forces: list = field(default_factory=list)  # (time, [x, y, z]), time 1 at the end of the first stage [N].
    pressures: dict = field(default_factory=dict)  # By node of the slave body [MPa].

    def ended(self):
        return not self.why
