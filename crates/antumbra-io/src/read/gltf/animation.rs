//! Animations at one time: what their channels make of the nodes (glTF 2.0, section 3.11 and appendix C).

use std::collections::BTreeMap;

use antumbra_math::real;

use super::accessor::Accessors;
use super::document::{Animation, Channel, Document, Node};
use super::material::named;
use super::primitive::of;
use crate::error::ReadError;
use crate::read::Counted;

/// What animations set: the numbers by node and property.
pub(super) type Pose = BTreeMap<(usize, Property), Vec<f64>>;

/// A property of a node that a channel may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Property {
    Translation,
    Rotation,
    Scale,
    Weights,
}

impl Property {
    fn of(path: &str) -> Option<Property> {
        match path {
            "translation" => Some(Property::Translation),
            "rotation" => Some(Property::Rotation),
            "scale" => Some(Property::Scale),
            "weights" => Some(Property::Weights),
            _ => None,
        }
    }
}

/// The keys of one channel.
struct Curve {
    times: Vec<f32>,
    values: Vec<f32>,
    /// Numbers of one value.
    width: usize,
    mode: Mode,
}

#[derive(Clone, Copy, PartialEq)]
enum Mode {
    Step,
    Linear,
    /// Linear on the sphere, for rotations.
    Slerp,
    Cubic,
}

/// The end of the last animation [s], as the file announces it.
pub(super) fn end(doc: &Document) -> f64 {
    let inputs = doc.animations.iter().flat_map(|a| &a.samplers).map(|s| s.input);
    let ends = inputs.filter_map(|i| doc.accessors.get(i)?.max.as_ref()?.first().copied());
    ends.fold(0.0, f64::max)
}

/// The names of the animations; their numbers where they have none.
pub(super) fn names(doc: &Document) -> Vec<String> {
    let name = |(i, a): (usize, &Animation)| if a.name.is_empty() { i.to_string() } else { a.name.clone() };
    doc.animations.iter().enumerate().map(name).collect()
}

/// The animation of a name, or all of them.
fn chosen(doc: &Document, wanted: Option<&str>) -> Result<Vec<usize>, ReadError> {
    let Some(wanted) = wanted else { return Ok((0..doc.animations.len()).collect()) };
    let names = names(doc);
    let found = names.iter().position(|n| n == wanted).map(|i| vec![i]);
    found.ok_or_else(|| {
        let what = format!("there is no animation \"{wanted}\"");
        let there = if names.is_empty() { "none".into() } else { names.join(", ") };
        ReadError::new("animations", what).hint(format!("There are: {there}."))
    })
}

/// The animations at a time [s]: the one of a name, or all. One that moves what an earlier one moves is left out with a
/// warning: players show such clips one at a time.
pub(super) fn pose(
    accessors: &Accessors,
    wanted: Option<&str>,
    time: f64,
    said: &mut Counted,
) -> Result<Pose, ReadError> {
    let mut pose = Pose::new();
    for i in chosen(accessors.doc, wanted)? {
        let animation = &accessors.doc.animations[i];
        let mut own = Pose::new();
        for (c, channel) in animation.channels.iter().enumerate() {
            let place = || format!("animation {}, channel {c}", named(i, &animation.name));
            let told = |e: ReadError| {
                let place = [place(), e.place.clone()].join(": ");
                ReadError { place: place.trim_end_matches(": ").into(), ..e }
            };
            let Some(node) = channel.target.node else {
                said.warn(place(), format!("moves {}, not a node: it stands still", channel.target.path));
                continue;
            };
            let Some(property) = Property::of(&channel.target.path) else {
                said.warn(place(), format!("moves \"{}\" of a node: it stands still", channel.target.path));
                continue;
            };
            let target = accessors.doc.nodes.get(node).ok_or_else(|| {
                let n = accessors.doc.nodes.len();
                told(ReadError::new("", format!("node {node} is named; there are {n}")))
            })?;
            if target.matrix.is_some() && property != Property::Weights {
                said.warn(place(), "its node has a matrix, which cannot be moved: it stands still");
                continue;
            }
            let curve = curve(accessors, animation, channel, property, target).map_err(told)?;
            own.entry((node, property)).or_insert(curve.at(time));
        }
        if own.keys().any(|k| pose.contains_key(k)) {
            let text = "moves what an earlier animation moves: left out (--animation NAME shows it alone)";
            said.warn(format!("animation {}", named(i, &animation.name)), text);
        } else {
            pose.extend(own);
        }
    }
    Ok(pose)
}

/// Puts the nodes where the animations want them.
pub(super) fn apply(doc: &mut Document, pose: &Pose) {
    for ((node, property), value) in pose {
        let Some(node) = doc.nodes.get_mut(*node) else { continue };
        let three = || Some([value[0], value[1], value[2]]);
        match property {
            Property::Translation => node.translation = three(),
            Property::Scale => node.scale = three(),
            Property::Rotation => node.rotation = Some([value[0], value[1], value[2], value[3]]),
            Property::Weights => node.weights = Some(value.iter().map(|v| *v as f32).collect()),
        }
    }
}

/// Reads the keys of a channel and checks them.
fn curve(
    accessors: &Accessors,
    animation: &Animation,
    channel: &Channel,
    property: Property,
    node: &Node,
) -> Result<Curve, ReadError> {
    let Some(sampler) = animation.samplers.get(channel.sampler) else {
        let n = animation.samplers.len();
        return Err(ReadError::new("", format!("sampler {} is named; there are {n}", channel.sampler)));
    };
    let times = accessors.floats::<1>(sampler.input, None).map_err(|e| of(e, "input"))?.into_flattened();
    if times.is_empty() || !times.iter().all(|t| t.is_finite()) || times.windows(2).any(|w| w[0] >= w[1]) {
        let what = "its times do not increase from key to key";
        return Err(ReadError::new(format!("accessor {} (input)", sampler.input), what));
    }
    let output = sampler.output;
    let values = match property {
        Property::Weights => accessors.floats::<1>(output, None).map(Vec::into_flattened),
        Property::Rotation => accessors.floats::<4>(output, None).map(Vec::into_flattened),
        _ => accessors.floats::<3>(output, None).map(Vec::into_flattened),
    };
    let values = values.map_err(|e| of(e, "output"))?;
    let width = match property {
        Property::Weights => targets(accessors.doc, node),
        Property::Rotation => 4,
        _ => 3,
    };
    let (mode, each) = match sampler.interpolation.as_deref() {
        Some("STEP") => (Mode::Step, 1),
        Some("CUBICSPLINE") => (Mode::Cubic, 3),
        Some("LINEAR") | None if property == Property::Rotation => (Mode::Slerp, 1),
        Some("LINEAR") | None => (Mode::Linear, 1),
        Some(other) => {
            let what = format!("its interpolation \"{other}\" is unknown (LINEAR, STEP, CUBICSPLINE)");
            return Err(ReadError::new("", what));
        }
    };
    let needed = times.len() * each * width;
    if values.len() != needed {
        let what = format!("has {} numbers; {} keys need {needed}", values.len(), times.len());
        return Err(ReadError::new(format!("accessor {output} (output)"), what));
    }
    Ok(Curve { times, values, width, mode })
}

/// Morph targets of the mesh of a node.
fn targets(doc: &Document, node: &Node) -> usize {
    let mesh = node.mesh.and_then(|m| doc.meshes.get(m));
    mesh.and_then(|m| m.primitives.first()).map_or(0, |p| p.targets.len())
}

impl Curve {
    /// The value at a time [s]; before the first key that of the first, after the last that of the last.
    fn at(&self, time: f64) -> Vec<f64> {
        let last = self.times.len() - 1;
        // Keys are numbers of single precision: a time of such a key hits it.
        let after = self.times.partition_point(|t| *t <= time as f32);
        let value = |key: usize| self.numbers(key, usize::from(self.mode == Mode::Cubic));
        if after == 0 {
            return value(0);
        }
        let (a, b) = (after - 1, after.min(last));
        if a == last || self.mode == Mode::Step {
            return value(a);
        }
        let (from, to) = (f64::from(self.times[a]), f64::from(self.times[b]));
        let span = to - from;
        let s = ((time - from) / span).clamp(0.0, 1.0);
        match self.mode {
            Mode::Slerp => slerp(&value(a), &value(b), s),
            Mode::Cubic => {
                // Hermite's cubic through both values, with the tangent out of the one and into the other.
                let (leaving, coming) = (self.numbers(a, 2), self.numbers(b, 0));
                let (s2, s3) = (s * s, s * s * s);
                let (p, q) = (2.0 * s3 - 3.0 * s2 + 1.0, 3.0 * s2 - 2.0 * s3);
                let (m, n) = (span * (s3 - 2.0 * s2 + s), span * (s3 - s2));
                let (a, b) = (value(a), value(b));
                (0..self.width).map(|i| p * a[i] + m * leaving[i] + q * b[i] + n * coming[i]).collect()
            }
            _ => value(a).iter().zip(value(b)).map(|(a, b)| a + (b - a) * s).collect(),
        }
    }

    /// Numbers of a key: of its value, or of a cubic's in-tangent (0), value (1), out-tangent (2).
    fn numbers(&self, key: usize, part: usize) -> Vec<f64> {
        let each = if self.mode == Mode::Cubic { 3 } else { 1 };
        let begin = (key * each + part) * self.width;
        self.values[begin..begin + self.width].iter().map(|v| f64::from(*v)).collect()
    }
}

/// From one rotation to the other the shorter way round, at an even pace.
fn slerp(a: &[f64], b: &[f64], s: f64) -> Vec<f64> {
    let dot: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
    let near = if dot < 0.0 { -1.0 } else { 1.0 };
    let angle = real::acos((dot * near).min(1.0));
    let sine = real::sin(angle);
    // Rotations that are nearly the same lie on a straight line; `trs` brings the length back to 1.
    let (p, q) = if sine < 1e-6 {
        (1.0 - s, s)
    } else {
        (real::sin((1.0 - s) * angle) / sine, real::sin(s * angle) / sine)
    };
    a.iter().zip(b).map(|(a, b)| p * a + q * near * b).collect()
}
