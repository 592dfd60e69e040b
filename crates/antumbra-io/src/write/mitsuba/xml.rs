//! Elements of XML as text.

use antumbra_math::{DVec3, Rgb, Transform};

/// An element with what stands in it.
#[derive(Clone, Debug)]
pub(super) struct Element {
    tag: &'static str,
    attributes: Vec<(&'static str, String)>,
    children: Vec<Element>,
}

impl Element {
    pub(super) fn new(tag: &'static str) -> Element {
        Element { tag, attributes: Vec::new(), children: Vec::new() }
    }

    /// A plugin.
    pub(super) fn plugin(tag: &'static str, kind: &str) -> Element {
        Element::new(tag).with("type", kind)
    }

    /// With an attribute; an empty one is left out.
    pub(super) fn with(mut self, name: &'static str, value: impl Into<String>) -> Element {
        let value = value.into();
        if !value.is_empty() {
            self.attributes.push((name, value));
        }
        self
    }

    /// With an element in it.
    pub(super) fn add(mut self, child: Element) -> Element {
        self.children.push(child);
        self
    }

    /// With elements in it.
    pub(super) fn all(mut self, children: impl IntoIterator<Item = Element>) -> Element {
        self.children.extend(children);
        self
    }

    /// With a property.
    fn property(self, tag: &'static str, name: &str, value: String) -> Element {
        self.add(Element::new(tag).with("name", name).with("value", value))
    }

    pub(super) fn float(self, name: &str, x: impl std::fmt::Display) -> Element {
        self.property("float", name, x.to_string())
    }

    pub(super) fn integer(self, name: &str, x: impl std::fmt::Display) -> Element {
        self.property("integer", name, x.to_string())
    }

    pub(super) fn string(self, name: &str, text: &str) -> Element {
        self.property("string", name, text.into())
    }

    pub(super) fn boolean(self, name: &str, value: bool) -> Element {
        self.property("boolean", name, value.to_string())
    }

    pub(super) fn rgb(self, name: &str, color: Rgb) -> Element {
        self.add(rgb(name, color))
    }

    /// With a point or vector.
    pub(super) fn place(self, tag: &'static str, name: &str, p: [f32; 3]) -> Element {
        let axes = ["x", "y", "z"].into_iter().zip(p);
        let element = Element::new(tag).with("name", name);
        self.add(axes.fold(element, |e, (axis, x)| e.with(axis, x.to_string())))
    }

    /// With a transform; nothing for the identity.
    pub(super) fn transform(self, name: &str, t: &Transform) -> Element {
        if *t == Transform::IDENTITY {
            return self;
        }
        let row = |i: usize| {
            let [x, y, z] = [t.linear.x_axis, t.linear.y_axis, t.linear.z_axis].map(|c| c[i]);
            [x, y, z, t.translation[i]]
        };
        let rows = [row(0), row(1), row(2), [0.0, 0.0, 0.0, 1.0]];
        let matrix = Element::new("matrix").with("value", join(rows.as_flattened()));
        self.add(Element::new("transform").with("name", name).add(matrix))
    }

    /// With a transform from the point `origin` toward `target`; `before`: a step that comes first.
    pub(super) fn looking(self, before: Option<Element>, origin: DVec3, target: DVec3, up: DVec3) -> Element {
        let lookat = Element::new("lookat")
            .with("origin", join(&origin.to_array()))
            .with("target", join(&target.to_array()))
            .with("up", join(&up.to_array()));
        self.add(Element::new("transform").with("name", "to_world").all(before).add(lookat))
    }

    /// The whole document.
    pub(super) fn document(&self) -> String {
        let mut text = String::from("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n");
        self.write(0, &mut text);
        text
    }

    fn write(&self, depth: usize, out: &mut String) {
        out.push_str(&"    ".repeat(depth));
        out.push('<');
        out.push_str(self.tag);
        for (name, value) in &self.attributes {
            out.push_str(&format!(" {name}=\"{}\"", escaped(value)));
        }
        if self.children.is_empty() {
            out.push_str("/>\n");
            return;
        }
        out.push_str(">\n");
        self.children.iter().for_each(|c| c.write(depth + 1, out));
        out.push_str(&format!("{}</{}>\n", "    ".repeat(depth), self.tag));
    }
}

/// A colour; one number for grey.
pub(super) fn rgb(name: &str, color: Rgb) -> Element {
    let Rgb([r, g, b]) = color;
    let value = if r == g && g == b { r.to_string() } else { join(&color.0) };
    Element::new("rgb").with("name", name).with("value", value)
}

/// Numbers with blanks between them.
pub(super) fn join<T: std::fmt::Display>(numbers: &[T]) -> String {
    numbers.iter().map(T::to_string).collect::<Vec<_>>().join(" ")
}

/// What may stand in an attribute; a `$` would be a parameter.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '$' => out.push('_'),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
