//! What readers, built-in scenes and Python put together, before anything is checked.

use antumbra_math::Transform;
use antumbra_trace::{Shape, Triangles};

use super::{Camera, Level, Material, MaterialId, Message, Tangents, TextureId};
use crate::light::Light;
use crate::texture::Texture;

/// Index of a mesh in its scene.
pub type MeshId = u32;

/// A mesh with what varies over it. Attributes have one entry a vertex.
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    /// Its name in the file; may be empty.
    pub name: String,
    /// Positions and indices.
    pub triangles: Triangles,
    /// Shading normals (any length), or flat.
    pub normals: Option<Vec<[f32; 3]>>,
    /// Texture coordinates, sets 0 and 1.
    pub uvs: [Option<Vec<[f32; 2]>>; 2],
    /// Where u grows; made by `build` where a normal map asks for it.
    pub tangents: Option<Tangents>,
    /// Linear colours and alpha that multiply the material's.
    pub colors: Option<Vec<[f32; 4]>>,
}

/// What an object is made of.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A mesh of the scene; many objects may share it.
    Mesh(MeshId),
    /// A single shape.
    Shape(Shape),
}

/// A body in its place.
#[derive(Clone, Debug)]
pub struct Object {
    /// Its name in the file; may be empty.
    pub name: String,
    /// What it is made of.
    pub body: Body,
    /// Its look.
    pub material: MaterialId,
    /// Object → world. Shapes take the identity only.
    pub transform: Transform,
}

/// A scene in the making. All checking happens in `build`.
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    /// What people call it (file name or name of the built-in scene).
    pub name: String,
    /// Meshes.
    pub meshes: Vec<Mesh>,
    /// Things in their places.
    pub objects: Vec<Object>,
    /// Looks.
    pub materials: Vec<Material>,
    /// Textures.
    pub textures: Vec<Texture>,
    /// Lights, with their names (may be empty), the environment among them. Area lights bring their own surface:
    /// seen, hit, blocking, black. Emissive meshes are found by `build`.
    pub lights: Vec<(String, Light)>,
    /// Cameras; the first is the default.
    pub cameras: Vec<Camera>,
    /// The format cannot carry lights, or the file has none: a default sky is added if nothing shines.
    pub sky_if_unlit: bool,
    /// Settings that the file asks for, in the words of the table of settings; a person's own stay above them.
    pub suggested: Vec<(&'static str, String)>,
    /// Parameters that the file declares, with their values.
    pub parameters: Vec<(String, String)>,
    /// Things the reader had to say.
    pub messages: Vec<Message>,
    /// What the file says of itself ("glTF 2.0, Blender 4.5 exporter"), for `info`.
    pub source: String,
}

impl SceneBuilder {
    /// An empty scene.
    pub fn new(name: impl Into<String>) -> SceneBuilder {
        SceneBuilder { name: name.into(), ..SceneBuilder::default() }
    }

    /// Adds a material.
    pub fn material(&mut self, material: Material) -> MaterialId {
        self.materials.push(material);
        self.materials.len() as MaterialId - 1
    }

    /// Adds a texture.
    pub fn texture(&mut self, texture: Texture) -> TextureId {
        self.textures.push(texture);
        self.textures.len() as TextureId - 1
    }

    /// Adds a mesh that objects may share.
    pub fn mesh(&mut self, mesh: Mesh) -> MeshId {
        self.meshes.push(mesh);
        self.meshes.len() as MeshId - 1
    }

    /// Places a mesh.
    pub fn place(&mut self, name: &str, mesh: MeshId, material: MaterialId, transform: Transform) {
        self.objects.push(Object { name: name.into(), body: Body::Mesh(mesh), material, transform });
    }

    /// Adds a mesh and places it as it is.
    pub fn object(&mut self, name: &str, triangles: Triangles, material: MaterialId) {
        let mesh = self.mesh(Mesh { name: name.into(), triangles, ..Mesh::default() });
        self.place(name, mesh, material, Transform::IDENTITY);
    }

    /// Adds a shape.
    pub fn shape(&mut self, name: &str, shape: Shape, material: MaterialId) {
        let body = Body::Shape(shape);
        self.objects.push(Object { name: name.into(), body, material, transform: Transform::IDENTITY });
    }

    /// Adds a light.
    pub fn light(&mut self, name: &str, light: impl Into<Light>) {
        self.lights.push((name.into(), light.into()));
    }

    /// Says something that a person should know.
    pub fn say(&mut self, level: Level, place: impl Into<String>, text: impl Into<String>) {
        self.messages.push(Message { level, place: place.into(), text: text.into() });
    }
}
