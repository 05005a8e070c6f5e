//! Elements of a file of VTK with their attributes, and the data appended to them.

use super::error::VtuError;
use quick_xml::Reader;
use quick_xml::escape::unescape;
use quick_xml::events::{BytesStart, Event};

/// Element with its text and the elements within it.
#[derive(Clone, Debug, Default)]
pub(super) struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub text: String,
    pub inner: Vec<Element>,
}

impl Element {
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    pub fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = &'a Element> {
        self.inner.iter().filter(move |element| element.name == name)
    }

    pub fn first(&self, name: &str) -> Option<&Element> {
        self.inner.iter().find(|element| element.name == name)
    }
}

/// Elements of a file, and the bytes after `_` of its appended data.
pub(super) struct Document<'a> {
    pub root: Element,
    pub appended: &'a [u8],
    /// True if the appended data are base64.
    pub in_base64: bool,
}

/// Begin of the appended data, which are no XML if they are raw.
const APPENDED: &[u8] = b"<AppendedData";
/// Elements within each other that are read: files of VTK have six.
const DEEPEST: usize = 16;

pub(super) fn document(bytes: &[u8]) -> Result<Document<'_>, VtuError> {
    let begin = bytes.windows(APPENDED.len()).position(|window| window == APPENDED);
    let Some(begin) = begin else {
        return Ok(Document { root: tree(bytes, false)?, appended: &[], in_base64: false });
    };
    let root = tree(&bytes[..begin], true)?;
    let tail = &bytes[begin..];
    let ends = || VtuError::Missing { part: "`_` before its appended data".into() };
    let head = tail.iter().position(|byte| *byte == b'>').ok_or_else(ends)?;
    let marker = tail[head..].iter().position(|byte| *byte == b'_').ok_or_else(ends)?;
    let element = String::from_utf8_lossy(&tail[..head]);
    let in_base64 = element.contains("base64");
    if !in_base64 && !element.contains("raw") {
        let found = element.trim_start_matches("<AppendedData").trim().to_string();
        return Err(VtuError::Storage { attribute: "encoding", found, read: "`raw` or `base64`" });
    }
    Ok(Document { root, appended: &tail[head + marker + 1..], in_base64 })
}

/// Elements of a text, which may end within some of them if it is `cut`.
fn tree(bytes: &[u8], cut: bool) -> Result<Element, VtuError> {
    let mut reader = Reader::from_reader(bytes);
    let mut open = vec![Element::default()];
    loop {
        let byte = usize::try_from(reader.buffer_position()).unwrap_or(usize::MAX);
        let damaged = |why: String| VtuError::Xml { byte, why };
        match reader.read_event().map_err(|e| damaged(e.to_string()))? {
            Event::Start(start) if open.len() > DEEPEST => {
                let name = start.name().as_ref().to_string();
                return Err(damaged(format!("`{name}` lies within {DEEPEST} others")));
            }
            Event::Start(start) => open.push(element(&start, byte)?),
            Event::Empty(start) => {
                let inner = element(&start, byte)?;
                if let Some(outer) = open.last_mut() {
                    outer.inner.push(inner);
                }
            }
            Event::Text(text) => {
                if let Some(outer) = open.last_mut() {
                    outer.text.push_str(&text);
                    outer.text.push(' ');
                }
            }
            Event::End(_) => close(&mut open),
            Event::Eof => break,
            _ => {}
        }
    }
    if open.len() > 1 && !cut {
        let name = open.last().map(|e| e.name.clone()).unwrap_or_default();
        return Err(VtuError::Xml { byte: bytes.len(), why: format!("it ends within `{name}`") });
    }
    while open.len() > 1 {
        close(&mut open);
    }
    open.pop()
        .and_then(|outer| outer.inner.into_iter().next())
        .ok_or_else(|| VtuError::Missing { part: "elements".into() })
}

/// Moves the innermost open element into the one around it.
fn close(open: &mut Vec<Element>) {
    if open.len() > 1
        && let Some(inner) = open.pop()
        && let Some(outer) = open.last_mut()
    {
        outer.inner.push(inner);
    }
}

/// Element that begins at a byte.
fn element(start: &BytesStart<'_>, byte: usize) -> Result<Element, VtuError> {
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        let attribute = attribute.map_err(|e| VtuError::Xml { byte, why: e.to_string() })?;
        let value = unescape(&attribute.value).map_err(|e| VtuError::Xml { byte, why: e.to_string() })?;
        attributes.push((attribute.key.as_ref().to_string(), value.into_owned()));
    }
    Ok(Element { name: start.name().as_ref().to_string(), attributes, ..Element::default() })
}
