//! Where a point lies on its primitive, and where the segments that leave it start.

use antumbra_math::DVec3;
use antumbra_trace::{NO_PRIM, PrimId, Shape, start};

use super::{Body, Placed, Scene, SceneMesh};

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

/// A point of a primitive with its outward unit normal, in f64.
pub(super) struct Place {
    pub(super) p: DVec3,
    pub(super) outward: DVec3,
    corners: Option<[DVec3; 3]>,
    /// Largest number that went into it (LAW §5).
    extent: f64,
}

impl Scene {
    /// Where a hit lies.
    #[inline]
    pub(super) fn place(&self, object: &Placed, local: u32, p: DVec3, uv: [f32; 2]) -> Place {
        match &object.body {
            Body::Shape(shape) => Place::on_shape(shape, p),
            Body::Mesh(mesh) => Place::on_triangle(&self.meshes[*mesh as usize], object, local, uv),
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
    pub(super) fn start(&self, toward: DVec3, prim: PrimId, how: Start) -> ([f32; 3], PrimId) {
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
