//! STL files, as text and binary: triangles without shared corners. Corners at the same position become one node.
//!
//! Normals and attributes of the file are not used; the order of the corners sets the side of a triangle. In a text, each
//! `solid` with a name is a group.

use super::error::{MeshError, Place};
use super::raw::{RawBlock, RawGroup, RawMesh, RawNode, Shape};
use crate::element::ElementKind;
use std::collections::BTreeMap;

/// Size of the header of a binary file, with the number of triangles \[bytes\].
const HEADER: usize = 84;
/// Size of a triangle of a binary file \[bytes\].
const FACET: usize = 50;
/// Number of characters of a wrong word shown in an error.
const SHOWN: usize = 40;

/// Reads a file. A file is binary if its size is the one that its header announces.
///
/// # Errors
/// Syntax errors with the line, and binary files that are truncated.
pub fn parse(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let announced = bytes.get(HEADER - 4..HEADER).and_then(|n| n.try_into().ok()).map(u32::from_le_bytes);
    let text = bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    match announced {
        Some(count) if bytes.len() as u64 == HEADER as u64 + u64::from(count) * FACET as u64 => {
            Ok(binary(&bytes[HEADER..]))
        }
        _ if text => ascii(bytes),
        Some(count) => Err(MeshError::Truncated {
            section: "the header".into(),
            place: Place::Byte(HEADER - 4),
            what: "triangles",
            count: u64::from(count),
            left: bytes.len() - HEADER,
        }),
        None => Err(MeshError::Syntax {
            section: "the file".into(),
            place: Place::Line(1),
            expected: "`solid`, or a binary header of 84 bytes",
            found: shown(bytes),
        }),
    }
}

fn shown(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).lines().next().unwrap_or_default().chars().take(SHOWN).collect()
}

/// Nodes and triangles as they are found.
#[derive(Default)]
struct WeldedMesh {
    mesh: RawMesh,
    /// Node at each position, by its bits.
    at: BTreeMap<[u64; 3], u64>,
}

impl WeldedMesh {
    /// Adds a triangle to the last block.
    fn add(&mut self, corners: [[f64; 3]; 3], element: u64) {
        let nodes = corners.map(|x| self.node(x));
        if let Some(block) = self.mesh.blocks.last_mut() {
            block.tags.push(element);
            block.nodes.extend(nodes);
        }
    }

    fn node(&mut self, x: [f64; 3]) -> u64 {
        // Zero has two signs.
        let x = x.map(|c| c + 0.0);
        let next = self.mesh.nodes.len() as u64 + 1;
        let tag = *self.at.entry(x.map(f64::to_bits)).or_insert(next);
        if tag == next {
            self.mesh.nodes.push(RawNode { tag, x });
        }
        tag
    }

    /// Begins a block of triangles, in a group of this name if there is one.
    fn begin(&mut self, name: &str) {
        let mut groups = Vec::new();
        if !name.is_empty() {
            groups.push(self.mesh.groups.len());
            self.mesh.groups.push(RawGroup { dimension: 2, tag: None, name: Some(name.to_string()) });
        }
        self.mesh.blocks.push(RawBlock {
            shape: Shape::Cell(ElementKind::Tri3),
            groups,
            entity: None,
            tags: Vec::new(),
            nodes: Vec::new(),
        });
    }
}

fn binary(bytes: &[u8]) -> RawMesh {
    let mut welded = WeldedMesh::default();
    welded.begin("");
    for (k, facet) in bytes.chunks_exact(FACET).enumerate() {
        let number = |i: usize| {
            let at = 4 * i;
            f64::from(f32::from_le_bytes([facet[at], facet[at + 1], facet[at + 2], facet[at + 3]]))
        };
        // The first three numbers are the normal.
        let corner = |c: usize| std::array::from_fn(|axis| number(3 + 3 * c + axis));
        welded.add([corner(0), corner(1), corner(2)], k as u64 + 1);
    }
    welded.mesh
}

fn ascii(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut welded = WeldedMesh::default();
    let (mut corners, mut element, mut section) = (Vec::new(), 0, "the file".to_string());
    let mut last = 0;
    for (k, line) in text.lines().enumerate() {
        last = k + 1;
        let wrong = |expected: &'static str| MeshError::Syntax {
            section: section.clone(),
            place: Place::Line(k + 1),
            expected,
            found: line.trim().chars().take(SHOWN).collect(),
        };
        // Some programs write the words in capitals.
        let mut words = line.split_whitespace();
        match words.next().map(str::to_ascii_lowercase).as_deref() {
            None | Some("outer" | "endloop" | "endsolid") => {}
            Some("solid") => {
                let name = words.collect::<Vec<_>>().join(" ");
                welded.begin(&name);
                section = format!("solid {name}").trim_end().to_string();
            }
            Some("facet") => corners.clear(),
            Some("vertex") => {
                let numbers: Result<Vec<f64>, _> = words.map(str::parse).collect();
                let x = numbers.ok().and_then(|n| <[f64; 3]>::try_from(n).ok());
                corners.push(x.ok_or_else(|| wrong("`vertex` and three numbers"))?);
            }
            Some("endfacet") => {
                element += 1;
                let three = <[[f64; 3]; 3]>::try_from(corners.as_slice());
                welded.add(three.map_err(|_| wrong("a facet of three vertices"))?, element);
                corners.clear();
            }
            Some(_) => return Err(wrong("`solid`, `facet`, `outer loop`, `vertex` or the end of one")),
        }
    }
    let ends = |line: &str| line.trim_start().to_ascii_lowercase().starts_with("endsolid");
    if !text.trim_end().lines().last().is_some_and(ends) {
        return Err(MeshError::Syntax {
            section,
            place: Place::Line(last),
            expected: "`endsolid`",
            found: "the end of the file".into(),
        });
    }
    Ok(welded.mesh)
}

#[cfg(test)]
mod tests {
    use super::{FACET, HEADER, parse};
    use crate::mesh::MeshError;

    const TEXT: &str = "solid ramp\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\n facet normal 0 0 1\n  outer loop\n   vertex 1 0 -0.0\n   vertex 1 1 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid ramp\n";

    /// The same two triangles as a binary file.
    fn binary() -> Vec<u8> {
        let mut bytes = vec![0; HEADER - 4];
        bytes[..5].copy_from_slice(b"solid");
        bytes.extend(2u32.to_le_bytes());
        for corners in [
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            [[1.0, 0.0, -0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        ] {
            let normal = [0.0f32, 0.0, 1.0];
            bytes.extend(normal.iter().chain(corners.as_flattened()).flat_map(|c: &f32| c.to_le_bytes()));
            bytes.extend([0, 0]);
        }
        bytes
    }

    #[test]
    fn text_and_binary_are_the_same_mesh_with_common_corners() {
        let (text, binary) = (parse(TEXT.as_bytes()).unwrap(), parse(&binary()).unwrap());
        assert_eq!(text.nodes, binary.nodes);
        assert_eq!(text.nodes.len(), 4);
        assert_eq!(text.blocks[0].nodes, binary.blocks[0].nodes);
        assert_eq!(text.blocks[0].nodes, [1, 2, 3, 2, 4, 3]);
        assert_eq!(text.groups[0].name.as_deref(), Some("ramp"));
    }

    #[test]
    fn words_in_capitals_are_the_same_words() {
        let capitals = TEXT.to_uppercase();
        let (usual, capitals) = (parse(TEXT.as_bytes()).unwrap(), parse(capitals.as_bytes()).unwrap());
        assert_eq!(usual.nodes, capitals.nodes);
        assert_eq!(usual.blocks[0].nodes, capitals.blocks[0].nodes);
        assert_eq!(capitals.groups[0].name.as_deref(), Some("RAMP"));
    }

    #[test]
    fn damaged_files_are_refused() {
        let text =
            |from: &str, to: &str| parse(TEXT.replacen(from, to, 1).as_bytes()).unwrap_err().to_string();
        assert!(text("vertex 1 0 0", "vertex 1 0").contains("line 5"));
        assert!(text("   vertex 0 1 0\n", "").contains("three vertices"));
        assert!(text("endsolid ramp\n", "").contains("endsolid"));
        let whole = binary();
        let cut = parse(&whole[..HEADER + FACET]);
        // It begins with `solid`, and is no text.
        assert!(matches!(cut, Err(MeshError::Syntax { .. })), "{cut:?}");
        let mut other = whole[..HEADER + FACET].to_vec();
        other[0] = b'x';
        assert!(matches!(parse(&other), Err(MeshError::Truncated { count: 2, .. })));
        assert!(parse(b"").is_err());
    }
}
