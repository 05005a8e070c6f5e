//! Sketches of body problems.

use asperity_output::figures::Sketch;

pub(super) fn draw(name: &str) -> Option<Sketch> {
    let sketch = match name {
        "antiplane" => antiplane(),
        "bodies_patch" => distorted("u = A x on the boundary"),
        "bodies_convergence" => distorted("u = waves of sines, with their body force").load(
            (26.0, 22.0),
            (26.0, 58.0),
            (8.0, 0.0),
            "b(x)",
        ),
        "lame_cylinder" => ring("r = 1", "r = 2", "p = 0.01"),
        "elastic_plastic_cylinder" => ring("100 mm", "200 mm", "p(t)"),
        "flamant_boussinesq" => point_load(),
        "cook_membrane" => cook(),
        "cantilever_rotation" => cantilever(),
        "steel_strip" => strip(),
        "stage_paths" => stages(),
        "mesh_files" => bar_of_cells(),
        "large_rotation" => turning(),
        "jaumann_shear" => sheared("γ = 4", "all displacements prescribed"),
        "maxwell_relaxation" => sheared("γ(t) or τ(t)", "G and η; besides a thick cylinder under p"),
        "volumetric_path" => expanded(),
        "uniaxial_hardening" => bar(),
        "forward_drift" => drift(),
        "static_explicit_jumps" => column(),
        _ => return None,
    };
    Some(sketch)
}

fn antiplane() -> Sketch {
    Sketch::new(62.0)
        .block((12.0, 14.0), (44.0, 46.0), "")
        .fault(&[(28.0, 46.0), (28.0, 30.0)])
        .held((12.0, 46.0), (12.0, 14.0))
        .note((45.0, 30.0), "u_z = 2")
        .text((28.0, 50.0), "crack, free")
        .dimension((12.0, 8.0), (44.0, 8.0), "2")
        .text((7.0, 52.0), "u_z = 0")
        .block((70.0, 16.0), (94.0, 40.0), "b_z = 1")
        .held((70.0, 16.0), (94.0, 16.0))
        .held((94.0, 40.0), (70.0, 40.0))
        .held((70.0, 40.0), (70.0, 16.0))
        .held((94.0, 16.0), (94.0, 40.0))
        .dimension((70.0, 8.0), (94.0, 8.0), "1")
}

/// A block of three by three crooked cells.
fn distorted(text: &str) -> Sketch {
    let at = |i: usize, j: usize| {
        let crooked = |k: usize| if (1..3).contains(&k) { 1.0 } else { 0.0 };
        let sign = if (i + j).is_multiple_of(2) { 1.8 } else { -1.8 };
        let inside = crooked(i) * crooked(j) * sign;
        (30.0 + 13.0 * i as f64 + inside, 20.0 + 13.0 * j as f64 - inside)
    };
    let mut sketch = Sketch::new(72.0).body(&[at(0, 0), at(3, 0), at(3, 3), at(0, 3)], "");
    for k in 1..3 {
        let across: Vec<_> = (0..4).map(|i| at(i, k)).collect();
        let along: Vec<_> = (0..4).map(|j| at(k, j)).collect();
        sketch = sketch.line(&across).line(&along);
    }
    sketch
        .dimension((30.0, 14.0), (69.0, 14.0), "1")
        .text((50.0, 66.0), text)
        .text((50.0, 4.0), "corners moved by up to 13 % of the cells")
}

fn ring(inner: &str, outer: &str, pressure: &str) -> Sketch {
    let centre = (22.0, 10.0);
    let mut corners = Sketch::arc(centre, 48.0, 0.0, 90.0);
    corners.extend(Sketch::arc(centre, 24.0, 90.0, 0.0));
    let spoke = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        ((22.0 + 14.0 * c, 10.0 + 14.0 * s), (22.0 + 24.0 * c, 10.0 + 24.0 * s))
    };
    let mut sketch = Sketch::new(66.0).body(&corners, "");
    for degrees in [12.0, 34.0, 56.0, 78.0] {
        let (from, to) = spoke(degrees);
        sketch = sketch.arrow(from, to, "");
    }
    sketch
        .rollers((46.0, 10.0), (70.0, 10.0))
        .rollers((22.0, 58.0), (22.0, 34.0))
        .text((29.0, 15.0), pressure)
        .dimension((22.0, 3.0), (46.0, 3.0), inner)
        .dimension((74.0, 10.0), (74.0, 58.0), outer)
        .note((60.0, 52.0), "outside free")
}

fn point_load() -> Sketch {
    let mut rock = Sketch::arc((50.0, 46.0), 36.0, 180.0, 360.0);
    rock.extend(Sketch::arc((50.0, 46.0), 7.0, 360.0, 180.0));
    Sketch::new(64.0)
        .body(&rock, "")
        .arrow((50.0, 60.0), (50.0, 47.0), "P, or p on |x| < 1")
        .guide(&[(50.0, 46.0), (50.0, 10.0)])
        .dimension((50.0, 45.0), (57.0, 45.0), "")
        .text((62.0, 40.0), "r = 1")
        .dimension((50.0, 46.0), (75.5, 20.5), "r = 4")
        .note((4.0, 12.0), "exact u")
        .note((4.0, 7.0), "on the border")
}

fn cook() -> Sketch {
    // One unit is one millimetre.
    let at = |x: f64, y: f64| (24.0 + x, 8.0 + y);
    Sketch::new(78.0)
        .body(&[at(0.0, 0.0), at(48.0, 44.0), at(48.0, 60.0), at(0.0, 44.0)], "")
        .held(at(0.0, 44.0), at(0.0, 0.0))
        .arrow(at(52.0, 45.0), at(52.0, 59.0), "F")
        .dimension(at(62.0, 44.0), at(62.0, 60.0), "16")
        .dimension(at(-14.0, 0.0), at(-14.0, 44.0), "44")
        .dimension(at(0.0, -4.0), at(48.0, -4.0), "48")
}

fn cantilever() -> Sketch {
    Sketch::new(56.0)
        .block((12.0, 14.0), (84.0, 19.0), "")
        .held((12.0, 24.0), (12.0, 9.0))
        .arrow((84.0, 34.0), (84.0, 20.0), "P")
        .line(&Sketch::arc((84.0, 16.5), 7.0, -70.0, 70.0))
        .note((92.0, 16.5), "M")
        .guide(&Sketch::arc((12.0, 39.5), 23.0, -90.0, 60.0))
        .note((40.0, 44.0), "rolled up by M L/(E I) = φ")
        .dimension((12.0, 6.0), (84.0, 6.0), "L")
}

fn stages() -> Sketch {
    Sketch::new(56.0)
        .block((14.0, 20.0), (58.0, 42.0), "")
        .rollers((14.0, 42.0), (14.0, 20.0))
        .rollers((14.0, 20.0), (58.0, 20.0))
        .load((58.0, 20.0), (58.0, 42.0), (7.0, 0.0), "2, 3, 1, 4 MPa")
        .note((64.0, 24.0), "then u = 5, 1, 2 mm")
        .dimension((14.0, 8.0), (58.0, 8.0), "2 m")
        .text((36.0, 31.0), "uniaxial strain")
}

fn bar_of_cells() -> Sketch {
    Sketch::new(56.0)
        .block((26.0, 12.0), (62.0, 48.0), "")
        .held((26.0, 48.0), (26.0, 12.0))
        .guide(&[(26.0, 12.0), (62.0, 48.0)])
        .guide(&[(26.0, 30.0), (62.0, 30.0)])
        .guide(&[(44.0, 12.0), (44.0, 48.0)])
        .arrow((62.0, 30.0), (74.0, 30.0), "")
        .note((75.0, 30.0), "10 mm, or weight")
        .dimension((26.0, 5.0), (62.0, 5.0), "1 m")
        .note((64.0, 44.0), "ν = 0")
}

fn strip() -> Sketch {
    Sketch::new(56.0)
        .block((12.0, 40.0), (84.0, 42.0), "")
        .held((12.0, 47.0), (12.0, 35.0))
        .load((12.0, 42.0), (84.0, 42.0), (0.0, -5.0), "weight 0.3032 N")
        .arrow((84.0, 39.0), (84.0, 28.0), "F")
        .guide(&[(12.0, 41.0), (30.0, 36.0), (45.0, 26.0), (54.0, 14.0), (57.0, 6.0)])
        .note((62.0, 8.0), "bent by up to 281 mm")
        .dimension((12.0, 31.0), (80.0, 31.0), "400 mm")
        .text((30.0, 20.0), "25 × 0.4 mm")
}

fn turning() -> Sketch {
    let square = |degrees: f64, (x, y): (f64, f64)| -> Vec<(f64, f64)> {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
            .iter()
            .map(|(a, b)| {
                let (s, c) = degrees.to_radians().sin_cos();
                (x + 10.0 * (a * c - b * s), y + 10.0 * (a * s + b * c))
            })
            .collect()
    };
    let turned = square(35.0, (70.0, 28.0));
    Sketch::new(56.0)
        .body(&square(0.0, (26.0, 28.0)), "σ")
        .load((16.0, 38.0), (36.0, 38.0), (0.0, 6.0), "")
        .load((36.0, 18.0), (16.0, 18.0), (0.0, -6.0), "")
        .body(&turned, "R σ Rᵀ")
        .line(&Sketch::arc((70.0, 28.0), 19.0, 0.0, 75.0))
        .text((88.0, 45.0), "1 to 120°")
        .text((50.0, 4.0), "a full circle, step by step")
}

fn sheared(amount: &str, text: &str) -> Sketch {
    Sketch::new(58.0)
        .body(&[(28.0, 14.0), (54.0, 14.0), (74.0, 40.0), (48.0, 40.0)], "")
        .guide(&[(28.0, 14.0), (28.0, 40.0), (54.0, 40.0), (54.0, 14.0)])
        .held((28.0, 14.0), (54.0, 14.0))
        .arrow((50.0, 45.0), (72.0, 45.0), "")
        .text((61.0, 50.0), amount)
        .dimension((20.0, 14.0), (20.0, 40.0), "1")
        .text((50.0, 4.0), text)
}

fn expanded() -> Sketch {
    Sketch::new(58.0)
        .guide(&[(34.0, 16.0), (58.0, 16.0), (58.0, 40.0), (34.0, 40.0), (34.0, 16.0)])
        .block((34.0, 16.0), (65.0, 47.0), "")
        .arrow((66.0, 31.0), (76.0, 31.0), "")
        .arrow((49.0, 48.0), (49.0, 56.0), "")
        .dimension((34.0, 10.0), (65.0, 10.0), "1.3")
        .note((78.0, 31.0), "prescribed")
        .text((50.0, 3.0), "cube, bar without narrowing, sheet")
}

fn bar() -> Sketch {
    Sketch::new(46.0)
        .block((16.0, 16.0), (70.0, 30.0), "")
        .rollers((16.0, 30.0), (16.0, 16.0))
        .arrow((71.0, 23.0), (84.0, 23.0), "")
        .note((86.0, 23.0), "ε(t)")
        .text((43.0, 37.0), "sides free")
        .text((50.0, 6.0), "stretched, unloaded, reversed, stretched again")
}

fn drift() -> Sketch {
    distorted("upper edge moves sideways and up").held((30.0, 20.0), (69.0, 20.0)).load(
        (30.0, 59.0),
        (69.0, 59.0),
        (5.0, 3.0),
        "",
    )
}

fn column() -> Sketch {
    Sketch::new(60.0)
        .block((20.0, 12.0), (38.0, 48.0), "ρ g")
        .rollers((20.0, 48.0), (20.0, 12.0))
        .rollers((38.0, 12.0), (38.0, 48.0))
        .rollers((20.0, 12.0), (38.0, 12.0))
        .load((20.0, 48.0), (38.0, 48.0), (0.0, -5.0), "jump at t = 0")
        .block((58.0, 12.0), (92.0, 22.0), "")
        .block((66.0, 22.0), (84.0, 34.0), "ρ g")
        .fault(&[(66.0, 22.0), (84.0, 22.0)])
        .held((58.0, 12.0), (92.0, 12.0))
        .arrow((56.0, 28.0), (66.0, 28.0), "")
        .text((75.0, 40.0), "friction taken off")
}
