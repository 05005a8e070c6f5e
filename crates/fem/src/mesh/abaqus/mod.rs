//! Abaqus input files: nodes, elements, sets and surfaces of one part (Abaqus keyword reference). Other keywords (materials,
//! steps, output) are skipped with their data; those that change positions or the origin of nodes and elements are refused.

mod lines;
mod sets;
mod shapes;

use super::error::{MeshError, Place};
use super::raw::{RawBlock, RawGroup, RawMesh, RawNode, RawSide, Shape};
use lines::{Keyword, Line, Lines};
use sets::Sets;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Reads a file. Element sets become groups by the dimension of their elements; surfaces become the faces of their elements.
///
/// # Errors
/// Syntax errors, unsupported keywords and element types, sets and elements that do not exist; with keyword and line.
pub fn parse(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader {
        nodes: Vec::new(),
        elements: Vec::new(),
        connectivity: Vec::new(),
        node_sets: Sets::of_file(bytes.len()),
        element_sets: Sets::of_file(bytes.len()),
        surfaces: Vec::new(),
        parts: 0,
        data: Data::Skipped,
        pending: Vec::new(),
        keyword: Rc::new(Keyword { name: "*".to_string(), parameters: Vec::new(), line: 1 }),
    };
    for line in Lines::new(&text) {
        match line {
            Line::Keyword(keyword) => reader.begin(keyword)?,
            Line::Data(values, line) => reader.data(&values, line)?,
        }
    }
    reader.complete()?;
    reader.finish()
}

/// Meaning of the data lines after a keyword.
#[derive(Clone, Debug)]
enum Data {
    Skipped,
    Nodes(Option<String>),
    Elements(Shape, Option<String>),
    NodeSet(String),
    ElementSet(String),
    Surface,
    Instance,
}

/// An element: its nodes begin at `first` in the connectivity.
struct Element {
    tag: u64,
    shape: Shape,
    first: usize,
}

/// A data line of a surface.
struct SurfaceLine {
    set: String,
    face: usize,
    line: usize,
    keyword: Rc<Keyword>,
}

struct Reader {
    nodes: Vec<RawNode>,
    elements: Vec<Element>,
    connectivity: Vec<u64>,
    node_sets: Sets,
    element_sets: Sets,
    surfaces: Vec<SurfaceLine>,
    parts: usize,
    data: Data,
    /// Numbers of an element that continues in the next line.
    pending: Vec<u64>,
    keyword: Rc<Keyword>,
}

impl Reader {
    /// Handles a keyword: sets the meaning of the following data, or refuses the keyword.
    fn begin(&mut self, keyword: Keyword) -> Result<(), MeshError> {
        self.complete()?;
        let set = |key| keyword.value(key).map(str::to_string);
        self.data = match keyword.name.as_str() {
            "*NODE" | "*ELEMENT" if keyword.has("INPUT") => {
                return Err(keyword.unsupported("data in another file are not read: put them into this one"));
            }
            "*NODE" if keyword.value("SYSTEM").is_some_and(|s| !s.eq_ignore_ascii_case("R")) => {
                return Err(keyword.unsupported("only rectangular coordinates are read"));
            }
            "*NODE" => Data::Nodes(set("NSET")),
            "*ELEMENT" => Data::Elements(element_shape(&keyword)?, set("ELSET")),
            "*NSET" if keyword.has("ELSET") => {
                return Err(keyword.unsupported("a set of the nodes of elements is not read: list the nodes"));
            }
            "*NSET" => Data::NodeSet(keyword.need("NSET", "NSET=name")?.to_string()),
            "*ELSET" => Data::ElementSet(keyword.need("ELSET", "ELSET=name")?.to_string()),
            "*SURFACE" if keyword.value("TYPE").is_none_or(|t| t.eq_ignore_ascii_case("ELEMENT")) => {
                keyword.need("NAME", "NAME=name")?;
                Data::Surface
            }
            "*INCLUDE" => {
                return Err(keyword.unsupported("other files are not read: put their lines into this one"));
            }
            "*PART" => {
                self.parts += 1;
                if self.parts > 1 {
                    return Err(keyword
                        .unsupported("a file with several parts is not read: write one mesh of all parts"));
                }
                Data::Skipped
            }
            "*INSTANCE" => Data::Instance,
            "*NGEN" | "*NFILL" | "*NCOPY" | "*NMAP" | "*ELGEN" | "*ELCOPY" | "*SYSTEM" | "*TRANSFORM" => {
                return Err(
                    keyword.unsupported("nodes and elements must be written out, in one system of axes")
                );
            }
            _ => Data::Skipped,
        };
        match &self.data {
            Data::NodeSet(name) => self.node_sets.declare(name),
            Data::ElementSet(name) => self.element_sets.declare(name),
            _ => {}
        }
        self.keyword = Rc::new(keyword);
        Ok(())
    }

    /// Handles a data line.
    fn data(&mut self, values: &[&str], line: usize) -> Result<(), MeshError> {
        match self.data.clone() {
            Data::Skipped => Ok(()),
            Data::Nodes(set) => self.node(values, line, set.as_deref()),
            Data::Elements(shape, set) => self.element(values, line, shape, set.as_deref()),
            Data::NodeSet(name) => self.node_sets.add_line(&name, values, line, &self.keyword),
            Data::ElementSet(name) => self.element_sets.add_line(&name, values, line, &self.keyword),
            Data::Surface => self.surface(values, line),
            Data::Instance => Err(self.keyword.unsupported("a part that is moved or turned is not read")),
        }
    }

    /// Reads a number and up to three coordinates; missing ones are zero.
    fn node(&mut self, values: &[&str], line: usize, set: Option<&str>) -> Result<(), MeshError> {
        let tag = self.keyword.number(values[0], line)?;
        let mut x = [0.0; 3];
        for (c, value) in x.iter_mut().zip(&values[1..]) {
            if !value.is_empty() {
                *c = self.keyword.real(value, line)?;
            }
        }
        self.nodes.push(RawNode { tag, x });
        if let Some(set) = set {
            self.node_sets.add(set, tag);
        }
        Ok(())
    }

    /// Reads a number and nodes, which may continue in the next lines.
    fn element(
        &mut self,
        values: &[&str],
        line: usize,
        shape: Shape,
        set: Option<&str>,
    ) -> Result<(), MeshError> {
        for value in values {
            let number = self.keyword.number(value, line)?;
            self.pending.push(number);
        }
        let wanted = 1 + shape.nodes();
        if self.pending.len() > wanted {
            let found = values.join(", ");
            return Err(self.keyword.syntax(line, "as many nodes as the type of element has", &found));
        }
        if self.pending.len() == wanted {
            let tag = self.pending[0];
            let first = self.connectivity.len();
            self.connectivity.extend(&self.pending[1..]);
            shape.reorder(shapes::order(shape), &mut self.connectivity[first..]);
            self.elements.push(Element { tag, shape, first });
            self.pending.clear();
            if let Some(set) = set {
                self.element_sets.add(set, tag);
            }
        }
        Ok(())
    }

    /// Reads an element or set of elements, and a face.
    fn surface(&mut self, values: &[&str], line: usize) -> Result<(), MeshError> {
        let face = values.get(1).and_then(|v| v.to_uppercase().strip_prefix('S')?.parse::<usize>().ok());
        let Some(face) = face.filter(|f| *f > 0) else {
            return Err(self.keyword.syntax(
                line,
                "an element or set, and a face S1 to S6",
                &values.join(", "),
            ));
        };
        let (set, keyword) = (values[0].to_string(), Rc::clone(&self.keyword));
        self.surfaces.push(SurfaceLine { set, face, line, keyword });
        Ok(())
    }

    /// Fails at the next keyword if an element is incomplete.
    fn complete(&self) -> Result<(), MeshError> {
        match self.pending.first() {
            None => Ok(()),
            Some(tag) => {
                let expected = "further nodes of the last element";
                Err(self.keyword.syntax(self.keyword.line, expected, &format!("element {tag}")))
            }
        }
    }

    fn nodes_of(&self, element: usize) -> &[u64] {
        let Element { shape, first, .. } = self.elements[element];
        &self.connectivity[first..first + shape.nodes()]
    }

    fn finish(mut self) -> Result<RawMesh, MeshError> {
        if self.nodes.is_empty() {
            return Err(MeshError::MissingSection { section: "*NODE" });
        }
        let mut order: Vec<(u64, usize)> =
            self.elements.iter().enumerate().map(|(e, x)| (x.tag, e)).collect();
        order.sort_unstable();
        if let Some(w) = order.windows(2).find(|w| w[0].0 == w[1].0) {
            return Err(MeshError::DuplicateElement { element: w[0].0 });
        }
        let tags: Vec<u64> = order.iter().map(|o| o.0).collect();
        let (groups, memberships) = self.resolve_groups(&order, &tags)?;
        let surfaces = self.resolve_surfaces(&order, &tags)?;
        let mut known: Vec<u64> = self.nodes.iter().map(|n| n.tag).collect();
        known.sort_unstable();
        let mut node_sets = BTreeMap::new();
        for name in self.node_sets.names() {
            if let Some(numbers) = self.node_sets.numbers(&name, &known, &self.keyword)? {
                node_sets.insert(name, numbers);
            }
        }
        let blocks = self.blocks(memberships);
        Ok(RawMesh { nodes: self.nodes, blocks, groups, surfaces, node_sets, repeats: false })
    }

    /// Faces of all surfaces.
    fn resolve_surfaces(
        &mut self,
        order: &[(u64, usize)],
        tags: &[u64],
    ) -> Result<BTreeMap<String, Vec<RawSide>>, MeshError> {
        let mut surfaces: BTreeMap<String, Vec<RawSide>> = BTreeMap::new();
        for SurfaceLine { set, face, line, keyword } in std::mem::take(&mut self.surfaces) {
            let name = keyword.need("NAME", "NAME=name")?;
            let elements = match set.parse::<u64>() {
                Ok(element) => vec![element],
                Err(_) => self
                    .element_sets
                    .numbers(&set, tags, &keyword)?
                    .ok_or_else(|| self.element_sets.unknown(&set, line, &keyword))?,
            };
            let sides = surfaces.entry(name.to_string()).or_default();
            for element in elements {
                let at = position(order, element, name)?;
                let Some(local) = shapes::faces(self.elements[at].shape).get(face - 1) else {
                    let found = format!("S{face} of element {element}");
                    return Err(keyword.syntax(line, "a face that the element has", &found));
                };
                let nodes = self.nodes_of(at);
                sides.push(RawSide { element, corners: local.iter().map(|&a| nodes[a]).collect() });
            }
        }
        Ok(surfaces)
    }

    /// Groups by name and dimension, and the groups of each element.
    fn resolve_groups(
        &mut self,
        order: &[(u64, usize)],
        tags: &[u64],
    ) -> Result<(Vec<RawGroup>, Vec<Vec<usize>>), MeshError> {
        let mut groups: Vec<RawGroup> = Vec::new();
        let mut memberships = vec![Vec::new(); self.elements.len()];
        for name in self.element_sets.names() {
            let numbers = self.element_sets.numbers(&name, tags, &self.keyword)?.unwrap_or_default();
            let mut of_dimension = [None; 4];
            for element in numbers {
                let at = position(order, element, &name)?;
                let dimension = self.elements[at].shape.dimension();
                let group = *of_dimension[dimension].get_or_insert_with(|| {
                    groups.push(RawGroup { dimension, tag: None, name: Some(name.clone()) });
                    groups.len() - 1
                });
                memberships[at].push(group);
            }
        }
        Ok((groups, memberships))
    }

    /// Elements of the same shape in the same groups.
    fn blocks(&self, memberships: Vec<Vec<usize>>) -> Vec<RawBlock> {
        let mut blocks: BTreeMap<(Shape, Vec<usize>), RawBlock> = BTreeMap::new();
        for (e, groups) in memberships.into_iter().enumerate() {
            let Element { tag, shape, .. } = self.elements[e];
            let block = blocks.entry((shape, groups.clone())).or_insert_with(|| RawBlock {
                shape,
                groups,
                entity: None,
                tags: Vec::new(),
                nodes: Vec::new(),
            });
            block.tags.push(tag);
            block.nodes.extend(self.nodes_of(e));
        }
        blocks.into_values().collect()
    }
}

fn element_shape(keyword: &Keyword) -> Result<Shape, MeshError> {
    let kind = keyword.need("TYPE", "TYPE=type")?.to_uppercase();
    shapes::shape(&kind).ok_or_else(|| MeshError::UnsupportedKind {
        section: keyword.name.clone(),
        place: Place::Line(keyword.line),
        kind,
    })
}

/// Position of an element referred to by a set.
fn position(order: &[(u64, usize)], element: u64, set: &str) -> Result<usize, MeshError> {
    match order.binary_search_by_key(&element, |o| o.0) {
        Ok(at) => Ok(order[at].1),
        Err(_) => Err(MeshError::DanglingElement { set: set.to_string(), element }),
    }
}
