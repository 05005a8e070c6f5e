//! Sketches of contact problems.

use asperity_output::figures::Sketch;

pub(super) fn draw(name: &str) -> Option<Sketch> {
    let sketch = match name {
        "block_dragged" => dragged(),
        "contact_combinations" | "contact_combinations_all" | "contact_combinations_space" => die(),
        "contact_enforcement" => enforcement(),
        "contact_extremes" => pushed("μ", "other units, orders, numberings and extreme meshes"),
        "contact_facets" => round("R = 1 m", "drawn at 25° to the grid, μ = 0.3"),
        "contact_hard" => hard(),
        "contact_invariance" => round("round", "turned by 37°, mirrored, in mm and MPa"),
        "contact_patch" => patch("equal meshes"),
        "contact_patch_mortar" => patch("meshes that do not match"),
        "contact_rotation" => rotation(),
        "contact_sliding" => sliding(),
        "coulomb_strip" => strip(),
        "first_slip" => first_slip(),
        "flat_punch" => punch(),
        "frictional_bar" => bar(),
        "frictional_crack" => crack(),
        "impact_balls" => balls(),
        "impact_bars" => impact(),
        "hertz_line" => hertz("R = 100 mm", "δ = 18.6 µm", "40 × 20 mm, steel", ""),
        "partial_slip" => hertz("R = 100 mm", "δ = 18.6 µm", "40 × 20 mm, steel, μ = 0.3", "4 µm, and back"),
        "hertz_sphere" => hertz("R = 8 mm", "δ = 18 µm", "rigid flat, about the axis", ""),
        "hertz_ball" => hertz("R = 8 mm", "δ = 18 µm", "three dimensions, μ = 0.3", "3.2 µm"),
        "nafems_roller" => hertz("R = 50 mm", "35 kN/mm", "aluminium, 200 × 200 mm", ""),
        "press_fit" => press_fit(),
        "two_rings" => rings(),
        "wavy_sliding" => wavy(),
        _ => return None,
    };
    Some(sketch)
}

fn dragged() -> Sketch {
    Sketch::new(58.0)
        .block((26.0, 14.0), (74.0, 38.0), "E = 130 GPa")
        .held((18.0, 14.0), (88.0, 14.0))
        .fault(&[(26.0, 14.0), (74.0, 14.0)])
        .load((26.0, 38.0), (74.0, 38.0), (0.0, -6.0), "50 MPa")
        .load((26.0, 16.0), (26.0, 37.0), (6.0, 0.0), "150 MPa")
        .rollers((74.0, 14.0), (74.0, 38.0))
        .dimension((26.0, 5.0), (74.0, 5.0), "40 mm")
        .dimension((90.0, 14.0), (90.0, 38.0), "20 mm")
        .text((62.0, 10.0), "μ = 1")
}

fn die() -> Sketch {
    Sketch::new(58.0)
        .block((12.0, 10.0), (88.0, 28.0), "slab")
        .held((12.0, 10.0), (88.0, 10.0))
        .body(&[(34.0, 30.0), (38.0, 28.0), (56.0, 28.0), (60.0, 30.0), (60.0, 42.0), (34.0, 42.0)], "die")
        .fault(&[(36.0, 28.5), (40.0, 28.0), (54.0, 28.0), (58.0, 28.5)])
        .load((34.0, 42.0), (60.0, 42.0), (0.0, -5.0), "pressed")
        .arrow((61.0, 36.0), (74.0, 36.0), "")
        .note((75.0, 36.0), "drawn, 3 cells")
        .text((50.0, 4.0), "flat or round; elastic or plastic; all laws")
}

/// A square on another.
fn pair() -> Sketch {
    Sketch::new(74.0)
        .block((34.0, 12.0), (60.0, 36.0), "")
        .block((34.0, 36.0), (60.0, 60.0), "")
        .fault(&[(34.0, 36.0), (60.0, 36.0)])
}

fn enforcement() -> Sketch {
    pair()
        .held((34.0, 12.0), (60.0, 12.0))
        .load((34.0, 60.0), (60.0, 60.0), (0.0, -5.0), "d = 10 mm")
        .arrow((61.0, 58.0), (74.0, 58.0), "")
        .note((75.0, 58.0), "U = 20 mm")
        .note((62.0, 36.0), "μ = 0.3")
        .dimension((26.0, 12.0), (26.0, 36.0), "1 m")
        .dimension((34.0, 5.0), (60.0, 5.0), "1 m")
        .note((62.0, 24.0), "E = 1000 Pa, ν = 0")
}

fn pushed(friction: &str, text: &str) -> Sketch {
    Sketch::new(54.0)
        .block((14.0, 10.0), (86.0, 22.0), "")
        .held((14.0, 10.0), (86.0, 10.0))
        .block((36.0, 22.0), (58.0, 36.0), "")
        .fault(&[(36.0, 22.0), (58.0, 22.0)])
        .load((36.0, 36.0), (58.0, 36.0), (0.0, -5.0), "p")
        .arrow((20.0, 29.0), (36.0, 29.0), "")
        .note((60.0, 26.0), friction)
        .text((50.0, 4.0), text)
}

fn round(radius: &str, text: &str) -> Sketch {
    let mut top = Sketch::arc((46.0, 62.0), 36.0, 242.0, 298.0);
    top.extend([(62.9, 46.0), (29.1, 46.0)]);
    Sketch::new(62.0)
        .block((10.0, 10.0), (90.0, 26.0), "")
        .held((10.0, 10.0), (90.0, 10.0))
        .body(&top, "")
        .fault(&Sketch::arc((46.0, 62.0), 36.0, 262.0, 278.0))
        .load((29.1, 46.0), (62.9, 46.0), (0.0, -5.0), "pressed")
        .arrow((64.0, 40.0), (78.0, 40.0), "")
        .note((79.0, 40.0), "drawn")
        .text((46.0, 38.0), radius)
        .text((50.0, 4.0), text)
}

fn hard() -> Sketch {
    Sketch::new(62.0)
        .body(&[(4.0, 10.0), (44.0, 10.0), (44.0, 28.0)], "")
        .body(&[(18.0, 16.3), (32.0, 22.6), (28.0, 31.5), (14.0, 25.2)], "ρ g")
        .fault(&[(18.0, 16.3), (32.0, 22.6)])
        .note((4.0, 40.0), "slope of 0.9 and 0.99 μ")
        .block((56.0, 10.0), (94.0, 22.0), "")
        .held((56.0, 10.0), (94.0, 10.0))
        .body(&[(75.0, 22.5), (85.0, 34.0), (75.0, 45.0), (65.0, 34.0)], "")
        .arrow((75.0, 55.0), (75.0, 46.0), "corner on a node")
        .text((50.0, 4.0), "shear at, below and above the limit; gaps, overlaps")
}

fn patch(text: &str) -> Sketch {
    pair()
        .rollers((34.0, 12.0), (60.0, 12.0))
        .rollers((34.0, 60.0), (34.0, 12.0))
        .load((34.0, 60.0), (60.0, 60.0), (0.0, -5.0), "u_y = −d")
        .note((62.0, 36.0), "no friction")
        .note((62.0, 24.0), text)
}

fn rotation() -> Sketch {
    let at = |x: f64, y: f64| {
        let (s, c) = 20.0_f64.to_radians().sin_cos();
        (40.0 + x * c - y * s, 10.0 + x * s + y * c)
    };
    Sketch::new(66.0)
        .body(&[at(0.0, 0.0), at(36.0, 0.0), at(36.0, 16.0), at(0.0, 16.0)], "")
        .body(&[at(9.0, 16.0), at(27.0, 16.0), at(27.0, 32.0), at(9.0, 32.0)], "")
        .fault(&[at(9.0, 16.0), at(27.0, 16.0)])
        .line(&Sketch::arc((40.0, 10.0), 46.0, 8.0, 62.0))
        .text((14.0, 12.0), "centre ×")
        .note((66.0, 54.0), "360°, 15° a step")
        .note((4.0, 58.0), "pressed 40 mm, sheared 10 mm, μ = 0.9")
}

fn sliding() -> Sketch {
    Sketch::new(58.0)
        .body(&[(8.0, 12.0), (92.0, 12.0), (92.0, 24.0), (8.0, 16.0)], "")
        .held((8.0, 12.0), (92.0, 12.0))
        .body(&[(30.0, 18.1), (58.0, 20.8), (58.0, 34.0), (30.0, 34.0)], "")
        .fault(&[(30.0, 18.1), (58.0, 20.8)])
        .load((30.0, 34.0), (58.0, 34.0), (0.0, -5.0), "G")
        .arrow((18.0, 27.0), (30.0, 27.0), "F")
        .note((62.0, 29.0), "μ = 0 to 0.3")
        .text((50.0, 5.0), "slope of 0.1, over segments and ends; a cone; a die")
}

fn strip() -> Sketch {
    pair()
        .held((34.0, 12.0), (60.0, 12.0))
        .load((34.0, 60.0), (60.0, 60.0), (0.0, -5.0), "p = 4 Pa")
        .arrow((61.0, 58.0), (74.0, 58.0), "")
        .note((75.0, 58.0), "±8.2 mm, twice")
        .note((62.0, 36.0), "μ p = 1 Pa")
        .dimension((26.0, 12.0), (26.0, 60.0), "2 m")
        .dimension((34.0, 5.0), (60.0, 5.0), "1 m")
}

fn punch() -> Sketch {
    Sketch::new(62.0)
        .block((10.0, 8.0), (90.0, 34.0), "half-plane of 100 a")
        .held((10.0, 8.0), (90.0, 8.0))
        .block((40.0, 34.0), (60.0, 46.0), "rigid")
        .fault(&[(40.0, 34.0), (60.0, 34.0)])
        .load((40.0, 46.0), (60.0, 46.0), (0.0, -5.0), "P")
        .dimension((50.0, 31.0), (60.0, 31.0), "")
        .text((55.0, 27.0), "a = 1 mm")
        .guide(&[(50.0, 29.0), (50.0, 40.0)])
        .note((62.0, 38.0), "no friction")
}

fn first_slip() -> Sketch {
    Sketch::new(66.0)
        .block((24.0, 10.0), (64.0, 32.0), "held")
        .block((29.0, 32.0), (55.0, 54.0), "held")
        .fault(&[(29.0, 32.0), (55.0, 32.0)])
        .load((29.0, 54.0), (55.0, 54.0), (0.0, -5.0), "10 mm; then +15, 0, −5 mm")
        .arrow((56.0, 48.0), (68.0, 48.0), "")
        .note((69.0, 48.0), "20 mm")
        .note((66.0, 32.0), "ε = 1000 Pa/m, along and across")
        .dimension((24.0, 5.0), (64.0, 5.0), "1 m")
}

fn bar() -> Sketch {
    Sketch::new(46.0)
        .block((18.0, 18.0), (88.0, 24.0), "")
        .held((10.0, 18.0), (94.0, 18.0))
        .fault(&[(18.0, 18.0), (88.0, 18.0)])
        .load((18.0, 24.0), (88.0, 24.0), (0.0, -5.0), "p = 100 Pa")
        .arrow((6.0, 21.0), (17.0, 21.0), "")
        .note((3.0, 27.0), "0.25 m")
        .dimension((18.0, 9.0), (88.0, 9.0), "150 m")
        .note((70.0, 13.0), "μ = 0.5")
}

fn impact() -> Sketch {
    Sketch::new(36.0)
        .block((8.0, 14.0), (48.0, 20.0), "")
        .block((52.0, 14.0), (92.0, 20.0), "")
        .arrow((20.0, 25.0), (34.0, 25.0), "2 m/s")
        .note((62.0, 26.0), "at rest")
        .dimension((8.0, 7.0), (48.0, 7.0), "100 mm")
        .note((56.0, 8.0), "c = 5000 m/s, ρ = 8000 kg/m³")
}

fn balls() -> Sketch {
    let ball = |y: f64| Sketch::arc((36.0, y), 16.0, 0.0, 360.0);
    Sketch::new(76.0)
        .body(&ball(22.0), "")
        .body(&ball(54.5), "")
        .guide(&[(36.0, 3.0), (36.0, 73.0)])
        .arrow((58.0, 62.0), (58.0, 48.0), "")
        .note((61.0, 55.0), "V = 1 to 16 m/s")
        .note((61.0, 38.0), "no friction")
        .note((61.0, 22.0), "at rest")
        .dimension((20.0, 22.0), (36.0, 22.0), "")
        .text((28.0, 25.0), "10 mm")
        .note((61.0, 12.0), "E = 200 GPa, ν = 0.3")
        .note((61.0, 6.0), "ρ = 7800 kg/m³")
}

fn crack() -> Sketch {
    let (s, c) = 20.0_f64.to_radians().sin_cos();
    Sketch::new(70.0)
        .block((22.0, 12.0), (78.0, 56.0), "")
        .load((22.0, 56.0), (78.0, 56.0), (0.0, -6.0), "s = 100 MPa")
        .load((78.0, 12.0), (22.0, 12.0), (0.0, 6.0), "")
        .fault(&[(50.0 - 16.0 * s, 34.0 - 16.0 * c), (50.0 + 16.0 * s, 34.0 + 16.0 * c)])
        .guide(&[(50.0, 24.0), (50.0, 54.0)])
        .text((52.6, 52.0), "ψ")
        .note((57.0, 33.0), "ψ = 20°, θ = 30°")
        .note((26.0, 40.0), "2 b = 2 m")
        .note((26.0, 16.0), "E = 25 GPa, ν = 0.25")
}

fn hertz(radius: &str, load: &str, ground: &str, shear: &str) -> Sketch {
    let mut top = Sketch::arc((46.0, 86.0), 56.0, 240.0, 300.0);
    top.extend([(74.0, 50.0), (18.0, 50.0)]);
    let sketch = Sketch::new(66.0)
        .block((12.0, 8.0), (80.0, 30.0), ground)
        .held((12.0, 8.0), (80.0, 8.0))
        .body(&top, "")
        .fault(&Sketch::arc((46.0, 86.0), 56.0, 264.0, 276.0))
        .load((18.0, 50.0), (74.0, 50.0), (0.0, -5.0), load)
        .guide(&[(46.0, 24.0), (46.0, 50.0)])
        .text((60.0, 43.0), radius)
        .dimension((46.0, 26.5), (51.8, 26.5), "")
        .text((55.0, 26.0), "a");
    if shear.is_empty() {
        sketch
    } else {
        sketch.arrow((75.0, 46.0), (84.0, 46.0), "").note((70.0, 54.0), shear)
    }
}

fn rings() -> Sketch {
    let mut sketch = quarters(11.0, 31.0, 48.0);
    for degrees in [20.0_f64, 45.0, 70.0] {
        let (s, c) = degrees.to_radians().sin_cos();
        sketch = sketch.arrow((20.0 + 56.0 * c, 10.0 + 56.0 * s), (20.0 + 48.5 * c, 10.0 + 48.5 * s), "");
    }
    sketch
        .note((63.0, 52.0), "p = 10 MPa")
        .note((63.0, 46.0), "r = 0.2, 0.6, 1 m")
        .note((63.0, 40.0), "E = 1 GPa, ν = 0.2")
        .note((63.0, 34.0), "no friction")
}

fn press_fit() -> Sketch {
    quarters(12.0, 24.0, 48.0)
        .note((67.0, 52.0), "overlap 0.4 mm")
        .note((67.0, 46.0), "r = 0.2, 0.4, 0.8 m")
        .note((67.0, 40.0), "E = 200 GPa, ν = 0.3")
        .note((67.0, 34.0), "μ = 0.3")
}

/// Quarters of two rings, one inside the other.
fn quarters(bore: f64, between: f64, outside: f64) -> Sketch {
    let centre = (20.0, 10.0);
    let quarter = |inner: f64, outer: f64| {
        let mut corners = Sketch::arc(centre, outer, 0.0, 90.0);
        corners.extend(Sketch::arc(centre, inner, 90.0, 0.0));
        corners
    };
    Sketch::new(70.0)
        .body(&quarter(between, outside), "")
        .body(&quarter(bore, between), "")
        .fault(&Sketch::arc(centre, between, 0.0, 90.0))
        .rollers((20.0 + bore, 10.0), (68.0, 10.0))
        .rollers((20.0, 58.0), (20.0, 10.0 + bore))
}

fn wavy() -> Sketch {
    let wave = |from: f64, to: f64| -> Vec<(f64, f64)> {
        (0..=60)
            .map(|k| from + (to - from) * f64::from(k) / 60.0)
            .map(|x| (x, 24.0 + 2.5 * (x * std::f64::consts::TAU / 16.0).sin()))
            .collect()
    };
    let mut base = wave(8.0, 92.0);
    base.extend([(92.0, 10.0), (8.0, 10.0)]);
    let mut block = wave(24.0, 56.0);
    block.extend([(56.0, 38.0), (24.0, 38.0)]);
    Sketch::new(58.0)
        .body(&base, "")
        .held((8.0, 10.0), (92.0, 10.0))
        .body(&block, "")
        .fault(&wave(24.0, 56.0))
        .load((24.0, 38.0), (56.0, 38.0), (0.0, -5.0), "10 mm")
        .arrow((57.0, 33.0), (70.0, 33.0), "")
        .note((71.0, 33.0), "3 wavelengths")
        .dimension((60.0, 16.0), (76.0, 16.0), "1 m")
        .text((50.0, 4.0), "amplitude 20 mm")
}
