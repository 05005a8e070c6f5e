//! Sketches of faults through earthquake cycles.

use asperity_output::figures::Sketch;

pub(super) fn draw(name: &str) -> Option<Sketch> {
    let sketch = match name {
        "seas_bp1" | "seas_bp1_fd" | "seas_bp1_full" | "seas_bp1_25m" | "seas_bp1_methods" => {
            strike_slip("8 mm", "16", "40 km")
        }
        "seas_bp1_16mm" | "seas_bp1_16mm_limit" => strike_slip("16 mm", "16", "40 km"),
        "seas_bp2" => strike_slip("4 mm", "16", "40 km"),
        "fault_balance" => strike_slip("40 mm", "", "24 km"),
        "fault_compression" => strike_slip("8 mm", "16", "40 km"),
        "seas_bp3" | "seas_bp3_full" => dipping(60.0, "dip 90, 60, 30°; 40 km along the dip"),
        "seas_bp3_25m" => dipping(90.0, "dip 90°; 40 km along the dip"),
        "fault_operator" => dipping(60.0, "dip 90, 60, 30°; buried, and from the surface"),
        "fault_medium" => dipping(60.0, "cells of uniform slip, without bodies"),
        "seas_bp4" | "seas_bp4_500m" | "seas_bp5" | "seas_bp5_limit" | "seas_bp7" => plane(),
        "fault_gravity" => gravity(),
        "fault_opening" => opening(),
        "fault_pressing" => pressed(),
        "fault_bend" => bend(),
        "fault_free_surface" => surface(),
        "fault_stability" => layers("δV ~ cos(k x) e^(s t), k = n π/W", "", "W"),
        "fault_space" => layers("slip along a declared direction, in space", "", ""),
        "fault_turning" => layers("slip turns in the plane of the fault, k = G/W", "W", ""),
        "fault_handover" => slabs(),
        "fault_bodies" => bodies(),
        "event_numbers" => unlike(),
        "seas_bp6" => injection(),
        "fluid_along_fault" => fluid(),
        "frictional_heat" => zone(),
        "dynamic_rupture" => rupture(),
        "rupture_in_space" | "rupture_in_space_full" => plane_rupture(),
        "kostrov_crack" => growing(),
        "unlike_rocks" => contrast(),
        _ => return None,
    };
    Some(sketch)
}

/// A vertical fault below a free surface, antiplane.
fn strike_slip(length: &str, weak: &str, depth: &str) -> Sketch {
    let sketch = Sketch::new(76.0)
        .block((12.0, 6.0), (88.0, 64.0), "")
        .fault(&[(50.0, 64.0), (50.0, 22.0)])
        .guide(&[(50.0, 22.0), (50.0, 6.0)])
        .text((50.0, 70.0), "free surface")
        .text((24.0, 54.0), "⊙ V_p/2")
        .text((76.0, 54.0), "⊗ V_p/2")
        .note((54.0, 44.0), &format!("L = {length}"))
        .note((54.0, 36.0), "ageing law, η")
        .note((54.0, 13.0), "V_p = 1e−9 m/s")
        .dimension((34.0, 22.0), (34.0, 64.0), depth);
    if weak.is_empty() { sketch } else { sketch.dimension((45.0, 47.0), (45.0, 64.0), weak) }
}

/// Two blocks, one of which is pushed against the other, which a spring then pulls down.
fn pressed() -> Sketch {
    Sketch::new(72.0)
        .block((20.0, 10.0), (50.0, 60.0), "")
        .block((50.0, 10.0), (80.0, 60.0), "")
        .fault(&[(50.0, 10.0), (50.0, 60.0)])
        .text((35.0, 36.0), "A")
        .text((65.0, 36.0), "B")
        .text((10.0, 36.0), "u →")
        .text((65.0, 66.0), "spring ↓ V")
        .note((52.0, 14.0), "τ = 0 while pressed")
        .dimension((20.0, 5.0), (80.0, 5.0), "w")
}

/// Two slabs between springs and dashpots.
fn slabs() -> Sketch {
    Sketch::new(64.0)
        .block((30.0, 12.0), (70.0, 52.0), "")
        .fault(&[(50.0, 12.0), (50.0, 52.0)])
        .text((40.0, 36.0), "⊙")
        .text((60.0, 36.0), "⊗")
        .text((16.0, 36.0), "spring κ")
        .text((16.0, 28.0), "absorbing")
        .text((84.0, 36.0), "spring κ")
        .text((84.0, 28.0), "absorbing")
        .note((54.0, 20.0), "uniform slip")
        .dimension((30.0, 6.0), (50.0, 6.0), "W")
}

/// A fault in the middle of rock with absorbing sides.
fn rupture() -> Sketch {
    Sketch::new(64.0)
        .block((8.0, 6.0), (92.0, 58.0), "")
        .fault(&[(20.0, 32.0), (80.0, 32.0)])
        .guide(&[(8.0, 32.0), (92.0, 32.0)])
        .text((50.0, 38.0), "hypocentre")
        .text((50.0, 52.0), "absorbing sides")
        .note((58.0, 24.0), "split nodes, 100 m apart")
        .dimension((20.0, 14.0), (80.0, 14.0), "30 km, or W + w")
}

/// The plane of a rectangular fault with its square of higher traction.
fn plane_rupture() -> Sketch {
    let corners = |from: (f64, f64), to: (f64, f64)| [from, (to.0, from.1), to, (from.0, to.1), from];
    Sketch::new(64.0)
        .block((8.0, 6.0), (92.0, 58.0), "")
        .fault(&corners((20.0, 16.0), (80.0, 46.0)))
        .guide(&corners((47.0, 28.0), (53.0, 34.0)))
        .arrow((55.0, 31.0), (68.0, 31.0), "slip")
        .text((50.0, 52.0), "beyond the fault the rock holds together")
        .note((26.0, 38.0), "70 MPa, in the square 81.6 MPa")
        .dimension((20.0, 11.0), (80.0, 11.0), "30 km")
        .dimension((15.0, 16.0), (15.0, 46.0), "15 km")
}

/// A crack whose ends run apart.
fn growing() -> Sketch {
    Sketch::new(64.0)
        .block((8.0, 6.0), (92.0, 58.0), "")
        .fault(&[(30.0, 32.0), (70.0, 32.0)])
        .guide(&[(8.0, 32.0), (92.0, 32.0)])
        .arrow((70.0, 36.0), (80.0, 36.0), "v")
        .arrow((30.0, 36.0), (20.0, 36.0), "v")
        .text((50.0, 50.0), "absorbing sides, out of reach")
        .note((58.0, 24.0), "Δτ = 1 MPa")
        .dimension((30.0, 14.0), (70.0, 14.0), "2 v t")
}

/// A fault between rocks of unlike speeds.
fn contrast() -> Sketch {
    Sketch::new(64.0)
        .block((8.0, 6.0), (92.0, 32.0), "c_s/1.2, ρ/1.2")
        .block((8.0, 32.0), (92.0, 58.0), "c_s, ρ")
        .fault(&[(8.0, 32.0), (92.0, 32.0)])
        .note((50.0, 36.0), "imposed traction within R")
        .dimension((44.0, 26.0), (56.0, 26.0), "2 R")
}

/// The zone that friction heats.
fn zone() -> Sketch {
    Sketch::new(64.0)
        .block((8.0, 8.0), (92.0, 28.0), "")
        .block((8.0, 36.0), (92.0, 56.0), "")
        .guide(&[(8.0, 32.0), (92.0, 32.0)])
        .text((50.0, 32.0), "q = τ V heats rock and fluid")
        .text((50.0, 46.0), "heat and fluid escape across the fault")
        .text((50.0, 18.0), "T − T_0 and p at the centre change friction")
        .dimension((86.0, 28.0), (86.0, 36.0), "h")
}

/// The plane of the fault of BP5.
fn plane() -> Sketch {
    Sketch::new(70.0)
        .block((5.0, 12.0), (95.0, 54.0), "a > b")
        .block((20.0, 37.0), (80.0, 50.0), "a < b")
        .guide(&[(36.0, 37.0), (36.0, 50.0)])
        .text((50.0, 59.0), "free surface")
        .text((50.0, 24.0), "V_p = 1e−9 m/s beyond the sides and below")
        .dimension((5.0, 7.0), (95.0, 7.0), "100 km")
        .dimension((20.0, 33.0), (80.0, 33.0), "60 km")
        .dimension((90.0, 12.0), (90.0, 54.0), "40")
        .note((22.0, 43.0), "seed")
}

fn dipping(dip: f64, text: &str) -> Sketch {
    let (s, c) = dip.to_radians().sin_cos();
    let end = (40.0 + 46.0 * c, 62.0 - 46.0 * s);
    let rock = Sketch::new(76.0)
        .block((6.0, 10.0), (94.0, 62.0), "")
        .fault(&[(40.0, 62.0), end])
        .text((30.0, 67.0), "free surface")
        .text((50.0, 4.0), text);
    let beyond = (end.0 + 5.0 * c, end.1 - 5.0 * s);
    let (along, across) = ((9.0 * c, 9.0 * s), (5.0 * s, 5.0 * c));
    let middle = (40.0 + 23.0 * c, 62.0 - 23.0 * s);
    let upper = (middle.0 + across.0, middle.1 + across.1);
    let lower = (middle.0 - across.0, middle.1 - across.1);
    rock.guide(&[end, beyond])
        .arrow((upper.0 + along.0, upper.1 - along.1), upper, "")
        .arrow((lower.0 - along.0, lower.1 + along.1), lower, "")
        .note((70.0, 52.0), "f_n = 50 MPa")
        .note((70.0, 45.0), "V_p = 1e−9 m/s")
}

fn gravity() -> Sketch {
    Sketch::new(70.0)
        .block((14.0, 12.0), (86.0, 60.0), "")
        .fault(&[(40.0, 60.0), (53.9, 36.0)])
        .rollers((14.0, 60.0), (14.0, 12.0))
        .rollers((86.0, 12.0), (86.0, 60.0))
        .rollers((14.0, 12.0), (86.0, 12.0))
        .arrow((28.0, 40.0), (28.0, 26.0), "ρ g")
        .note((50.0, 53.0), "dip 30 to 75°")
        .text((50.0, 65.0), "free surface")
}

fn opening() -> Sketch {
    Sketch::new(58.0)
        .block((24.0, 12.0), (76.0, 46.0), "")
        .fault(&[(50.0, 36.0), (50.0, 22.0)])
        .load((17.0, 14.0), (17.0, 44.0), (-6.0, 0.0), "")
        .load((83.0, 44.0), (83.0, 14.0), (6.0, 0.0), "")
        .dimension((42.0, 22.0), (42.0, 36.0), "4 km")
        .note((53.0, 29.0), "opens")
        .dimension((24.0, 6.0), (76.0, 6.0), "400 km")
        .text((50.0, 52.0), "pulled evenly; normal fault, thrust")
}

fn bend() -> Sketch {
    Sketch::new(66.0)
        .block((16.0, 8.0), (84.0, 58.0), "")
        .fault(&[(46.0, 56.0), (46.0, 34.0), (57.0, 15.0)])
        .guide(&[(46.0, 34.0), (46.0, 14.0)])
        .text((50.5, 18.0), "30°")
        .dimension((34.0, 15.0), (34.0, 56.0), "30 km")
        .arrow((22.0, 24.0), (22.0, 40.0), "")
        .arrow((78.0, 40.0), (78.0, 24.0), "")
        .text((50.0, 62.0), "plate, plane strain")
}

fn surface() -> Sketch {
    Sketch::new(60.0)
        .body(&[(8.0, 40.0), (38.0, 54.0), (94.0, 54.0), (64.0, 40.0)], "")
        .body(&[(8.0, 40.0), (64.0, 40.0), (64.0, 8.0), (8.0, 8.0)], "")
        .body(&[(64.0, 40.0), (94.0, 54.0), (94.0, 22.0), (64.0, 8.0)], "")
        .fault(&[(36.0, 40.0), (66.0, 54.0)])
        .fault(&[(36.0, 40.0), (36.0, 22.0)])
        .arrow((46.0, 38.0), (46.0, 28.0), "")
        .note((40.0, 25.0), "slip, 6 km")
        .text((24.0, 57.0), "free surface")
        .text((24.0, 12.0), "10 GPa")
        .text((52.0, 12.0), "40 GPa")
}

fn layers(text: &str, thickness: &str, length: &str) -> Sketch {
    let sketch = Sketch::new(56.0)
        .block((12.0, 12.0), (84.0, 26.0), "G")
        .block((12.0, 26.0), (84.0, 40.0), "G")
        .fault(&[(12.0, 26.0), (84.0, 26.0)])
        .arrow((40.0, 43.0), (62.0, 43.0), "")
        .note((63.0, 44.0), "V/2")
        .arrow((62.0, 8.0), (40.0, 8.0), "")
        .note((63.0, 8.0), "V/2")
        .text((50.0, 2.5), text);
    let sketch =
        if thickness.is_empty() { sketch } else { sketch.dimension((90.0, 12.0), (90.0, 40.0), thickness) };
    if length.is_empty() { sketch } else { sketch.dimension((12.0, 50.0), (84.0, 50.0), length) }
}

/// Faults between unlike rocks, as blocks and as slabs.
fn unlike() -> Sketch {
    Sketch::new(70.0)
        .block((8.0, 24.0), (20.0, 48.0), "10")
        .block((20.0, 24.0), (32.0, 48.0), "40 GPa")
        .fault(&[(20.0, 24.0), (20.0, 48.0)])
        .arrow((14.0, 51.0), (14.0, 58.0), "")
        .arrow((26.0, 58.0), (26.0, 51.0), "")
        .dimension((8.0, 18.0), (32.0, 18.0), "2 km")
        .text((20.0, 8.0), "all points slip alike")
        .block((48.0, 14.0), (70.0, 60.0), "10 GPa")
        .block((70.0, 14.0), (92.0, 60.0), "40 GPa")
        .fault(&[(70.0, 14.0), (70.0, 60.0)])
        .dimension((44.0, 14.0), (44.0, 60.0), "6 km")
        .text((70.0, 8.0), "an event in the upper 4 km")
}

fn bodies() -> Sketch {
    Sketch::new(70.0)
        .block((6.0, 10.0), (46.0, 58.0), "")
        .fault(&[(18.0, 50.0), (18.0, 26.0)])
        .fault(&[(34.0, 50.0), (34.0, 26.0)])
        .text((26.0, 63.0), "free surface")
        .text((26.0, 17.0), "two faults")
        .block((54.0, 10.0), (94.0, 58.0), "")
        .fault(&Sketch::arc((92.0, 58.0), 26.0, 180.0, 225.0))
        .note((58.0, 17.0), "an arc, 90 to 45°")
        .text((50.0, 4.0), "also a crack, and pairs of blocks")
}

fn fluid() -> Sketch {
    Sketch::new(58.0)
        .block((10.0, 8.0), (90.0, 50.0), "")
        .fault(&[(16.0, 29.0), (84.0, 29.0)])
        .arrow((38.0, 46.0), (38.0, 30.5), "")
        .note((41.0, 43.0), "q")
        .note((18.0, 34.0), "k₁, S₁")
        .note((66.0, 34.0), "k₂, S₂")
        .dimension((16.0, 20.0), (84.0, 20.0), "16 km")
        .text((50.0, 13.0), "S ∂p/∂t = ∂(k/η ∂p/∂x)/∂x + q δ")
}

fn injection() -> Sketch {
    Sketch::new(58.0)
        .block((10.0, 8.0), (90.0, 50.0), "")
        .fault(&[(16.0, 29.0), (84.0, 29.0)])
        .arrow((50.0, 46.0), (50.0, 30.5), "")
        .note((53.0, 43.0), "q for 100 days")
        .note((18.0, 34.0), "p(x, t)")
        .dimension((16.0, 20.0), (84.0, 20.0), "40 km")
        .text((50.0, 13.0), "a > b; f_n = σ − p")
}
