//! Checksums of files and texts.

use sha2::{Digest, Sha256};

/// SHA-256 of the concatenated `parts`, in hexadecimal.
#[must_use]
pub fn sha256<T: AsRef<[u8]>>(parts: impl IntoIterator<Item = T>) -> String {
    let mut hash = Sha256::new();
    parts.into_iter().for_each(|part| hash.update(part));
    hexadecimal(hash)
}

/// Sum in hexadecimal.
#[must_use]
pub fn hexadecimal(hash: Sha256) -> String {
    hash.finalize().iter().map(|b| format!("{b:02x}")).collect()
}
