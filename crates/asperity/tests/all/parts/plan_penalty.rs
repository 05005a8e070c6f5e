use asperity_plan::bodies::penalty::*;
use asperity_plan::reading::scene::model::{Enforcement, EnforcementKind, here};
use asperity_plan::reading::scene::units::Penalty;
use asperity_run::Warning;

fn spec(factor: f64) -> Enforcement {
    Enforcement {
        kind: here(EnforcementKind::Penalty),
        normal: here(Penalty::YoungPerSize(factor)),
        tangential: None,
        penetration: None,
        augmentations: None,
    }
}

fn softer(contrast: f64) -> SofterCells {
    SofterCells { body: "clay".into(), contrast, young_per_size: 1e12, size: 1e-2, extent: 100.0 }
}

fn told(factor: f64, contrast: f64) -> Vec<Warning> {
    doubts("fault", &spec(factor), &softer(contrast))
}

#[test]
fn penalties_far_from_the_stiffness_of_the_softer_cells_are_doubtful() {
    assert!(told(1.0, 1.0).is_empty() && told(1e5, 1.0).is_empty());
    let soft = &told(0.01, 1.0)[0];
    assert!(soft.message.contains("like a layer of 1 m of the material"), "{soft}");
    let stiff = &told(1e6, 1.0)[0];
    assert!(stiff.message.contains("rounding") && stiff.to_string().contains("\"100 E/h\""), "{stiff}");
}

#[test]
fn what_the_slave_calls_a_hundred_is_measured_by_the_softer_side() {
    let stiff = &told(100.0, 1e6)[0];
    assert!(stiff.message.contains("1.0e8 E/h of body `clay`"), "{stiff}");
    assert!(stiff.to_string().contains("make the side of `clay` the slave"), "{stiff}");
    assert!(stiff.to_string().contains("`normal = \"1.000e14 Pa/m\"`"), "{stiff}");
    assert!(told(1e-4, 1e6).is_empty());
}

#[test]
fn runs_are_told_of_large_penalties_only() {
    assert!(blamed("fault", &spec(100.0), &softer(1.0)).is_none());
    assert!(blamed("fault", &spec(1e7), &softer(1.0)).is_some_and(|b| b.contains("1.0e7 E/h")));
}
