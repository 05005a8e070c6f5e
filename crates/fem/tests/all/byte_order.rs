//! Binary MSH files of the other byte order: the samples, reversed number by number, give the same meshes.
#![allow(clippy::disallowed_methods)]

use crate::reading::sample;
#[allow(dead_code)]
use asperity_fem::mesh::{MeshError, Place, gmsh};

/// Copies a binary file and reverses its numbers.
struct Turn<'a> {
    from: &'a [u8],
    to: Vec<u8>,
}

impl Turn<'_> {
    /// Copies a line of text, and returns it without the line end.
    fn line(&mut self) -> String {
        let end = self.from.iter().position(|&b| b == b'\n').unwrap();
        let line = String::from_utf8(self.from[..end].to_vec()).unwrap();
        self.to.extend(&self.from[..=end]);
        self.from = &self.from[end + 1..];
        line
    }

    /// The next number, of `N` bytes.
    fn number<const N: usize>(&mut self) -> [u8; N] {
        let number: [u8; N] = self.from[..N].try_into().unwrap();
        self.to.extend(number.iter().rev());
        self.from = &self.from[N..];
        number
    }

    fn int(&mut self) -> usize {
        i32::from_le_bytes(self.number()) as usize
    }

    fn size(&mut self) -> usize {
        u64::from_le_bytes(self.number()) as usize
    }

    fn ints(&mut self, n: usize) {
        for _ in 0..n {
            self.int();
        }
    }

    fn sizes(&mut self, n: usize) {
        for _ in 0..n {
            self.size();
        }
    }

    /// A count of 8 bytes, and that many numbers of 4.
    fn list(&mut self) {
        let n = self.size();
        self.ints(n);
    }

    fn entities(&mut self, partitioned: bool) {
        if partitioned {
            self.sizes(1);
            let ghosts = self.size();
            self.ints(2 * ghosts);
        }
        let counts = [(); 4].map(|()| self.size());
        for (dimension, count) in counts.into_iter().enumerate() {
            for _ in 0..count {
                self.ints(1);
                if partitioned {
                    self.ints(2);
                    self.list();
                }
                self.sizes(if dimension == 0 { 3 } else { 6 });
                self.list();
                if dimension > 0 {
                    self.list();
                }
            }
        }
    }

    fn nodes(&mut self) {
        let blocks = self.size();
        self.sizes(3);
        for _ in 0..blocks {
            let dimension = self.int();
            self.ints(1);
            let further = if self.int() == 0 { 0 } else { dimension };
            let n = self.size();
            self.sizes(n * (4 + further));
        }
    }

    fn elements(&mut self) {
        let blocks = self.size();
        self.sizes(3);
        for _ in 0..blocks {
            self.ints(2);
            let nodes = nodes_of_type(self.int());
            let n = self.size();
            self.sizes(n * (1 + nodes));
        }
    }

    fn old_nodes(&mut self) {
        let n: usize = self.line().parse().unwrap();
        for _ in 0..n {
            self.ints(1);
            self.sizes(3);
        }
    }

    fn old_elements(&mut self) {
        let mut left: usize = self.line().parse().unwrap();
        while left > 0 {
            let (nodes, n, tags) = (nodes_of_type(self.int()), self.int(), self.int());
            self.ints(n * (1 + tags + nodes));
            left -= n;
        }
    }
}

/// Nodes of an element type (Gmsh reference manual, "MSH file format").
fn nodes_of_type(kind: usize) -> usize {
    [0, 2, 3, 4, 4, 8, 6, 5, 3, 6, 9, 10, 27, 18, 14, 1, 8, 20, 15][kind]
}

fn turned(bytes: &[u8]) -> Vec<u8> {
    let mut turn = Turn { from: bytes, to: Vec::new() };
    let mut old = false;
    while !turn.from.is_empty() {
        match (turn.line().as_str(), old) {
            ("$MeshFormat", _) => {
                old = turn.line().starts_with("2.2");
                turn.ints(1);
            }
            ("$Entities", _) => turn.entities(false),
            ("$PartitionedEntities", _) => turn.entities(true),
            ("$Nodes", false) => turn.nodes(),
            ("$Nodes", true) => turn.old_nodes(),
            ("$Elements", false) => turn.elements(),
            ("$Elements", true) => turn.old_elements(),
            // Names are text; sections that are not read may stay unchanged up to their end.
            ("$Periodic", _) => while turn.line() != "$EndPeriodic" {},
            _ => {}
        }
    }
    turn.to
}

#[test]
fn files_of_both_orders_of_bytes_say_the_same() {
    for name in [
        "good_3d_tet10_shared_binary.msh",
        "unit_parametric_binary.msh",
        "unit_partitioned_binary.msh",
        "unit_quad4_v22_binary.msh",
        "unit_wedge15_v22_binary.msh",
    ] {
        let bytes = sample(name);
        let other = turned(&bytes);
        assert!(other != bytes && gmsh::parse(&other).unwrap() == gmsh::parse(&bytes).unwrap(), "{name}");
    }
}

/// The number 1 indicates the byte order; without it, a file of the other order would be read as nonsense.
#[test]
fn an_order_of_bytes_that_is_neither_is_refused() {
    let mut bytes = turned(&sample("good_3d_tet10_shared_binary.msh"));
    let at = bytes.windows(4).position(|w| w == [0, 0, 0, 1]).unwrap();
    bytes[at..at + 4].copy_from_slice(&[0, 1, 0, 0]);
    assert_eq!(gmsh::parse(&bytes), Err(MeshError::ByteOrder { place: Place::Byte(at) }));
    bytes[at..at + 4].copy_from_slice(&[1, 0, 0, 0]);
    assert!(gmsh::parse(&bytes).is_err(), "counts of the wrong order are too large for the file");
}
