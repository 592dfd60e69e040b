//! The planes that a film can sum beside the picture itself, and their names.

/// A set of planes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Planes(u16);

/// Name, bit and channels of each plane, in the order in which they are written.
const NAMED: &[(&str, Planes, usize)] = &[
    ("direct", Planes::DIRECT, 3),
    ("indirect", Planes::INDIRECT, 3),
    ("emission", Planes::EMISSION, 3),
    ("albedo", Planes::ALBEDO, 3),
    ("normal", Planes::NORMAL, 3),
    ("position", Planes::POSITION, 3),
    ("depth", Planes::DEPTH, 1),
    ("visible-fraction", Planes::VISIBLE_FRACTION, 1),
    ("unshadowed-direct", Planes::UNSHADOWED, 3),
    ("sample-count", Planes::SAMPLE_COUNT, 1),
    ("standard-error", Planes::STANDARD_ERROR, 3),
    ("regions", Planes::REGIONS, 1),
];

impl Planes {
    /// No plane.
    pub const NONE: Planes = Planes(0);
    /// The picture itself.
    pub const BEAUTY: Planes = Planes(1);
    /// Light that came straight from a light to what is seen.
    pub const DIRECT: Planes = Planes(1 << 1);
    /// Light that was reflected before.
    pub const INDIRECT: Planes = Planes(1 << 2);
    /// Light that what is seen gives off itself.
    pub const EMISSION: Planes = Planes(1 << 3);
    /// Albedo of what is seen.
    pub const ALBEDO: Planes = Planes(1 << 4);
    /// Shading normal in world space.
    pub const NORMAL: Planes = Planes(1 << 5);
    /// Position in world space.
    pub const POSITION: Planes = Planes(1 << 6);
    /// Distance from the eye.
    pub const DEPTH: Planes = Planes(1 << 7);
    /// Mean visibility over the lights.
    pub const VISIBLE_FRACTION: Planes = Planes(1 << 8);
    /// Direct light as if nothing blocked.
    pub const UNSHADOWED: Planes = Planes(1 << 9);
    /// Samples per pixel.
    pub const SAMPLE_COUNT: Planes = Planes(1 << 10);
    /// Standard error of the picture.
    pub const STANDARD_ERROR: Planes = Planes(1 << 11);
    /// Umbra, penumbra, antumbra, lit: one map a light, not a sum.
    pub const REGIONS: Planes = Planes(1 << 12);
    /// All that can be asked for.
    pub const ALL: Planes = Planes((1 << 13) - 2);
    /// The names of all that can be asked for.
    pub const NAMES: &[&str] = &{
        let mut names = [""; NAMED.len()];
        let mut i = 0;
        while i < NAMED.len() {
            names[i] = NAMED[i].0;
            i += 1;
        }
        names
    };

    /// Both sets.
    pub const fn union(self, other: Planes) -> Planes {
        Planes(self.0 | other.0)
    }

    /// The set but for the planes of `other`.
    pub const fn without(self, other: Planes) -> Planes {
        Planes(self.0 & !other.0)
    }

    /// Any plane of `other` is in.
    #[inline]
    pub const fn has(self, other: Planes) -> bool {
        self.0 & other.0 != 0
    }

    /// Those of the set that hold sums: the number of samples and the error are known without.
    pub const fn summed(self) -> Planes {
        Planes(self.0 & !(Planes::SAMPLE_COUNT.0 | Planes::STANDARD_ERROR.0))
    }

    /// How many planes are in.
    pub fn count(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Which of the sums is `plane`.
    #[inline]
    pub fn index_of(self, plane: Planes) -> Option<usize> {
        self.has(plane).then(|| (self.0 & (plane.0 - 1)).count_ones() as usize)
    }

    /// The plane of this name.
    pub fn by_name(name: &str) -> Option<Planes> {
        NAMED.iter().find(|(n, ..)| *n == name).map(|(_, plane, _)| *plane)
    }

    /// The names in the set.
    pub fn list(self) -> Vec<&'static str> {
        self.named().map(|(n, ..)| n).collect()
    }

    /// Name, plane and channels of each in the set.
    pub fn named(self) -> impl Iterator<Item = (&'static str, Planes, usize)> {
        NAMED.iter().copied().filter(move |(_, plane, _)| self.has(*plane))
    }
}
