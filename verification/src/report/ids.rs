//! Names of claims that do not change between runs: their permalinks and their keys in the history.

use crate::claim::JudgedClaim;
use std::collections::BTreeMap;

/// Maximum length of a name, without the number appended to a repeated one.
pub const LONGEST: usize = 72;

/// Unique names of the claims of a case.
pub fn unique(claims: &[JudgedClaim]) -> Vec<String> {
    let mut seen: BTreeMap<String, usize> = BTreeMap::new();
    let name = |judged: &JudgedClaim| {
        let slug = slug(&judged.claim.quantity);
        let times = seen.entry(slug.clone()).or_insert(0);
        *times += 1;
        if *times == 1 { slug } else { format!("{slug}-{times}") }
    };
    claims.iter().map(name).collect()
}

/// Lower-case letters and digits of a text, joined by hyphens; a long text is shortened to its beginning and a hash.
pub fn slug(text: &str) -> String {
    let mut slug = String::new();
    for c in text.chars() {
        match c {
            c if c.is_ascii_alphanumeric() => slug.push(c.to_ascii_lowercase()),
            _ if slug.ends_with('-') || slug.is_empty() => {}
            _ => slug.push('-'),
        }
    }
    let slug = slug.trim_end_matches('-');
    if slug.len() <= LONGEST {
        return if slug.is_empty() { "claim".to_owned() } else { slug.to_owned() };
    }
    // FNV-1a hash (Fowler, Noll and Vo), 32 bits.
    let hash = slug.bytes().fold(0x811c_9dc5_u32, |h, b| (h ^ u32::from(b)).wrapping_mul(0x0100_0193));
    format!("{}-{hash:08x}", &slug[..LONGEST - 9])
}
