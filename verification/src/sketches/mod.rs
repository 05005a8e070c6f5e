//! Sketches of the problems of the cases, with dimensions and boundary conditions. Not every case has one.

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
    #[test]
    fn sketches_have_finite_places() {
        for case in crate::cases::ALL {
            if let Some(svg) = super::of(case.name) {
                assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{}", case.name);
            }
        }
    }
}
