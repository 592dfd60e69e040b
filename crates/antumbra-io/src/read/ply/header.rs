//! The header of a PLY: elements and their properties.

use crate::error::ReadError;
use crate::limits::Limits;
use crate::read::text::show;

/// How numbers are written.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Encoding {
    Ascii,
    Little,
    Big,
}

/// Type of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &str) -> Option<Kind> {
        Some(match name {
            "char" | "int8" => Kind::I8,
            "uchar" | "uint8" => Kind::U8,
            "short" | "int16" => Kind::I16,
            "ushort" | "uint16" => Kind::U16,
            "int" | "int32" => Kind::I32,
            "uint" | "uint32" => Kind::U32,
            "float" | "float32" => Kind::F32,
            "double" | "float64" => Kind::F64,
            _ => return None,
        })
    }

    /// Bytes of a number.
    pub(super) fn size(self) -> usize {
        match self {
            Kind::I8 | Kind::U8 => 1,
            Kind::I16 | Kind::U16 => 2,
            Kind::I32 | Kind::U32 | Kind::F32 => 4,
            Kind::F64 => 8,
        }
    }
}

/// A property of an element; a list has a type for its length.
pub(super) struct Property {
    pub name: String,
    pub kind: Kind,
    pub length: Option<Kind>,
}

/// An element with the number of its rows.
pub(super) struct Element {
    pub name: String,
    pub count: usize,
    pub properties: Vec<Property>,
}

impl Element {
    /// Bytes of a binary row, if all rows have the same.
    pub(super) fn row(&self) -> Option<usize> {
        self.properties.iter().map(|p| p.length.is_none().then(|| p.kind.size())).sum()
    }

    /// The least bytes of a row: a list may be empty, a number of a text takes a digit and a blank.
    fn least(&self, encoding: Encoding) -> usize {
        match encoding {
            Encoding::Ascii => 2 * self.properties.len(),
            _ => self.properties.iter().map(|p| p.length.unwrap_or(p.kind).size()).sum(),
        }
    }

    /// The three properties of a colour: red, green and blue, or an attribute by its name in Mitsuba's schemes.
    pub(super) fn colors(&self, attribute: Option<&str>) -> Option<[usize; 3]> {
        let of = |names: [String; 3]| {
            let found = names.map(|n| self.find(&[&n]).filter(|i| self.properties[*i].length.is_none()));
            let [Some(r), Some(g), Some(b)] = found else { return None };
            Some([r, g, b])
        };
        let plain = |names: [&str; 3]| of(names.map(String::from));
        let Some(name) = attribute else {
            return plain(["red", "green", "blue"])
                .or_else(|| plain(["diffuse_red", "diffuse_green", "diffuse_blue"]));
        };
        let ends = [["r", "g", "b"], ["x", "y", "z"], ["0", "1", "2"], ["1", "2", "3"]];
        let own = ends.into_iter().find_map(|ends| of(ends.map(|end| format!("{name}_{end}"))));
        let color = || plain(["r", "g", "b"]).or_else(|| plain(["red", "green", "blue"]));
        own.or_else(|| if name == "color" { color() } else { None })
    }

    /// The position of a property.
    pub(super) fn find(&self, names: &[&str]) -> Option<usize> {
        self.properties.iter().position(|p| names.contains(&p.name.as_str()))
    }
}

/// The whole header.
pub(super) struct Header {
    pub encoding: Encoding,
    pub elements: Vec<Element>,
    /// Where the data begin.
    pub data: usize,
}

/// Reads the header; counts are held against what is left of the file.
pub(super) fn read(bytes: &[u8], limits: &Limits) -> Result<Header, ReadError> {
    let fail = |what: String| ReadError::new("header", what);
    if bytes.is_empty() {
        return Err(ReadError::new("", "the file is empty (0 bytes)"));
    }
    if !bytes.starts_with(b"ply") {
        return Err(fail("this is no PLY: it does not begin with \"ply\"".into()));
    }
    let head = &bytes[..bytes.len().min(limits.header_bytes)];
    let (mut encoding, mut elements, mut at) = (None, Vec::<Element>::new(), 0);
    loop {
        let Some(length) = head[at..].iter().position(|b| *b == b'\n' || *b == b'\r') else {
            return Err(fail("there is no end_header".into()).hint("The file is cut short."));
        };
        let line = String::from_utf8_lossy(&head[at..at + length]).into_owned();
        at += length + 1;
        if head[at - 1] == b'\r' && head.get(at) == Some(&b'\n') {
            at += 1;
        }
        let words: Vec<&str> = line.split_ascii_whitespace().collect();
        match words[..] {
            ["end_header"] => break,
            ["format", name, _] => encoding = Some(encoding_of(name).map_err(fail)?),
            ["element", name, count] => {
                let count = count
                    .parse()
                    .map_err(|_| fail(format!("element {name} has the count {}", show(count.as_bytes()))))?;
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", ..] => {
                let property = property(&words).map_err(fail)?;
                let element =
                    elements.last_mut().ok_or_else(|| fail("a property stands before any element".into()))?;
                element.properties.push(property);
            }
            ["ply" | "comment" | "obj_info", ..] | [] => {}
            _ => return Err(fail(format!("the line {} is not understood", show(line.as_bytes())))),
        }
    }
    let encoding = encoding.ok_or_else(|| fail("it names no format".into()))?;
    announced(&elements, encoding, bytes.len() - at).map_err(fail)?;
    Ok(Header { encoding, elements, data: at })
}

/// Refuses counts that the rest of the file cannot hold.
fn announced(elements: &[Element], encoding: Encoding, left: usize) -> Result<(), String> {
    let mut needed = 0usize;
    for e in elements {
        needed = needed.saturating_add(e.count.saturating_mul(e.least(encoding)));
        // The last number of a text may end without a line end.
        if needed > left.saturating_add(1) || e.count > u32::MAX as usize {
            let (n, name) = (e.count, &e.name);
            return Err(format!("announces {n} of {name}, the file has {left} bytes left"));
        }
    }
    Ok(())
}

fn encoding_of(name: &str) -> Result<Encoding, String> {
    match name {
        "ascii" => Ok(Encoding::Ascii),
        "binary_little_endian" => Ok(Encoding::Little),
        "binary_big_endian" => Ok(Encoding::Big),
        _ => Err(format!("the format {} is unknown", show(name.as_bytes()))),
    }
}

fn property(words: &[&str]) -> Result<Property, String> {
    let kind =
        |name: &str| Kind::of(name).ok_or(format!("the property type {} is unknown", show(name.as_bytes())));
    match words {
        ["property", "list", length, of, name] => {
            let length = kind(length)?;
            if matches!(length, Kind::F32 | Kind::F64) {
                return Err(format!("the list {name} has a length that is no integer"));
            }
            Ok(Property { name: (*name).into(), kind: kind(of)?, length: Some(length) })
        }
        ["property", of, name] => Ok(Property { name: (*name).into(), kind: kind(of)?, length: None }),
        _ => Err(format!("the line {} is not understood", show(words.join(" ").as_bytes()))),
    }
}
