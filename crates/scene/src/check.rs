//! Checks of a scene before anything is built. All errors are collected.

mod bodies;
mod conditions;
mod corners;
mod coulomb;
pub mod course;
mod diffusion;
mod explicit;
mod fault_physics;
mod faults;
mod fields;
mod forced_ruptures;
mod heat;
pub mod incompatibility;
mod inertia;
mod interfaces;
mod materials;
mod medium;
mod meshes;
mod output;
mod patches;
mod place;
mod platform;
pub mod pressing;
mod receivers;
mod ruptures;
mod solver;
mod speeds;
mod start_gaps;
mod starts;
mod stress;
mod surface;
mod time;
mod unused_values;
mod wells;

use super::model::{Body, Kinematics, MeshSource, Scene, Spanned};
use super::suggestions::suggest;
use crate::diagnostic::Diagnostic;
use crate::law::Laws;
use crate::names::SIDES;
use asperity_run::Warning;
use std::ops::Range;

/// All errors and warnings of a scene, in the order of the file.
#[must_use]
pub fn check(scene: &Scene, laws: &Laws) -> (Vec<Diagnostic>, Vec<Warning>) {
    let mut checker = Checker { scene, laws, errors: Vec::new(), warnings: Vec::new() };
    checker.schema();
    checker.materials();
    checker.bodies();
    checker.interfaces();
    checker.faults();
    checker.place();
    checker.stages();
    checker.time();
    checker.inertia();
    checker.solver();
    checker.output();
    checker.unused();
    let (mut errors, mut warnings) = (checker.errors, checker.warnings);
    errors.sort_by_key(|e| (e.span.is_empty(), e.span.start));
    warnings.sort_by_key(|w| (w.span.is_empty(), w.span.start));
    (errors, warnings)
}

/// Longest name \[bytes\]. File systems have room for 255, of which the longest ends take some 40.
const LONGEST_NAME: usize = 100;

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

struct Checker<'a> {
    scene: &'a Scene,
    laws: &'a Laws,
    errors: Vec<Diagnostic>,
    warnings: Vec<Warning>,
}

impl Checker<'_> {
    fn error(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.errors.push(Diagnostic::at(span, message, help));
    }

    /// Adds a warning about a setting that is admissible but probably not intended.
    fn warn(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        self.warnings.push(Warning::at(span, message, help));
    }

    /// Adds an error about one position that involves a second one.
    fn conflict(
        &mut self,
        span: &Range<usize>,
        message: impl Into<String>,
        help: impl Into<String>,
        also: (&Range<usize>, &str),
    ) {
        self.errors.push(Diagnostic::at(span.clone(), message, help).and(also.0.clone(), also.1));
    }

    /// Reports a count that is surely a mistake and would exhaust the memory.
    fn too_many(&mut self, count: &Spanned<usize>, name: &str, most: usize) {
        self.error(
            count.span(),
            format!("`{name}` is {}, more than anyone could use", count.get_ref()),
            format!("at most {most}"),
        );
    }

    fn dimension(&self) -> usize {
        self.scene.kinematics.get_ref().dimension()
    }

    /// Name of the idealisation.
    fn idealisation(&self) -> &'static str {
        self.scene.kinematics.get_ref().words()
    }

    /// Axes along which bodies move.
    fn motions(&self) -> Vec<usize> {
        if self.is_antiplane() { vec![2] } else { (0..self.dimension()).collect() }
    }

    fn is_antiplane(&self) -> bool {
        *self.scene.kinematics.get_ref() == Kinematics::Antiplane
    }

    fn schema(&mut self) {
        let schema = *self.scene.schema.get_ref();
        if schema != 1 {
            self.error(
                self.scene.schema.span(),
                format!("there is no version {schema} of the scene format"),
                "this program reads `schema = 1`",
            );
        }
    }

    /// Checks a name. Names become parts of set names and of file names.
    fn name(&mut self, what: &str, name: &str, place: Range<usize>) {
        if name.len() > LONGEST_NAME {
            let message = format!("the name of {what} has {} bytes", name.len());
            let help =
                format!("at most {LONGEST_NAME}: it is part of names of files, which have at most 255");
            self.error(place.clone(), message, help);
        }
        if name.is_empty() || !name.chars().all(|c| c.is_alphanumeric() || c == '_' || c == '-') {
            self.error(
                place,
                format!("`{name}` cannot be the name of {what}"),
                "names consist of letters, digits, `_` and `-`",
            );
        }
    }

    /// Body, axis and end (0 lower, 1 upper) of a set `body.side` of a rectangular block. A missing set is reported. Sets of
    /// other meshes are known only once these are generated or read.
    fn set(&mut self, set: &Spanned<String>) -> Option<(String, usize, usize)> {
        let body = set.get_ref().split('.').next().and_then(|name| self.scene.bodies.get(name));
        if body.is_some_and(|b| !matches!(b.mesh, MeshSource::Block(_))) && set.get_ref().contains('.') {
            return None;
        }
        let found = self.block_side(set.get_ref()).map(|(body, axis, end)| (body.to_string(), axis, end));
        if found.is_none() {
            self.unknown_set(set);
        }
        found
    }

    /// Body, axis and end of a side of a rectangular block; `None` for any other set.
    fn block_side<'s>(&self, set: &'s str) -> Option<(&'s str, usize, usize)> {
        let is_block = |b: &Body| matches!(b.mesh, MeshSource::Block(_));
        split(set, self.dimension()).filter(|side| self.scene.bodies.get(side.0).is_some_and(is_block))
    }

    fn unknown_set(&mut self, set: &Spanned<String>) {
        let name = set.get_ref();
        let sides: Vec<&str> = SIDES[..self.dimension()].iter().flatten().copied().collect();
        let dotted = |b: &String| b.contains('.') && name.strip_prefix(b).is_some_and(|s| s.starts_with('.'));
        if self.scene.bodies.keys().any(dotted) {
            return; // The error is in the name of the body and is reported only once.
        }
        let Some((body, side)) = name.split_once('.') else {
            let list = format!("a set is `body.side`, with the sides {}", sides.join(", "));
            self.error(set.span(), format!("`{name}` names no side of a body"), list);
            return;
        };
        if self.scene.bodies.contains_key(body) {
            let help = suggest(side, "sides", sides.iter().copied());
            let message = format!("body `{body}` has no side `{side}` in {}", self.idealisation());
            self.error(set.span(), message, help);
        } else {
            let help = suggest(body, "bodies", self.scene.bodies.keys().map(String::as_str));
            self.error(set.span(), format!("there is no body `{body}` in `{name}`"), help);
        }
    }
}

/// Splits the name of a side set of a block into body, axis and end.
fn split(set: &str, dimension: usize) -> Option<(&str, usize, usize)> {
    let (body, side) = set.split_once('.')?;
    SIDES[..dimension]
        .iter()
        .enumerate()
        .find_map(|(axis, ends)| ends.iter().position(|&end| end == side).map(|end| (body, axis, end)))
}
