//! `Shape`: what each is made of, its look and its light; objects that are placed many times.

mod mesh;
mod patch;
mod round;
mod subdivision;

use std::collections::HashMap;

use antumbra::scene::{Alpha, Emission, Material, MaterialId, Mesh, MeshId, Surface};
use antumbra_math::{DVec3, Rgb, Transform};
use antumbra_trace::Shape;

use super::Reader;
use super::directive::name_of;
use super::parameters::Parameters;
use super::text::At;
use crate::error::ReadError;
use crate::read::GREY;
use crate::read::text::show;

/// What a shape is made of.
#[derive(Clone, Copy)]
enum Body {
    /// A mesh of the scene.
    Mesh(MeshId),
    /// A shape of the core, in the world.
    Shape(Shape),
}

/// How a shape lies in the world.
struct Placing {
    /// Shape → our world.
    world: Transform,
    /// It must be a mesh: it is painted with textures, or placed more than once.
    mesh: bool,
    /// Its other side is its front.
    reverse: bool,
    /// It gives off light.
    shines: bool,
}

/// How many materials back the same one is looked for.
const NEAR: usize = 256;

/// A shape in its place.
#[derive(Clone)]
struct Part {
    name: String,
    mesh: MeshId,
    material: MaterialId,
    world: Transform,
}

/// What was made already.
#[derive(Default)]
pub(super) struct Known {
    /// Meshes of files.
    meshes: HashMap<String, MeshId>,
    /// What `ObjectBegin` … `ObjectEnd` holds, by its name.
    objects: HashMap<String, Vec<Part>>,
    /// The object that is being defined.
    defining: Option<(String, Vec<Part>)>,
    /// Shapes that the file asks for, drawn or not.
    announced: usize,
}

impl Known {
    /// The file has a shape.
    pub fn any(&self) -> bool {
        self.announced > 0
    }
}

/// Makes the body of a shape; `None` after a warning if there is nothing of it.
type Make = fn(&mut Reader, &Parameters, &Placing) -> Result<Option<Body>, ReadError>;

/// Every shape that is read. To add one: a function and a line here.
const SHAPES: [(&str, Make); 7] = [
    ("trianglemesh", mesh::trianglemesh),
    ("plymesh", mesh::plymesh),
    ("bilinearmesh", patch::bilinearmesh),
    ("loopsubdiv", subdivision::loopsubdiv),
    ("sphere", round::sphere),
    ("disk", round::disk),
    ("cylinder", round::cylinder),
];

impl Reader<'_> {
    /// Places a shape, with its light.
    pub(super) fn shape(&mut self, p: &Parameters, plugin: &str) -> Result<(), ReadError> {
        self.shapes.announced += 1;
        let Some((_, make)) = SHAPES.iter().find(|s| s.0 == plugin) else {
            self.lacks(p, "left out");
            return Ok(());
        };
        let base = self.material_in_use();
        let material = self.masked(self.scene.materials[base as usize].clone(), p)?;
        let defining = self.shapes.defining.is_some();
        let area = self.state.area.clone();
        if defining && let Some(area) = &area {
            self.said.warn(area.at.words(), "light of an object that is placed more than once: left out");
        }
        let area = area.filter(|_| !defining);
        let placing = Placing {
            world: self.world(),
            mesh: defining || self.needs_coordinates(&material),
            reverse: self.state.reverse,
            shines: area.is_some(),
        };
        let Some(body) = make(self, p, &placing)? else { return Ok(()) };
        self.name_the_unread(p);
        let emission = area.map(|area| {
            let radiance = area.of(self.area(body, &placing.world));
            Emission { radiance, both_sides: area.both_sides }
        });
        let material = self.variant(base, Material { emission, ..material });
        let name = stem(p.text("filename")?.unwrap_or(""));
        match (body, &mut self.shapes.defining) {
            (Body::Mesh(mesh), Some((_, parts))) => {
                parts.push(Part { name, mesh, material, world: placing.world })
            }
            (Body::Mesh(mesh), None) => self.scene.place(&name, mesh, material, placing.world),
            (Body::Shape(shape), _) => self.scene.shape(&name, shape, material),
        }
        Ok(())
    }

    /// The material of the shapes that follow: grey if the file names none.
    fn material_in_use(&mut self) -> MaterialId {
        match self.state.material {
            Some(id) => id,
            None => {
                let id = self.scene.material(Material::diffuse(Rgb::grey(GREY)));
                self.state.material = Some(id);
                id
            }
        }
    }

    /// With the holes that `alpha` makes.
    fn masked(&mut self, material: Material, p: &Parameters) -> Result<Material, ReadError> {
        if !p.has("alpha") {
            return Ok(material);
        }
        let alpha = self.number(p, "alpha", 1.0)?;
        let opacity = material.opacity * alpha.factor.0[0];
        if alpha.image.is_none() && opacity >= 1.0 {
            return Ok(material);
        }
        let cover = alpha.image.as_ref().map(|texture| self.intern(texture)).or(material.cover);
        Ok(Material { alpha: Alpha::Blend, opacity, cover, ..material })
    }

    /// The material as it is in use here: `base` itself where nothing is changed, else a copy that is made once.
    fn variant(&mut self, base: MaterialId, material: Material) -> MaterialId {
        let materials = &self.scene.materials;
        if materials[base as usize] == material {
            return base;
        }
        // Further back, a copy costs less than looking for it.
        let near = materials.len().saturating_sub(NEAR);
        match materials[near..].iter().rposition(|m| *m == material) {
            Some(i) => (near + i) as MaterialId,
            None => self.scene.material(material),
        }
    }

    /// A look is painted with a texture or stretched along its tangents, so that it needs texture coordinates; one of parts
    /// may be, where the scene has such.
    fn needs_coordinates(&self, material: &Material) -> bool {
        let parts = matches!(material.surface, Surface::Blend { .. });
        let stretched = |m: &Material| m.surface.is_stretched();
        let any = || !self.scene.textures.is_empty() || self.scene.materials.iter().any(stretched);
        material.textures().next().is_some() || stretched(material) || (parts && any())
    }

    /// Area in the world.
    fn area(&self, body: Body, world: &Transform) -> f64 {
        let pi = std::f64::consts::PI;
        let square = |r: f32| f64::from(r) * f64::from(r);
        match body {
            Body::Shape(Shape::Sphere { radius, .. }) => 4.0 * pi * square(radius),
            Body::Shape(Shape::Disk { radius, .. }) => pi * square(radius),
            Body::Shape(Shape::Cylinder { p, q, radius }) => {
                let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
                2.0 * pi * f64::from(radius) * (wide(p) - wide(q)).length()
            }
            Body::Mesh(id) => {
                let triangles = &self.scene.meshes[id as usize].triangles;
                let at = |i: u32| world.point(DVec3::from(triangles.vertices[i as usize].map(f64::from)));
                let area = |t: &[u32; 3]| {
                    let [a, b, c] = t.map(at);
                    0.5 * (b - a).cross(c - a).length()
                };
                triangles.indices.iter().map(area).sum()
            }
        }
    }

    /// A mesh that is added to the scene.
    fn mesh(&mut self, mesh: Mesh) -> Option<Body> {
        Some(Body::Mesh(self.scene.mesh(mesh)))
    }

    /// `ObjectBegin`: shapes that follow are kept, not drawn.
    pub(super) fn object_begin(&mut self, at: &At) -> Result<(), ReadError> {
        let name = name_of(self, "ObjectBegin")?;
        if self.shapes.defining.is_some() {
            return Err(at.error("ObjectBegin within an object"));
        }
        self.shapes.defining = Some((name, Vec::new()));
        self.keep("ObjectBegin")
    }

    pub(super) fn object_end(&mut self, at: &At) -> Result<(), ReadError> {
        let Some((name, parts)) = self.shapes.defining.take() else {
            return Err(at.error("ObjectEnd without its ObjectBegin"));
        };
        self.shapes.objects.insert(name, parts);
        self.bring_back(at, "ObjectBegin")
    }

    /// Draws an object once more.
    pub(super) fn object_instance(&mut self, at: &At) -> Result<(), ReadError> {
        let name = name_of(self, "ObjectInstance")?;
        if self.shapes.defining.is_some() {
            return Err(at.error("ObjectInstance within an object"));
        }
        let Some(parts) = self.shapes.objects.get(&name) else {
            let what = format!("no object is called {}", show(name.as_bytes()));
            return Err(at.error(what).hint("ObjectBegin must stand before what uses it."));
        };
        self.context.take(parts.len() as u64, 256).map_err(|why| at.error(why))?;
        // The parts lie in our world already: only what the file's transform does to them is new.
        let root = self.context.root;
        let Some(back) = root.inverse() else { return Err(at.error("the transform is singular")) };
        let again = root.after(&self.state.world).after(&back);
        for part in parts.clone() {
            self.scene.place(&part.name, part.mesh, part.material, again.after(&part.world));
        }
        Ok(())
    }
}

/// What people call a file: its name without folder and endings.
fn stem(path: &str) -> String {
    let last = path.rsplit(['/', '\\']).next().unwrap_or(path);
    last.strip_suffix(".gz").unwrap_or(last).rsplit_once('.').map_or(last, |n| n.0).to_string()
}
