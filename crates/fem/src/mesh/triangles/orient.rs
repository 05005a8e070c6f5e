//! One orientation for each connected piece of a surface of triangles.

use super::error::TriangleError;
use std::collections::BTreeMap;

/// Triangles at each side, with the direction in which they pass it.
type Sides = BTreeMap<[usize; 2], Vec<(usize, bool)>>;

/// Pieces that are connected over common sides. Triangles that are oriented against the first one of their piece are
/// turned; `turned` counts them.
pub(super) struct Pieces {
    pub pieces: Vec<Vec<usize>>,
    pub turned: usize,
}

fn sides(corners: &[[usize; 3]]) -> Sides {
    let mut sides = Sides::new();
    for (k, c) in corners.iter().enumerate() {
        for i in 0..3 {
            let (a, b) = (c[i], c[(i + 1) % 3]);
            sides.entry([a.min(b), a.max(b)]).or_default().push((k, a < b));
        }
    }
    sides
}

/// Orients the triangles of each piece as most of them are.
///
/// # Errors
/// [`TriangleError::Branch`] and [`TriangleError::OneSided`].
pub(super) fn orient(corners: &mut [[usize; 3]], elements: &[u64]) -> Result<Pieces, TriangleError> {
    let sides = sides(corners);
    // Neighbours of each triangle, and whether both have the same orientation.
    let mut next: Vec<Vec<(usize, bool)>> = vec![Vec::new(); corners.len()];
    for at in sides.values() {
        match at.as_slice() {
            [_] => {}
            [(a, along), (b, other)] => {
                next[*a].push((*b, along != other));
                next[*b].push((*a, along != other));
            }
            [a, b, c, ..] => {
                return Err(TriangleError::Branch { elements: [a, b, c].map(|s| elements[s.0]) });
            }
            [] => {}
        }
    }
    let mut sense: Vec<Option<bool>> = vec![None; corners.len()];
    let mut found = Pieces { pieces: Vec::new(), turned: 0 };
    for first in 0..corners.len() {
        if sense[first].is_some() {
            continue;
        }
        sense[first] = Some(true);
        let mut piece = vec![first];
        let mut reached = 0;
        while let Some(&k) = piece.get(reached) {
            reached += 1;
            let own = sense[k] == Some(true);
            for &(j, same) in &next[k] {
                let wanted = own == same;
                match sense[j] {
                    None => {
                        sense[j] = Some(wanted);
                        piece.push(j);
                    }
                    Some(there) if there != wanted => {
                        return Err(TriangleError::OneSided { element: elements[j] });
                    }
                    Some(_) => {}
                }
            }
        }
        let against = piece.iter().filter(|&&k| sense[k] == Some(false)).count();
        let minority = 2 * against <= piece.len();
        for &k in piece.iter().filter(|&&k| sense[k] == Some(!minority)) {
            corners[k].swap(1, 2);
            found.turned += 1;
        }
        piece.sort_unstable();
        found.pieces.push(piece);
    }
    Ok(found)
}
