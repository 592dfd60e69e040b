//! The definition that every kernel must equal: the law asked of every primitive, one after the other.

use antumbra_math::Transform;

use crate::law::{self, Line};
use crate::{Bits, Geometry, Hits, Instance, Passes, PrimId, Segments, Shape, Visibility};

/// Visibility by asking the [`law`] of every primitive of every instance, in builder order.
///
/// An instance whose transform has no inverse, or whose geometry does not exist, blocks nothing.
pub struct Brute<'a> {
    placed: Vec<Placed<'a>>,
    passes: Option<&'a dyn Passes>,
}

struct Placed<'a> {
    geometry: &'a Geometry,
    /// Identity of its primitive 0.
    base: PrimId,
    object_from_world: Option<Transform>,
    masked: bool,
}

impl<'a> Brute<'a> {
    /// Over the same lists as a world; `passes` is asked for hits on masked instances.
    pub fn new(
        geometries: &'a [Geometry],
        instances: &[Instance],
        passes: Option<&'a dyn Passes>,
    ) -> Brute<'a> {
        let mut placed = Vec::with_capacity(instances.len());
        let mut base: PrimId = 0;
        for instance in instances {
            let Some(geometry) = geometries.get(instance.geometry as usize) else { continue };
            let object_from_world = instance.transform.map(|t| t.inverse());
            // `Some(None)`: placed by a map without inverse, flat in the world.
            if object_from_world != Some(None) {
                let object_from_world = object_from_world.flatten();
                placed.push(Placed { geometry, base, object_from_world, masked: instance.masked });
            }
            base += geometry.len() as PrimId;
        }
        Brute { placed, passes }
    }

    /// Calls `found(id, instance, primitive, line)` for what blocks entry i, until it returns false.
    fn each_hit(&self, segments: &Segments<'_>, i: usize, mut found: impl FnMut(Hit<'_>) -> bool) {
        let world_line = Line::of(segments, i);
        for placed in &self.placed {
            let line = placed.object_from_world.as_ref().map_or(world_line, |m| world_line.to_object(m));
            if !line.is_valid() {
                continue;
            }
            for primitive in 0..placed.geometry.len() {
                let prim = placed.base + primitive as PrimId;
                if prim == segments.last[i]
                    || (prim == segments.first[i] && is_flat(placed.geometry, primitive))
                {
                    continue;
                }
                let Some(t) = hit(placed.geometry, primitive, &line) else { continue };
                let hit = Hit { placed, primitive, prim, line: &line, t };
                if !self.goes_through(&hit, segments.number[i]) && !found(hit) {
                    return;
                }
            }
        }
    }

    fn goes_through(&self, hit: &Hit<'_>, number: u32) -> bool {
        hit.placed.masked && self.passes.is_some_and(|p| p.passes(number, hit.prim, hit.uv()))
    }
}

/// A primitive that the law says is hit.
struct Hit<'a> {
    placed: &'a Placed<'a>,
    primitive: usize,
    prim: PrimId,
    line: &'a Line,
    t: f64,
}

impl Hit<'_> {
    fn uv(&self) -> [f32; 2] {
        match self.placed.geometry {
            Geometry::Triangles(mesh) => law::barycentrics(self.line, mesh.corners(self.primitive)),
            Geometry::Shapes(_) => [0.0; 2],
        }
    }
}

fn hit(geometry: &Geometry, primitive: usize, line: &Line) -> Option<f64> {
    match geometry {
        Geometry::Triangles(mesh) => law::triangle(line, mesh.corners(primitive)),
        Geometry::Shapes(shapes) => law::shape(line, &shapes[primitive]),
    }
}

fn is_flat(geometry: &Geometry, primitive: usize) -> bool {
    match geometry {
        Geometry::Triangles(_) => true,
        Geometry::Shapes(shapes) => matches!(shapes[primitive], Shape::Disk { .. }),
    }
}

impl Visibility for Brute<'_> {
    fn occluded(&self, segments: Segments<'_>, out: &mut Bits) {
        out.reset(segments.len());
        for i in 0..segments.len() {
            self.each_hit(&segments, i, |_| {
                out.set(i);
                false
            });
        }
    }

    fn nearest(&self, rays: Segments<'_>, out: &mut Hits) {
        out.reset(rays.len());
        for i in 0..rays.len() {
            self.each_hit(&rays, i, |hit| {
                // Identities grow, so the first of equal t stays.
                if hit.t < out.t[i] {
                    (out.t[i], out.prim[i], out.uv[i]) = (hit.t, hit.prim, hit.uv());
                }
                true
            });
        }
    }
}
