//! Sketches of the problems of the cases, with dimensions and conditions.

mod bodies;
mod contact;
mod faults;
mod interfaces;
mod sliders;

use asperity_output::plots::Sketch;

/// The sketch of a case as SVG.
pub fn of(name: &str) -> Option<String> {
    let subjects: [fn(&str) -> Option<Sketch>; 5] =
        [bodies::of, contact::of, interfaces::of, sliders::of, faults::of];
    subjects.iter().find_map(|subject| subject(name)).map(|sketch| sketch.svg())
}

#[cfg(test)]
mod tests {
    /// Cases of many problems, or of files.
    const WITHOUT: [&str; 9] = [
        "absence",
        "elastic_waves",
        "event_files",
        "explicit_materials",
        "implicit_dynamics",
        "newton_convergence",
        "output_files",
        "restarts",
        "scene_units",
    ];

    #[test]
    fn every_case_of_one_problem_has_a_sketch_with_finite_places() {
        for case in crate::cases::ALL {
            match super::of(case.name) {
                Some(svg) => assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{}", case.name),
                None => assert!(WITHOUT.contains(&case.name), "{} has no sketch", case.name),
            }
        }
    }
}
