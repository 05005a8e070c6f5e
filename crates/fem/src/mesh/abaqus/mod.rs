//! Abaqus input files: nodes, elements, sets and surfaces, of the file itself or of parts that instances place in an assembly (Abaqus
//! keyword reference). Other keywords (materials, steps, output) are skipped with their data; those that change positions or
//! the origin of nodes and elements are refused.

mod finish;
mod lines;
mod numbers;
mod placement;
mod scope;
mod sets;
mod shapes;

use super::error::MeshError;
use super::raw::{RawMesh, RawNode, Shape};
use lines::{Keyword, Line, Lines};
use numbers::Instances;
use placement::Placement;
use scope::{Element, ElementOrSet, NodesOf, Scope, SurfaceLine, UnreadElements};
use sets::Name;
use std::collections::BTreeMap;
use std::rc::Rc;

/// Reads a file. Element sets become groups by the dimension of their elements; surfaces become the faces of their elements, or
/// sets of nodes. An instance is an element set, too. Sets and surfaces of a part are named `instance.set`, and also `set`
/// where only one has this name.
///
/// # Errors
/// Syntax errors, unsupported keywords, sets and elements that do not exist; with keyword and line.
pub fn parse(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader {
        bytes: bytes.len(),
        file: Scope::for_file(bytes.len()),
        parts: BTreeMap::new(),
        level: Level::File,
        instances: Instances::default(),
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
    reader.leave()?;
    finish::mesh(reader.whole()?, &reader.instances, &reader.keyword)
}

/// Meaning of the data lines after a keyword.
#[derive(Clone, Debug)]
enum Data {
    Skipped,
    Nodes(Option<String>),
    Elements(Shape, Option<String>),
    /// Elements of a type that is not read: only their numbers.
    Unread(Option<String>),
    NodeSet(String),
    /// A surface of nodes.
    NodeSurface(String),
    ElementSet(String),
    Surface(String),
    /// Position of an instance.
    Instance,
}

/// Part of the file that is being read.
enum Level {
    /// The file itself, or its assembly.
    File,
    /// A part, by its name in capitals.
    Part(String, Scope),
    /// An instance: its number, name and part, its own nodes and elements, and its position.
    Instance { number: u64, name: String, part: Option<String>, own: Scope, placement: Placement },
}

impl Level {
    /// Destination of its nodes, elements and sets.
    fn scope<'a>(&'a mut self, file: &'a mut Scope) -> &'a mut Scope {
        match self {
            Self::File => file,
            Self::Part(_, scope) | Self::Instance { own: scope, .. } => scope,
        }
    }
}

struct Reader {
    /// Size of the file.
    bytes: usize,
    file: Scope,
    parts: BTreeMap<String, Scope>,
    level: Level,
    instances: Instances,
    data: Data,
    /// Numbers of an element that continues in the next line.
    pending: Vec<u64>,
    keyword: Rc<Keyword>,
}

impl Reader {
    fn scope(&mut self) -> &mut Scope {
        self.level.scope(&mut self.file)
    }

    /// Handles a keyword: sets the meaning of the following data, or refuses the keyword.
    fn begin(&mut self, keyword: Keyword) -> Result<(), MeshError> {
        self.complete()?;
        let keyword = Rc::new(keyword);
        self.keyword = Rc::clone(&keyword);
        self.data = Data::Skipped;
        match keyword.name.as_str() {
            "*PART" => return self.part(),
            "*INSTANCE" => return self.instance(),
            "*END PART" | "*END INSTANCE" | "*ASSEMBLY" | "*END ASSEMBLY" | "*STEP" => return self.leave(),
            _ => {}
        }
        self.data = self.meaning(&keyword)?;
        let internal = keyword.has("INTERNAL");
        match self.data.clone() {
            Data::NodeSet(name) => match keyword.value("ELSET") {
                None => self.scope().node_sets.declare(&name, internal),
                Some(set) => {
                    let set = match keyword.value("INSTANCE") {
                        Some(instance) => format!("{instance}.{set}"),
                        None => set.to_string(),
                    };
                    let name = Name { own: name, instance: None };
                    self.scope().nodes_of.push(NodesOf { name, set, keyword });
                }
            },
            Data::NodeSurface(name) => self.scope().node_sets.declare(&name, internal),
            Data::ElementSet(name) => self.scope().element_sets.declare(&name, internal),
            Data::Unread(_) => {
                let kind = keyword.need("TYPE", "TYPE=type")?.to_uppercase();
                self.scope().unread.push(UnreadElements { kind, keyword, tags: Vec::new() });
            }
            _ => {}
        }
        Ok(())
    }

    /// Meaning of the data of a keyword that stays at the same level.
    fn meaning(&self, keyword: &Keyword) -> Result<Data, MeshError> {
        let set = |key| keyword.value(key).map(str::to_string);
        Ok(match keyword.name.as_str() {
            "*NODE" | "*ELEMENT" if keyword.has("INPUT") => {
                return Err(keyword.unsupported("data in another file are not read: put them into this one"));
            }
            "*NODE" if keyword.value("SYSTEM").is_some_and(|s| !s.eq_ignore_ascii_case("R")) => {
                return Err(keyword.unsupported("only rectangular coordinates are read"));
            }
            "*NODE" => Data::Nodes(set("NSET")),
            "*ELEMENT" => {
                let kind = keyword.need("TYPE", "TYPE=type")?.to_uppercase();
                match shapes::shape(&kind) {
                    Some(shape) => Data::Elements(shape, set("ELSET")),
                    None => Data::Unread(set("ELSET")),
                }
            }
            "*NSET" => Data::NodeSet(keyword.need("NSET", "NSET=name")?.to_string()),
            "*ELSET" => Data::ElementSet(keyword.need("ELSET", "ELSET=name")?.to_string()),
            "*SURFACE" if keyword.value("TYPE").is_none_or(|t| t.eq_ignore_ascii_case("ELEMENT")) => {
                Data::Surface(keyword.need("NAME", "NAME=name")?.to_string())
            }
            "*SURFACE" if keyword.value("TYPE").is_some_and(|t| t.eq_ignore_ascii_case("NODE")) => {
                Data::NodeSurface(keyword.need("NAME", "NAME=name")?.to_string())
            }
            "*INCLUDE" => {
                return Err(keyword.unsupported("other files are not read: put their lines into this one"));
            }
            "*NGEN" | "*NFILL" | "*NCOPY" | "*NMAP" | "*ELGEN" | "*ELCOPY" | "*SYSTEM" => {
                return Err(
                    keyword.unsupported("nodes and elements must be written out, in one system of axes")
                );
            }
            _ => Data::Skipped,
        })
    }

    /// Begins a part.
    fn part(&mut self) -> Result<(), MeshError> {
        self.leave()?;
        let name = self.keyword.need("NAME", "NAME=name")?.to_uppercase();
        if self.parts.contains_key(&name) {
            return Err(self.keyword.unsupported("the file has a part of this name before"));
        }
        self.level = Level::Part(name, Scope::for_file(self.bytes));
        Ok(())
    }

    /// Begins an instance.
    fn instance(&mut self) -> Result<(), MeshError> {
        self.leave()?;
        let keyword = Rc::clone(&self.keyword);
        if keyword.has("LIBRARY") {
            return Err(keyword.unsupported("results of another analysis are not read"));
        }
        let name = keyword.need("NAME", "NAME=name")?.to_string();
        let part = match keyword.value("PART") {
            None => None,
            Some(part) => {
                let part = part.to_uppercase();
                if !self.parts.contains_key(&part) {
                    return Err(keyword.syntax(keyword.line, "the name of a part before this line", &part));
                }
                Some(part)
            }
        };
        let number = self.instances.add(&name, &keyword)?;
        let (own, placement) = (Scope::for_file(self.bytes), Placement::default());
        self.level = Level::Instance { number, name, part, own, placement };
        self.data = Data::Instance;
        Ok(())
    }

    /// Ends a part or an instance, if one is being read.
    fn leave(&mut self) -> Result<(), MeshError> {
        match std::mem::replace(&mut self.level, Level::File) {
            Level::File => {}
            Level::Part(name, scope) => {
                self.parts.insert(name, scope);
            }
            Level::Instance { number, name, part, own, placement } => {
                let part = part.and_then(|part| self.parts.get(&part));
                for scope in part.into_iter().chain([&own]) {
                    self.file.add(scope, number, &name, &placement, &self.keyword, self.bytes)?;
                }
            }
        }
        Ok(())
    }

    /// Parts and instances of the file. A part that no instance places is the file, if it is the only one.
    fn whole(&mut self) -> Result<Scope, MeshError> {
        let mut parts = std::mem::take(&mut self.parts).into_values();
        if let (true, Some(only)) = (self.instances.names.is_empty(), parts.next()) {
            if parts.next().is_some() {
                return Err(MeshError::MissingSection { section: "*INSTANCE of its parts" });
            }
            if self.file.nodes.is_empty() {
                return Ok(only);
            }
        }
        Ok(std::mem::replace(&mut self.file, Scope::for_file(self.bytes)))
    }

    /// Handles a data line.
    fn data(&mut self, values: &[&str], line: usize) -> Result<(), MeshError> {
        let keyword = Rc::clone(&self.keyword);
        match self.data.clone() {
            Data::Skipped => Ok(()),
            Data::Nodes(set) => self.node(values, line, set.as_deref()),
            Data::Elements(shape, set) => self.element(values, line, shape, set.as_deref()),
            Data::Unread(set) => {
                self.unread(values, line, set.as_deref());
                Ok(())
            }
            Data::NodeSet(name) => {
                let scope = self.level.scope(&mut self.file);
                scope.node_sets.add_line(&name, values, line, &keyword, &self.instances)
            }
            // A weight follows.
            Data::NodeSurface(name) => {
                let scope = self.level.scope(&mut self.file);
                scope.node_sets.add_line(&name, &values[..1], line, &keyword, &self.instances)
            }
            Data::ElementSet(name) => {
                let scope = self.level.scope(&mut self.file);
                scope.element_sets.add_line(&name, values, line, &keyword, &self.instances)
            }
            Data::Surface(name) => self.surface(name, values, line),
            Data::Instance => match &mut self.level {
                Level::Instance { placement, .. } => placement.line(values, line, &keyword),
                Level::File | Level::Part(..) => Ok(()),
            },
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
        let scope = self.scope();
        scope.nodes.push(RawNode { tag, x });
        if let Some(set) = set {
            scope.node_sets.add(set, tag);
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
            let number = self.instances.number(value, line, &self.keyword)?;
            let wrong = || self.keyword.syntax(line, "a number of a node or element", value);
            self.pending.push(number.ok_or_else(wrong)?);
        }
        let wanted = 1 + shape.nodes();
        if self.pending.len() > wanted {
            let found = values.join(", ");
            return Err(self.keyword.syntax(line, "as many nodes as the type of element has", &found));
        }
        if self.pending.len() == wanted {
            let tag = self.pending[0];
            let scope = self.level.scope(&mut self.file);
            let first = scope.connectivity.len();
            scope.connectivity.extend(&self.pending[1..]);
            shape.reorder(shapes::order(shape), &mut scope.connectivity[first..]);
            scope.elements.push(Element { tag, shape, first });
            self.pending.clear();
            if let Some(set) = set {
                scope.element_sets.add(set, tag);
            }
        }
        Ok(())
    }

    /// Reads the number of an element of a type that is not read. Lines that continue an element are taken as elements, too:
    /// how many nodes it has is not known.
    fn unread(&mut self, values: &[&str], line: usize, set: Option<&str>) {
        let Ok(tag) = self.keyword.number(values[0], line) else { return };
        let scope = self.scope();
        if let Some(unread) = scope.unread.last_mut() {
            unread.tags.push(tag);
        }
        if let Some(set) = set {
            scope.element_sets.add(set, tag);
        }
    }

    /// Reads an element or set of elements, and a face.
    fn surface(&mut self, name: String, values: &[&str], line: usize) -> Result<(), MeshError> {
        let keyword = Rc::clone(&self.keyword);
        let face = values.get(1).map(|v| v.to_uppercase()).unwrap_or_default();
        let number = face.strip_prefix('S').and_then(|n| n.parse::<usize>().ok()).filter(|f| *f > 0);
        let of_shell = ["SPOS", "SNEG", "E1", "E2", "E3", "E4", "END1", "END2"].contains(&face.as_str());
        if number.is_none() && !of_shell {
            let expected = "an element or set, and a face S1 to S6";
            return Err(keyword.syntax(line, expected, &values.join(", ")));
        }
        let of = match self.instances.number(values[0], line, &keyword)? {
            Some(element) => ElementOrSet::Element(element),
            None => ElementOrSet::Set(values[0].to_string()),
        };
        let name = Name { own: name, instance: None };
        self.scope().surfaces.push(SurfaceLine { name, of, face: number, line, keyword });
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
}
