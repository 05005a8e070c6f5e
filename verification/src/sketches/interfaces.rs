//! Sketches of interfaces with rate-and-state friction, and of the sandwich.

use asperity_output::figures::Sketch;

pub(super) fn draw(name: &str) -> Option<Sketch> {
    let sketch = match name {
        "sandwich_pressed" => sandwich("0.00966 mm", "", "no friction, or μ(V)"),
        "sandwich_sheared" | "sandwich_steppers" => sandwich("0.00966 mm", "1 µm/s, to 0.05 mm", "μ(V)"),
        "sandwich_3d" => sandwich("0.00966 mm", "1 µm/s", "a layer of hex8, held in z"),
        "sandwich_state" => sandwich("0.0966 mm", "spring, 1 µm/s", "ageing law"),
        "stick_slip" => sandwich("0.0966 mm", "spring, 1 µm/s", "ageing law, radiation damping"),
        "stick_slip_inertia" => column("spring, 1 µm/s", "rigid, 540 kg/m²"),
        "stick_slip_inertia_events" => sandwich("0.066 mm", "spring, 1 µm/s", "ageing law, inertia"),
        "interface_rate_state" => column("1, 10, 1, 0, 1 µm/s", "a = 0.010, b = 0.015, L = 10 µm"),
        "interface_laws" => column("u(t)", "Coulomb, slip weakening, μ(V), μ(V, θ), static-kinetic"),
        "interface_instability" => bonded(),
        "interface_prestress" => prestress(),
        _ => return None,
    };
    Some(sketch)
}

fn sandwich(push: &str, drawn: &str, law: &str) -> Sketch {
    let sketch = Sketch::new(78.0)
        .block((26.0, 16.0), (44.0, 52.0), "A")
        .block((44.0, 10.0), (62.0, 60.0), "B")
        .fault(&[(44.0, 16.0), (44.0, 52.0)])
        .load((26.0, 18.0), (26.0, 50.0), (5.0, 0.0), "")
        .text((14.0, 56.0), push)
        .rollers((62.0, 10.0), (62.0, 60.0))
        .guide(&[(66.0, 6.0), (66.0, 66.0)])
        .note((68.0, 14.0), "symmetry")
        .rollers((26.0, 16.0), (44.0, 16.0))
        .dimension((26.0, 5.0), (44.0, 5.0), "25 mm")
        .dimension((75.0, 22.0), (75.0, 58.0), "50, 70 mm")
        .note((2.0, 73.0), law);
    if drawn.is_empty() {
        sketch
    } else {
        sketch.load((44.0, 60.0), (62.0, 60.0), (0.0, -5.0), "").note((63.0, 67.0), drawn)
    }
}

/// A column on a rigid base, pressed and sheared.
fn column(motion: &str, text: &str) -> Sketch {
    Sketch::new(66.0)
        .block((40.0, 18.0), (54.0, 50.0), "")
        .held((26.0, 18.0), (80.0, 18.0))
        .fault(&[(40.0, 18.0), (54.0, 18.0)])
        .load((40.0, 50.0), (54.0, 50.0), (0.0, -5.0), "10 MPa")
        .arrow((55.0, 48.0), (70.0, 48.0), "")
        .note((71.0, 48.0), motion)
        .dimension((32.0, 18.0), (32.0, 50.0), "0.2 m")
        .note((57.0, 30.0), "k = 1/(h/G + 1/E_t)")
        .text((50.0, 8.0), text)
}

fn bonded() -> Sketch {
    Sketch::new(68.0)
        .block((10.0, 10.0), (90.0, 20.0), "plate")
        .held((10.0, 10.0), (90.0, 10.0))
        .block((24.0, 20.0), (76.0, 32.0), "block, 1 × 0.2 m")
        .fault(&[(24.0, 20.0), (76.0, 20.0)])
        .block((24.0, 32.0), (76.0, 37.0), "")
        .note((78.0, 34.5), "soft bond")
        .block((10.0, 37.0), (90.0, 47.0), "plate")
        .arrow((62.0, 52.0), (80.0, 52.0), "")
        .note((81.0, 52.0), "1 µm/s")
        .load((14.0, 47.0), (54.0, 47.0), (0.0, -5.0), "10 MPa")
}

fn prestress() -> Sketch {
    Sketch::new(62.0)
        .body(&[(8.0, 10.0), (30.0, 10.0), (50.0, 44.6), (8.0, 44.6)], "ρ g")
        .body(&[(30.0, 10.0), (70.0, 10.0), (70.0, 44.6), (50.0, 44.6)], "ρ g")
        .fault(&[(30.0, 10.0), (50.0, 44.6)])
        .held((8.0, 10.0), (70.0, 10.0))
        .held((8.0, 44.6), (8.0, 10.0))
        .held((70.0, 10.0), (70.0, 44.6))
        .text((40.0, 15.0), "60°")
        .dimension((82.0, 10.0), (82.0, 44.6), "1 km")
        .text((40.0, 52.0), "σ_yy = −ρ g depth, σ_xx half of it")
        .text((40.0, 3.0), "also a ramp of 27°, and blocks pressed by σ")
}
