//! Units of columns, from the file or the scene.

use crate::reading::wrong::Wrong;
use asperity_scene::units::{self, Dimension};

/// Part of a file that has a unit.
#[derive(Clone, Copy)]
pub(crate) struct FilePart<'a> {
    /// Kind, such as a column.
    pub kind: &'a str,
    pub name: &'a str,
}

impl<'a> FilePart<'a> {
    pub(crate) fn new(kind: &'a str, name: &'a str) -> Self {
        Self { kind, name }
    }
}

/// Names of coordinates on Earth, which are in degrees where nothing else is said.
const ON_EARTH: [&str; 4] = ["longitude", "latitude", "lon", "lat"];

/// A unit of this dimension that a user would write.
fn usual(dimension: Dimension) -> &'static str {
    if dimension == Dimension::Angle { "deg" } else { dimension.si() }
}

/// Unit of numbers of this dimension: that of the file, or the stated one where the file has none.
///
/// # Errors
/// [`Wrong`] for a unit that is missing, of another dimension, or not the stated one.
pub(crate) fn chosen<'a>(
    FilePart { kind: what, name }: FilePart<'_>,
    own: Option<&'a str>,
    stated: Option<&'a str>,
    dimension: Option<Dimension>,
) -> Result<Option<&'a str>, Wrong> {
    let own = own.filter(|unit| !unit.is_empty());
    let Some(dimension) = dimension else {
        return match own.or(stated) {
            None | Some("-" | "1") => Ok(None),
            Some(unit) => Err(Wrong::new(
                format!("its {what} `{name}` has the unit {unit}, and is a number without a unit"),
                format!("`{name}` or `{name} [-]`"),
            )),
        };
    };
    let size = |unit: &str| {
        units::parse(&format!("1 {unit}"), dimension).map_err(|why| {
            let help = format!("such as `{name} [{}]`", usual(dimension));
            Wrong::new(format!("the unit of its {what} `{name}`: {why}"), help)
        })
    };
    let degrees = (dimension == Dimension::Angle && ON_EARTH.contains(&name)).then_some("deg");
    let Some(unit) = own.or(stated).or(degrees) else {
        return Err(Wrong::new(
            format!("its {what} `{name}` has no unit, and is {}", dimension.name()),
            format!("the unit in brackets, such as `{name} [{}]`", usual(dimension)),
        ));
    };
    let own_size = size(unit)?;
    match stated {
        Some(stated) if size(stated)? != own_size => Err(Wrong::new(
            format!("its {what} `{name}` has the unit {unit}, and the scene states {stated}"),
            "leave the unit out of the scene where the file has it",
        )),
        _ => Ok(Some(unit)),
    }
}
