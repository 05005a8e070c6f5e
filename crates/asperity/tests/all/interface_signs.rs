//! The sign of slip and shear traction in what observers see: the same for both measures, small and finite sliding, in the plane and in space.

use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_output::bodies::view::InterfaceFields;
use asperity_plan::bodies;
use asperity_plan::reading::scene;

/// A block on another one, pressed and pushed along x (or z) by `push` \[m\].
fn pushed(axis: &str, push: f64, measure: &str, sliding: &str, space: bool) -> InterfaceFields {
    let (kinematics, element) = if space { ("3d", "hex8") } else { ("plane-strain", "quad4") };
    let corner = |x: [f64; 3]| if space { format!("{x:?}") } else { format!("{:?}", &x[..2]) };
    let hold = if space { ", z = 0" } else { "" };
    // Across the motion the block is held.
    let across = match (space, axis) {
        (true, "x") => ", z = 0",
        (true, _) => ", x = 0",
        _ => "",
    };
    let text = format!(
        r#"schema = 1
title = "a block on another"
kinematics = "{kinematics}"
[materials.rock]
young = "10 GPa"
poisson = 0.25
[bodies.lower]
mesh.block = {{ min = {}, max = {}, size = 1, element = "{element}" }}
material = "rock"
[bodies.upper]
mesh.block = {{ min = {}, max = {}, size = 1, element = "{element}" }}
material = "rock"
[interfaces.joint]
slave = "upper.bottom"
master = "lower.top"
measure = "{measure}"
sliding = "{sliding}"
enforcement = {{ kind = "penalty", normal = "100 E/h", tangential = "100 E/h" }}
law = {{ kind = "coulomb", mu = 0.3 }}
[[stages]]
name = "push"
duration = 1
conditions = [{{ set = "lower.bottom", x = 0, y = 0{hold} }}, {{ set = "upper.top", y = -1e-4, {axis} = {{ to = {push:e} }}{across} }}]
[time]
stepper = "implicit"
"#,
        corner([-1.0, -1.0, -1.0]),
        corner([4.0, 0.0, 4.0]),
        corner([0.0, 0.0, 0.0]),
        corner([3.0, 1.0, 3.0]),
    );
    let plan = bodies::plan(&scene::read(&text).unwrap()).unwrap();
    let mut record = Recorder::new();
    kinds::bodies::run(&plan, &mut record).unwrap();
    record.stage_end("push").unwrap().interfaces[0].clone()
}

const WAYS: [(&str, &str); 4] =
    [("node-to-point", "small"), ("node-to-point", "finite"), ("mortar", "small"), ("mortar", "finite")];

/// Area-weighted mean.
fn mean(fields: &InterfaceFields, values: impl Iterator<Item = f64>) -> f64 {
    values.zip(&fields.area).map(|(v, a)| v * a).sum::<f64>() / fields.area.iter().sum::<f64>()
}

#[test]
fn in_the_plane_slip_is_positive_to_the_left_of_the_normal_of_the_master() {
    for (measure, sliding) in WAYS {
        for push in [1e-3, -1e-3] {
            let f = pushed("x", push, measure, sliding, false);
            for values in
                [&f.slip, &f.shear_traction, &f.mean_shear_traction, &f.relative_displacement, &f.slip_rate]
            {
                let mean = mean(&f, values.iter().copied());
                // The normal of the lower body points up.
                assert!(mean * push < 0.0, "{measure}, {sliding}: {mean} for {push}");
            }
            assert!(f.slip_vector.is_empty() && f.shear_vector.is_empty());
        }
    }
}

#[test]
fn in_space_sizes_stand_beside_vectors_along_the_push() {
    for (measure, sliding) in WAYS {
        for (axis, c) in [("x", 0), ("z", 2)] {
            for push in [1e-3, -1e-3] {
                let f = pushed(axis, push, measure, sliding, true);
                let slip = mean(&f, f.slip_vector.iter().map(|v| v[c]));
                let shear = mean(&f, f.shear_vector.iter().map(|v| v[c]));
                assert!(
                    slip * push > 0.0 && shear * push > 0.0,
                    "{measure}, {sliding}: {slip}, {shear} for {push} along {axis}"
                );
                assert!(slip.abs() > 0.5e-3, "{measure}, {sliding}: {slip}");
                let size = |v: &[f64; 3]| v.iter().map(|c| c * c).sum::<f64>().sqrt();
                for p in 0..f.slip.len() {
                    assert!((f.slip[p] - size(&f.slip_vector[p])).abs() <= 1e-15 && f.slip_rate[p] >= 0.0);
                    assert!(
                        (f.shear_traction[p] - size(&f.shear_vector[p])).abs()
                            <= 1e-9 * f.normal_traction[p].max(1.0)
                    );
                    // The full shear traction is seen along either axis: 0.3 of the normal traction where the interface
                    // slides.
                    let slides = f.status[p] == 2;
                    assert!(
                        !slides
                            || (f.shear_traction[p] - 0.3 * f.normal_traction[p]).abs()
                                <= 1e-6 * f.normal_traction[p].max(1.0)
                    );
                }
            }
        }
    }
}
