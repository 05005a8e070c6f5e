"""Makes the modules shared with the comparison in the plane available."""

import sys
from pathlib import Path

SHARED = Path(__file__).resolve().parent.parent / "calculix"
sys.path.append(str(SHARED))
