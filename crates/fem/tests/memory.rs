//! Memory held at a time by the mesh readers, relative to the size of the file: whatever its headers announce, and however its
//! lists refer to each other.
#![allow(clippy::unwrap_used, clippy::disallowed_methods, clippy::format_push_string)]

mod counting;

use asperity_fem::block::LinearBlock;
use asperity_fem::condense::{Condensation, LoadedBody, Stiffness};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::{Formulation, Idealisation};
use asperity_fem::material::elastic::Elastic;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::{MeshError, Options, RawMesh, abaqus, gmsh};
use counting::{CountingAllocator, peak_of};
use std::fmt::Write;

#[global_allocator]
static ALLOCATOR: CountingAllocator = CountingAllocator;

/// Memory that a reader needs for an empty file \[bytes\]: names, tables of quadrature, an error.
const BASE: usize = 64 << 10;

/// Bytes held for each byte of a file that is a mesh. In reading, a number of two bytes or more becomes one of eight, and a node
/// of eight or more a record of 32. In Abaqus files each element is also in a tree of its set. Making the mesh needs this memory
/// again for indices, with the elements in order.
const HONEST: usize = 10;

/// Bytes held for each byte of any file. An entry of a set of sets costs no text but is bounded by two for each byte, and takes
/// up to 70; cells at the same position make 64 pairs each.
const ANY: usize = 256;

type Parse = fn(&[u8]) -> Result<RawMesh, MeshError>;

/// Peaks of reading and of making meshes, with the result of the latter.
fn peaks(parse: Parse, bytes: &[u8], options: &Options) -> (usize, usize, String) {
    let (raw, parsing) = peak_of(|| parse(bytes));
    let raw = match raw {
        Ok(raw) => raw,
        Err(e) => return (parsing, 0, e.to_string()),
    };
    let ((), meshing) = peak_of(|| {
        let _ = raw.clone().into_mesh::<3>(options);
    });
    let (mesh, plane) = peak_of(|| raw.into_mesh::<2>(options));
    let what = match mesh {
        Ok(mesh) => format!("{} nodes", mesh.nodes.len()),
        Err(e) => e.to_string(),
    };
    (parsing, meshing.max(plane), what)
}

/// Asserts that at most `most` bytes are held for each byte, and returns the result.
fn assert_bounded(name: &str, parse: Parse, bytes: &[u8], options: &Options, most: usize) -> String {
    let (reading, meshing, what) = peaks(parse, bytes, options);
    let held = reading.max(meshing);
    assert!(held <= BASE + most * bytes.len(), "{name}: {reading} and {meshing} of {}: {what}", bytes.len());
    what
}

/// A plane grid of n x n quadrilaterals in one group, in the formats MSH 2.2 and 4.1 and Abaqus.
fn grid(n: usize) -> [(&'static str, Parse, Vec<u8>); 4] {
    let m = n + 1;
    let node = |k: usize| (k % m, k / m);
    let quad = |e: usize| {
        let a = 1 + e % n + e / n * m;
        [a, a + 1, a + 1 + m, a + m]
    };
    let mut v22 = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", m * m);
    let mut v41 = format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n$Nodes\n1 {0} 1 {0}\n2 1 0 {0}\n",
        m * m
    );
    let mut inp = String::from("*NODE\n");
    let mut binary = b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Entities\n".to_vec();
    for count in [0_u64, 0, 1, 0] {
        binary.extend(count.to_le_bytes());
    }
    binary.extend(1_i32.to_le_bytes());
    for x in [0.0_f64, 0.0, 0.0, 1.0, 1.0, 0.0] {
        binary.extend(x.to_le_bytes());
    }
    binary.extend(1_u64.to_le_bytes());
    binary.extend(1_i32.to_le_bytes());
    binary.extend(0_u64.to_le_bytes());
    binary.extend(b"\n$EndEntities\n$Nodes\n");
    for count in [1, m * m, 1, m * m] {
        binary.extend((count as u64).to_le_bytes());
    }
    for word in [2_i32, 1, 0] {
        binary.extend(word.to_le_bytes());
    }
    binary.extend((m * m).to_le_bytes());
    for k in 0..m * m {
        writeln!(v41, "{}", k + 1).unwrap();
        binary.extend((k as u64 + 1).to_le_bytes());
    }
    for k in 0..m * m {
        let (i, j) = node(k);
        writeln!(v22, "{} {i} {j} 0", k + 1).unwrap();
        writeln!(v41, "{i} {j} 0").unwrap();
        writeln!(inp, "{}, {i}, {j}", k + 1).unwrap();
        [i as f64, j as f64, 0.0].iter().for_each(|x| binary.extend(x.to_le_bytes()));
    }
    write!(v22, "$EndNodes\n$Elements\n{}\n", n * n).unwrap();
    write!(v41, "$EndNodes\n$Elements\n1 {0} 1 {0}\n2 1 3 {0}\n", n * n).unwrap();
    inp.push_str("*ELEMENT, TYPE=CPE4, ELSET=body\n");
    binary.extend(b"\n$EndNodes\n$Elements\n");
    for count in [1, n * n, 1, n * n] {
        binary.extend((count as u64).to_le_bytes());
    }
    for word in [2_i32, 1, 3] {
        binary.extend(word.to_le_bytes());
    }
    binary.extend((n * n).to_le_bytes());
    for e in 0..n * n {
        let [a, b, c, d] = quad(e);
        writeln!(v22, "{} 3 2 1 1 {a} {b} {c} {d}", e + 1).unwrap();
        writeln!(v41, "{} {a} {b} {c} {d}", e + 1).unwrap();
        writeln!(inp, "{}, {a}, {b}, {c}, {d}", e + 1).unwrap();
        [e + 1, a, b, c, d].iter().for_each(|x| binary.extend((*x as u64).to_le_bytes()));
    }
    v22.push_str("$EndElements\n");
    v41.push_str("$EndElements\n");
    binary.extend(b"\n$EndElements\n");
    [
        ("2.2", gmsh::parse as Parse, v22.into_bytes()),
        ("4.1", gmsh::parse, v41.into_bytes()),
        ("4.1 binary", gmsh::parse, binary),
        ("abaqus", abaqus::parse, inp.into_bytes()),
    ]
}

#[test]
fn a_large_mesh_takes_a_few_times_its_file() {
    for (name, parse, bytes) in grid(200) {
        assert_eq!(assert_bounded(name, parse, &bytes, &Options::default(), HONEST), "40401 nodes");
    }
}

#[test]
fn lists_that_refer_to_each_other_stay_within_bounds() {
    let free = Options { allow_free_parts: true, ..Options::default() };
    for (name, parse, text, ends) in [
        ("groups", gmsh::parse as Parse, many_groups(5000), "3 nodes"),
        ("faces", gmsh::parse, equal_faces(5000), "three cells or more"),
        ("stack", gmsh::parse, stacked(5000), "15000 nodes"),
        ("surfaces", abaqus::parse, surfaces_of_a_set(5000), "beyond all measure"),
        ("sets", abaqus::parse, sets_of_everything(5000), "beyond all measure"),
        ("tags", gmsh::parse, own_groups(5000), "3 nodes"),
    ] {
        let what = assert_bounded(name, parse, text.as_bytes(), &free, ANY);
        assert!(what.contains(ends), "{name}: {what}");
        assert_bounded(name, parse, text.as_bytes(), &Options::default(), ANY);
    }
}

/// Beginnings of files up to a false count; `#` represents it in text, `@` for its eight bytes and `%` for its four.
const LIES: [&str; 15] = [
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n#\n",
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n#\n",
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n1\n1 15 #\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n#\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n# # # #\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 0 0\n1 0 0 0 #\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PartitionedEntities\n1 #\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n# # 1 1\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 0 #\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n# # 1 1\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Elements\n1 1 1 1\n3 1 12 #\n",
    "$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n@@@@",
    "$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Entities\n@@@@",
    "$MeshFormat\n2.2 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n#\n",
    "$MeshFormat\n2.2 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n#\n\x11\0\0\0%\0\0\0\0",
];

#[test]
fn what_a_header_announces_is_not_believed() {
    const PADDING: usize = 1 << 20;
    for lie in LIES {
        for count in [1 << 14, 1 << 17, 1 << 19, 1 << 31, 1 << 40, u64::MAX] {
            let mut bytes = Vec::new();
            for &byte in lie.as_bytes() {
                match byte {
                    b'#' => bytes.extend(count.to_string().bytes()),
                    b'@' => bytes.extend(count.to_le_bytes()),
                    b'%' => bytes.extend((count as u32).to_le_bytes()),
                    byte => bytes.push(byte),
                }
            }
            let what = assert_bounded(lie, gmsh::parse, &bytes, &Options::default(), 0);
            assert!(!what.ends_with("nodes"), "{lie}");
            // Further bytes make the false count more plausible.
            for filler in [0_u8, b' ', b'1'] {
                let mut bytes = bytes.clone();
                bytes.resize(bytes.len() + PADDING, filler);
                assert_bounded(lie, gmsh::parse, &bytes, &Options::default(), HONEST);
            }
        }
    }
}

const HEAD: &str = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const TRIANGLE: &str = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";

/// An entity in 32 groups, and n blocks of one line element of it.
fn many_groups(n: usize) -> String {
    let groups: Vec<String> = (1..=32).map(|g| g.to_string()).collect();
    let mut text = format!(
        "{HEAD}$Entities\n0 1 1 0\n1 0 0 0 1 1 0 32 {} 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n{TRIANGLE}$Elements\n{1} {1} 1 {1}\n2 1 2 1\n1 1 2 3\n",
        groups.join(" "),
        n + 1
    );
    for e in 0..n {
        writeln!(text, "1 1 1 1\n{} 1 2", e + 2).unwrap();
    }
    text + "$EndElements\n"
}

/// n identical triangles, and n identical lines that name their common face.
fn equal_faces(n: usize) -> String {
    let mut text = format!(
        "{HEAD}$Entities\n0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n{TRIANGLE}$Elements\n2 {} 1 {}\n2 1 2 {n}\n",
        2 * n,
        2 * n
    );
    (0..n).for_each(|e| writeln!(text, "{} 1 2 3", e + 1).unwrap());
    writeln!(text, "1 1 1 {n}").unwrap();
    (0..n).for_each(|e| writeln!(text, "{} 1 2", n + e + 1).unwrap());
    text + "$EndElements\n"
}

/// n triangles with separate nodes at the same positions.
fn stacked(n: usize) -> String {
    let mut text = format!(
        "{HEAD}$Entities\n0 0 1 0\n1 0 0 0 1 1 0 1 1 0\n$EndEntities\n$Nodes\n1 {0} 1 {0}\n2 1 0 {0}\n",
        3 * n
    );
    (0..3 * n).for_each(|k| writeln!(text, "{}", k + 1).unwrap());
    (0..n).for_each(|_| text.push_str("0 0 0\n1 0 0\n0 1 0\n"));
    write!(text, "$EndNodes\n$Elements\n1 {n} 1 {n}\n2 1 2 {n}\n").unwrap();
    (0..n).for_each(|e| writeln!(text, "{} {} {} {}", e + 1, 3 * e + 1, 3 * e + 2, 3 * e + 3).unwrap());
    text + "$EndElements\n"
}

const NODES: &str = "*NODE\n1,0,0\n2,1,0\n3,0,1\n";

/// A set of n triangles, and n lines of a surface that name the set.
fn surfaces_of_a_set(n: usize) -> String {
    let mut text = format!("{NODES}*ELEMENT, TYPE=CPE3, ELSET=s\n");
    (0..n).for_each(|e| writeln!(text, "{},1,2,3", e + 1).unwrap());
    text.push_str("*SURFACE, NAME=f\n");
    (0..n).for_each(|_| text.push_str("s,S1\n"));
    text
}

/// n triangles, and n sets of all of them.
fn sets_of_everything(n: usize) -> String {
    let mut text = format!("{NODES}*ELEMENT, TYPE=CPE3, ELSET=s\n");
    (0..n).for_each(|e| writeln!(text, "{},1,2,3", e + 1).unwrap());
    (0..n).for_each(|k| write!(text, "*ELSET, ELSET={k}a\ns\n").unwrap());
    text
}

/// n lines, each in a separate group and entity.
fn own_groups(n: usize) -> String {
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n$Elements\n{}\n1 2 1 1 1 2 3\n",
        n + 1
    );
    (0..n).for_each(|e| writeln!(text, "{0} 1 1 {0} 1 2", e + 2).unwrap());
    text + "$EndElements\n"
}

/// A square of n x n quadratic cells, antiplane.
fn square(n: usize) -> (Stiffness, usize) {
    let grading = [Grading::Uniform; 2];
    let block = Block { min: [0.0; 2], max: [1.0; 2], divisions: [n; 2], grading, kind: ElementKind::Quad9 };
    let mesh = block.mesh().unwrap();
    let material = Elastic::new(1.0, 0.25).unwrap();
    let cells =
        LinearBlock::new(&mesh, 0, &material, Idealisation::Antiplane, Formulation::Standard).unwrap();
    let (pattern, values) = cells.into_stiffness();
    (Stiffness { pattern, values, dofs: mesh.nodes.len() }, mesh.nodes.len())
}

#[test]
fn condensation_with_loads_holds_what_it_foretells_and_less_than_the_factor() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        let (body, dofs) = square(60);
        let (retained, fixed) = ((0..61).collect::<Vec<_>>(), (dofs - 61..dofs).collect::<Vec<_>>());
        let loaded =
            |body: &Stiffness| LoadedBody::analyse(body.clone(), &retained, &fixed, Vec::new()).unwrap();
        // Dense kernels keep their memory after the first use.
        loaded(&body).eliminate(usize::MAX).unwrap();
        let loaded = loaded(&body);
        let (asked, told) = (loaded.asked(1), loaded.bytes(1));
        let (left, held) = peak_of(|| loaded.eliminate(usize::MAX).unwrap());
        assert_eq!(left.order(), 61);
        assert!(held <= asked, "{held} of {asked}");
        // Only half of the contributions is written.
        assert!(told < asked && 2 * told > asked, "{told} of {asked}");
        let factored = Condensation::analyse(&body, &retained, &fixed).unwrap();
        let whole = factored.bytes();
        assert!(3 * asked < 2 * whole, "{asked} and {whole}");
    });
}
