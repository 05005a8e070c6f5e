//! Checks sets that share nodes for conflicting prescriptions. For generated blocks the scene check has done this already; for other meshes the
//! shared nodes are known only from the mesh.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::check::course::Course;
use crate::reading::scene::model::{Motion, Stage};
use crate::shared::model::{Model, sets};
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A set and a component.
pub(super) type Key = (String, usize);

/// Prescriptions from stage to stage, with their positions in the scene.
#[derive(Default)]
pub(super) struct PrescriptionHistory {
    /// Positions in the scene of the motions in force.
    pub places: BTreeMap<Key, Range<usize>>,
    /// Displacement of each component ever prescribed; `None` once it has been free.
    present: BTreeMap<Key, Option<f64>>,
    stages: usize,
}

impl PrescriptionHistory {
    /// Checks the motions of a stage and advances them to its end.
    pub fn stage<const D: usize>(
        &mut self,
        model: &Model<D>,
        stage: &Stage,
        held: &BTreeMap<Key, Motion>,
    ) -> Result<(), Diagnostic> {
        let duration = stage.duration.get_ref().0;
        for (a, b) in pairs(model, held) {
            let (from_a, from_b) = (self.start(a), self.start(b));
            let first = Course::new(&held[a], from_a.or(from_b), duration);
            let second = Course::new(&held[b], from_b.or(from_a), duration);
            if !first.agrees(&second, duration) {
                let place = |key| self.places.get(key).cloned().unwrap_or_default();
                let span = if place(a).start > place(b).start { place(a) } else { place(b) };
                let axis = ["x", "y", "z"][a.1];
                return Err(Diagnostic::at(
                    span,
                    format!(
                        "`{}` and `{}` share nodes and prescribe {axis} there differently in stage `{}`",
                        a.0, b.0, stage.name
                    ),
                    format!(
                        "`{}` prescribes {}, `{}` {}: say the same on both, or release one with `{axis} = \"free\"`",
                        a.0,
                        first.words(),
                        b.0,
                        second.words()
                    ),
                ));
            }
        }
        let ends: Vec<(Key, Option<f64>)> = held
            .iter()
            .map(|(key, motion)| (key.clone(), Course::new(motion, self.start(key), duration).at(duration)))
            .collect();
        self.present.extend(ends);
        self.stages += 1;
        Ok(())
    }

    /// Displacement of a component at the start of the stage, if known.
    fn start(&self, key: &Key) -> Option<f64> {
        self.present.get(key).copied().unwrap_or((self.stages == 0).then_some(0.0))
    }
}

/// Pairs of sets that prescribe the same component at common nodes, in order.
fn pairs<'a, const D: usize>(
    model: &Model<D>,
    held: &'a BTreeMap<Key, Motion>,
) -> BTreeSet<(&'a Key, &'a Key)> {
    let mut owners: Vec<Option<&Key>> = vec![None; model.dofs()];
    let mut pairs = BTreeSet::new();
    for (key, _) in held.iter().filter(|(_, m)| **m != Motion::Free) {
        for node in sets::find_nodes(model, &key.0).unwrap_or_default() {
            match &mut owners[model.dof(node, key.1)] {
                Some(owner) => {
                    pairs.insert((*owner, key));
                }
                none => *none = Some(key),
            }
        }
    }
    pairs
}
