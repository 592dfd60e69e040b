//! Eight vectors side by side.

use fearless_simd::{Simd, f32x8, prelude::*};

use crate::layout::WIDTH;

/// Eight points or directions, one a lane.
#[derive(Clone, Copy)]
pub(crate) struct V3<S: Simd> {
    pub x: f32x8<S>,
    pub y: f32x8<S>,
    pub z: f32x8<S>,
}

impl<S: Simd> V3<S> {
    /// The same vector in every lane.
    #[inline(always)]
    pub fn splat(simd: S, v: [f32; 3]) -> V3<S> {
        V3 { x: f32x8::splat(simd, v[0]), y: f32x8::splat(simd, v[1]), z: f32x8::splat(simd, v[2]) }
    }

    /// One vector a lane, by axis.
    #[inline(always)]
    pub fn load(simd: S, v: &[[f32; WIDTH]; 3]) -> V3<S> {
        V3 {
            x: f32x8::load_array_ref(simd, &v[0]),
            y: f32x8::load_array_ref(simd, &v[1]),
            z: f32x8::load_array_ref(simd, &v[2]),
        }
    }

    /// self − b.
    #[inline(always)]
    pub fn minus(self, b: V3<S>) -> V3<S> {
        V3 { x: self.x - b.x, y: self.y - b.y, z: self.z - b.z }
    }

    /// self + b.
    #[inline(always)]
    pub fn plus(self, b: V3<S>) -> V3<S> {
        V3 { x: self.x + b.x, y: self.y + b.y, z: self.z + b.z }
    }

    /// self × b; a difference may be fused (only filters use this).
    #[inline(always)]
    pub fn cross(self, b: V3<S>) -> V3<S> {
        V3 {
            x: self.y.mul_sub(b.z, self.z * b.y),
            y: self.z.mul_sub(b.x, self.x * b.z),
            z: self.x.mul_sub(b.y, self.y * b.x),
        }
    }

    /// self · b; sums may be fused (only filters use this).
    #[inline(always)]
    pub fn dot(self, b: V3<S>) -> f32x8<S> {
        self.x.mul_add(b.x, self.y.mul_add(b.y, self.z * b.z))
    }

    /// By component.
    #[inline(always)]
    pub fn abs(self) -> V3<S> {
        V3 { x: self.x.abs(), y: self.y.abs(), z: self.z.abs() }
    }

    /// The smaller one, by component.
    #[inline(always)]
    pub fn smaller(self, b: V3<S>) -> V3<S> {
        V3 { x: self.x.min(b.x), y: self.y.min(b.y), z: self.z.min(b.z) }
    }

    /// The larger one, by component.
    #[inline(always)]
    pub fn larger(self, b: V3<S>) -> V3<S> {
        V3 { x: self.x.max(b.x), y: self.y.max(b.y), z: self.z.max(b.z) }
    }

    /// The largest component.
    #[inline(always)]
    pub fn largest(self) -> f32x8<S> {
        self.x.max(self.y).max(self.z)
    }
}
