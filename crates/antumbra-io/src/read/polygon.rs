//! Polygons → triangles: a fan where the polygon is convex, ear clipping where it is not.
//!
//! After D. Eberly, "Triangulation by Ear Clipping" (2002). Every polygon of n corners gives n − 2 triangles, however
//! degenerate it is, less those with a repeated vertex.

/// Tests of a point against a triangle that all polygons of a file may spend together, beyond a few for each corner.
const TESTS: u64 = 100_000_000;
const TESTS_PER_CORNER: u64 = 64;

/// Triangulates polygons; keeps its memory between them.
pub(super) struct Triangulator {
    xy: Vec<[f64; 2]>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// Corners that may block, with their places, so that most are passed over without a look elsewhere.
    reflex: Vec<(u32, [f64; 2])>,
    tests: u64,
}

impl Triangulator {
    pub(super) fn new() -> Triangulator {
        let none = Vec::new;
        Triangulator { xy: Vec::new(), next: none(), previous: none(), reflex: Vec::new(), tests: TESTS }
    }

    /// Polygons became so intricate that the rest of one was cut as a fan.
    pub(super) fn gave_up(&self) -> bool {
        self.tests == 0
    }

    /// Gives each triangle of the polygon with corners `at(0) … at(n − 1)` as three of 0 … n − 1, turning as it turns.
    pub(super) fn cut(&mut self, n: usize, at: impl Fn(usize) -> [f32; 3], mut out: impl FnMut([usize; 3])) {
        if n == 3 {
            out([0, 1, 2]);
        } else if n > 3 {
            let fan = !self.flatten(n, at) || self.is_convex(n);
            if fan {
                (1..n - 1).for_each(|i| out([0, i, i + 1]));
            } else {
                self.clip(n, out);
            }
        }
    }

    /// Projects the polygon along the largest component of its normal, counter-clockwise; `false` if it has none.
    fn flatten(&mut self, n: usize, at: impl Fn(usize) -> [f32; 3]) -> bool {
        let normal = newell(n, &at);
        let size = normal.map(f64::abs);
        let largest = size[0].max(size[1]).max(size[2]);
        if largest.is_nan() || largest == 0.0 {
            return false;
        }
        let axis = if size[2] == largest { 2 } else { usize::from(size[1] == largest) };
        let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
        if normal[axis] < 0.0 {
            std::mem::swap(&mut u, &mut v);
        }
        self.xy.clear();
        self.xy.extend((0..n).map(at).map(|p| [f64::from(p[u]), f64::from(p[v])]));
        true
    }

    fn is_convex(&self, n: usize) -> bool {
        (0..n).all(|i| self.turn((i + n - 1) % n, i, (i + 1) % n) > 0.0)
    }

    /// Twice the area of a triangle, positive if it turns counter-clockwise.
    fn turn(&self, a: usize, b: usize, c: usize) -> f64 {
        let ([ax, ay], [bx, by], [cx, cy]) = (self.xy[a], self.xy[b], self.xy[c]);
        (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
    }

    fn clip(&mut self, n: usize, mut out: impl FnMut([usize; 3])) {
        self.next.clear();
        self.next.extend((1..n as u32).chain([0]));
        self.previous.clear();
        self.previous.extend([n as u32 - 1].into_iter().chain(0..n as u32 - 1));
        self.reflex.clear();
        for i in 0..n {
            if self.turn((i + n - 1) % n, i, (i + 1) % n) <= 0.0 {
                self.reflex.push((i as u32, self.xy[i]));
            }
        }
        let mut free = n as u64 * TESTS_PER_CORNER;
        let (mut left, mut at, mut failed) = (n, 0, 0);
        while left > 2 {
            let (before, after) = (self.previous[at] as usize, self.next[at] as usize);
            // After a whole round without an ear (crossing edges) any corner that turns the right way is cut, after
            // two rounds any corner.
            let turns = self.turn(before, at, after) > 0.0;
            let ear = !self.spend(&mut free)
                || failed >= 2 * left
                || turns && (failed >= left || self.is_empty(before, at, after, &mut free));
            if !ear {
                failed += 1;
                at = after;
                continue;
            }
            out([before, at, after]);
            self.next[before] = after as u32;
            self.previous[after] = before as u32;
            self.next[at] = u32::MAX;
            (left, failed) = (left - 1, 0);
            // Going on behind the next corner gives rounder triangles than cutting there again.
            at = self.next[after] as usize;
        }
    }

    /// Takes one test from the polygon's own, else from those of all polygons; `false` if none is left.
    fn spend(&mut self, free: &mut u64) -> bool {
        let purse = if *free > 0 { free } else { &mut self.tests };
        let left = *purse > 0;
        *purse = purse.saturating_sub(1);
        left
    }

    /// No other corner lies in the triangle. Corners at the same place as one of the three do not count: polygons with
    /// holes pass their bridges twice.
    fn is_empty(&mut self, a: usize, b: usize, c: usize, free: &mut u64) -> bool {
        let corners = [self.xy[a], self.xy[b], self.xy[c]];
        let low = |k: usize| corners[0][k].min(corners[1][k]).min(corners[2][k]);
        let high = |k: usize| corners[0][k].max(corners[1][k]).max(corners[2][k]);
        let (x, y) = (low(0)..=high(0), low(1)..=high(1));
        let mut i = 0;
        while i < self.reflex.len() {
            if !self.spend(free) {
                return true;
            }
            let (p, at) = (self.reflex[i].0 as usize, self.reflex[i].1);
            if !x.contains(&at[0]) || !y.contains(&at[1]) || corners.contains(&at) {
                i += 1;
                continue;
            }
            if self.next[p] == u32::MAX {
                self.reflex.swap_remove(i);
                continue;
            }
            i += 1;
            // Corners that became convex when their neighbours were cut block nothing any more.
            let is_reflex = self.turn(self.previous[p] as usize, p, self.next[p] as usize) <= 0.0;
            if is_reflex
                && self.turn(a, b, p) >= 0.0
                && self.turn(b, c, p) >= 0.0
                && self.turn(c, a, p) >= 0.0
            {
                return false;
            }
        }
        true
    }
}

/// Twice the vector area of a polygon (Newell's sum), in f64.
pub(super) fn newell(n: usize, at: impl Fn(usize) -> [f32; 3]) -> [f64; 3] {
    let wide = |i: usize| at(i).map(f64::from);
    let first = wide(0);
    let edge = |p: [f64; 3]| [p[0] - first[0], p[1] - first[1], p[2] - first[2]];
    let mut sum = [0.0; 3];
    let mut a = edge(wide(1));
    for i in 2..n {
        let b = edge(wide(i));
        let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        sum.iter_mut().zip(cross).for_each(|(s, c)| *s += c);
        a = b;
    }
    sum
}

#[cfg(test)]
mod tests {
    use antumbra_math::hash::{hash2, unit_f32};
    use antumbra_math::real;

    use super::*;

    fn area(p: &[[f32; 3]], t: [usize; 3]) -> f64 {
        newell(3, |i| p[t[i]])[2] / 2.0
    }

    /// The triangles cover the polygon once: all turn one way, and their areas add up to its area.
    fn covers(p: &[[f32; 3]]) {
        let mut triangles = Vec::new();
        Triangulator::new().cut(p.len(), |i| p[i], |t| triangles.push(t));
        assert_eq!(triangles.len(), p.len() - 2);
        let whole = newell(p.len(), |i| p[i])[2] / 2.0;
        let parts: f64 = triangles.iter().map(|t| area(p, *t)).sum();
        let sizes: f64 = triangles.iter().map(|t| area(p, *t).abs()).sum();
        // The areas are sums of n products of f32 in f64: n roundings of their size.
        let tolerance = whole.abs() * 1e-12 * p.len() as f64;
        assert!(
            (parts - whole).abs() <= tolerance && (sizes - whole.abs()).abs() <= tolerance,
            "{whole} {sizes}"
        );
    }

    fn star(n: u32, radius: impl Fn(u32) -> f32, turn: f32) -> Vec<[f32; 3]> {
        let corner = |i: u32| {
            let angle = turn * 2.0 * real::PI * i as f32 / n as f32;
            [radius(i) * real::cosf(angle), radius(i) * real::sinf(angle), 0.5]
        };
        (0..n).map(corner).collect()
    }

    #[test]
    fn convex_and_star_shaped_polygons_are_covered_once() {
        covers(&star(4, |_| 1.0, 1.0));
        covers(&star(5000, |_| 1.0, 1.0));
        for seed in 0..50 {
            let radius = |i| 0.2 + unit_f32(hash2(i, seed));
            covers(&star(7 + 5 * seed, radius, 1.0));
            covers(&star(7 + 5 * seed, radius, -1.0));
        }
    }

    #[test]
    fn combs_and_collinear_corners() {
        // Teeth of a comb: every second corner is reflex.
        let tooth = |i: u16| [f32::from(i), if i.is_multiple_of(2) { 10.0 } else { 1.0 }, 0.0];
        let mut comb: Vec<_> = (0..2001).rev().map(tooth).collect();
        comb.extend([[0.0, 0.0, 0.0], [2000.0, 0.0, 0.0]]);
        covers(&comb);
        let side = |n: u16, f: &dyn Fn(f32) -> [f32; 3]| {
            (0..n).map(|i| f(f32::from(i) / f32::from(n))).collect::<Vec<_>>()
        };
        let square = [
            side(64, &|t| [t, 0.0, 0.0]),
            side(64, &|t| [1.0, t, 0.0]),
            side(64, &|t| [1.0 - t, 1.0, 0.0]),
            side(64, &|t| [0.0, 1.0 - t, 0.0]),
        ];
        covers(&square.concat());
    }

    #[test]
    fn a_hole_with_a_bridge_is_left_open() {
        let p = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0], [1, 1], [1, 3], [3, 3], [3, 1], [1, 1]];
        let p: Vec<_> = p.map(|[x, y]| [x as f32, y as f32, 0.0]).into();
        covers(&p);
    }

    #[test]
    fn nonsense_ends() {
        let mut count = 0;
        let mut cut = |p: &[[f32; 3]]| Triangulator::new().cut(p.len(), |i| p[i], |_| count += 1);
        cut(&[[0.0; 3]; 9]);
        cut(&[[f32::NAN; 3]; 9]);
        cut(&[[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.3, 9.0, f32::INFINITY]]);
        // A bow tie of many corners at random places crosses itself everywhere.
        let random = |i: u32| [unit_f32(hash2(i, 1)), unit_f32(hash2(i, 2)), unit_f32(hash2(i, 3))];
        cut(&(0..300).map(random).collect::<Vec<_>>());
        assert_eq!(count, 7 + 7 + 3 + 298);
    }
}
