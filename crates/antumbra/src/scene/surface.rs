//! What a ray met: the point, its normals, its reflection and its emission there.

use antumbra_math::{DVec3, Frame, Rgb, Vec3, World, hash};
use antumbra_trace::{NO_PRIM, PrimId, Shape, start};

use super::{Body, Material, NormalMap, Placed, Scene, SceneMesh, Surface, Tangents, TextureId};
use crate::bsdf::{Bsdf, Diffuse, MetallicRoughness, Mirror, Plastic, RoughPlastic};
use crate::light::LightId;
use crate::receiver::Receiver;

/// Tells the numbers of blends in blends apart.
const BLENDED: u32 = 0x2c1b_3c6d;

/// An object, which of its triangles, and where on it.
type At<'a> = (&'a Placed, u32, [f32; 2]);

/// Where segments start. `Safe` is right; the others show why.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Start {
    /// LAW §5: provably above the surface.
    #[default]
    Safe,
    /// At the rounded position itself.
    None,
    /// A fixed distance above it.
    Epsilon(f32),
}

/// How a render looks at the scene.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Look {
    /// Every surface two-sided diffuse of this reflectance.
    pub clay: Option<f32>,
    /// Where segments start.
    pub start: Start,
}

/// A ray and where it met a primitive.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub o: Vec3,
    /// Where it goes, of any length.
    pub d: Vec3,
    /// Where it met the primitive, in lengths of `d`.
    pub t: f64,
    /// The primitive.
    pub prim: PrimId,
    /// Weights of its second and third corner.
    pub uv: [f32; 2],
    /// The number of the ray, which draws among blended materials.
    pub number: u32,
}

/// A surface that a ray met.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// The point, ready to ask for light (cell, stream, throughput are the caller's).
    pub receiver: Receiver,
    /// L_e toward where the ray came from, and the light it belongs to.
    pub emitted: Option<(LightId, Rgb)>,
    /// The colour of an unlit surface: radiance for the sensor alone.
    pub shown: Rgb,
}

/// A point of a primitive with its outward unit normal, in f64.
pub(super) struct Place {
    pub(super) p: DVec3,
    pub(super) outward: DVec3,
    corners: Option<[DVec3; 3]>,
    /// Largest number that went into it (LAW §5).
    extent: f64,
}

impl Scene {
    /// The surface where `ray` met it.
    pub fn meet(&self, ray: &Ray, look: &Look) -> Met {
        let Ray { o, d, t, prim, uv, number } = *ray;
        let (object, local) = self.locate(prim);
        let place = self.place(object, local, o.as_dvec3() + d.as_dvec3() * t, uv);
        let front = place.outward.dot(d.as_dvec3()) < 0.0;
        let material = self.material_at((object, local, uv), front, hash::hash2(number, prim));
        let toward = if front { place.outward } else { -place.outward };
        let (start, first) = place.start(toward, prim, look.start);
        let wo = -d.normalize();
        let normal = material.normal.filter(|_| look.clay.is_none());
        let ng = toward.as_vec3();
        let frame = self.shading_frame(object, local, uv, &Seen { ng, front, wo, normal });
        let bsdf = self.bsdf(material, (object, local, uv), front, look);
        let beyond = match bsdf.index_below() {
            None => start,
            Some(_) => place.start(-toward, prim, look.start).0,
        };
        let receiver = Receiver {
            p: place.p.as_vec3(),
            start,
            beyond,
            prim: first,
            ng,
            wo: frame.to_local(wo),
            frame,
            bsdf,
            cell: 0,
            stream: 0,
            index: 0,
            throughput: Rgb::WHITE,
            bounce: 0,
        };
        let emitted = self.light_of(object, local).and_then(|light| self.light_toward(light, wo, front));
        Met { receiver, emitted, shown: self.shown(material, (object, local, uv), look) }
    }

    /// L_e of the surface toward the ray that met it, and the light it belongs to: as [`Scene::meet`] says.
    #[inline]
    pub fn emitted(&self, ray: &Ray) -> Option<(LightId, Rgb)> {
        let Ray { o, d, t, prim, uv, .. } = *ray;
        let (object, local) = self.locate(prim);
        let light = self.light_of(object, local)?;
        let place = self.place(object, local, o.as_dvec3() + d.as_dvec3() * t, uv);
        let front = place.outward.dot(d.as_dvec3()) < 0.0;
        self.light_toward(light, -d.normalize(), front)
    }

    /// L_e of a light's surface toward ω_o, unless it is black.
    #[inline]
    fn light_toward(&self, light: LightId, wo: World, front: bool) -> Option<(LightId, Rgb)> {
        let radiance = self.lights()[light as usize].emitted(-wo, front);
        (!radiance.is_black()).then_some((light, radiance))
    }

    fn place(&self, object: &Placed, local: u32, p: DVec3, uv: [f32; 2]) -> Place {
        match &object.body {
            Body::Shape(shape) => Place::on_shape(shape, p),
            Body::Mesh(mesh) => Place::on_triangle(&self.meshes[*mesh as usize], object, local, uv),
        }
    }

    /// The frame about the interpolated normal, bent by the normal map, on the viewer's side of both surface and normal.
    fn shading_frame(&self, object: &Placed, local: u32, uv: [f32; 2], seen: &Seen) -> Frame {
        let Seen { ng, front, wo, normal } = *seen;
        let Body::Mesh(mesh) = object.body else { return Frame::about(ng) };
        let mesh = &self.meshes[mesh as usize];
        let outside = if front { ng } else { -ng };
        let n = match &mesh.normals {
            Some(normals) => interpolated_normal(mesh, normals, object, local, uv),
            None if mesh.tangents.is_some() => outside,
            None => return Frame::about(ng),
        };
        let Some(tangents) = &mesh.tangents else { return visible_frame(if front { n } else { -n }, ng, wo) };
        let [t, b] = tangent_plane(mesh, tangents, object, local, uv, n);
        let bent = normal.map(|map| {
            let texture = &self.textures[map.texture as usize];
            let [x, y, z, _] = texture.at(mesh.uv_at(texture.uv_set, local, uv)).map(|c| 2.0 * c - 1.0);
            (t * (map.scale * x) + b * (map.scale * y) + n * z).normalize_or_zero()
        });
        let n = bent.filter(|bent| *bent != Vec3::ZERO).unwrap_or(n);
        let n = facing(if front { n } else { -n }, wo);
        visible_frame(n, ng, wo).turned_to(t)
    }

    /// The reflection of a surface with its textures looked up.
    fn bsdf(&self, material: &Material, at: At<'_>, front: bool, look: &Look) -> Bsdf {
        if let Some(rho) = look.clay {
            return Bsdf::Diffuse(Diffuse { albedo: Rgb::grey(rho) });
        }
        if material.one_sided && !front {
            return Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK });
        }
        let metal_rough = || self.texel(at, material.metallic_roughness).unwrap_or([1.0; 4]);
        reflection(&material.surface, front, |c| self.tinted(c, material, at), metal_rough)
    }

    /// The look of an object's side at a point: of a blend, the one that `number` draws.
    fn material_at(&self, at: At<'_>, front: bool, number: u32) -> &Material {
        let side = |id: u32| match self.materials[id as usize].back {
            Some(back) if !front => &self.materials[back as usize],
            _ => &self.materials[id as usize],
        };
        let mut material = side(at.0.material);
        // Not the number that alpha took.
        let mut number = hash::hash2(number, BLENDED);
        while let Surface::Blend { first, second, weight } = material.surface {
            let [red, ..] = self.texel(at, material.blend).unwrap_or([1.0; 4]);
            let second_wins = hash::unit_f32(number) < weight * red;
            material = side(if second_wins { second } else { first });
            number = hash::hash2(number, BLENDED);
        }
        material
    }

    /// A texture at a point of a mesh.
    fn texel(&self, (object, local, uv): At<'_>, id: Option<TextureId>) -> Option<[f32; 4]> {
        let Body::Mesh(mesh) = object.body else { return None };
        let texture = &self.textures[id? as usize];
        Some(texture.at(self.meshes[mesh as usize].uv_at(texture.uv_set, local, uv)))
    }

    /// A colour times the material's texture and the vertex colours.
    fn tinted(&self, c: Rgb, material: &Material, at: At<'_>) -> Rgb {
        let (object, local, uv) = at;
        let white = |c: Option<[f32; 4]>| c.map_or(Rgb::WHITE, |c| Rgb([c[0], c[1], c[2]]));
        let vertex = match object.body {
            Body::Mesh(m) => self.meshes[m as usize].color_at(local, uv),
            Body::Shape(_) => None,
        };
        c * white(self.texel(at, material.color)) * white(vertex)
    }

    /// What an unlit surface shows to the sensor.
    fn shown(&self, material: &Material, at: At<'_>, look: &Look) -> Rgb {
        match material.surface {
            Surface::Unlit { color } if look.clay.is_none() => self.tinted(color, material, at),
            _ => Rgb::BLACK,
        }
    }
}

/// How a surface is seen.
struct Seen {
    ng: Vec3,
    front: bool,
    wo: World,
    /// What bends the normal.
    normal: Option<NormalMap>,
}

/// Normals stand at the corners in world space, of length 1, before they are interpolated: copies and instances of a
/// stretched mesh look the same.
fn interpolated_normal(
    mesh: &SceneMesh,
    normals: &[[f32; 3]],
    object: &Placed,
    local: u32,
    uv: [f32; 2],
) -> Vec3 {
    let n = match &object.transform {
        None => DVec3::from(mesh.interpolate(normals, local, uv).map(f64::from)),
        Some(t) => {
            let corner = |v: u32| t.normal(DVec3::from(normals[v as usize].map(f64::from)));
            let [a, b, c] = mesh.triangles.indices[local as usize].map(|v| corner(v).normalize_or_zero());
            let [u, v] = uv.map(f64::from);
            a * (1.0 - u - v) + b * u + c * v
        }
    };
    n.normalize_or_zero().as_vec3()
}

/// Tangent and bitangent at a point, in world space; about of length 1.
fn tangent_plane(
    mesh: &SceneMesh,
    tangents: &Tangents,
    object: &Placed,
    local: u32,
    uv: [f32; 2],
    n: Vec3,
) -> [Vec3; 2] {
    let corners = tangents.corners(&mesh.triangles.indices, local);
    let [x, y, z, w] = std::array::from_fn(|k| {
        corners[0][k] * (1.0 - uv[0] - uv[1]) + corners[1][k] * uv[0] + corners[2][k] * uv[1]
    });
    let t = match &object.transform {
        None => Vec3::new(x, y, z),
        Some(place) => place.vector(DVec3::new(x.into(), y.into(), z.into())).normalize_or_zero().as_vec3(),
    };
    let turned = object.transform.is_some_and(|place| place.mirrors());
    [t, n.cross(t) * if turned { -w } else { w }]
}

/// The nearest normal to `n` that does not turn away from the viewer: what a bent normal shows is seen at a grazing angle.
fn facing(n: Vec3, wo: World) -> Vec3 {
    /// The least cosine between a bent normal and the viewer.
    const LEAST: f32 = 0.01;
    let cos = n.dot(wo);
    if cos >= LEAST { n } else { (n + wo * (LEAST - cos)).normalize_or_zero() }
}

/// The frame about `n`. A normal that turns away from the viewer or from its own face cannot bend the BSDF: then about
/// the face's.
fn visible_frame(n: Vec3, ng: Vec3, wo: World) -> Frame {
    if n.dot(ng) > 0.0 && n.dot(wo) > 0.0 { Frame::about(n) } else { Frame::about(ng) }
}

/// The BSDF of a surface on its front or back; `tint` multiplies a colour by the texture's, `metal_rough` is the texel of
/// metallic (blue) and roughness (green).
fn reflection(
    surface: &Surface,
    front: bool,
    tint: impl Fn(Rgb) -> Rgb,
    metal_rough: impl Fn() -> [f32; 4],
) -> Bsdf {
    match *surface {
        Surface::Diffuse { albedo } => Bsdf::Diffuse(Diffuse { albedo: tint(albedo) }),
        Surface::Mirror { reflectance } => Bsdf::Mirror(Mirror { reflectance: tint(reflectance) }),
        // An unlit one's colour is shown by `shown`; of a blend, `material_at` has drawn one.
        Surface::Unlit { .. } | Surface::Blend { .. } => Bsdf::Diffuse(Diffuse { albedo: Rgb::BLACK }),
        Surface::MetallicRoughness { base, metallic, roughness, f0 } => {
            let [_, green, blue, _] = metal_rough();
            let (metallic, roughness) = (metallic * blue, roughness * green);
            Bsdf::MetallicRoughness(MetallicRoughness::of_index(tint(base), metallic, roughness, f0))
        }
        Surface::Conductor(mut c) => {
            c.reflectance = tint(c.reflectance);
            Bsdf::Conductor(c)
        }
        Surface::RoughConductor(mut c) => {
            c.reflectance = tint(c.reflectance);
            Bsdf::RoughConductor(c)
        }
        Surface::Dielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::Dielectric(if front { d } else { d.turned() })
        }
        Surface::ThinDielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::ThinDielectric(d)
        }
        Surface::Plastic { albedo, coat } => Bsdf::Plastic(Plastic::new(coat, tint(albedo))),
        Surface::RoughPlastic { albedo, coat } => Bsdf::RoughPlastic(RoughPlastic::new(coat, tint(albedo))),
        Surface::RoughDielectric(mut d) => {
            d.transmittance = tint(d.transmittance);
            Bsdf::RoughDielectric(if front { d } else { d.turned() })
        }
    }
}

impl Place {
    /// p by barycentrics in f64, the geometric normal from the corners in world space.
    pub(super) fn on_triangle(mesh: &SceneMesh, object: &Placed, local: u32, uv: [f32; 2]) -> Place {
        let own = mesh.triangles.corners(local as usize).map(|c| DVec3::from(c.map(f64::from)));
        let n = (own[1] - own[0]).cross(own[2] - own[0]);
        let (corners, n, extent) = match &object.transform {
            None => (own, n, 0.0),
            Some(t) => {
                let largest = own.iter().fold(0.0, |m: f64, c| m.max(c.abs().max_element()));
                let rows = t.linear.transpose();
                let norm = rows.x_axis.abs().element_sum().max(rows.y_axis.abs().element_sum());
                let norm = norm.max(rows.z_axis.abs().element_sum());
                (
                    own.map(|c| t.point(c)),
                    t.normal(n),
                    (norm * largest).max(t.translation.abs().max_element()),
                )
            }
        };
        let [u, v] = uv.map(f64::from);
        let p = corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v;
        Place { p, outward: n.normalize_or_zero(), corners: Some(corners), extent }
    }

    /// The hit point drawn back onto the surface.
    pub(super) fn on_shape(shape: &Shape, p: DVec3) -> Place {
        let dvec = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        match *shape {
            Shape::Sphere { center, radius } => {
                let (c, r) = (dvec(center), f64::from(radius));
                let outward = (p - c).normalize_or_zero();
                Place { p: c + outward * r, outward, corners: None, extent: c.abs().max_element() + r }
            }
            Shape::Disk { center, normal, radius } => {
                let (c, n) = (dvec(center), dvec(normal).normalize_or_zero());
                let p = p - n * (p - c).dot(n);
                Place { p, outward: n, corners: None, extent: c.abs().max_element() + f64::from(radius) }
            }
            Shape::Cylinder { p: from, q: to, radius } => {
                let (from, to, r) = (dvec(from), dvec(to), f64::from(radius));
                let axis = (to - from).normalize_or_zero();
                let on_axis = from + axis * (p - from).dot(axis);
                let outward = (p - on_axis).normalize_or_zero();
                let extent = from.abs().max_element().max(to.abs().max_element()) + r;
                Place { p: on_axis + outward * r, outward, corners: None, extent }
            }
        }
    }

    /// Area of the triangle; 0 for shapes.
    pub(super) fn area(&self) -> f64 {
        self.corners.map_or(0.0, |[a, b, c]| 0.5 * (b - a).cross(c - a).length())
    }

    /// The safe start (or end) on the outward (+1) or inward (−1) side.
    pub(super) fn lifted(&self, side: f64) -> [f32; 3] {
        self.start(self.outward * side, NO_PRIM, Start::Safe).0
    }

    /// Where segments start on the side of `toward`, and the primitive that they are known to leave.
    fn start(&self, toward: DVec3, prim: PrimId, how: Start) -> ([f32; 3], PrimId) {
        match (how, &self.corners) {
            (Start::Safe, Some(corners)) => {
                let corners = corners.map(|c| c.to_array());
                let p = self.p.to_array();
                (start::start_on_placed_triangle(p, toward.to_array(), corners, self.extent), prim)
            }
            (Start::Safe, None) => {
                (start::start_on_shape(self.p.to_array(), toward.to_array(), self.extent), prim)
            }
            (Start::None, _) => (self.p.as_vec3().to_array(), NO_PRIM),
            (Start::Epsilon(e), _) => ((self.p + toward * f64::from(e)).as_vec3().to_array(), NO_PRIM),
        }
    }
}
