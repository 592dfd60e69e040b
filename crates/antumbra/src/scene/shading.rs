//! The shading frame: normals interpolated between corners and bent by a picture of normals.

use antumbra_math::{DVec3, Frame, Vec3, World};

use super::{Body, BumpMap, NormalMap, Placed, Scene, SceneMesh, Tangents};

impl Scene {
    /// The frame about the interpolated normal, bent by the normal map and the heights, on the viewer's side of both surface
    /// and normal.
    #[inline]
    pub(super) fn shading_frame(&self, object: &Placed, local: u32, uv: [f32; 2], seen: &Seen) -> Frame {
        let Seen { ng, front, wo, normal, bump } = *seen;
        let Body::Mesh(mesh) = object.body else { return Frame::about(ng) };
        let mesh = &self.meshes[mesh as usize];
        let outside = if front { ng } else { -ng };
        let n = match &mesh.normals {
            Some(normals) => interpolated_normal(mesh, normals, object, local, uv),
            None if mesh.tangents.is_some() || bump.is_some() => outside,
            None => return Frame::about(ng),
        };
        if mesh.tangents.is_none() && bump.is_none() {
            return visible_frame(if front { n } else { -n }, ng, wo);
        }
        let plane = mesh.tangents.as_ref().map(|t| tangent_plane(mesh, t, object, local, uv, n));
        let mapped = plane.zip(normal).map(|([t, b], map)| {
            let texture = &self.textures[map.texture as usize];
            let [x, y, z, _] = texture.at(mesh.uv_at(texture.uv_set, local, uv)).map(|c| 2.0 * c - 1.0);
            (t * (map.scale * x) + b * (map.scale * y) + n * z).normalize_or_zero()
        });
        let n = mapped.filter(|bent| *bent != Vec3::ZERO).unwrap_or(n);
        let n = bump.and_then(|map| self.bumped(map, object, local, uv, [n, outside])).unwrap_or(n);
        let n = facing(if front { n } else { -n }, wo);
        let frame = visible_frame(n, ng, wo);
        plane.map_or(frame, |[t, _]| frame.turned_to(t))
    }

    /// The normal of the surface raised by its heights h along n: that of ∂p/∂u + n ∂h/∂u and ∂p/∂v + n ∂h/∂v, with the
    /// flat surface's derivatives put across n first (Blinn 1978; Mitsuba's `bumpmap` does the same). `None` where the
    /// texture coordinates span nothing.
    fn bumped(
        &self,
        map: BumpMap,
        object: &Placed,
        local: u32,
        uv: [f32; 2],
        [n, outside]: [Vec3; 2],
    ) -> Option<Vec3> {
        let Body::Mesh(mesh) = object.body else { return None };
        let mesh = &self.meshes[mesh as usize];
        let texture = &self.textures[map.texture as usize];
        let [along_u, along_v] = mesh.derivatives(texture.uv_set, local)?.map(|d| match &object.transform {
            None => d,
            Some(place) => place.vector(d),
        });
        let slope = texture.slope(mesh.uv_at(texture.uv_set, local, uv)).map(|s| f64::from(s * map.scale));
        let n = n.as_dvec3();
        let raised = |d: DVec3, s: f64| d + n * (s - n.dot(d));
        let bent = raised(along_u, slope[0]).cross(raised(along_v, slope[1])).normalize_or_zero().as_vec3();
        (bent != Vec3::ZERO && bent.is_finite()).then_some(if bent.dot(outside) < 0.0 { -bent } else { bent })
    }
}

impl SceneMesh {
    /// ∂p/∂u and ∂p/∂v over a triangle, in the numbers of the mesh; `None` where the coordinates span nothing.
    fn derivatives(&self, set: u8, local: u32) -> Option<[DVec3; 2]> {
        let uvs = self.uvs.get(set as usize)?.as_ref()?;
        let corners = self.triangles.indices[local as usize];
        let [a, b, c] = self.triangles.corners(local as usize).map(|c| DVec3::from(c.map(f64::from)));
        let [ta, tb, tc] = corners.map(|v| uvs[v as usize].map(f64::from));
        let ([u1, v1], [u2, v2]) = ([tb[0] - ta[0], tb[1] - ta[1]], [tc[0] - ta[0], tc[1] - ta[1]]);
        let (p1, p2, area) = (b - a, c - a, u1 * v2 - v1 * u2);
        (area != 0.0).then(|| [(p1 * v2 - p2 * v1) / area, (p2 * u1 - p1 * u2) / area])
    }
}

/// How a surface is seen.
pub(super) struct Seen {
    pub(super) ng: Vec3,
    pub(super) front: bool,
    pub(super) wo: World,
    /// What bends the normal.
    pub(super) normal: Option<NormalMap>,
    pub(super) bump: Option<BumpMap>,
}

/// Normals stand at the corners in world space, of length 1, before they are interpolated: copies and instances of a
/// stretched mesh look the same.
fn interpolated_normal(
    mesh: &SceneMesh,
    normals: &[[f32; 3]],
    object: &Placed,
    local: u32,
    uv: [f32; 2],
) -> Vec3 {
    let n = match &object.transform {
        None => DVec3::from(mesh.interpolate(normals, local, uv).map(f64::from)),
        Some(t) => {
            let corner = |v: u32| t.normal(DVec3::from(normals[v as usize].map(f64::from)));
            let [a, b, c] = mesh.triangles.indices[local as usize].map(|v| corner(v).normalize_or_zero());
            let [u, v] = uv.map(f64::from);
            a * (1.0 - u - v) + b * u + c * v
        }
    };
    n.normalize_or_zero().as_vec3()
}

/// Tangent and bitangent at a point, in world space; about of length 1.
fn tangent_plane(
    mesh: &SceneMesh,
    tangents: &Tangents,
    object: &Placed,
    local: u32,
    uv: [f32; 2],
    n: Vec3,
) -> [Vec3; 2] {
    let corners = tangents.corners(&mesh.triangles.indices, local);
    let [x, y, z, w] = std::array::from_fn(|k| {
        corners[0][k] * (1.0 - uv[0] - uv[1]) + corners[1][k] * uv[0] + corners[2][k] * uv[1]
    });
    let t = match &object.transform {
        None => Vec3::new(x, y, z),
        Some(place) => place.vector(DVec3::new(x.into(), y.into(), z.into())).normalize_or_zero().as_vec3(),
    };
    let turned = object.transform.is_some_and(|place| place.mirrors());
    [t, n.cross(t) * if turned { -w } else { w }]
}

/// The nearest normal to `n` that does not turn away from the viewer: what a bent normal shows is seen at a grazing angle.
fn facing(n: Vec3, wo: World) -> Vec3 {
    /// The least cosine between a bent normal and the viewer.
    const LEAST: f32 = 0.01;
    let cos = n.dot(wo);
    if cos >= LEAST { n } else { (n + wo * (LEAST - cos)).normalize_or_zero() }
}

/// The frame about `n`. A normal that turns away from the viewer or from its own face cannot bend the BSDF: then about
/// the face's.
fn visible_frame(n: Vec3, ng: Vec3, wo: World) -> Frame {
    if n.dot(ng) > 0.0 && n.dot(wo) > 0.0 { Frame::about(n) } else { Frame::about(ng) }
}
