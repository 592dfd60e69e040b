//! Shapes: what each plugin is made of, its look and its light.

mod analytic;
mod cube;
mod file;
mod group;
mod round;
mod serialized;

use std::collections::HashMap;

use antumbra::light;
use antumbra::scene::{Emission, Material, MaterialId, Mesh, MeshId, Surface};
use antumbra_math::{Rgb, Transform, Vec3};
use antumbra_trace::Shape;

use super::Reader;
use super::document::Element;
use crate::error::ReadError;

/// What a shape plugin makes.
enum Body {
    /// A mesh of the scene in its place.
    Mesh(MeshId, Transform),
    /// A shape of the core.
    Shape(Shape),
    /// A parallelogram: corner and two sides, emitting along u × v.
    Parallelogram([Vec3; 3], MeshId, Transform),
}

/// Makes the body of a shape: file → world, and whether its material has textures (so that it needs coordinates).
type Make = for<'a> fn(&mut Reader<'a>, &'a Element, &Placing) -> Result<Body, ReadError>;

/// How a shape lies in the world.
struct Placing {
    /// Shape → world.
    world: Transform,
    /// Its own transform mirrors it, whatever that of an instance does.
    mirrored: bool,
    /// What its look shows of the mesh: `vertex_NAME` or `face_NAME`.
    attribute: Option<String>,
    /// Texture coordinates matter.
    textured: bool,
    /// It gives off light.
    shines: bool,
}

/// Every shape plugin that is read. To add one: a function and a line here.
const SHAPES: [(&str, Make); 8] = [
    ("ply", file::ply),
    ("obj", file::obj),
    ("serialized", serialized::serialized),
    ("rectangle", analytic::rectangle),
    ("disk", analytic::disk),
    ("cube", cube::cube),
    ("sphere", round::sphere),
    ("cylinder", round::cylinder),
];

/// Meshes that were made already, by what they are made of.
pub(super) type Known = HashMap<String, MeshId>;

pub(super) use serialized::Serialized;

/// Where a shape is placed.
struct Within<'a> {
    /// What the shape's own transform leads into → world.
    world: Transform,
    /// The instance that draws it.
    instance: Option<&'a Element>,
    /// Shapes that hold it.
    depth: u32,
}

impl<'a> Reader<'a> {
    /// Places a shape of the scene, as an object, a light or both.
    pub(super) fn shape(&mut self, element: &'a Element) -> Result<(), ReadError> {
        let within = Within { world: self.context.root, instance: None, depth: 0 };
        self.shape_within(element, &within)
    }

    fn shape_within(&mut self, element: &'a Element, within: &Within<'a>) -> Result<(), ReadError> {
        if let Some((_, place)) = group::GROUPS.iter().find(|g| g.0 == element.plugin()) {
            return place(self, element, within);
        }
        self.announced += 1;
        let Some((_, make)) = SHAPES.iter().find(|s| s.0 == element.plugin()) else {
            self.lacks(element, "left out");
            return Ok(());
        };
        let emission = self.area_emitter(element)?;
        let (material, written_out) = self.look(element, emission.is_some())?;
        let name = name(within.instance.filter(|i| i.given("id").is_some()).unwrap_or(element));
        let own = element.transform("to_world")?;
        let textured = self.needs_coordinates(&material);
        let placing = Placing {
            world: within.world.after(&own),
            mirrored: own.mirrors(),
            attribute: written_out.and_then(|id| self.bsdfs.attribute(id)),
            textured,
            shines: emission.is_some(),
        };
        let body = make(self, element, &placing)?;
        self.name_the_unread(element);
        if let Some(attribute) = &placing.attribute {
            self.check_attribute(element, &body, attribute);
        }
        let black = matches!(material.surface, Surface::Diffuse { albedo } if albedo.is_black());
        let black = black && material.back.is_none();
        if let (Body::Parallelogram([corner, u, v], ..), Some(radiance), true) = (&body, emission, black) {
            self.scene.light(&name, light::Rectangle::new(*corner, *u, *v, radiance));
            return Ok(());
        }
        let material = self.material_of(material, written_out, emission);
        match body {
            Body::Mesh(mesh, world) | Body::Parallelogram(_, mesh, world) => {
                self.scene.place(&name, mesh, material, world);
            }
            Body::Shape(shape) => self.scene.shape(&name, shape, material),
        }
        Ok(())
    }

    /// Says where a shape has no attribute that its look asks for.
    fn check_attribute(&mut self, element: &Element, body: &Body, attribute: &str) {
        let painted = match body {
            Body::Mesh(mesh, _) => self.scene.meshes[*mesh as usize].colors.is_some(),
            _ => false,
        };
        if !painted {
            let what = format!("{} has no colours called \"{attribute}\": drawn white", element.words());
            self.said.warn(element.at.words(), what);
        }
    }

    /// A look is painted with a texture or stretched along its tangents, so that it needs texture coordinates; one of parts
    /// may be, where the scene has such.
    fn needs_coordinates(&self, material: &Material) -> bool {
        let parts = matches!(material.surface, Surface::Blend { .. }) || material.back.is_some();
        let stretched = |m: &Material| m.surface.is_stretched();
        let any = || !self.scene.textures.is_empty() || self.scene.materials.iter().any(stretched);
        material.textures().next().is_some() || stretched(material) || (parts && any())
    }

    /// The material of a shape, and its id if shapes may share it.
    fn look(
        &mut self,
        element: &'a Element,
        shines: bool,
    ) -> Result<(Material, Option<MaterialId>), ReadError> {
        let found = self.plugins(element, "bsdf")?;
        match found[..] {
            // A light without a look is black, all else is grey; both from their front.
            [] => {
                let albedo = Rgb::grey(if shines { 0.0 } else { 0.5 });
                Ok((Material { one_sided: true, ..Material::diffuse(albedo) }, None))
            }
            [bsdf] => {
                let id = self.bsdf(bsdf)?;
                Ok((self.scene.materials[id as usize].clone(), Some(id)))
            }
            [_, second, ..] => Err(second.at.error(format!("{} has more than one bsdf", element.words()))),
        }
    }

    fn material_of(
        &mut self,
        material: Material,
        shared: Option<MaterialId>,
        emission: Option<Rgb>,
    ) -> MaterialId {
        match (shared, emission) {
            (Some(id), None) => id,
            (None, None) => match self.scene.materials.iter().position(|m| *m == material) {
                Some(id) => id as MaterialId,
                None => self.scene.material(material),
            },
            (_, Some(radiance)) => {
                let emission = Some(Emission { radiance, both_sides: false });
                self.scene.material(Material { emission, ..material })
            }
        }
    }

    /// A mesh that is made once for each key; an empty one is a mesh without triangles.
    fn mesh(
        &mut self,
        key: String,
        make: impl FnOnce(&mut Reader<'a>) -> Result<Mesh, ReadError>,
    ) -> Result<MeshId, ReadError> {
        if let Some(id) = self.meshes.get(&key) {
            return Ok(*id);
        }
        let mesh = make(self)?;
        let id = self.scene.mesh(mesh);
        self.meshes.insert(key, id);
        Ok(id)
    }
}

/// What people call a shape: its id, or the name of its file.
fn name(element: &Element) -> String {
    let file = element.children.iter().find(|c| c.given("name") == Some("filename"));
    let stem = |path: &str| {
        let last = path.rsplit(['/', '\\']).next().unwrap_or(path);
        last.rsplit_once('.').map_or(last, |n| n.0).to_string()
    };
    match (element.given("id"), file) {
        (Some(id), _) => id.to_string(),
        (None, Some(file)) => stem(file.attribute("value")),
        (None, None) => String::new(),
    }
}
