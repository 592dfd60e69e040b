//! Instances with a transform: a tree over their boxes in the world, each leading to a tree in object space.

use antumbra_math::{DVec3, Transform};

use crate::PrimId;
use crate::build::{BuildOptions, Item, Workers, build};
use crate::layout::{Bounds, Tree, above, below};
use crate::traverse::Limits;

/// Origins up to this many times Ms find their instances through the tree; others ask each instance.
const REACH: f64 = 1024.0;

/// An instance with a transform that has an inverse.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Whose object tree.
    pub geometry: usize,
    /// World number of its primitive 0.
    pub base: PrimId,
    /// Its hits are asked back.
    pub masked: bool,
    /// The stored inverse: the law's map (LAW §6).
    pub object_from_world: Transform,
}

/// All of them.
#[derive(Clone, Debug, Default)]
pub(crate) struct PlaceTree {
    pub places: Vec<Place>,
    /// Over world boxes; its leaves hold indices into `places`.
    pub tree: Tree,
    /// Places that no box holds safely (nearly singular maps, enormous numbers): always asked.
    pub wild: Vec<u32>,
    pub limits: Limits,
    /// The box around all in `tree`.
    pub bounds: Bounds,
}

impl PlaceTree {
    /// Over `places`, each with its map to the world and the box of its object.
    pub fn new(
        places: Vec<(Place, Transform, Bounds)>,
        options: &BuildOptions,
        workers: Workers,
    ) -> PlaceTree {
        let images: Vec<Image> = places.iter().map(|(_, map, bounds)| Image::of(map, bounds)).collect();
        let scale = images.iter().map(|image| image.largest()).fold(0.0, f64::max);
        let (mut items, mut wild) = (Vec::new(), Vec::new());
        for (i, ((place, map, _), image)) in (0u32..).zip(places.iter().zip(&images)) {
            match image.padded(map, &place.object_from_world, REACH * scale) {
                Some(b) => items.push(Item::new(i, &b, half_area(&b))),
                None => wild.push(i),
            }
        }
        let tree = build(&mut items, options, workers);
        PlaceTree {
            places: places.into_iter().map(|p| p.0).collect(),
            limits: Limits::of(&tree).within(REACH * scale),
            bounds: tree.bounds,
            tree,
            wild,
        }
    }

    /// Bytes held.
    pub fn bytes(&self) -> usize {
        size_of_val(self.places.as_slice()) + self.tree.bytes() + size_of_val(self.wild.as_slice())
    }
}

fn half_area(b: &Bounds) -> f32 {
    let (x, y, z) = (b.hi[0] - b.lo[0], b.hi[1] - b.lo[1], b.hi[2] - b.lo[2]);
    x * y + y * z + z * x
}

/// The box of the image of a box, in f64.
#[derive(Clone, Copy, Debug)]
struct Image {
    lo: DVec3,
    hi: DVec3,
    /// The largest coordinate of the object, in object space.
    object: f64,
}

impl Image {
    fn of(map: &Transform, b: &Bounds) -> Image {
        // Rule G lets a shape's hit lie 2⁻³² M outside its box; take 2⁻²².
        let grow = b.magnitude() / 4_194_304.0;
        let corner = |axis: usize, high: bool| {
            if high { f64::from(b.hi[axis]) + grow } else { f64::from(b.lo[axis]) - grow }
        };
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for k in 0..8 {
            let p =
                map.point(DVec3::new(corner(0, k & 1 != 0), corner(1, k & 2 != 0), corner(2, k & 4 != 0)));
            (lo, hi) = (lo.min(p), hi.max(p));
        }
        Image { lo, hi, object: b.magnitude() + grow }
    }

    fn largest(&self) -> f64 {
        let m = self.lo.abs().max(self.hi.abs()).max_element();
        if m.is_finite() { m } else { 0.0 }
    }

    /// The world box that holds every point Y = o + t d of a line with |o|∞ ≤ `reach` at which the object is hit, or
    /// `None` where that cannot be said.
    ///
    /// The law's object-space point is X = R Y + s + ε with the stored inverse (R, s) and
    /// |ε| ≤ 16·2⁻⁵³ (|R| (2|o| + |Y|) + |s|): five roundings in the origin, four in the direction (t|d| ≤ |o| + |Y|),
    /// and components below 2⁻²⁰⁰ that became 0. With (M, T) the map itself, M R = 1 + Δ and M s + T = δ:
    /// Y = (M X + T) − Δ Y − δ − M ε. Here y ≥ |Y|∞, and Δ and δ are computed in f64 with their own bounds.
    fn padded(&self, map: &Transform, inverse: &Transform, reach: f64) -> Option<Bounds> {
        const W16: f64 = 16.0 / 9_007_199_254_740_992.0;
        let (m, r) = (map.linear, inverse.linear);
        let norm = |m: antumbra_math::DMat3| (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()).max_element();
        let (nm, nr) = (norm(m), norm(r));
        let (ns, nt) = (inverse.translation.abs().max_element(), map.translation.abs().max_element());
        let turn = norm(m * r - antumbra_math::DMat3::IDENTITY) + W16 * nm * nr;
        let shift = (m * inverse.translation + map.translation).abs().max_element() + W16 * (nm * ns + nt);
        // The image itself is computed with rounding; y as below, solved for with ‖Δ‖ + 16·2⁻⁵³ ‖M‖‖R‖ ≤ 1/4.
        let image = self.largest() + W16 * (nm * self.object + nt);
        let slope = turn + W16 * nm * nr;
        let y = 2.0 * (image + shift + W16 * nm * (2.0 * nr * reach + ns));
        let pad = slope * y + shift + W16 * nm * (2.0 * nr * reach + ns) + W16 * (nm * self.object + nt);
        // 2⁸⁰ keeps flushed components (2⁻²⁰⁰ of a direction of 2⁻⁴⁰ and more) below all of these.
        let tame = slope <= 0.25 && nm <= 1.2e24 && nr <= 1.2e24 && pad.is_finite();
        let (lo, hi) = (self.lo - DVec3::splat(pad), self.hi + DVec3::splat(pad));
        let small = lo.abs().max(hi.abs()).max_element() <= f64::from(f32::MAX) / 4.0;
        (tame && small).then(|| Bounds { lo: lo.to_array().map(below), hi: hi.to_array().map(above) })
    }
}
