//! What looks wrong with the size of a scene: its unit, how far away it lies, a thing lost far outside, lights that are
//! out of proportion to it.

use antumbra_math::{DVec3, Vec3, real};
use antumbra_trace::Shape;

use super::super::{Body, Emits, Placed, Scene};
use super::three_digits;

/// Sizes that files in metres hardly mean [m]: a ring about a grain of sand and a town.
const METRES: [f64; 2] = [1e-3, 1e4];
/// Without the thing that lies far outside, the scene is smaller by this.
const LOST: f64 = 100.0;
/// A scene this many times its size away from the origin has 3 digits left in f32.
const FAR: f64 = 1e4;
/// Irradiance between which a picture shows something without `exposure` [W/m²].
const SHOWN: [f64; 2] = [1e-3, 1e3];

/// Lower and upper corner of what an object fills.
pub(super) type Extent = [DVec3; 2];

impl Scene {
    /// One sentence for each thing about the size that looks wrong; lamps may stand far away. `boxes`: of each object.
    pub(super) fn size_looks_wrong(&self, boxes: &[Option<Extent>], said: &mut Vec<String>) {
        let Some(all) = boxes.iter().flatten().copied().reduce(join) else { return };
        let size = (all[1] - all[0]).max_element();
        if self.source.starts_with("glTF") && size > 0.0 && !(METRES[0]..=METRES[1]).contains(&size) {
            let text = format!("{} m large (glTF is in metres): another unit?", three_digits(size));
            said.push(text);
        }
        let away = ((all[0] + all[1]) / 2.0).abs().max_element();
        if size > 0.0 && away > FAR * size {
            let times = three_digits(away / size);
            said.push(format!(
                "lies {times} times its size away from the origin: its numbers are coarse there"
            ));
        }
        let stands = |i: usize| self.objects[i].emits == Emits::Nothing;
        if let Some((object, times)) = lost(boxes, size).filter(|(i, _)| stands(*i)) {
            let name = self.name_of(object);
            said.push(format!("{name} lies far outside: the rest is {} times smaller", three_digits(times)));
        }
        self.brightness_looks_wrong(said);
    }

    /// The power of all lights, spread over a sphere about the scene, is what a picture would show, to a power of ten.
    fn brightness_looks_wrong(&self, said: &mut Vec<String>) {
        let radius = f64::from(self.radius());
        let power: f64 = self.lights().iter().map(|l| f64::from(l.power(self.radius()))).sum();
        let spread = power / (4.0 * std::f64::consts::PI * radius * radius);
        if power > 0.0 && !(SHOWN[0]..=SHOWN[1]).contains(&spread) {
            let (word, ev) =
                (if spread > 1.0 { "white" } else { "black" }, -(real::log(spread) / real::log(2.0)).round());
            let size = three_digits(spread);
            said.push(format!(
                "its lights give about {size} W/m²: {word} pictures without `exposure` {ev:+}"
            ));
        }
    }

    /// What each object fills in the world.
    pub(super) fn boxes(&self) -> Vec<Option<Extent>> {
        let of_mesh: Vec<_> = self
            .meshes
            .iter()
            .map(|mesh| {
                let used = mesh.triangles.indices.iter().flatten();
                used.map(|v| Vec3::from(mesh.triangles.vertices[*v as usize]).as_dvec3())
                    .map(|p| [p, p])
                    .reduce(join)
            })
            .collect();
        self.objects.iter().map(|object| placed_box(object, &of_mesh)).collect()
    }
}

/// The object without which the scene would be much smaller, and how many times; the world has more than two objects.
fn lost(boxes: &[Option<Extent>], size: f64) -> Option<(usize, f64)> {
    let n = boxes.len();
    let mut after = vec![None; n + 1];
    for i in (0..n).rev() {
        after[i] = both(boxes[i], after[i + 1]);
    }
    let mut before = None;
    for i in 0..n {
        let rest = both(before, after[i + 1]);
        let left = rest.map_or(0.0, |[low, high]: Extent| (high - low).max_element());
        let own = boxes[i].map_or(size, |[low, high]| (high - low).max_element());
        // A large thing around the rest is a ground or a sky.
        if left > 0.0 && size > LOST * left && own < size / 2.0 && n > 2 {
            return Some((i, size / left));
        }
        before = both(before, boxes[i]);
    }
    None
}

fn placed_box(object: &Placed, of_mesh: &[Option<Extent>]) -> Option<Extent> {
    match &object.body {
        Body::Shape(shape) => Some(shape_box(shape)),
        Body::Mesh(m) => {
            let [low, high] = of_mesh[*m as usize]?;
            let Some(transform) = object.transform else { return Some([low, high]) };
            let ends = [low, high];
            (0..8usize)
                .map(|k| DVec3::new(ends[k & 1].x, ends[k >> 1 & 1].y, ends[k >> 2].z))
                .map(|p| transform.point(p))
                .map(|p| [p, p])
                .reduce(join)
        }
    }
}

/// A disk as its sphere, a cylinder with round ends.
fn shape_box(shape: &Shape) -> Extent {
    let (p, q, radius) = match shape {
        Shape::Sphere { center, radius } | Shape::Disk { center, radius, .. } => (center, center, radius),
        Shape::Cylinder { p, q, radius } => (p, q, radius),
    };
    let [p, q] = [p, q].map(|p| Vec3::from(*p).as_dvec3());
    [p.min(q) - f64::from(*radius), p.max(q) + f64::from(*radius)]
}

pub(super) fn join(a: Extent, b: Extent) -> Extent {
    [a[0].min(b[0]), a[1].max(b[1])]
}

fn both(a: Option<Extent>, b: Option<Extent>) -> Option<Extent> {
    match (a, b) {
        (Some(a), Some(b)) => Some(join(a, b)),
        (a, b) => a.or(b),
    }
}
