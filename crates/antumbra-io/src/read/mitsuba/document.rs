//! The XML as a tree of elements that know their place: includes drawn in, `$names` replaced.

use std::cell::Cell;
use std::collections::{HashMap, HashSet};
use std::rc::Rc;

use antumbra::scene::nearest;
use roxmltree::{Document, Node, ParsingOptions};

use crate::error::ReadError;
use crate::files::FileError;
use crate::read::Context;
use crate::read::text::plain;

/// Elements within elements; Mitsuba's own scenes need about eight.
const DEEPEST: usize = 100;
/// Files that include each other, one below the other.
const INCLUDES: usize = 15;
/// Folders that `<path>` adds.
const FOLDERS: usize = 64;
/// Bytes of a text that is made of `$names`.
const LONGEST: usize = 1 << 16;
/// Bytes that an element takes in memory, at least.
const ELEMENT_BYTES: u64 = 256;

/// Where an element stands.
#[derive(Clone, Debug)]
pub(super) struct Place {
    /// The included file; nothing for the scene's own.
    file: Rc<str>,
    row: u32,
    column: u32,
}

impl Place {
    /// "line 12, column 3", with the name of an included file before it.
    pub fn words(&self) -> String {
        let colon = if self.file.is_empty() { "" } else { ": " };
        format!("{}{colon}line {}, column {}", self.file, self.row, self.column)
    }

    /// An error here.
    pub fn error(&self, what: impl Into<String>) -> ReadError {
        ReadError::new(self.words(), what)
    }
}

/// An element of the scene.
#[derive(Debug)]
pub(super) struct Element {
    /// Its tag: "shape", "float", …
    pub tag: String,
    attributes: Vec<(String, String)>,
    /// What stands in it, in order.
    pub children: Vec<Element>,
    /// Where it begins.
    pub at: Place,
    /// Somebody looked at it.
    pub used: Cell<bool>,
}

impl Element {
    /// The text of an attribute; empty if it has none.
    pub fn attribute(&self, name: &str) -> &str {
        self.given(name).unwrap_or("")
    }

    /// The text of an attribute, if it is there.
    pub fn given(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|a| a.0 == name).map(|a| a.1.as_str())
    }
}

/// A scene's elements and what they are called.
pub(super) struct Tree {
    /// The `<scene>`.
    pub root: Element,
    /// What the scene calls its parameters, with their values.
    pub parameters: Vec<(String, String)>,
    /// The folders that the scene's files may lie in besides its own, the last one first.
    pub folders: Vec<String>,
}

/// Reads the scene and everything that it includes.
pub(super) fn load(bytes: &[u8], context: &Context) -> Result<Tree, ReadError> {
    let mut loader =
        Loader { context, values: HashMap::new(), names: Vec::new(), folders: Vec::new(), above: Vec::new() };
    for (name, value) in context.parameters {
        loader.values.insert(name.clone(), value.clone());
    }
    let mut tops = loader.file(bytes, "".into())?;
    loader.check_given()?;
    let Some(root) = tops.pop().filter(|root| root.tag == "scene") else {
        let what = "this is not a Mitsuba scene: its outermost element is not <scene>";
        return Err(ReadError::new("", what));
    };
    let parameters = loader.names.iter().map(|n| (n.clone(), loader.values[n].clone())).collect();
    Ok(Tree { root, parameters, folders: loader.folders })
}

/// The bytes of a file that the scene names, from the first of its folders that has it.
pub(super) fn open(context: &Context, folders: &[String], name: &str) -> Result<Vec<u8>, FileError> {
    for folder in folders {
        match context.files.open(&format!("{folder}/{name}")) {
            Err(FileError::Missing) => {}
            found => return found,
        }
    }
    context.files.open(name)
}

struct Loader<'a> {
    context: &'a Context<'a>,
    /// The value of every `$name` so far.
    values: HashMap<String, String>,
    /// The parameters that the files declare, in order.
    names: Vec<String>,
    /// The folders of `<path>`, the last one first.
    folders: Vec<String>,
    /// The files that are being read, outermost first.
    above: Vec<String>,
}

impl Loader<'_> {
    /// The outermost element of a file, or all that stands in it where that is a `<scene>` in an included file.
    fn file(&mut self, bytes: &[u8], name: Rc<str>) -> Result<Vec<Element>, ReadError> {
        let here = |place: String| if name.is_empty() { place } else { format!("{name}: {place}") };
        let text = plain(bytes);
        let text = std::str::from_utf8(&text).map_err(|e| {
            ReadError::new(here(format!("byte {}", e.valid_up_to())), "this is not UTF-8 text")
        })?;
        let most = (bytes.len() as u64 / 2).clamp(16, 1 << 27) as u32;
        let options = ParsingOptions { nodes_limit: most, ..ParsingOptions::default() };
        let document = Document::parse_with_options(text, options).map_err(|e| {
            let place = e.pos();
            broken(here(format!("line {}, column {}", place.row, place.col)), &e)
        })?;
        let lines = Lines::of(text);
        let root = document.root_element();
        let top = root.tag_name().name() == "scene";
        if top {
            check_version(root, &lines.place(root, &name))?;
        }
        let element = self.element(root, &lines, &name, 0)?;
        Ok(if top && !name.is_empty() { element.children } else { vec![element] })
    }

    fn element(
        &mut self,
        node: Node,
        lines: &Lines,
        file: &Rc<str>,
        depth: usize,
    ) -> Result<Element, ReadError> {
        let at = lines.place(node, file);
        if depth > DEEPEST {
            return Err(at.error(format!("elements lie more than {DEEPEST} deep in each other")));
        }
        self.context.take(1, ELEMENT_BYTES).map_err(|what| at.error(what))?;
        let mut attributes = Vec::new();
        for a in node.attributes() {
            let value = self.filled(a.value()).map_err(|what| {
                let hint = "Give it with -D name=value, or a <default> in the file.";
                at.error(what).hint(hint)
            })?;
            self.context.take(value.len() as u64, 1).map_err(|what| at.error(what))?;
            attributes.push((a.name().to_string(), value));
        }
        let tag = node.tag_name().name().to_string();
        let mut element = Element { tag, attributes, children: Vec::new(), at, used: Cell::new(false) };
        for child in node.children().filter(Node::is_element) {
            match child.tag_name().name() {
                "default" => self.default(child, lines.place(child, file))?,
                "path" => self.path(child, lines.place(child, file))?,
                "include" => element.children.extend(self.include(child, lines.place(child, file))?),
                _ => element.children.push(self.element(child, lines, file, depth + 1)?),
            }
        }
        Ok(element)
    }

    /// `<default name value>`: what was given before, on the command line or outside, stays.
    fn default(&mut self, node: Node, at: Place) -> Result<(), ReadError> {
        let (Some(name), Some(value)) = (node.attribute("name"), node.attribute("value")) else {
            return Err(at.error("a <default> needs a name and a value"));
        };
        let value = self.filled(value).map_err(|what| at.error(what))?;
        self.values.entry(name.into()).or_insert(value);
        if !self.names.iter().any(|n| n == name) {
            self.names.push(name.into());
        }
        Ok(())
    }

    /// `<path value>`: a folder in which files are looked for first.
    fn path(&mut self, node: Node, at: Place) -> Result<(), ReadError> {
        let folder = self.filled(node.attribute("value").unwrap_or("")).map_err(|what| at.error(what))?;
        if let Err(FileError::Refused(why)) = self.context.files.open(&folder) {
            let hint = "A folder below that of the scene is needed, or --files-from with one above it.";
            return Err(at.error(format!("the folder \"{folder}\" of <path>: {why}")).hint(hint));
        }
        if self.folders.len() >= FOLDERS {
            return Err(at.error(format!("more than {FOLDERS} <path>")));
        }
        self.folders.insert(0, folder);
        Ok(())
    }

    fn include(&mut self, node: Node, at: Place) -> Result<Vec<Element>, ReadError> {
        let Some(name) = node.attribute("filename") else {
            return Err(at.error("an <include> needs a filename"));
        };
        let name = self.filled(name).map_err(|what| at.error(what))?;
        if self.above.len() >= INCLUDES || self.above.contains(&name) {
            let what =
                format!("the file \"{name}\" includes itself, or more than {INCLUDES} lie in each other");
            return Err(at.error(what));
        }
        let bytes = open(self.context, &self.folders, &name);
        let bytes = bytes.map_err(|e| at.error(format!("the included file \"{name}\": {e}")))?;
        // A file that is drawn in again and again brings no more room with it.
        self.context.grant_file(&name, bytes.len() as u64);
        self.context.take(bytes.len() as u64, 1).map_err(|what| at.error(what))?;
        self.above.push(name.clone());
        let inside = self.file(&bytes, name.as_str().into());
        self.above.pop();
        inside
    }

    /// A text with each `$name` replaced by its value; longest names first, as Mitsuba does.
    fn filled(&self, text: &str) -> Result<String, String> {
        let mut out = String::new();
        let mut rest = text;
        while let Some((before, after)) = rest.split_once('$') {
            out.push_str(before);
            let of_name = |c: char| c.is_alphanumeric() || c == '_' || c == '-';
            let end = after.find(|c| !of_name(c)).unwrap_or(after.len());
            let known = (1..=end).rev().filter(|n| after.is_char_boundary(*n));
            let name = known.map(|n| &after[..n]).find(|name| self.values.contains_key(*name));
            let Some(name) = name else {
                return Err(format!("${} has no value", &after[..end]));
            };
            out.push_str(&self.values[name]);
            if out.len() > LONGEST {
                return Err(format!("${name} makes a text of more than {LONGEST} bytes: it is too long"));
            }
            rest = &after[name.len()..];
        }
        out.push_str(rest);
        Ok(out)
    }

    /// Parameters that a person gave are declared somewhere.
    fn check_given(&self) -> Result<(), ReadError> {
        let known: Vec<&str> = self.names.iter().map(String::as_str).collect();
        for (name, _) in self.context.parameters {
            if !known.contains(&name.as_str()) {
                let near = nearest(name, &known).map(|n| format!("; did you mean \"{n}\"?"));
                let hint = match known.as_slice() {
                    [] => "The file has no parameters.".into(),
                    _ => format!("Its parameters are {}.", known.join(", ")),
                };
                let what = format!("there is no parameter \"{name}\"{}", near.unwrap_or_default());
                return Err(ReadError::new("", what).hint(hint));
            }
        }
        Ok(())
    }
}

/// Version 2 and 3 are read; before, names were written otherwise.
fn check_version(root: Node, at: &Place) -> Result<(), ReadError> {
    let version = root.attribute("version").unwrap_or("3");
    let old = version.starts_with("0.") || version.starts_with("1.");
    if old {
        let what = format!(
            "this scene is of Mitsuba {version}, whose names are others (toWorld is to_world in Mitsuba 3)"
        );
        let hint = "Mitsuba 3 upgrades such a file: mitsuba.parser.parse_file, transform_upgrade and write_file; then \
                    write version=\"3.0.0\" in the new one.";
        return Err(at.error(what).hint(hint));
    }
    Ok(())
}

/// What the parser says, with words of our own for what is kept out on purpose.
fn broken(place: String, e: &roxmltree::Error) -> ReadError {
    use roxmltree::Error as E;
    match e {
        E::DtdDetected => {
            let what = "entities and document types (<!DOCTYPE>) are not read";
            ReadError::new(place, what).hint("Write the values where the entities are used.")
        }
        E::NodesLimitReached => ReadError::new("", "it has too many elements for its size"),
        _ => {
            let text = e.to_string();
            let what = text.rsplit_once(" at ").map_or(text.as_str(), |t| t.0);
            ReadError::new(place, format!("the XML is broken ({what})"))
        }
    }
}

/// Where each line begins, so that a place is found without walking the text from its start.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Lines {
        let ends = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        Lines(std::iter::once(0).chain(ends).collect())
    }

    fn place(&self, node: Node, file: &Rc<str>) -> Place {
        let at = node.range().start;
        let row = self.0.partition_point(|start| *start <= at);
        Place { file: Rc::clone(file), row: row as u32, column: (at - self.0[row - 1] + 1) as u32 }
    }
}

/// Elements that bear an id, by it, and by what `<alias id="old" as="new"/>` calls them besides.
pub(super) fn ids(root: &Element) -> Result<HashMap<&str, &Element>, ReadError> {
    let (mut all, mut twice, mut aliases) = (HashMap::new(), HashSet::new(), Vec::new());
    let mut rest = vec![root];
    while let Some(element) = rest.pop() {
        rest.extend(element.children.iter().rev());
        match element.tag.as_str() {
            "ref" => continue,
            "alias" => {
                aliases.push(element);
                continue;
            }
            _ => {}
        }
        let Some(id) = element.given("id") else { continue };
        if all.insert(id, element).is_some() && twice.insert(id) {
            return Err(element.at.error(format!("the id \"{id}\" is given twice")));
        }
    }
    for alias in aliases {
        let (Some(id), Some(name)) = (alias.given("id"), alias.given("as")) else {
            return Err(alias.at.error("an <alias> needs \"id\" and \"as\""));
        };
        let named = all.get(id).copied().ok_or_else(|| {
            alias
                .at
                .error(format!("nothing has the id \"{id}\""))
                .hint("An <alias> of an <alias> stands below it.")
        })?;
        if all.insert(name, named).is_some() {
            return Err(alias.at.error(format!("the id \"{name}\" is given twice")));
        }
    }
    Ok(all)
}
