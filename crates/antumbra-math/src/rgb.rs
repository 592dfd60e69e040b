//! Linear colour, Rec. 709 primaries: radiance, throughput, reflectance.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Sub};

/// Three linear components (red, green, blue).
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C)]
pub struct Rgb(pub [f32; 3]);

impl Rgb {
    /// No light.
    pub const BLACK: Rgb = Rgb([0.0; 3]);
    /// One in each component.
    pub const WHITE: Rgb = Rgb([1.0; 3]);

    /// A colour of its three components.
    #[inline]
    pub const fn new(r: f32, g: f32, b: f32) -> Rgb {
        Rgb([r, g, b])
    }

    /// The same value in each component.
    #[inline]
    pub const fn grey(v: f32) -> Rgb {
        Rgb([v; 3])
    }

    /// Luminance Y of Rec. 709 primaries.
    #[inline]
    pub fn luminance(self) -> f32 {
        0.2126 * self.0[0] + 0.7152 * self.0[1] + 0.0722 * self.0[2]
    }

    /// Largest component.
    #[inline]
    pub fn max(self) -> f32 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }

    /// Mean of the components.
    #[inline]
    pub fn mean(self) -> f32 {
        (self.0[0] + self.0[1] + self.0[2]) * (1.0 / 3.0)
    }

    /// No component carries light.
    #[inline]
    pub fn is_black(self) -> bool {
        self.0 == [0.0; 3]
    }

    /// All components are finite.
    #[inline]
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }

    /// Each component through `f`.
    #[inline]
    pub fn map(self, f: impl Fn(f32) -> f32) -> Rgb {
        Rgb(self.0.map(f))
    }

    /// (1−t)·self + t·other.
    #[inline]
    pub fn lerp(self, other: Rgb, t: f32) -> Rgb {
        self * (1.0 - t) + other * t
    }
}

macro_rules! componentwise {
    ($($trait:ident $method:ident $op:tt),*) => {$(
        impl $trait for Rgb {
            type Output = Rgb;
            #[inline]
            fn $method(self, o: Rgb) -> Rgb {
                Rgb([self.0[0] $op o.0[0], self.0[1] $op o.0[1], self.0[2] $op o.0[2]])
            }
        }
    )*};
}
componentwise!(Add add +, Sub sub -, Mul mul *);

impl Mul<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn mul(self, s: f32) -> Rgb {
        Rgb([self.0[0] * s, self.0[1] * s, self.0[2] * s])
    }
}

impl Div<f32> for Rgb {
    type Output = Rgb;
    #[inline]
    fn div(self, s: f32) -> Rgb {
        self * (1.0 / s)
    }
}

impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, o: Rgb) {
        *self = *self + o;
    }
}

impl MulAssign for Rgb {
    #[inline]
    fn mul_assign(&mut self, o: Rgb) {
        *self = *self * o;
    }
}

impl std::iter::Sum for Rgb {
    fn sum<I: Iterator<Item = Rgb>>(iter: I) -> Rgb {
        iter.fold(Rgb::BLACK, Add::add)
    }
}
