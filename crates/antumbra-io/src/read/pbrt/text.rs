//! The words of a pbrt file: directives, strings in quotes, lists of values.

use std::borrow::Cow;
use std::rc::Rc;

use crate::error::ReadError;
use crate::read::text::{double, plain, show};

/// Where something stands.
#[derive(Clone, Debug)]
pub(super) struct At {
    /// An included file, or empty for the scene's own.
    pub file: Rc<str>,
    /// From 1.
    pub line: u32,
}

impl At {
    /// "line 12", after the file's name if the scene includes it.
    pub fn words(&self) -> String {
        let file = if self.file.is_empty() { String::new() } else { format!("{}, ", self.file) };
        format!("{file}line {}", self.line)
    }

    /// An error here.
    pub fn error(&self, what: impl Into<String>) -> ReadError {
        ReadError::new(self.words(), what)
    }
}

/// Values of a parameter; a list of any length, brackets or not.
#[derive(Clone, Debug)]
pub(super) enum Values {
    /// Numbers.
    Numbers(Vec<f64>),
    /// Strings.
    Texts(Vec<String>),
    /// `true` and `false`.
    Truths(Vec<bool>),
}

impl Values {
    /// How many there are.
    pub fn len(&self) -> usize {
        match self {
            Values::Numbers(all) => all.len(),
            Values::Texts(all) => all.len(),
            Values::Truths(all) => all.len(),
        }
    }
}

/// A file that is being read.
pub(super) struct Text<'a> {
    name: Rc<str>,
    bytes: Cow<'a, [u8]>,
    next: usize,
    line: u32,
}

impl<'a> Text<'a> {
    /// From the first byte on.
    pub fn new(name: &str, bytes: Cow<'a, [u8]>) -> Text<'a> {
        let bytes = match bytes {
            Cow::Borrowed(bytes) => plain(bytes),
            // A mark of three bytes is passed over below.
            Cow::Owned(bytes) => match plain(&bytes) {
                Cow::Borrowed(_) => Cow::Owned(bytes),
                Cow::Owned(other) => Cow::Owned(other),
            },
        };
        let next = if bytes.starts_with(&[0xef, 0xbb, 0xbf]) { 3 } else { 0 };
        Text { name: name.into(), bytes, next, line: 1 }
    }

    /// Where the next word stands.
    pub fn here(&mut self) -> At {
        self.skip();
        At { file: self.name.clone(), line: self.line }
    }

    /// The next directive; `None` at the end.
    pub fn directive(&mut self) -> Result<Option<String>, ReadError> {
        match self.peek() {
            None => Ok(None),
            Some(c) if c.is_ascii_alphabetic() => Ok(Some(String::from_utf8_lossy(self.bare()).into_owned())),
            Some(_) => {
                let at = self.here();
                let word = show(self.bare_or_one());
                Err(at.error(format!("{word} stands where a directive is expected")))
            }
        }
    }

    /// The next word without quotes, as `ActiveTransform` takes one.
    pub fn word(&mut self) -> String {
        self.skip();
        String::from_utf8_lossy(self.bare()).into_owned()
    }

    /// The next string in quotes.
    pub fn string(&mut self, of: &str) -> Result<String, ReadError> {
        let at = self.here();
        match self.quoted()? {
            Some(text) => Ok(text),
            None => Err(at.error(format!("{of}: a string in quotes is expected"))),
        }
    }

    /// The next string in quotes, if there is one.
    pub fn string_if_any(&mut self) -> Result<Option<String>, ReadError> {
        self.quoted()
    }

    /// N numbers, with brackets or without.
    pub fn numbers<const N: usize>(&mut self, of: &str) -> Result<[f64; N], ReadError> {
        let at = self.here();
        let bracket = self.peek() == Some(b'[');
        if bracket {
            self.next += 1;
        }
        let mut numbers = [0.0; N];
        for (i, number) in numbers.iter_mut().enumerate() {
            let fail = || at.error(format!("{of} takes {N} numbers, and {i} are here"));
            *number = self.number()?.ok_or_else(fail)?;
        }
        if bracket && self.peek() == Some(b']') {
            self.next += 1;
        } else if bracket {
            return Err(at.error(format!("{of} takes {N} numbers, then ]")));
        }
        Ok(numbers)
    }

    /// The values of a parameter: one, or a list in brackets.
    pub fn values(&mut self, of: &str) -> Result<Values, ReadError> {
        let at = self.here();
        let list = self.peek() == Some(b'[');
        if list {
            self.next += 1;
        }
        let (mut numbers, mut texts, mut truths) = (Vec::new(), Vec::new(), Vec::new());
        loop {
            match self.peek() {
                None => return Err(at.error(format!("{of}: the file ends before its value does"))),
                Some(b']') if list => {
                    self.next += 1;
                    break;
                }
                Some(b'"') => texts.extend(self.quoted()?),
                Some(b't' | b'f') => truths.push(self.truth(of)?),
                Some(_) => numbers.extend(self.number()?.map(Some).ok_or_else(|| {
                    let word = show(self.bare_or_one());
                    at.error(format!("{of}: {word} is no value"))
                })?),
            }
            if !list {
                break;
            }
        }
        match (numbers.is_empty(), texts.is_empty(), truths.is_empty()) {
            (_, true, true) => Ok(Values::Numbers(numbers)),
            (true, false, true) => Ok(Values::Texts(texts)),
            (true, true, false) => Ok(Values::Truths(truths)),
            _ => Err(at.error(format!("{of} holds values of different kinds"))),
        }
    }

    fn truth(&mut self, of: &str) -> Result<bool, ReadError> {
        let at = self.here();
        match self.bare() {
            b"true" => Ok(true),
            b"false" => Ok(false),
            word => Err(at.error(format!("{of}: {} is no value", show(word)))),
        }
    }

    /// The next number; `None` if something else is next.
    fn number(&mut self) -> Result<Option<f64>, ReadError> {
        if !matches!(self.peek(), Some(b'0'..=b'9' | b'+' | b'-' | b'.')) {
            return Ok(None);
        }
        let at = At { file: self.name.clone(), line: self.line };
        let word = self.bare();
        match double(word) {
            Some(number) => Ok(Some(number)),
            None => Err(at.error(format!("{} is no number", show(word)))),
        }
    }

    fn quoted(&mut self) -> Result<Option<String>, ReadError> {
        if self.peek() != Some(b'"') {
            return Ok(None);
        }
        let at = self.here();
        let from = self.next + 1;
        let mut end = from;
        while self.bytes.get(end).is_some_and(|c| *c != b'"' && *c != b'\n') {
            end += if self.bytes[end] == b'\\' { 2 } else { 1 };
        }
        if self.bytes.get(end) != Some(&b'"') {
            return Err(at.error("a string is not closed: its second \" is missing"));
        }
        self.next = end + 1;
        let text = String::from_utf8_lossy(&self.bytes[from..end]);
        Ok(Some(if text.contains('\\') { unescaped(&text) } else { text.into_owned() }))
    }

    /// The bytes up to the next blank, quote, bracket or comment.
    fn bare(&mut self) -> &[u8] {
        let from = self.next;
        let ends = |c: &u8| c.is_ascii_whitespace() || matches!(c, b'"' | b'[' | b']' | b'#');
        self.next = self.bytes[from..].iter().position(ends).map_or(self.bytes.len(), |n| from + n);
        &self.bytes[from..self.next]
    }

    /// The same, or the one byte that ends it.
    fn bare_or_one(&mut self) -> &[u8] {
        let from = self.next;
        if self.bare().is_empty() {
            self.next = (from + 1).min(self.bytes.len());
        }
        &self.bytes[from..self.next]
    }

    fn peek(&mut self) -> Option<u8> {
        self.skip();
        self.bytes.get(self.next).copied()
    }

    /// Passes over blanks, line ends and comments.
    fn skip(&mut self) {
        while let Some(c) = self.bytes.get(self.next) {
            match c {
                b'\n' => self.line += 1,
                b'#' => {
                    let rest = &self.bytes[self.next..];
                    self.next += rest.iter().position(|c| *c == b'\n').unwrap_or(rest.len());
                    continue;
                }
                c if c.is_ascii_whitespace() => {}
                _ => return,
            }
            self.next += 1;
        }
    }
}

/// Backslashes before quotes, backslashes and letters read as what they mean.
fn unescaped(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        plain.extend(match (c, c == '\\') {
            (_, true) => rest.next().map(|c| match c {
                'n' => '\n',
                't' => '\t',
                c => c,
            }),
            (c, false) => Some(c),
        });
    }
    plain
}
