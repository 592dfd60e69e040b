//! glTF 2.0, binary (`.glb`) or as text with its numbers beside it (`.gltf`, `.bin`).
//!
//! Numbers are written with as many digits as bring the same bits back. Light and reflection stay the file's own numbers:
//! intensities as radiant intensity, strengths as radiance.

mod buffer;
mod camera;
mod light;
mod material;
mod mesh;
mod tangents;
mod texture;

use std::collections::{BTreeSet, HashMap};

use serde_json::{Map, Value, json};

use super::Job;
use buffer::Buffer;

/// The document as it grows.
struct Writer<'j, 'a> {
    job: &'j mut Job<'a>,
    buffer: Buffer,
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    /// What each material asks of its meshes.
    asks: Vec<material::Asks>,
    textures: Vec<Value>,
    images: Vec<Value>,
    samplers: Vec<Value>,
    cameras: Vec<Value>,
    lights: Vec<Value>,
    extensions: BTreeSet<&'static str>,
    made: Made,
}

/// What was written already.
#[derive(Default)]
struct Made {
    geometries: HashMap<(mesh::Source, bool), mesh::Geometry>,
    meshes: HashMap<(mesh::Source, usize), usize>,
    materials: HashMap<(u32, bool), usize>,
    images: texture::Images,
}

/// A `.glb`: header, the document, the numbers (glTF 2.0, section 4.4).
pub(super) fn glb(job: &mut Job) -> Result<Vec<u8>, String> {
    let (document, numbers) = write(job, None)?;
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = Vec::with_capacity(json.len() + numbers.len() + 28);
    let mut chunks = vec![(b"JSON", &json)];
    if !numbers.is_empty() {
        chunks.push((b"BIN\0", &numbers));
    }
    let whole: usize = chunks.iter().map(|(_, chunk)| chunk.len() + 8).sum::<usize>() + 12;
    let length =
        u32::try_from(whole).map_err(|_| format!("{whole} bytes: a .glb holds 4 GiB; .gltf holds more"))?;
    bytes.extend_from_slice(b"glTF");
    bytes.extend_from_slice(&2u32.to_le_bytes());
    bytes.extend_from_slice(&length.to_le_bytes());
    for (kind, chunk) in chunks {
        bytes.extend_from_slice(&(chunk.len() as u32).to_le_bytes());
        bytes.extend_from_slice(kind);
        bytes.extend_from_slice(chunk);
    }
    Ok(bytes)
}

/// A `.gltf`, its numbers and pictures in a `.bin` of the same name.
pub(super) fn text(job: &mut Job) -> Result<Vec<u8>, String> {
    let name = format!("{}.bin", job.stem);
    let (document, numbers) = write(job, Some(&name))?;
    if !numbers.is_empty() {
        job.file(&name, numbers);
    }
    serde_json::to_vec_pretty(&document).map_err(|e| e.to_string())
}

/// The document and its buffer; `uri`: the file that holds the buffer.
fn write(job: &mut Job, uri: Option<&str>) -> Result<(Value, Vec<u8>), String> {
    let mut writer = Writer {
        job,
        buffer: Buffer::default(),
        nodes: Vec::new(),
        meshes: Vec::new(),
        materials: Vec::new(),
        asks: Vec::new(),
        textures: Vec::new(),
        images: Vec::new(),
        samplers: Vec::new(),
        cameras: Vec::new(),
        lights: Vec::new(),
        extensions: BTreeSet::new(),
        made: Made::default(),
    };
    for object in writer.job.objects() {
        writer.object(object)?;
    }
    writer.lights()?;
    for camera in &writer.job.scene.cameras {
        writer.camera(camera);
    }
    Ok(writer.finish(uri))
}

impl Writer<'_, '_> {
    fn finish(self, uri: Option<&str>) -> (Value, Vec<u8>) {
        let Writer { job, mut buffer, mut extensions, .. } = self;
        let mut document = Map::new();
        let generator = concat!("antumbra ", env!("CARGO_PKG_VERSION"));
        document.insert("asset".into(), json!({"version": "2.0", "generator": generator}));
        let mut scene = json!({});
        if !job.scene.name.is_empty() {
            scene["name"] = json!(job.scene.name);
        }
        if !self.nodes.is_empty() {
            scene["nodes"] = json!((0..self.nodes.len()).collect::<Vec<_>>());
        }
        document.insert("scene".into(), json!(0));
        document.insert("scenes".into(), json!([scene]));
        if !self.lights.is_empty() {
            extensions.insert(light::PUNCTUAL);
            let lights = json!({light::PUNCTUAL: {"lights": self.lights}});
            document.insert("extensions".into(), lights);
        }
        let bytes = std::mem::take(&mut buffer.bytes);
        let mut buffers = Vec::new();
        if !bytes.is_empty() {
            let mut whole = json!({"byteLength": bytes.len()});
            if let Some(uri) = uri {
                whole["uri"] = json!(percent(uri));
            }
            buffers.push(whole);
        }
        let extensions = extensions.into_iter().map(|name| json!(name)).collect();
        // An empty list is not allowed.
        for (name, list) in [
            ("nodes", self.nodes),
            ("meshes", self.meshes),
            ("materials", self.materials),
            ("textures", self.textures),
            ("images", self.images),
            ("samplers", self.samplers),
            ("cameras", self.cameras),
            ("accessors", buffer.accessors),
            ("bufferViews", buffer.views),
            ("buffers", buffers),
            ("extensionsUsed", extensions),
        ] {
            if !list.is_empty() {
                document.insert(name.into(), Value::Array(list));
            }
        }
        (Value::Object(document), bytes)
    }

    /// Adds a node.
    fn node(&mut self, name: &str, mut node: Value) {
        if !name.is_empty() {
            node["name"] = json!(name);
        }
        self.nodes.push(node);
    }

    fn warn(&mut self, place: impl Into<String>, text: impl Into<String>) {
        self.job.said.warn(place, text);
    }
}

/// A number with the fewest digits that bring the same bits back.
fn number(x: f32) -> Value {
    let short = x.to_string().parse::<f64>().ok().filter(|wide| *wide as f32 == x);
    json!(short.unwrap_or(f64::from(x)))
}

/// The same of several.
fn numbers(all: impl IntoIterator<Item = f32>) -> Value {
    all.into_iter().map(number).collect()
}

/// A file's name as a URI (RFC 3986): what is not plain as `%` and two digits.
fn percent(name: &str) -> String {
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-._~".contains(&b);
    name.bytes().map(|b| if plain(b) { char::from(b).to_string() } else { format!("%{b:02X}") }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_come_back_to_the_bit() {
        assert_eq!(numbers([0.1, 1.0, -0.25]).to_string(), "[0.1,1.0,-0.25]");
        for bits in (0..2000u32).map(|i| i.wrapping_mul(0x9e37_79b9)) {
            let x = f32::from_bits(bits);
            if x.is_finite() {
                let back: f64 = serde_json::from_str(&number(x).to_string()).unwrap_or(f64::NAN);
                assert_eq!((back as f32).to_bits(), x.to_bits());
            }
        }
    }

    #[test]
    fn names_of_files_are_uris() {
        assert_eq!(percent("a b%ü.bin"), "a%20b%25%C3%BC.bin");
    }
}
