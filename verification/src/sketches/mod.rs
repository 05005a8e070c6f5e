//! Sketches of the problems of the cases, with dimensions and conditions.

mod bodies;
mod contact;
mod faults;
mod interfaces;
mod sliders;

use asperity_output::figures::Sketch;

/// The sketch of a case as SVG.
pub fn draw(name: &str) -> Option<String> {
    let subjects: [fn(&str) -> Option<Sketch>; 5] =
        [bodies::draw, contact::draw, interfaces::draw, sliders::draw, faults::draw];
    subjects.iter().find_map(|subject| subject(name)).map(|sketch| sketch.svg())
}
