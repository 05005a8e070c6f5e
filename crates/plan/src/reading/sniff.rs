//! Kinds of files, by their first bytes: a reader that is given another kind of file than its own says which one it is, and what
//! would be right.

use crate::reading::wrong::Wrong;

/// Kind of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Empty,
    Gmsh,
    OldGmsh,
    Abaqus,
    Stl,
    Ply,
    Obj,
    Nastran,
    LegacyVtk,
    Xml,
    Netcdf,
    Hdf5,
    Exodus,
    Med,
    Cgns,
    Utf16,
    OtherCoding,
    Gzip,
    Archive,
    Compressed,
    Numpy,
    Matlab,
    Picture,
    Pdf,
    LfsPointer,
    Binary,
}

/// A reader of files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// `mesh.gmsh`, `triangles.gmsh`.
    Gmsh,
    /// `mesh.abaqus`, `triangles.abaqus`.
    Abaqus,
    /// `triangles.stl`.
    Stl,
    /// `triangles.depths`.
    Depths,
    /// Tables and traces.
    Columns,
    /// Values at positions.
    Fields,
    /// A scene.
    Scene,
}

/// Bytes that are searched for the marks of a format whose first bytes are those of another, or any text.
const SEARCHED: usize = 1 << 16;

/// First bytes that only one kind of file has.
const MAGIC: [(&[u8], Kind); 17] = [
    (b"\x1f\x8b", Kind::Gzip),
    (b"PK\x03\x04", Kind::Archive),
    (b"\xfd7zXZ", Kind::Compressed),
    (b"BZh", Kind::Compressed),
    (b"\x28\xb5\x2f\xfd", Kind::Compressed),
    (b"7z\xbc\xaf", Kind::Archive),
    (b"\xff\xfe", Kind::Utf16),
    (b"\xfe\xff", Kind::Utf16),
    (b"\x93NUMPY", Kind::Numpy),
    (b"MATLAB ", Kind::Matlab),
    (b"\x89PNG", Kind::Picture),
    (b"\xff\xd8\xff", Kind::Picture),
    (b"II*\0", Kind::Picture),
    (b"MM\0*", Kind::Picture),
    (b"%PDF", Kind::Pdf),
    (b"# vtk DataFile", Kind::LegacyVtk),
    (b"version https://git-lfs", Kind::LfsPointer),
];

/// Kind of a file; `None` for a text of no known form.
pub(crate) fn kind(bytes: &[u8]) -> Option<Kind> {
    let start = &bytes[..bytes.len().min(SEARCHED)];
    let has = |mark: &[u8]| start.windows(mark.len()).any(|w| w == mark);
    if let Some((_, kind)) = MAGIC.iter().find(|(magic, _)| bytes.starts_with(magic)) {
        return Some(*kind);
    }
    if bytes.starts_with(b"\x89HDF") {
        let marks =
            [(&b"ENS_MAA"[..], Kind::Med), (b"CGNSLibrary", Kind::Cgns), (b"num_el_blk", Kind::Exodus)];
        return Some(marks.into_iter().find(|(mark, _)| has(mark)).map_or(Kind::Hdf5, |m| m.1));
    }
    if bytes.starts_with(b"CDF") && bytes.get(3).is_some_and(|version| *version < b' ') {
        return Some(if has(b"num_el_blk") || has(b"coordx") { Kind::Exodus } else { Kind::Netcdf });
    }
    if start.trim_ascii().is_empty() {
        return Some(Kind::Empty);
    }
    if is_binary_stl(bytes) {
        return Some(Kind::Stl);
    }
    if has(b"$MeshFormat") {
        return Some(Kind::Gmsh);
    }
    // Data appended to a VTU file may be raw.
    if let [b'<', ..] = start.trim_ascii_start()
        && (has(b"<?xml") || has(b"<VTKFile"))
    {
        return Some(Kind::Xml);
    }
    // A text may be cut within a character.
    match std::str::from_utf8(start) {
        Ok(text) => kind_of_text(text),
        Err(error) if error.error_len().is_none() => kind_of_text(&String::from_utf8_lossy(start)),
        Err(_) if half_are_zero(start) => Some(Kind::Utf16),
        Err(_) if start.contains(&0) => Some(Kind::Binary),
        Err(_) => kind_of_text(&String::from_utf8_lossy(start)).or(Some(Kind::OtherCoding)),
    }
}

/// True for a binary STL file: its size is that which its header announces.
fn is_binary_stl(bytes: &[u8]) -> bool {
    let count = bytes.get(80..84).and_then(|n| n.try_into().ok()).map(u32::from_le_bytes);
    count.is_some_and(|count| count > 0 && bytes.len() as u64 == 84 + 50 * u64::from(count))
}

/// True if every other byte is zero, as in a text of UTF-16 without a mark.
fn half_are_zero(bytes: &[u8]) -> bool {
    let zero = |from: usize| bytes.iter().skip(from).step_by(2).filter(|b| **b == 0).count();
    let (even, odd) = (zero(0), zero(1));
    // Nine of ten at one parity, and one of ten at most at the other.
    bytes.len() > 1 && 20 * even.max(odd) > 9 * bytes.len() && 20 * even.min(odd) < bytes.len()
}

/// Kind of a text, by its first lines.
fn kind_of_text(text: &str) -> Option<Kind> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let first = lines.next().unwrap_or_default();
    let upper = first.to_uppercase();
    let begins = |words: &[&str]| words.iter().any(|word| upper.starts_with(word));
    if begins(&["<?XML", "<VTKFILE"]) {
        return Some(Kind::Xml);
    }
    if text.contains('\0') {
        return Some(if half_are_zero(text.as_bytes()) { Kind::Utf16 } else { Kind::Binary });
    }
    if first == "ply" {
        return Some(Kind::Ply);
    }
    if begins(&["$NOD"]) {
        return Some(Kind::OldGmsh);
    }
    let holds = |words: &[&str]| {
        let at = |line: &str, word: &str| {
            line.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word))
        };
        text.lines().map(str::trim_start).any(|line| words.iter().any(|word| at(line, word)))
    };
    if upper.split_whitespace().next() == Some("SOLID") && holds(&["facet", "endsolid"]) {
        return Some(Kind::Stl);
    }
    if first.starts_with('*') && holds(&["*node", "*heading", "*part", "*element", "*include"]) {
        return Some(Kind::Abaqus);
    }
    let any = |is: &dyn Fn(&str) -> bool| text.lines().any(is);
    let grid =
        |line: &str| ["GRID,", "GRID*", "GRID ", "BEGIN BULK"].iter().any(|word| line.starts_with(word));
    if begins(&["SOL ", "CEND", "BEGIN BULK", "GRID", "$"]) && any(&grid) {
        return Some(Kind::Nastran);
    }
    let numbers = |line: &str, word: &str| {
        let rest = line.strip_prefix(word).map(str::split_whitespace);
        rest.is_some_and(|mut words| words.next().is_some_and(|n| n.parse::<f64>().is_ok()))
    };
    (any(&|line| numbers(line, "v ")) && any(&|line| line.starts_with("f "))).then_some(Kind::Obj)
}

impl Kind {
    /// Name of the kind, as text.
    fn words(self) -> &'static str {
        match self {
            Self::Empty => "it is empty",
            Self::Gmsh => "it is a mesh of Gmsh (MSH)",
            Self::OldGmsh => "it is a mesh of Gmsh in the format MSH 1",
            Self::Abaqus => "it is an input file of Abaqus or CalculiX",
            Self::Stl => "it is an STL file: triangles of a surface",
            Self::Ply => "it is a PLY file: triangles of a surface",
            Self::Obj => "it is an OBJ file: triangles of a surface",
            Self::Nastran => "it is an input file of Nastran (bulk data)",
            Self::LegacyVtk => "it is a legacy VTK file",
            Self::Xml => "it is XML, such as a VTU file",
            Self::Netcdf => "it is a netCDF file",
            Self::Hdf5 => "it is HDF5, such as netCDF-4",
            Self::Exodus => "it is an Exodus mesh",
            Self::Med => "it is a MED mesh of Salome",
            Self::Cgns => "it is a CGNS mesh",
            Self::Utf16 => "it is a text in UTF-16",
            Self::OtherCoding => "it is a text in another coding than UTF-8, such as Latin-1",
            Self::Gzip => "it is compressed by gzip",
            Self::Archive => "it is an archive, such as a zip file or a spreadsheet",
            Self::Compressed => "it is compressed",
            Self::Numpy => "it is a NumPy array",
            Self::Matlab => "it is a MATLAB file",
            Self::Picture => "it is a picture",
            Self::Pdf => "it is a PDF document",
            Self::LfsPointer => "it is a pointer of Git LFS, and not the file itself",
            Self::Binary => "it is not a text: it has bytes that are zero",
        }
    }

    fn is_mesh(self) -> bool {
        matches!(
            self,
            Self::OldGmsh
                | Self::Nastran
                | Self::LegacyVtk
                | Self::Xml
                | Self::Exodus
                | Self::Med
                | Self::Cgns
        )
    }
}

impl Reader {
    /// True if this is a file of this reader, which then finds what is wrong in it.
    fn takes(self, kind: Kind) -> bool {
        match self {
            Self::Gmsh => kind == Kind::Gmsh,
            Self::Abaqus => kind == Kind::Abaqus,
            // One that is cut cannot be told from other bytes.
            Self::Stl => matches!(kind, Kind::Stl | Kind::Binary),
            Self::Depths => matches!(kind, Kind::Netcdf | Kind::Hdf5),
            Self::Fields => matches!(kind, Kind::Netcdf | Kind::Hdf5 | Kind::Xml),
            Self::Columns | Self::Scene => false,
        }
    }

    /// Form of the files of this reader.
    fn form(self) -> &'static str {
        match self {
            Self::Gmsh => "a mesh of Gmsh, MSH 4.1 or 2.2",
            Self::Abaqus => "an input file of Abaqus",
            Self::Stl => "an STL file, text or binary",
            Self::Depths => "a netCDF grid of depths, or a text of longitude, latitude and depth",
            Self::Columns => "a CSV file whose first line names the columns, such as `time [s],x [mm]`",
            Self::Fields => "a CSV file whose first line names the columns, a netCDF grid or a VTU file",
            Self::Scene => "a scene in TOML, such as `asperity new` writes it",
        }
    }

    /// Text that would be right where a file of this kind was found.
    fn help(self, kind: Kind) -> String {
        let form = self.form();
        let of_mesh = matches!(self, Self::Gmsh | Self::Abaqus);
        match kind {
            Kind::Gzip => format!("unpack it, such as with `gunzip`: {form}"),
            Kind::Compressed | Kind::Archive => format!("unpack it, or write it anew: {form}"),
            Kind::Utf16 | Kind::OtherCoding => format!("save it in UTF-8: {form}"),
            Kind::LfsPointer => "fetch the file, such as with `git lfs pull`".to_string(),
            Kind::Gmsh if of_mesh || self == Self::Stl => "the key `gmsh` reads it: `gmsh = { file = .. }`".to_string(),
            Kind::Abaqus if of_mesh || self == Self::Stl => "the key `abaqus` reads it: `abaqus = { file = .. }`".to_string(),
            Kind::Stl if of_mesh => "a body needs cells: mesh the volume with Gmsh. The key `triangles.stl` of a fault reads such a surface".to_string(),
            Kind::Netcdf | Kind::Hdf5 if matches!(self, Self::Columns) => format!("write it as text: {form}"),
            _ if kind.is_mesh() && of_mesh => format!("write it as {form}, such as with Gmsh or meshio"),
            _ => format!("this key takes {form}"),
        }
    }
}

/// Complaint about a file that is of another kind than those of a reader; `None` if it may be one of those.
pub fn other(bytes: &[u8], reader: Reader) -> Option<Wrong> {
    let found = kind(bytes).filter(|kind| !reader.takes(*kind))?;
    let mut message = found.words().to_string();
    if found == Kind::OtherCoding
        && let Some(place) = undecoded(bytes)
    {
        message += &place;
    }
    Some(Wrong::new(message, reader.help(found)))
}

/// Place of the first byte that is not UTF-8.
fn undecoded(bytes: &[u8]) -> Option<String> {
    let at = std::str::from_utf8(bytes).err()?.valid_up_to();
    let line = 1 + bytes[..at].iter().filter(|b| **b == b'\n').count();
    Some(format!(" (byte {:#04x} in line {line})", bytes[at]))
}

/// A text without the mark of UTF-8 at its start.
pub fn unmarked(mut bytes: Vec<u8>) -> Vec<u8> {
    const MARK: [u8; 3] = [0xef, 0xbb, 0xbf];
    if bytes.starts_with(&MARK) {
        bytes.drain(..MARK.len());
    }
    bytes
}
