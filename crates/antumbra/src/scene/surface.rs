//! What a ray met: the point, its normals, its reflection and its emission there.

use antumbra_math::{Rgb, Vec3, World, hash};
use antumbra_trace::PrimId;

use super::shading::Seen;
use super::{Scene, Start};
use crate::light::LightId;
use crate::receiver::Receiver;

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

/// For whom a ray looks: what the receiver that it makes takes over.
#[derive(Clone, Copy, Debug)]
pub struct Errand {
    /// See [`Receiver::cell`].
    pub cell: u32,
    /// See [`Receiver::stream`].
    pub stream: u32,
    /// See [`Receiver::index`].
    pub index: u32,
    /// See [`Receiver::throughput`].
    pub throughput: Rgb,
    /// See [`Receiver::bounce`].
    pub bounce: u32,
}

impl Default for Errand {
    /// The first number of a pixel without a name.
    fn default() -> Errand {
        Errand { cell: 0, stream: 0, index: 0, throughput: Rgb::WHITE, bounce: 0 }
    }
}

/// A surface that a ray met.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// The point, ready to ask for light.
    pub receiver: Receiver,
    /// L_e toward where the ray came from, and the light it belongs to.
    pub emitted: Option<(LightId, Rgb)>,
    /// The colour of an unlit surface: radiance for the sensor alone.
    pub shown: Rgb,
}

impl Scene {
    /// The surface where `ray` met it, for nobody in particular.
    pub fn meet(&self, ray: &Ray, look: &Look) -> Met {
        self.meet_for(Errand::default(), ray, look)
    }

    /// The surface where `ray` met it.
    pub fn meet_for(&self, errand: Errand, ray: &Ray, look: &Look) -> Met {
        let Errand { cell, stream, index, throughput, bounce } = errand;
        let Ray { o, d, t, prim, uv, number } = *ray;
        let (object, local) = self.locate(prim);
        let place = self.place(object, local, o.as_dvec3() + d.as_dvec3() * t, uv);
        let front = place.outward.dot(d.as_dvec3()) < 0.0;
        let material = self.material_at((object, local, uv), front, hash::hash2(number, prim));
        let toward = if front { place.outward } else { -place.outward };
        let (start, first) = place.start(toward, prim, look.start);
        let wo = -d.normalize();
        let (normal, bump) =
            if look.clay.is_none() { (material.normal, material.bump) } else { (None, None) };
        let ng = toward.as_vec3();
        let frame = self.shading_frame(object, local, uv, &Seen { ng, front, wo, normal, bump });
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
            cell,
            stream,
            index,
            throughput,
            bounce,
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
}
