//! glTF 2.0 and GLB.

mod accessor;
mod animation;
mod buffers;
mod camera;
mod clear_coat;
mod container;
mod document;
pub(crate) mod draco;
mod extensions;
mod forecast;
mod light;
mod material;
mod mesh;
mod meshopt;
mod node;
mod primitive;
mod skin;
mod specular;
mod texture;
mod variant;

use antumbra::scene::{Level, SceneBuilder};
use antumbra_math::Transform;

use accessor::Accessors;
use document::{Asset, Document};

use super::{Context, Counted};
use crate::error::ReadError;

/// The work in progress: the document, what is built from it, and what was said.
struct Reader<'a> {
    doc: &'a Document,
    accessors: Accessors<'a>,
    context: &'a Context<'a>,
    scene: SceneBuilder,
    said: Counted,
    /// Index of the variant of materials that is wanted.
    variant: Option<usize>,
    materials: material::Materials,
    meshes: primitive::Meshes,
    /// Where each node of the scene stands.
    world: Vec<Option<Transform>>,
}

/// Reads a `.gltf` or `.glb`.
pub(super) fn read(bytes: &[u8], context: &Context) -> Result<SceneBuilder, ReadError> {
    let container = container::open(bytes, context.named_glb)?;
    let mut doc = parse(container.json)?;
    let mut said = Counted::default();
    if container.trailing > 0 {
        let what = format!("{} bytes after its announced length are not read", container.trailing);
        said.warn("GLB header", what);
    }
    extensions::check(&doc, &mut said)?;
    if context.forecast.is_asked() {
        forecast::tell(&doc, context)?;
    }
    let buffers = buffers::load(&doc, container.bin, context)?;
    stand(&mut doc, &buffers, context, &mut said)?;
    let variant = variant::find(&doc, context.variant)?;
    let mut reader = Reader {
        doc: &doc,
        accessors: Accessors { doc: &doc, buffers: &buffers, context },
        context,
        scene: SceneBuilder { source: source(&doc.asset), ..SceneBuilder::default() },
        said,
        variant,
        materials: material::Materials::default(),
        meshes: primitive::Meshes::default(),
        world: vec![None; doc.nodes.len()],
    };
    let placed = node::walk(&doc, &context.root, &mut reader.said)?;
    placed.iter().for_each(|p| reader.world[p.node] = Some(p.world));
    for node in &placed {
        reader.place(node)?;
    }
    reader.finish()
}

impl Reader<'_> {
    /// Everything that hangs at a node.
    fn place(&mut self, at: &node::Placed) -> Result<(), ReadError> {
        let node = &self.doc.nodes[at.node];
        if let Some(mesh) = node.mesh {
            self.place_mesh(at, mesh)?;
        }
        if let Some(camera) = node.camera {
            self.place_camera(at, camera)?;
        }
        self.place_light(at)
    }

    fn finish(mut self) -> Result<SceneBuilder, ReadError> {
        if !self.meshes.announced {
            let what = "there is nothing to render: no mesh with triangles in the scene";
            return Err(ReadError::new("", what).hint("Check that the right scene was exported."));
        }
        if let Some(text) = offers(self.doc, self.context) {
            self.scene.say(Level::Note, "", text);
        }
        self.scene.sky_if_unlit = true;
        self.said.into_scene(&mut self.scene);
        Ok(self.scene)
    }
}

/// Puts the nodes where the animations have them at the time that is asked for.
fn stand(
    doc: &mut Document,
    buffers: &buffers::Buffers,
    context: &Context,
    said: &mut Counted,
) -> Result<(), ReadError> {
    let Some(time) = context.at_time else { return Ok(()) };
    if doc.animations.is_empty() && context.animation.is_none() {
        said.note("animations", "there are none: every time shows the same");
    }
    let pose = animation::pose(&Accessors { doc, buffers, context }, context.animation, time, said)?;
    animation::apply(doc, &pose);
    Ok(())
}

/// What the file has besides what is shown.
fn offers(doc: &Document, context: &Context) -> Option<String> {
    let still = context.at_time.is_none() && !doc.animations.is_empty();
    let still = still.then(|| {
        let end = antumbra_math::real::round(animation::end(doc) * 1000.0) / 1000.0;
        let names = animation::names(doc);
        let which =
            if names.len() < 2 { String::new() } else { format!("; --animation {}", names.join(", ")) };
        format!("animations stand still (--at-time T, 0 to {end} s{which})")
    });
    let names = if context.variant.is_none() { variant::names(doc) } else { Vec::new() };
    let looks =
        (!names.is_empty()).then(|| format!("materials in variants (--variant {})", names.join(", ")));
    let parts: Vec<_> = [still, looks].into_iter().flatten().collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

/// What the file says of itself.
fn source(asset: &Asset) -> String {
    let version = if asset.version.is_empty() { "2.0" } else { &asset.version };
    match asset.generator.as_str() {
        "" => format!("glTF {version}"),
        generator => format!("glTF {version}, {generator}"),
    }
}

fn parse(json: &[u8]) -> Result<Document, ReadError> {
    #[derive(Default, serde::Deserialize)]
    #[serde(default)]
    struct Head {
        asset: Asset,
    }
    let parsed = serde_json::from_slice::<Document>(json);
    // Version 1 has other shapes of everything: it is told apart before anything else is said about it.
    let head = match &parsed {
        Ok(doc) => Some((doc.asset.version.clone(), doc.asset.min_version.clone())),
        Err(_) => serde_json::from_slice::<Head>(json).ok().map(|h| (h.asset.version, h.asset.min_version)),
    };
    if let Some((version, min)) = head {
        let old = !version.is_empty() && !version.starts_with("2.");
        if old || min.as_ref().is_some_and(|m| m != "2.0") {
            let version = if old { version } else { min.unwrap_or_default() };
            let what = format!("this is glTF {version}; glTF 2.0 is read");
            return Err(ReadError::new("asset", what).hint("Export the scene as glTF 2.0."));
        }
    }
    parsed.map_err(|e| {
        let text = e.to_string();
        let what = text.rsplit_once(" at line ").map_or(text.as_str(), |t| t.0);
        let place = format!("JSON line {} column {}", e.line(), e.column());
        ReadError::new(place, what).hint("`npx gltf-validator` says more about such a file.")
    })
}
