//! A fault through earthquake cycles.

/// A vertical strike-slip fault on coarse cells, with events every 100 yr or so: three of them.
pub const SCENE: &str = r#"schema = 1
title = "cycles"
kinematics = "antiplane"
[materials.rock]
young = "80 GPa"
poisson = 0.25
density = 2670
[bodies.crust]
material = "rock"
mesh.fault = { trace = [["0 km", "0 km"], ["0 km", "-15 km"], ["0 km", "-18 km"], ["0 km", "-24 km"], ["0 km", "-80 km"]], spacing = [["0 km", "750 m"], ["24 km", "1 km"], ["80 km", "20 km"]], min = ["-80 km", "-80 km"], max = ["80 km", "0 km"], growth = 1.5, element = "quad4" }
[faults.main]
minus = "crust.fault.minus"
plus = "crust.fault.plus"
law = { kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.010, b = 0.015, l = "40 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }
profiles.a = { along = "distance", points = [["15 km", 0.010], ["18 km", 0.025]] }
normal = "50 MPa"
rate = "1e-9 m/s"
damping = "radiation"
creep = { beyond = "24 km", rate = "1e-9 m/s" }
[[stages]]
name = "cycles"
duration = "3000 yr"
conditions = [{ set = "crust.left", z = { rate = "-0.5e-9 m/s" } }, { set = "crust.right", z = { rate = "0.5e-9 m/s" } }]
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
stop_after = 3
[output]
stations.main = ["0 km", "7.5 km", "15 km"]
"#;
