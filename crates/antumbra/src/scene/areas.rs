//! Points drawn evenly over all surfaces of a scene.

use antumbra_math::{Frame, Vec3, World, real};
use antumbra_trace::{PrimId, Shape};

use super::place::Place;
use super::{Body, Scene};
use antumbra_math::Rgb;

/// The area of everything, ready to be drawn from.
pub struct SurfaceAreas {
    /// Running area up to and with primitive i.
    running: Vec<f64>,
}

/// A point of a surface.
pub struct SurfacePoint {
    /// Position.
    pub p: World,
    /// Outward unit normal.
    pub n: World,
    /// The primitive it lies on.
    pub prim: PrimId,
    place: Place,
}

impl SurfacePoint {
    /// Where a segment that comes from the side of `w` ends: in front of the surface there.
    pub fn end_toward(&self, w: World) -> [f32; 3] {
        self.place.lifted(if self.n.dot(w) >= 0.0 { 1.0 } else { -1.0 })
    }
}

impl SurfaceAreas {
    /// Measures every primitive.
    pub fn of(scene: &Scene) -> SurfaceAreas {
        let mut running = Vec::with_capacity(scene.world().prim_count() as usize);
        let mut total = 0.0;
        for object in scene.objects.iter() {
            match &object.body {
                Body::Shape(shape) => {
                    total += shape_area(shape);
                    running.push(total);
                }
                Body::Mesh(m) => {
                    let mesh = &scene.meshes[*m as usize];
                    for i in 0..mesh.triangles.indices.len() as u32 {
                        total += Place::on_triangle(mesh, object, i, [0.0; 2]).area();
                        running.push(total);
                    }
                }
            }
        }
        SurfaceAreas { running }
    }

    /// A: the area of all surfaces.
    pub fn total(&self) -> f32 {
        self.running.last().map_or(0.0, |a| *a as f32)
    }

    /// The point that three numbers name; `None` without surfaces.
    pub fn point(&self, scene: &Scene, choice: f32, u: [f32; 2]) -> Option<SurfacePoint> {
        let total = *self.running.last()?;
        let prim =
            self.running.partition_point(|a| *a <= f64::from(choice) * total).min(self.running.len() - 1);
        let prim = prim as PrimId;
        let (object, local) = scene.locate(prim);
        let place = match &object.body {
            Body::Mesh(m) => {
                // Uniform on the triangle: the square folded along its diagonal.
                let [s, t] = if u[0] + u[1] > 1.0 { [1.0 - u[0], 1.0 - u[1]] } else { u };
                Place::on_triangle(&scene.meshes[*m as usize], object, local, [s, t])
            }
            Body::Shape(shape) => Place::on_shape(shape, point_on(shape, u).as_dvec3()),
        };
        Some(SurfacePoint { p: place.p.as_vec3(), n: place.outward.as_vec3(), prim, place })
    }
}

impl Scene {
    /// L_e of a primitive toward −`wi`, on its front or its back.
    pub fn emitted_at(&self, prim: PrimId, wi: World, front: bool) -> Rgb {
        let (object, local) = self.locate(prim);
        let light = self.light_of(object, local);
        light.map_or(Rgb::BLACK, |id| self.lights()[id as usize].emitted(wi, front))
    }
}

fn shape_area(shape: &Shape) -> f64 {
    use std::f64::consts::PI;
    match *shape {
        Shape::Sphere { radius, .. } => 4.0 * PI * f64::from(radius) * f64::from(radius),
        Shape::Disk { radius, .. } => PI * f64::from(radius) * f64::from(radius),
        Shape::Cylinder { p, q, radius } => {
            let length = (Vec3::from(q).as_dvec3() - Vec3::from(p).as_dvec3()).length();
            2.0 * PI * f64::from(radius) * length
        }
    }
}

/// A uniform point on a shape.
fn point_on(shape: &Shape, u: [f32; 2]) -> Vec3 {
    let phi = 2.0 * real::PI * u[1];
    let (sin, cos) = (real::sinf(phi), real::cosf(phi));
    match *shape {
        Shape::Sphere { center, radius } => {
            let z = 1.0 - 2.0 * u[0];
            let r = real::safe_sqrt(1.0 - z * z);
            Vec3::from(center) + Vec3::new(r * cos, r * sin, z) * radius
        }
        Shape::Disk { center, normal, radius } => {
            let frame = Frame::about(Vec3::from(normal).normalize());
            Vec3::from(center) + (frame.s * cos + frame.t * sin) * (radius * u[0].sqrt())
        }
        Shape::Cylinder { p, q, radius } => {
            let (p, q) = (Vec3::from(p), Vec3::from(q));
            let frame = Frame::about((q - p).normalize());
            p + (q - p) * u[0] + (frame.s * cos + frame.t * sin) * radius
        }
    }
}
