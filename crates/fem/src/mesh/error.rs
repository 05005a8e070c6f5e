//! Errors of a mesh file.

use std::fmt;

/// Position in a file: the line of a text, or the byte of a binary section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Line, counted from 1.
    Line(usize),
    /// Offset from the beginning of the file \[bytes\].
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// A group of a mesh: its dimension and its name.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GroupName {
    /// Dimension of its elements.
    pub dimension: usize,
    /// Name, or number if the file has no name for it.
    pub name: String,
}

/// A part of a mesh: cells joined by common nodes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Groups its cells belong to.
    pub groups: Vec<String>,
    /// Number of cells.
    pub cells: usize,
    /// Number in the file of its first element.
    pub element: u64,
}

impl fmt::Display for Part {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { groups, cells, element } = self;
        match groups[..] {
            [] => write!(f, "the part of {cells} cells around element {element}"),
            _ => write!(f, "the part `{}` ({cells} cells, among them element {element})", groups.join(", ")),
        }
    }
}

/// Errors of a mesh file. Elements and nodes are named by their numbers in the file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// Bytes that violate the format.
    #[error("{section}, {place}: expected {expected}, found `{found}`")]
    Syntax {
        /// Section or keyword.
        section: String,
        /// Position.
        place: Place,
        /// Content expected by the format.
        expected: &'static str,
        /// Content found.
        found: String,
    },
    /// The file ends before the announced data, or in the middle of a value.
    #[error(
        "{section}, {place}: {count} {what} announced, but only {left} bytes follow: the file is truncated or its \
         header is damaged"
    )]
    Truncated {
        /// Section or keyword.
        section: String,
        /// Position.
        place: Place,
        /// Announced items.
        what: &'static str,
        /// Number announced.
        count: u64,
        /// Bytes that follow.
        left: usize,
    },
    /// A count that only makes sense in the other order of bytes.
    #[error(
        "{section}, {place}: {count} {what} announced, or {swapped} with the bytes in the other order: the numbers of the file are not in          the order that the 1 in $MeshFormat tells"
    )]
    Swapped {
        /// Section.
        section: String,
        /// Position.
        place: Place,
        /// Announced items.
        what: &'static str,
        /// Number as read.
        count: u64,
        /// Number in the other order.
        swapped: u64,
    },
    /// A header that contradicts the data.
    #[error("{section}: the header announces {announced} {what}, the section holds {held}")]
    Count {
        /// Section.
        section: String,
        /// Counted items.
        what: &'static str,
        /// Number in the header.
        announced: u64,
        /// Number in the section.
        held: u64,
    },
    /// An unsupported version of the format.
    #[error("MSH version {found} is not read; those that are: 2.2 and 4.1")]
    Version {
        /// Version of the file.
        found: String,
    },
    /// An unsupported size of numbers.
    #[error("{section}: numbers of {found} bytes are not read, only those of 8")]
    DataSize {
        /// Section.
        section: String,
        /// Size of the file's numbers \[bytes\].
        found: i64,
    },
    /// A binary file without the number that indicates the byte order.
    #[error("$MeshFormat, {place}: the number 1 that tells the order of bytes is missing")]
    ByteOrder {
        /// Position.
        place: Place,
    },
    /// A required section that is missing.
    #[error("the file has no {section}")]
    MissingSection {
        /// Section or keyword.
        section: &'static str,
    },
    /// A repeated section or keyword, or one that changes the meaning of others.
    #[error("{section}, {place}: {reason}")]
    Unsupported {
        /// Section or keyword.
        section: String,
        /// Position.
        place: Place,
        /// Reason.
        reason: &'static str,
    },
    /// An element of an unsupported shape.
    #[error("{section}, {place}: element {element} has the unsupported type {kind}")]
    UnsupportedElement {
        /// Section or keyword.
        section: String,
        /// Position.
        place: Place,
        /// Element.
        element: u64,
        /// Type, as the format names it.
        kind: String,
    },
    /// An unsupported element type, before any element of it.
    #[error("{section}, {place}: elements of type {kind} are not read")]
    UnsupportedKind {
        /// Section or keyword.
        section: String,
        /// Position.
        place: Place,
        /// Type, as the format names it.
        kind: String,
    },
    /// Cells of a shape without an element.
    #[error("element {element} is of type {kind}, for which there is no element here")]
    NoElement {
        /// Element.
        element: u64,
        /// Type.
        kind: &'static str,
    },
    /// A node defined twice.
    #[error("node {node} is defined twice")]
    DuplicateNode {
        /// Node.
        node: u64,
    },
    /// An element defined twice.
    #[error("element {element} is defined twice")]
    DuplicateElement {
        /// Element.
        element: u64,
    },
    /// A node that does not exist.
    #[error("{holder} refers to node {node}, which does not exist")]
    DanglingNode {
        /// The element or set that refers to it.
        holder: Holder,
        /// Node.
        node: u64,
    },
    /// An element that does not exist.
    #[error("the set `{set}` refers to element {element}, which does not exist")]
    DanglingElement {
        /// Set.
        set: String,
        /// Element.
        element: u64,
    },
    /// A set that does not exist.
    #[error("{section}, {place}: there is no set `{set}`{}", suggestion(set, present))]
    UnknownSet {
        /// Keyword.
        section: String,
        /// Position.
        place: Place,
        /// Set.
        set: String,
        /// Sets that exist.
        present: Vec<String>,
    },
    /// A coordinate that is not a number.
    #[error("node {node} has the coordinate {} = {value}", ["x", "y", "z"][*axis])]
    Coordinate {
        /// Node.
        node: u64,
        /// Axis.
        axis: usize,
        /// Value.
        value: f64,
    },
    /// A node off the plane z = 0 of a plane mesh.
    #[error("node {node} of the plane mesh has z = {z:e}: a plane mesh lies in z = 0")]
    OffPlane {
        /// Node.
        node: u64,
        /// Its z, in the unit of the file.
        z: f64,
    },
    /// An invalid unit of length.
    #[error("the unit of length is {metres} m: it must be positive and finite")]
    LengthUnit {
        /// Given length \[m\].
        metres: f64,
    },
    /// A mesh of a different dimension than requested.
    #[error("the mesh is {found}-dimensional, a {wanted}-dimensional one is needed")]
    Dimension {
        /// Largest dimension of the file's elements.
        found: usize,
        /// Requested dimension.
        wanted: usize,
    },
    /// No elements at all.
    #[error("the file has no elements")]
    NoElements,
    /// No group at all.
    #[error(
        "the mesh has no groups ({cells} cells without any): name the bodies and boundaries as physical groups (Gmsh) or \
         sets (Abaqus) and write the file again{}",
        wanted_list(wanted)
    )]
    NoGroups {
        /// Number of cells.
        cells: usize,
        /// Requested groups.
        wanted: Vec<String>,
    },
    /// A requested group that does not exist.
    #[error("there is no group `{name}`{}", group_suggestion(name, present))]
    MissingGroup {
        /// Group.
        name: String,
        /// Groups of the file.
        present: Vec<GroupName>,
    },
    /// A group number that does not exist.
    #[error("`{name}` is declared as group {tag}, but no group has this number; there are {}", list(present))]
    MissingTag {
        /// Name to be given to the group.
        name: String,
        /// Number.
        tag: i64,
        /// Numbers of the file.
        present: Vec<i64>,
    },
    /// An error in a file that counts the nodes and elements of each instance from one.
    #[error("{error} (counted on from one instance to the next: {})", counted(origins))]
    Numbered {
        /// The error.
        error: Box<MeshError>,
        /// First numbers of each instance but the first.
        origins: Vec<(u64, String)>,
    },
    /// Elements of a group of faces or nodes that belong to no cell.
    #[error(
        "{count} of the elements of group `{group}` belong to no cell of the mesh, the first is element {element}: a body \
         beside them is missing in the file, or they lie off it"
    )]
    Orphan {
        /// Group.
        group: String,
        /// First such element.
        element: u64,
        /// Number of them.
        count: usize,
    },
    /// A named face of more than two cells.
    #[error(
        "element {element} of group `{group}` is a face of three cells or more, the third is element {cell}: a face lies \
         between two cells at the most, so cells overlap or stand in the file twice"
    )]
    Crowded {
        /// Group.
        group: String,
        /// The element that names the face.
        element: u64,
        /// The third cell.
        cell: u64,
    },
    /// An element that is inverted, folded, or without volume.
    #[error(
        "element {element} ({kind}) is {}: its Jacobian determinant, relative to its greatest, falls to {least:.3} \
         (it must be positive){}",
        if *least <= -1.0 { "inverted" } else { "folded or flat" },
        others(*count)
    )]
    Inverted {
        /// Element.
        element: u64,
        /// Its kind.
        kind: &'static str,
        /// Smallest determinant over the largest magnitude in the element \[-\]; -1 for one inverted throughout.
        least: f64,
        /// Number of such elements.
        count: usize,
    },
    /// Nodes on edges of cells that do not have them.
    #[error(
        "nodes hang ({count}): the one at {at:?} m lies on an edge of element {element}, which does not have it, so that cells on \
         both sides are not joined there. Cells that meet share all nodes of a face: mesh both sides alike and in one order, or name \
         the faces on both sides when they are an interface"
    )]
    HangingNodes {
        /// Position of one of them \[m\].
        at: Vec<f64>,
        /// Element with the edge.
        element: u64,
        /// Number of nodes.
        count: usize,
    },
    /// Elements that lie over each other.
    #[error(
        "elements {} and {} lie over each other: they have a face in common, at node {at:?} m, and are on the same side of it. Each would \
         have its stiffness and weight there: leave one of them out", .elements[0], .elements[1]
    )]
    Overlapping {
        /// Both elements.
        elements: [u64; 2],
        /// Position of a common node \[m\].
        at: Vec<f64>,
    },
    /// A part that touches another without being tied to it.
    #[error(
        "{free} hangs free: {pairs} of its nodes coincide with nodes of {other}, but the two share none, and no named face \
         lies there on both sides. Weld the nodes, or name the faces on both sides when they are an interface"
    )]
    FreePart {
        /// The part that hangs free.
        free: Part,
        /// The part it touches.
        other: Part,
        /// Pairs of coincident nodes of the two.
        pairs: usize,
    },
}

/// An element or a set that refers to a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Holder {
    /// An element.
    Element(u64),
    /// A set.
    Set(String),
}

impl fmt::Display for Holder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Element(tag) => write!(f, "element {tag}"),
            Self::Set(name) => write!(f, "the set `{name}`"),
        }
    }
}

/// Instances named in an error.
const MOST_ORIGINS: usize = 4;

fn counted(origins: &[(u64, String)]) -> String {
    let named = origins.iter().take(MOST_ORIGINS).map(|(first, name)| format!("`{name}` after {first}"));
    let more = if origins.len() > MOST_ORIGINS { ", .." } else { "" };
    format!("{}{more}", named.collect::<Vec<_>>().join(", "))
}

fn others(count: usize) -> String {
    if count > 1 { format!("; {count} elements are so") } else { String::new() }
}

fn list(numbers: &[i64]) -> String {
    let numbers: Vec<String> = numbers.iter().map(i64::to_string).collect();
    if numbers.is_empty() { "none".to_string() } else { numbers.join(", ") }
}

fn wanted_list(wanted: &[String]) -> String {
    if wanted.is_empty() { String::new() } else { format!("; asked for: {}", wanted.join(", ")) }
}

fn suggestion(name: &str, present: &[String]) -> String {
    let list = if present.is_empty() {
        "; there are none".to_string()
    } else {
        format!("; there are {}", present.join(", "))
    };
    match super::check::nearest(name, present.iter().map(String::as_str)) {
        Some(meant) => format!("; did you mean `{meant}`?{list}"),
        None => list,
    }
}

fn group_suggestion(name: &str, present: &[GroupName]) -> String {
    let list: Vec<String> = present
        .iter()
        .map(|g| format!("`{}` ({})", g.name, ["points", "lines", "surfaces", "volumes"][g.dimension.min(3)]))
        .collect();
    let meant = super::check::nearest(name, present.iter().map(|g| g.name.as_str()))
        .map(|m| format!("; did you mean `{m}`?"))
        .unwrap_or_default();
    format!("{meant}; there are {}", list.join(", "))
}
