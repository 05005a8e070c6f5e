//! Gmsh's MSH format, versions 2.2 and 4.1, ASCII and binary in both byte orders (Gmsh reference manual, "File formats").
//!
//! The sections `$PhysicalNames`, `$Entities`, `$PartitionedEntities`, `$Nodes`, `$ParametricNodes` and `$Elements` are read;
//! other sections (`$Periodic`, `$GhostElements`, `$NodeData`, comments, ...) are skipped.

mod kinds;
mod scan;
mod v22;
mod v41;

use super::error::MeshError;
use super::raw::{RawGroup, RawMesh};
use scan::{Coding, Scan};
use std::collections::BTreeMap;

/// Names of physical groups by dimension and number.
type Names = BTreeMap<(usize, i64), String>;

/// Reads a file.
///
/// Allocation is bounded by the size of the file: a number in a header never allocates more than the remaining bytes could
/// hold.
///
/// # Errors
/// Syntax errors, truncation, unsupported versions and element types; all with the section and the line or byte.
pub fn parse(bytes: &[u8]) -> Result<RawMesh, MeshError> {
    let mut scan = Scan::new(bytes);
    let version = header(&mut scan)?;
    let mut names = Names::new();
    let mut reader = match version {
        Version::V22 => Reader::V22(v22::Reader::default()),
        Version::V41 => Reader::V41(v41::Reader::default()),
    };
    while let Some(section) = scan.next_section()? {
        match section.as_str() {
            "$PhysicalNames" => {
                physical_names(&mut scan, &mut names)?;
                scan.end_section()?;
            }
            _ if reader.section(&mut scan, &section)? => scan.end_section()?,
            _ => scan.skip_section()?,
        }
    }
    let mut mesh = match reader {
        Reader::V22(reader) => reader.finish()?,
        Reader::V41(reader) => reader.finish()?,
    };
    for RawGroup { dimension, tag, name } in &mut mesh.groups {
        *name = tag.and_then(|tag| names.get(&(*dimension, tag)).cloned());
    }
    Ok(mesh)
}

enum Version {
    V22,
    V41,
}

enum Reader {
    V22(v22::Reader),
    V41(v41::Reader),
}

impl Reader {
    /// Reads a section; false if it is not one of those supported.
    fn section(&mut self, scan: &mut Scan<'_>, section: &str) -> Result<bool, MeshError> {
        match self {
            Self::V22(reader) => reader.section(scan, section),
            Self::V41(reader) => reader.section(scan, section),
        }
    }
}

/// `$MeshFormat`: version, text or binary, size of numbers, and in a binary file the number 1.
fn header(scan: &mut Scan<'_>) -> Result<Version, MeshError> {
    match scan.next_section()? {
        Some(section) if section == "$MeshFormat" => {}
        Some(_) | None => return Err(MeshError::MissingSection { section: "$MeshFormat" }),
    }
    let version = match scan.word("a version")? {
        "2.2" => Version::V22,
        "4.1" => Version::V41,
        other => return Err(MeshError::Version { found: other.to_string() }),
    };
    let binary = match scan.decimal("0 (ASCII) or 1 (binary)")? {
        0 => false,
        1 => true,
        _ => return Err(scan.unexpected("0 (ASCII) or 1 (binary)")),
    };
    let size = scan.decimal("the size of numbers")?;
    if size != 8 {
        return Err(MeshError::DataSize { section: "$MeshFormat".to_string(), found: size });
    }
    if binary {
        scan.end_line()?;
        scan.coding = scan.byte_order()?;
    }
    scan.end_section()?;
    Ok(version)
}

/// `$PhysicalNames`: always text.
fn physical_names(scan: &mut Scan<'_>, names: &mut Names) -> Result<(), MeshError> {
    let coding = std::mem::replace(&mut scan.coding, Coding::Ascii);
    // The shortest entry is `0 1 ""` and the end of the line.
    let count = scan.count("names", 3, 0)?;
    for _ in 0..count {
        let dimension = scan.dimension()?;
        let tag = scan.decimal("the number of a physical group")?;
        names.insert((dimension, tag), scan.quoted()?);
    }
    scan.coding = coding;
    Ok(())
}
