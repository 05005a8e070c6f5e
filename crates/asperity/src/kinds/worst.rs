//! Warnings about results outside the assumptions of the model: strain, rotation and slip that are not small, and contacts that never closed.

use super::cell_gradient::CellGradient;
use super::cell_variation::{self, is_followed};
use super::step_turn::StepTurn;
use asperity_contact::Sliding;
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::mesh::{Cells, MeshFace};
use asperity_mechanics::{Model, Path, PlannedInterface, Problem};
use asperity_output::bodies::view::InterfaceFields;
use asperity_run::Warning;
use asperity_scene::lengths::brief;
use nalgebra::SymmetricEigen;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Largest principal strain admitted in small-strain theory \[-\]. The error is of the order of the strain itself, so that stress and area have
/// errors of about five per cent here.
const SMALL_STRAIN: f64 = 0.05;

/// Largest rotation admitted in small-strain theory \[rad\]. It takes a rotation θ for a strain θ²/2, here 1.25e-3, which in rock is tens of MPa.
const SMALL_ROTATION: f64 = 0.05;

/// Share of these below which differences of displacement within a cell over its shortest edge leave no doubt: gradients are at most
/// some times as large, unless a cell is ten times flatter than its edges.
const SAFE: f64 = 0.1;

/// Fewest cells that are judged by one task: a few microseconds of work.
const CELLS: usize = 1024;

/// Slip over the size of the master faces from which a fixed pairing is wrong, because the node is then on another face.
const SMALL_SLIDING: f64 = 1.0;

/// Largest principal strain and rotation of the cells of a body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Largest {
    /// Largest principal strain \[-\].
    pub strain: f64,
    /// Largest rotation \[rad\].
    pub rotation: f64,
}

impl Largest {
    /// The larger of each.
    fn max(self, other: Self) -> Self {
        Self { strain: self.strain.max(other.strain), rotation: self.rotation.max(other.rotation) }
    }
}

/// Growth of displacements or tractions from which on a state is judged again: a strain in between is at most so much larger.
const GROWN: f64 = 1.05;

/// The worst states of a stage so far.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// Largest strain and rotation of each body, with their times \[s\].
    bodies: Vec<(Largest, [f64; 2])>,
    /// Largest relative displacement of each interface \[m\].
    slid: Vec<f64>,
    /// Largest rotation of a face of the master of each interface \[rad\].
    turned: Vec<f64>,
    /// Sizes of the state that was judged last: displacements \[m\], and tractions of interfaces \[Pa\].
    judged: [f64; 2],
    /// Shortest distance of two corners of a cell of each block \[m\]; found when bodies are judged first.
    #[serde(skip)]
    shortest: Vec<f64>,
    /// Displacements at the end of the stage \[m\].
    #[serde(skip)]
    end: Vec<f64>,
    /// Largest turn of each body in a step.
    swung: Vec<StepTurn>,
    /// Displacements at the end of the last step of the stage \[m\], where bodies account for large deformation.
    before: Vec<f64>,
}

impl Worst {
    /// Sees the end of a step, with the slip and the tractions of the interfaces. `displacement` gives that of all degrees of freedom,
    /// which costs a solution where bodies are condensed: then slip and tractions tell whether it is worth it. `begin` has those at
    /// the start of the stage \[m\].
    pub fn see<const D: usize>(
        &mut self,
        problem: &Problem<D>,
        (time, begin): (f64, &[f64]),
        fields: &[InterfaceFields],
        displacement: &dyn Fn() -> Vec<f64>,
        last: bool,
    ) {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
        self.slid.resize(fields.len(), 0.0);
        for (slid, f) in self.slid.iter_mut().zip(fields) {
            *slid = slid.max(largest(&mut f.relative_displacement.iter().copied()));
        }
        let traction = largest(&mut fields.iter().flat_map(|f| f.normal_traction.iter().copied()));
        let condensed = problem.path == Path::Condensed;
        let (size, u) = if condensed {
            (self.slid.iter().copied().fold(0.0, f64::max), None)
        } else {
            let u = displacement();
            self.step(&problem.model, time, begin, &u);
            (largest(&mut u.iter().copied()), Some(u))
        };
        let grown = |now: f64, before: f64| now > GROWN * before;
        if !(last || grown(size, self.judged[0]) || grown(traction, self.judged[1])) {
            return;
        }
        self.judged = [self.judged[0].max(size), self.judged[1].max(traction)];
        let u = u.unwrap_or_else(displacement);
        self.judge(&problem.model, time, &u);
        self.turned.resize(problem.interfaces.len(), 0.0);
        let each = self.turned.iter_mut().zip(&problem.interfaces);
        for (turned, interface) in each.filter(|(_, interface)| stays(interface)) {
            *turned = turned.max(largest_turn(&problem.model, &interface.master_faces, &u));
        }
        if last {
            self.end = u;
        }
    }

    /// Notes how far bodies of large deformation have turned in the step to displacements `u` \[m\].
    fn step<const D: usize>(&mut self, model: &Model<D>, time: f64, begin: &[f64], u: &[f64]) {
        if !(0..model.blocks.len()).any(|block| is_followed(model, block)) {
            return;
        }
        self.swung.resize(model.bodies.len(), StepTurn::default());
        let before = if self.before.is_empty() { begin } else { &self.before };
        for (body, turn) in model.bodies.iter().zip(&mut self.swung) {
            turn.note((model, body), time, before, u);
        }
        self.before = u.to_vec();
    }

    /// Sees displacements of a model \[m\] at a time \[s\].
    pub fn judge<const D: usize>(&mut self, model: &Model<D>, time: f64, u: &[f64]) {
        self.bodies.resize(model.bodies.len(), Default::default());
        if self.shortest.is_empty() {
            self.shortest = model.mesh.blocks.iter().map(|cells| shortest_in_block(model, cells)).collect();
        }
        for (body, (worst, at)) in model.bodies.iter().zip(&mut self.bodies) {
            for block in body.blocks.clone() {
                let now = largest_in_block(model, block, self.shortest[block], u);
                if now.strain > worst.strain {
                    (worst.strain, at[0]) = (now.strain, time);
                }
                if now.rotation > worst.rotation {
                    (worst.rotation, at[1]) = (now.rotation, time);
                }
            }
        }
    }

    /// Warnings about the stage.
    #[must_use]
    pub fn warnings<const D: usize>(&self, problem: &Problem<D>, stage: &str) -> Vec<Warning> {
        let model = &problem.model;
        let interfaces = problem.interfaces.iter().zip(&self.slid);
        let dragged = interfaces.filter_map(|(i, slid)| dragged(model, i, stage, *slid));
        let interfaces = problem.interfaces.iter().zip(&self.turned);
        let turned = interfaces.filter_map(|(i, angle)| turned(model, i, stage, *angle));
        let bent = model.bodies.iter().filter(|_| !self.end.is_empty());
        let bent = bent.filter_map(|body| cell_variation::warning(model, body, stage, &self.end));
        let swung = model.bodies.iter().zip(&self.swung);
        let swung = swung.filter_map(|(body, turn)| turn.warning(&body.name, stage));
        self.body_warnings(model, stage).chain(swung).chain(dragged).chain(turned).chain(bent).collect()
    }

    /// Warnings about the bodies in a stage.
    pub fn body_warnings<const D: usize>(
        &self,
        model: &Model<D>,
        stage: &str,
    ) -> impl Iterator<Item = Warning> {
        let bodies = model.bodies.iter().zip(&self.bodies);
        bodies.filter_map(move |(b, (worst, at))| {
            body_warning(&b.name, stage, (*worst, *at), b.elastic[0].young())
        })
    }
}

fn body_warning(body: &str, stage: &str, (largest, at): (Largest, [f64; 2]), young: f64) -> Option<Warning> {
    let help = format!("add `strain = \"finite\"` to body `{body}`, or check the loads and the units");
    if largest.strain > SMALL_STRAIN {
        let message = format!(
            "body `{body}` is strained by {:.3} in stage `{stage}`, most at {:e} s, and its strain is taken as small (up to {SMALL_STRAIN})",
            largest.strain, at[0]
        );
        return Some(Warning::at(0..0, message, help));
    }
    (largest.rotation > SMALL_ROTATION).then(|| {
        let theta = largest.rotation;
        let message = format!(
            "body `{body}` turns by {theta:.3} rad in stage `{stage}`, most at {:e} s, which a theory of small strain takes for a strain of {:.1e}, a stress of \
             about {:.3e} Pa",
            at[1],
            0.5 * theta * theta,
            0.5 * theta * theta * young
        );
        Warning::at(0..0, message, help)
    })
}

/// Largest strain and rotation in the cells of a block, at their centres and between these and their corners, about where stresses are
/// computed; zero if the block accounts for large deformation, and in cells that leave no doubt. `shortest` is the shortest edge of its
/// cells \[m\], or anything below.
pub fn largest_in_block<const D: usize>(model: &Model<D>, block: usize, shortest: f64, u: &[f64]) -> Largest {
    // Antiplane motion has one component, and its equation is linear for slopes of any size.
    if is_followed(model, block) || model.idealisation == Idealisation::Antiplane {
        return Largest::default();
    }
    let cells = &model.mesh.blocks[block];
    let places = places(cells.kind);
    let limit = SAFE * SMALL_STRAIN.min(SMALL_ROTATION);
    let doubtful = |cell: usize| {
        let (range, hoop) = (range::<D>(cells, cell, u), hoop(model, cells, cell, u));
        // Few cells have to be measured: most leave no doubt whatever their size.
        hoop > limit || range > limit * shortest && range > limit * shortest_edge(model, cells, cell)
    };
    let of_cell = |cell: usize| {
        let of_places = places.iter().map(|place| deformation(model, cells, (cell, *place), u));
        of_places.fold(Largest::default(), Largest::max)
    };
    let all = (0..cells.len()).into_par_iter().with_min_len(CELLS).filter(|cell| doubtful(*cell));
    all.map(of_cell).reduce(Largest::default, Largest::max)
}

/// Largest principal strain and rotation at natural coordinates of a cell.
fn deformation<const D: usize>(
    model: &Model<D>,
    cells: &Cells,
    place: (usize, [f64; 3]),
    u: &[f64],
) -> Largest {
    let CellGradient { gradient, .. } = CellGradient::new(model, cells, place.0, place.1, u);
    let strain = 0.5 * (&gradient + gradient.transpose());
    let spin = 0.5 * (&gradient - gradient.transpose());
    Largest {
        strain: SymmetricEigen::new(strain).eigenvalues.amax().max(hoop(model, cells, place.0, u)),
        // In 3D each component of the rotation vector appears twice in the spin.
        rotation: spin.norm() / std::f64::consts::SQRT_2,
    }
}

/// Largest difference of a component of displacement within a cell \[m\].
fn range<const D: usize>(cells: &Cells, cell: usize, u: &[f64]) -> f64 {
    let u = u.as_chunks::<D>().0;
    let (mut low, mut high) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for &node in cells.cell(cell) {
        for c in 0..D {
            (low[c], high[c]) = (low[c].min(u[node][c]), high[c].max(u[node][c]));
        }
    }
    low.iter().zip(high).fold(0.0, |largest, (low, high)| largest.max(high - low))
}

/// Shortest edge of the cells of a block \[m\].
fn shortest_in_block<const D: usize>(model: &Model<D>, cells: &Cells) -> f64 {
    let all = (0..cells.len()).into_par_iter().with_min_len(CELLS);
    all.map(|cell| shortest_edge(model, cells, cell)).reduce(|| f64::INFINITY, f64::min)
}

/// Shortest distance of two corners of a cell \[m\].
fn shortest_edge<const D: usize>(model: &Model<D>, cells: &Cells, cell: usize) -> f64 {
    let corners = &cells.cell(cell)[..cells.kind.corners()];
    let square = |a: usize, b: usize| {
        let (a, b) = (&model.mesh.nodes[a], &model.mesh.nodes[b]);
        (0..D).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>()
    };
    let pairs = corners.iter().enumerate().flat_map(|(k, &a)| corners[..k].iter().map(move |&b| (a, b)));
    pairs.map(|(a, b)| square(a, b)).fold(f64::INFINITY, f64::min).sqrt()
}

/// Magnitude of the hoop strain in axisymmetry.
fn hoop<const D: usize>(model: &Model<D>, cells: &Cells, cell: usize, u: &[f64]) -> f64 {
    if model.idealisation != Idealisation::Axisymmetric {
        return 0.0;
    }
    let nodes = cells.cell(cell);
    let radius: f64 = nodes.iter().map(|&n| model.mesh.nodes[n][0]).sum();
    let moved: f64 = nodes.iter().map(|&n| u[n * D]).sum();
    (moved / radius).abs()
}

/// Distance of the points towards the corners, over that of the corners: that of the Gauss points of first order, 1/√3.
const TOWARDS: f64 = 0.577_350_269_189_625_8;

/// Natural coordinates of the centre of a cell and of points towards its corners; simplices of first order have one strain.
fn places(kind: ElementKind) -> Vec<[f64; 3]> {
    let corners = &kind.node_coordinates()[..kind.corners()];
    let middle: [f64; 3] =
        std::array::from_fn(|c| corners.iter().map(|x| x[c]).sum::<f64>() / corners.len() as f64);
    let towards = |x: &[f64; 3]| std::array::from_fn(|c| middle[c] + TOWARDS * (x[c] - middle[c]));
    std::iter::once(middle).chain(corners.iter().map(towards)).collect()
}

/// True if an interface keeps the pairs and directions of its start, which matter where it is not bonded.
fn stays(planned: &PlannedInterface) -> bool {
    planned.sliding != Sliding::Finite && !planned.law.as_ref().is_some_and(|law| law.bonded())
}

/// Warning about a side that is dragged off the faces it was paired with.
fn dragged<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    stage: &str,
    slid: f64,
) -> Option<Warning> {
    if !stays(planned) {
        return None;
    }
    let size = face_size(model, &planned.master_faces);
    (slid > SMALL_SLIDING * size).then(|| {
        Warning::at(
            0..0,
            format!(
                "interface `{}` slides by {} in stage `{stage}`, {:.1} times the size {} of the faces of its master, and its pairing does not \
                 follow: beyond some {} nodes bear on faces that they have left, with full friction even off the end of the master",
                planned.name,
                brief(slid),
                slid / size,
                brief(size),
                brief(SMALL_SLIDING * size)
            ),
            "use `sliding = \"finite\"`; with \"small\" every node keeps the partner that it has at the start",
        )
    })
}

/// Warning about a side of a body of large deformation that turns, while the normals of its interface do not.
fn turned<const D: usize>(
    model: &Model<D>,
    planned: &PlannedInterface,
    stage: &str,
    angle: f64,
) -> Option<Warning> {
    if !stays(planned) {
        return None;
    }
    // A body of small strain is warned of as a body.
    let node = planned.master_faces.first()?.nodes[0];
    let body = model.bodies.iter().find(|b| b.nodes.contains(&node))?;
    (angle > SMALL_ROTATION && is_followed(model, body.blocks.start)).then(|| {
        Warning::at(
            0..0,
            format!(
                "the master of interface `{}` turns by {angle:.3} rad in stage `{stage}`, and the directions in which it presses and slides stay those of the start",
                planned.name
            ),
            "use `sliding = \"finite\"`; with \"small\" pairs and directions are those of the start",
        )
    })
}

/// Largest rotation of the normals of faces under displacements `u` \[rad\].
fn largest_turn<const D: usize>(model: &Model<D>, faces: &[MeshFace], u: &[f64]) -> f64 {
    if model.idealisation.components() != D {
        return 0.0;
    }
    let u = u.as_chunks::<D>().0;
    let of_face = |face: &MeshFace| {
        let (before, after) =
            (model.face_normal(&face.nodes), model.moved_face_normal(&face.nodes, |n| u[n]));
        let chord = before.iter().zip(&after).map(|(b, a)| (b - a).powi(2)).sum::<f64>().sqrt();
        2.0 * (0.5 * chord).min(1.0).asin()
    };
    faces.iter().map(of_face).fold(0.0, f64::max)
}

/// Mean distance between the first two corners of faces \[m\].
fn face_size<const D: usize>(model: &Model<D>, faces: &[MeshFace]) -> f64 {
    let edge = |face: &MeshFace| {
        let (a, b) = (model.mesh.nodes[face.nodes[0]], model.mesh.nodes[face.nodes[1]]);
        (0..D).map(|c| (a[c] - b[c]).powi(2)).sum::<f64>().sqrt()
    };
    faces.iter().map(edge).sum::<f64>() / faces.len().max(1) as f64
}
