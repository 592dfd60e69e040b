//! The law as geometry over big integers: no formula of the crate, no rounding. It intersects the line with the plane
//! and asks for each edge on which side of it the point lies.

use num_bigint::{BigInt, Sign};

type Big3 = [BigInt; 3];

/// A line in exact numbers.
pub struct ExactLine {
    pub o: [f64; 3],
    pub to: To,
    pub tmax: f64,
}

/// Where it goes.
pub enum To {
    Point([f64; 3]),
    Direction([f64; 3]),
}

/// t = v / d in units where the numbers are integers.
pub struct Crossing {
    v: BigInt,
    d: BigInt,
}

impl Crossing {
    /// |t − v/d| ≤ 2^−bits · v/d.
    pub fn is_close(&self, t: f64, bits: u32) -> bool {
        let (mantissa, exponent) = parts(t);
        // Both sides times d · 2^(−exponent) where exponent < 0.
        let (mut got, mut want) = (BigInt::from(mantissa) * &self.d, self.v.clone());
        if exponent < 0 {
            want <<= -exponent;
        } else {
            got <<= exponent;
        }
        abs(&(got - &want)) << bits <= abs(&want)
    }
}

/// Some iff the open line meets the closed triangle and is not parallel to its plane.
pub fn crossing(line: &ExactLine, corners: [[f32; 3]; 3]) -> Option<Crossing> {
    let corners = corners.map(|c| c.map(f64::from));
    let end = match line.to {
        To::Point(q) => q,
        To::Direction(d) => d,
    };
    let all = corners.iter().flatten().chain(&line.o).chain(&end);
    let unit = all.filter(|x| **x != 0.0).map(|x| parts(*x).1).min().unwrap_or(0);
    let big3 = |v: [f64; 3]| v.map(|x| big(x, unit));
    let ([a, b, c], o, end) = (corners.map(big3), big3(line.o), big3(end));
    let d = if matches!(line.to, To::Point(_)) { sub(&end, &o) } else { end };

    let n = cross(&sub(&b, &a), &sub(&c, &a));
    let (mut v, mut det) = (dot(&n, &sub(&a, &o)), dot(&n, &d));
    if det.sign() == Sign::Minus {
        (v, det) = (-v, -det);
    }
    if det.sign() == Sign::NoSign || v.sign() != Sign::Plus || !is_before(&v, &det, line.tmax) {
        return None;
    }
    // det · (hit point − start of the edge), turned against the normal.
    let inside = [(&a, &b), (&b, &c), (&c, &a)].iter().all(|(p, q)| {
        let from_p = [0, 1, 2].map(|k| (&o[k] - &p[k]) * &det + &d[k] * &v);
        dot(&n, &cross(&sub(q, p), &from_p)).sign() != Sign::Minus
    });
    inside.then_some(Crossing { v, d: det })
}

/// v / d < tmax, d > 0.
fn is_before(v: &BigInt, d: &BigInt, tmax: f64) -> bool {
    if tmax == f64::INFINITY {
        return true;
    }
    let (mantissa, exponent) = parts(tmax);
    let far = BigInt::from(mantissa) * d;
    if exponent < 0 { v << -exponent < far } else { *v < far << exponent }
}

/// x = mantissa · 2^exponent.
fn parts(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let field = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (m, e) = if field == 0 { (fraction, -1074) } else { (fraction | 1 << 52, field - 1075) };
    // Trailing zeros go to the exponent: smaller integers.
    let zeros = if m == 0 { 0 } else { m.trailing_zeros() };
    (if x < 0.0 { -(m >> zeros) } else { m >> zeros }, e + zeros as i32)
}

fn big(x: f64, unit: i32) -> BigInt {
    let (m, e) = parts(x);
    if m == 0 { BigInt::ZERO } else { BigInt::from(m) << (e - unit) }
}

fn abs(x: &BigInt) -> BigInt {
    BigInt::from(x.magnitude().clone())
}

fn sub(a: &Big3, b: &Big3) -> Big3 {
    [0, 1, 2].map(|k| &a[k] - &b[k])
}

fn dot(a: &Big3, b: &Big3) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}

fn cross(a: &Big3, b: &Big3) -> Big3 {
    [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &a[i] * &b[j] - &a[j] * &b[i])
}
