//! Identity of a scene for a run that is resumed.

use asperity_plan::shared::sha256::sha256;

/// Hash of the scene `text`, without its title and the entries that `leave_out` removes, and of the hashes of its mesh files. The layout of the file
/// has no effect.
#[must_use]
pub fn hash<'a>(
    text: &str,
    leave_out: impl FnOnce(&mut toml::Table),
    meshes: impl Iterator<Item = &'a str>,
) -> String {
    let table = toml::from_str::<toml::Table>(text).ok().map(|mut table| {
        table.remove("title");
        leave_out(&mut table);
        table
    });
    // Tables are sorted by their keys. Text that was read as a scene also parses as a table; otherwise the raw text is
    // hashed.
    let scene = table.and_then(|table| serde_json::to_string(&table).ok()).unwrap_or_else(|| text.into());
    sha256(std::iter::once(scene.as_str()).chain(meshes.map(|mesh| mesh as &str)))
}
