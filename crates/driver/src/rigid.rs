//! Whether every body, and every part of one that is split, is held: by its conditions, by symmetry, or by contact alone.
//!
//! A rigid motion is free when no fixed degree of freedom sees it. It is refused when no interface of the body could
//! hold it either, in any stage.

use crate::coordinates;
use crate::diagnostic::Diagnostic;
use crate::loading::Stage;
use crate::model::Model;
use crate::plan::PlannedInterface;
use crate::scene::model::Scene;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::face_nodes;
use nalgebra::DMatrix;
use std::ops::Range;

/// Eigenvalue of the Gram matrix of constraints, relative to the largest, below which a motion is free: rounding of a
/// sum over at most 1e6 rows of order one.
const FREE: f64 = 1e-9;

/// Checks all bodies in all stages. Returns remarks on bodies that contact alone holds.
///
/// # Errors
/// [`Diagnostic`] naming the body, the motion and the stage.
pub fn check<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    stages: &[Stage],
    interfaces: &[PlannedInterface],
) -> Result<Vec<String>, Diagnostic> {
    let mut remarks = Vec::new();
    for (body, nodes) in model.bodies.iter().flat_map(|b| b.parts.iter().map(move |p| (b, p))) {
        let what = match body.parts.len() {
            1 => format!("body `{}`", body.name),
            _ => format!(
                "the part of body `{}` with the node at {}",
                body.name,
                coordinates::in_words(&model.mesh.nodes[nodes[0]])
            ),
        };
        for stage in stages {
            let mut rows = condition_rows(model, nodes, stage);
            let Some(motion) = free_motion::<D>(&rows, model.idealisation) else { continue };
            rows.extend(contact_rows(model, nodes, stage, interfaces));
            if let Some(loose) = free_motion::<D>(&rows, model.idealisation) {
                return Err(Diagnostic::at(
                    scene.bodies[&body.name].material.span(),
                    format!("{what} is free to move in stage `{}`: nothing holds its {loose}", stage.name),
                    remedy(model, &body.name, &loose),
                ));
            }
            remarks.push(format!("stage `{}`: contact alone holds the {motion} of {what}", stage.name));
        }
    }
    Ok(remarks)
}

/// Sets of a body that are named in a remedy; more would hide it.
const MOST_NAMED: usize = 8;

/// What would hold a body.
fn remedy<const D: usize>(model: &Model<D>, body: &str, loose: &str) -> String {
    let own = |set: &&String| set.strip_prefix(body).is_some_and(|rest| rest.starts_with('.'));
    let sets: Vec<&String> = model.mesh.side_sets.keys().filter(own).collect();
    let axis = ["x", "y", "z"].iter().position(|axis| loose == format!("translation in {axis}"));
    let across = sets.iter().find(|set| axis.is_some_and(|axis| is_across(model, set, axis)));
    let Some(first) = across.or(sets.first()) else {
        return "the body has no sets: a condition needs one, such as a physical group of faces in its mesh"
            .into();
    };
    let example = match loose.strip_prefix("translation in ") {
        Some(axis) => format!("such as `{{ set = \"{first}\", {axis} = 0 }}`"),
        None => format!("such as one on `{first}` that holds both ends of the set"),
    };
    let named: Vec<String> = sets.iter().take(MOST_NAMED).map(|s| format!("`{s}`")).collect();
    let more = if sets.len() > MOST_NAMED { ", .." } else { "" };
    format!(
        "add a condition that prevents the {loose}, {example}, or an interface that can; its sets are {}{more}",
        named.join(", ")
    )
}

/// Whether the faces of a set are turned along an axis.
fn is_across<const D: usize>(model: &Model<D>, set: &str, axis: usize) -> bool {
    let mut faces = model.mesh.side_sets[set].iter().map(|side| face_nodes(&model.mesh, side));
    faces.all(|face| axis < D && model.face_normal(&face)[axis].abs() > ACROSS)
}

/// Part of a normal along an axis from which a face lies across it: within 25 degrees.
const ACROSS: f64 = 0.9;

/// Rigid modes of a point, one entry a mode: translations, then rotations about the body's centre.
type Row = Vec<f64>;

fn modes<const D: usize>() -> usize {
    D * (D + 1) / 2
}

/// The modes without strain: about an axis of revolution only the translation along it, in antiplane motion the only one there is.
fn rigid<const D: usize>(idealisation: Idealisation) -> Range<usize> {
    match idealisation {
        Idealisation::Axisymmetric => 1..2,
        Idealisation::Antiplane => 0..1,
        _ => 0..modes::<D>(),
    }
}

/// Displacement component `axis` at `x` of every rigid mode; lengths in units of the body.
fn row<const D: usize>(x: [f64; D], axis: usize) -> Row {
    let mut row = vec![0.0; modes::<D>()];
    row[axis] = 1.0;
    if D == 2 {
        row[2] = if axis == 0 { -x[1] } else { x[0] };
    } else {
        // Rotation about axis k moves component i by ε_ikj ω_k x_j.
        let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
        row[3 + j] = x[k];
        row[3 + k] = -x[j];
    }
    row
}

fn centred<const D: usize>(model: &Model<D>, nodes: &[usize]) -> impl Fn(usize) -> [f64; D] {
    let points: Vec<[f64; D]> = nodes.iter().map(|&n| model.mesh.nodes[n]).collect();
    let (min, max) = crate::model::bounds(&points);
    let size = (0..D).map(|c| max[c] - min[c]).fold(0.0, f64::max);
    move |node| std::array::from_fn(|c| (model.mesh.nodes[node][c] - 0.5 * (min[c] + max[c])) / size)
}

fn condition_rows<const D: usize>(model: &Model<D>, nodes: &[usize], stage: &Stage) -> Vec<Row> {
    let position = centred(model, nodes);
    let components = model.idealisation.components();
    let held = stage.fixed.iter().filter(|&&d| nodes.binary_search(&(d / components)).is_ok());
    if model.idealisation == Idealisation::Antiplane {
        return held.map(|_| vec![1.0]).collect();
    }
    held.map(|&d| row(position(d / components), d % components)).collect()
}

/// Contact holds the normal of each face; friction its tangents as well.
fn contact_rows<const D: usize>(
    model: &Model<D>,
    nodes: &[usize],
    stage: &Stage,
    interfaces: &[PlannedInterface],
) -> Vec<Row> {
    let position = centred(model, nodes);
    let mut rows = Vec::new();
    for interface in interfaces {
        let friction = interface.law.is_some() && !stage.frictionless.contains(&interface.name);
        for face in interface.slave_faces.iter().chain(&interface.master_faces) {
            if nodes.binary_search(&face[0]).is_err() {
                continue;
            }
            let normal = model.face_normal(face);
            for &node in face {
                let components: Vec<Row> = (0..D).map(|axis| row(position(node), axis)).collect();
                if friction {
                    rows.extend(components);
                } else {
                    rows.push(project(&components, &normal));
                }
            }
        }
    }
    rows
}

fn project(components: &[Row], normal: &[f64]) -> Row {
    let mut sum = vec![0.0; components[0].len()];
    for (component, n) in components.iter().zip(normal) {
        for (s, c) in sum.iter_mut().zip(component) {
            *s += n * c;
        }
    }
    sum
}

/// A rigid motion no row sees, in words.
fn free_motion<const D: usize>(rows: &[Row], idealisation: Idealisation) -> Option<String> {
    let rigid = rigid::<D>(idealisation);
    let m = rigid.len();
    let mut gram = DMatrix::<f64>::zeros(m, m);
    for row in rows {
        let row = &row[rigid.clone()];
        for i in 0..m {
            for j in 0..m {
                gram[(i, j)] += row[i] * row[j];
            }
        }
    }
    let eigen = gram.symmetric_eigen();
    let largest = eigen.eigenvalues.max();
    let (k, &smallest) = eigen.eigenvalues.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1))?;
    if largest > 0.0 && smallest > FREE * largest {
        return None;
    }
    let mode = eigen.eigenvectors.column(k);
    let dominant = (0..m).max_by(|&i, &j| mode[i].abs().total_cmp(&mode[j].abs()))?;
    Some(match idealisation {
        Idealisation::Antiplane => "translation in z".into(),
        _ => name_of_mode::<D>(rigid.start + dominant),
    })
}

fn name_of_mode<const D: usize>(mode: usize) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    if mode < D {
        format!("translation in {}", AXES[mode])
    } else if D == 2 {
        "rotation in the plane".into()
    } else {
        format!("rotation about {}", AXES[mode - 3])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_fem::kinematics::Idealisation::{Antiplane, Axisymmetric, PlaneStrain};

    #[test]
    fn rows_of_three_dimensions_are_those_of_a_rotation() {
        // ω × x for ω = e_z is (-y, x, 0).
        let x = [0.3, 0.7, -0.2];
        assert_eq!((0..3).map(|i| row(x, i)[5]).collect::<Vec<_>>(), vec![-0.7, 0.3, 0.0]);
        assert_eq!((0..3).map(|i| row(x, i)[3]).collect::<Vec<_>>(), vec![0.0, 0.2, 0.7]);
    }

    #[test]
    fn a_line_of_rollers_leaves_the_translation_along_it() {
        let rows: Vec<Row> = [-0.5, 0.0, 0.5].iter().map(|&y| row([0.0, y], 0)).collect();
        assert_eq!(free_motion::<2>(&rows, PlaneStrain).as_deref(), Some("translation in y"));
        let held: Vec<Row> = rows.into_iter().chain([row([0.0, 0.5], 1)]).collect();
        assert_eq!(free_motion::<2>(&held, PlaneStrain), None);
    }

    #[test]
    fn about_an_axis_only_the_translation_along_it_is_rigid() {
        let radial = vec![row([0.5, 0.1], 0)];
        assert_eq!(free_motion::<2>(&radial, Axisymmetric).as_deref(), Some("translation in y"));
        assert_eq!(free_motion::<2>(&[row([0.5, 0.1], 1)], Axisymmetric), None);
    }

    #[test]
    fn in_antiplane_motion_one_node_holds_a_body() {
        assert_eq!(free_motion::<2>(&[], Antiplane).as_deref(), Some("translation in z"));
        assert_eq!(free_motion::<2>(&[vec![1.0]], Antiplane), None);
    }
}
