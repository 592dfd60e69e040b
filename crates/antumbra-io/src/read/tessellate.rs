//! Meshes of round shapes, and normals of meshes: what readers of shapes share.

use std::f64::consts::PI;

use antumbra::scene::Mesh;
use antumbra_math::{DVec3, Transform, real};

/// Steps around a round shape. The corners of 256 lie 7·10⁻⁵ of the radius outside of its sides.
pub(super) const AROUND: u32 = 256;
/// Steps from pole to pole.
pub(super) const DOWN: u32 = 128;

/// The length of vectors that are equally long and at right angles (to 10⁻⁴, what hand-written matrices keep).
pub(super) fn similar(axes: &[DVec3]) -> Option<f32> {
    let length = axes[0].length();
    let fits = |x: f64| x.abs() <= 1e-4 * length * length;
    let square = |a: &DVec3| fits(a.length_squared() - length * length);
    let right = |i: usize| (0..i).all(|j| fits(axes[i].dot(axes[j])));
    let all = length > 0.0 && axes.iter().all(square) && (0..axes.len()).all(right);
    all.then_some(length as f32)
}

/// The images of the axes.
pub(super) fn axes(t: &Transform) -> [DVec3; 3] {
    [t.linear.x_axis, t.linear.y_axis, t.linear.z_axis]
}

/// The sphere of radius 1; u runs around +z, v from +z down.
pub(crate) fn ball(flipped: bool) -> Mesh {
    let at = |i: u32, j: u32| {
        let theta = PI * f64::from(j) / f64::from(DOWN);
        // Both poles are points, and the last meridian is the first to the bit.
        let r = if j == 0 || j == DOWN { 0.0 } else { real::sin(theta) };
        ring(i) * r + DVec3::Z * real::cos(theta)
    };
    grid(DOWN, flipped, at, at)
}

/// The disk of radius 1 that faces +z (−z if `turned`) with its area kept; u is the radius, v the angle.
pub(crate) fn fan(turned: bool) -> Mesh {
    // The polygon's area is n/2·sin(2π/n) r² where the disk's is π.
    let step = 2.0 * PI / f64::from(AROUND);
    let radius = (PI / (0.5 * f64::from(AROUND) * real::sin(step))).sqrt();
    let mut mesh = Mesh::default();
    let mut uvs = Vec::new();
    for i in 0..=AROUND {
        let (angle, v) = (step * f64::from(i % AROUND), i as f32 / AROUND as f32);
        let rim = DVec3::new(real::cos(angle), real::sin(angle), 0.0) * radius;
        mesh.triangles.vertices.extend([[0.0; 3], rim.as_vec3().to_array()]);
        uvs.extend([[0.0, v], [1.0, v]]);
        if i < AROUND {
            let (center, here, next) = (2 * i, 2 * i + 1, 2 * i + 3);
            mesh.triangles.indices.push(if turned { [center, next, here] } else { [center, here, next] });
        }
    }
    mesh.uvs[0] = Some(uvs);
    mesh
}

/// The side of the cylinder of radius 1 from z = 0 to 1.
pub(crate) fn tube(flipped: bool) -> Mesh {
    grid(1, flipped, |i, j| ring(i) + DVec3::Z * f64::from(j), |i, _| ring(i))
}

/// Place i on the circle.
fn ring(i: u32) -> DVec3 {
    sector(i, 2.0 * PI)
}

/// Place i on a part of the circle; the end of the whole circle is its begin to the bit.
pub(super) fn sector(i: u32, angle: f64) -> DVec3 {
    let i = if angle >= 2.0 * PI { i % AROUND } else { i };
    let phi = angle * f64::from(i) / f64::from(AROUND);
    DVec3::new(real::cos(phi), real::sin(phi), 0.0)
}

/// A grid around z with points and normals at (i, j), j from 0 to `down`.
pub(super) fn grid(
    down: u32,
    flipped: bool,
    point: impl Fn(u32, u32) -> DVec3,
    normal: impl Fn(u32, u32) -> DVec3,
) -> Mesh {
    let mut mesh = Mesh::default();
    let (mut normals, mut uvs) = (Vec::new(), Vec::new());
    let side = if flipped { -1.0 } else { 1.0 };
    for j in 0..=down {
        for i in 0..=AROUND {
            mesh.triangles.vertices.push(point(i, j).as_vec3().to_array());
            normals.push((normal(i, j) * side).as_vec3().to_array());
            uvs.push([i as f32 / AROUND as f32, j as f32 / down as f32]);
        }
    }
    let at = |i: u32, j: u32| j * (AROUND + 1) + i;
    for j in 0..down {
        for i in 0..AROUND {
            // Seen from outside: a above b (or below, for a tube), c and d one step on.
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)];
            let both = [[a, b, d], [a, d, c]];
            mesh.triangles.indices.extend(both.map(|[a, b, c]| if flipped { [a, c, b] } else { [a, b, c] }));
        }
    }
    let whole = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| mesh.triangles.vertices[i as usize]);
        a != b && b != c && a != c
    };
    let kept: Vec<_> = mesh.triangles.indices.iter().copied().filter(whole).collect();
    mesh.triangles.indices = kept;
    (mesh.normals, mesh.uvs[0]) = (Some(normals), Some(uvs));
    face_the_normals(&mut mesh);
    mesh
}

/// Turns triangles round that face away from their normals: the side of a surface is that of its normals.
pub(super) fn face_the_normals(mesh: &mut Mesh) {
    let Some(normals) = &mesh.normals else { return };
    let wide = |v: [f32; 3]| DVec3::from(v.map(f64::from));
    for triangle in &mut mesh.triangles.indices {
        let [a, b, c] = triangle.map(|i| wide(mesh.triangles.vertices[i as usize]));
        let mean: DVec3 = triangle.iter().map(|i| wide(normals[*i as usize])).sum();
        if (b - a).cross(c - a).dot(mean) < 0.0 {
            triangle.swap(1, 2);
        }
    }
}

/// Turns a mesh round, with its normals.
pub(super) fn flip(mesh: &mut Mesh) {
    mesh.triangles.indices.iter_mut().for_each(|t| t.swap(1, 2));
    mesh.normals.iter_mut().flatten().for_each(|n| *n = n.map(|c| -c));
}

/// Normals of vertices: those of their faces, weighed by the angle of the corner (Thürmer and Wüthrich 1998, "Computing
/// Vertex Normals from Polygonal Facets").
pub(super) fn smooth(mesh: &Mesh) -> Vec<[f32; 3]> {
    let vertices = &mesh.triangles.vertices;
    let at = |i: u32| DVec3::from(vertices[i as usize].map(f64::from));
    let mut sums = vec![DVec3::ZERO; vertices.len()];
    for t in &mesh.triangles.indices {
        let p = t.map(at);
        let n = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
        for i in 0..3 {
            let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
            sums[t[i] as usize] += n * real::atan2(a.cross(b).length(), a.dot(b));
        }
    }
    sums.into_iter().map(|s| s.normalize_or(DVec3::X).as_vec3().to_array()).collect()
}
