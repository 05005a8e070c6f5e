//! One direction for each connected piece of a surface, and in the plane an order along it.

use super::surface::InnerFace;
use super::{SplitError, Surface};
use crate::mesh::Mesh;
use crate::vector::length;
use std::collections::BTreeMap;

/// Cosine below which a direction counts as lying in the surface: three degrees, less than anyone would call "across".
const CROSSES: f64 = 0.05;

/// Component of the mean normal of a piece below which it does not face along an axis: the sine of six hundredths of a degree,
/// more than coordinates of six digits err by, and less than any slope that is meant.
const FACES: f64 = 1e-3;

/// Common part of two faces: a node in the plane, an edge in space.
type Ridge = [usize; 2];

/// Faces at each ridge, with the direction in which they pass it.
type Ridges = BTreeMap<Ridge, Vec<(usize, bool)>>;

/// Orients the faces of a surface piece by piece and, in the plane, sorts them along the fault.
pub(super) fn orient<const D: usize>(
    mesh: &Mesh<D>,
    surface: &Surface<D>,
    faces: &mut Vec<InnerFace>,
) -> Result<(), SplitError> {
    let ridges = ridges(D, faces);
    let pieces = pieces(D, &ridges, &surface.name, faces)?;
    let mut normals = Vec::new();
    for piece in &pieces {
        let mean = Mean::from_faces(mesh, piece, faces);
        let reversed = match &surface.towards_plus {
            Some(direction) => mean.is_against(surface, direction, faces[piece[0]].index)?,
            None => mean.is_reversed(mesh, piece, faces),
        };
        if reversed {
            piece.iter().for_each(|&k| faces[k].turn());
        }
        normals.push(if reversed { mean.normal.map(|c| -c) } else { mean.normal });
    }
    if surface.towards_plus.is_none() {
        agree(surface, &normals)?;
    }
    if D == 2 {
        let mut order = Vec::with_capacity(faces.len());
        for piece in &pieces {
            walk(surface, &ridges, piece, faces, &mut order);
        }
        *faces = order.into_iter().map(|k| faces[k].clone()).collect();
    }
    Ok(())
}

/// The ridges of a face and the direction in which it passes them.
fn ridges_of(dimension: usize, face: &InnerFace) -> Vec<(Ridge, bool)> {
    let c = face.corners(dimension);
    if dimension == 2 {
        return vec![([c[0]; 2], false), ([c[1]; 2], true)];
    }
    (0..c.len())
        .map(|k| {
            let (a, b) = (c[k], c[(k + 1) % c.len()]);
            ([a.min(b), a.max(b)], a < b)
        })
        .collect()
}

fn ridges(dimension: usize, faces: &[InnerFace]) -> Ridges {
    let mut ridges = Ridges::new();
    for (k, face) in faces.iter().enumerate() {
        for (ridge, sense) in ridges_of(dimension, face) {
            ridges.entry(ridge).or_default().push((k, sense));
        }
    }
    ridges
}

/// Faces connected over ridges of two faces; each piece is oriented like its first face. At ridges of more than two faces, the
/// surface is divided into pieces.
fn pieces(
    dimension: usize,
    ridges: &Ridges,
    name: &str,
    faces: &mut [InnerFace],
) -> Result<Vec<Vec<usize>>, SplitError> {
    // True if the face is reversed against its given direction; `None` until it is reached.
    let mut turned: Vec<Option<bool>> = vec![None; faces.len()];
    let mut pieces = Vec::new();
    for first in 0..faces.len() {
        if turned[first].is_some() {
            continue;
        }
        turned[first] = Some(false);
        let mut piece = vec![first];
        let mut next = 0;
        while next < piece.len() {
            let face = piece[next];
            let own = turned[face] == Some(true);
            next += 1;
            for (ridge, sense) in ridges_of(dimension, &faces[face]) {
                let [a, b] = ridges[&ridge][..] else { continue };
                let (other, other_sense) = if a.0 == face { b } else { a };
                // Neighbours that agree pass their ridge in opposite directions.
                let turn = (sense != own) == other_sense;
                match turned[other] {
                    None => {
                        turned[other] = Some(turn);
                        piece.push(other);
                    }
                    Some(t) if t != turn => {
                        return Err(SplitError::NotOrientable {
                            surface: name.to_string(),
                            face: faces[other].index,
                        });
                    }
                    Some(_) => {}
                }
            }
        }
        piece.sort_unstable();
        pieces.push(piece);
    }
    for (face, turned) in faces.iter_mut().zip(turned) {
        if turned == Some(true) {
            face.turn();
        }
    }
    Ok(pieces)
}

/// Normal times area of a face, from minus to plus: the edge turned clockwise, or half the cross products around the corners.
fn area_vector<const D: usize>(mesh: &Mesh<D>, face: &InnerFace) -> [f64; D] {
    let x: Vec<[f64; D]> = face.corners(D).iter().map(|&n| mesh.nodes[n]).collect();
    if D == 2 {
        return std::array::from_fn(|c| if c == 0 { x[1][1] - x[0][1] } else { x[0][0] - x[1][0] });
    }
    let mut area = [0.0; D];
    for k in 1..x.len() - 1 {
        for (c, total) in area.iter_mut().enumerate() {
            let (i, j) = ((c + 1) % D, (c + 2) % D);
            let edge = |m: usize, axis: usize| x[m][axis] - x[0][axis];
            *total += 0.5 * (edge(k, i) * edge(k + 1, j) - edge(k, j) * edge(k + 1, i));
        }
    }
    area
}

/// Mean normal of a piece.
struct Mean<const D: usize> {
    /// Sum of area vectors over the area: shorter than a unit vector where the piece is curved.
    normal: [f64; D],
}

impl<const D: usize> Mean<D> {
    fn from_faces(mesh: &Mesh<D>, piece: &[usize], faces: &[InnerFace]) -> Self {
        let (mut sum, mut area) = ([0.0; D], 0.0);
        for &k in piece {
            let a = area_vector(mesh, &faces[k]);
            area += length(&a);
            sum.iter_mut().zip(a).for_each(|(s, a)| *s += a);
        }
        Self { normal: sum.map(|s| s / area) }
    }

    /// True if the normal points against `direction`.
    fn is_against(
        &self,
        surface: &Surface<D>,
        direction: &[f64; D],
        face: usize,
    ) -> Result<bool, SplitError> {
        let cosine = dot(&self.normal, direction) / length(direction);
        // In this form a direction without length (NaN) is refused, too.
        if !matches!(cosine.abs().partial_cmp(&CROSSES), Some(std::cmp::Ordering::Greater)) {
            return Err(SplitError::Hint { surface: surface.name.clone(), face, cosine });
        }
        Ok(cosine < 0.0)
    }

    /// True if the normal points to smaller x; where the piece is parallel to x, to smaller y, then z; where it is closed,
    /// inwards.
    fn is_reversed(&self, mesh: &Mesh<D>, piece: &[usize], faces: &[InnerFace]) -> bool {
        match self.normal.iter().find(|c| c.abs() > FACES) {
            Some(c) => *c < 0.0,
            None => points_inwards(mesh, piece, faces),
        }
    }
}

/// True if the normals of a closed piece point to its inside: the area or volume around a node, from the distances of faces.
fn points_inwards<const D: usize>(mesh: &Mesh<D>, piece: &[usize], faces: &[InnerFace]) -> bool {
    let origin = mesh.nodes[faces[piece[0]].nodes[0][0]];
    let share = |k: &usize| {
        let corners = faces[*k].corners(D);
        let middle: [f64; D] = std::array::from_fn(|c| {
            corners.iter().map(|&n| mesh.nodes[n][c] - origin[c]).sum::<f64>() / corners.len() as f64
        });
        dot(&middle, &area_vector(mesh, &faces[*k]))
    };
    piece.iter().map(share).sum::<f64>() < 0.0
}

/// Refuses pieces whose normals point away from each other, because one rule then calls opposite sides of them plus.
fn agree<const D: usize>(surface: &Surface<D>, normals: &[[f64; D]]) -> Result<(), SplitError> {
    let open = |n: &&[f64; D]| n.iter().any(|c| c.abs() > FACES);
    let all: Vec<&[f64; D]> = normals.iter().filter(open).collect();
    let pairs = all.iter().enumerate().flat_map(|(k, a)| all[..k].iter().map(move |b| (*a, *b)));
    // Right angles, as at a junction, have rounding.
    let mut apart = pairs.filter(|(a, b)| dot(a, b) < -FACES * length(a) * length(b));
    match apart.next() {
        None => Ok(()),
        Some((a, b)) => {
            let [a, b] = [a, b].map(|n| n.to_vec());
            Err(SplitError::Apart { surface: surface.name.clone(), normals: [b, a] })
        }
    }
}

fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Appends the faces of a piece in order along the fault, starting at the end whose face was given first; a closed piece
/// starts at its first face.
fn walk<const D: usize>(
    surface: &Surface<D>,
    ridges: &Ridges,
    piece: &[usize],
    faces: &mut [InnerFace],
    order: &mut Vec<usize>,
) {
    let is_end = |node: usize| ridges[&[node; 2]].len() != 2;
    let ends = |k: usize, faces: &[InnerFace]| [faces[k].nodes[0][0], faces[k].nodes[0][1]];
    let start = piece.iter().copied().find(|&k| ends(k, faces).into_iter().any(is_end));
    let mut face = start.unwrap_or(piece[0]);
    let [a, b] = ends(face, faces);
    // A piece of one face, or a closed one, follows the direction in which the face was given.
    let mut from = if is_end(a) == is_end(b) {
        surface.faces[faces[face].index][0]
    } else if is_end(a) {
        a
    } else {
        b
    };
    for _ in 0..piece.len() {
        let [a, b] = ends(face, faces);
        faces[face].backwards = from == b;
        order.push(face);
        from = if from == a { b } else { a };
        let Some(&(next, _)) = ridges[&[from; 2]].iter().find(|(k, _)| *k != face) else { break };
        face = next;
    }
}
