//! How long readers take against reading the bytes: a PLY of 10⁶ triangles and a GLB of 100 MB, warm page cache.
//!
//! `cargo bench --profile demo -p antumbra-io --bench reading`; `ANTUMBRA_DETAIL` scales the files, `ANTUMBRA_ROUNDS`
//! says how often each is read, `ANTUMBRA_RESULT` names a JSON file for the times.

use std::fs;
use std::path::Path;
use std::time::Instant;

use antumbra::scene::{Body, SceneBuilder};
use antumbra_io::{Format, Limits, MemoryFiles, read};

/// A field of (n + 1)² vertices.
fn vertices(n: u32) -> impl Iterator<Item = [f32; 3]> {
    let height = |x: u32, z: u32| ((x * 7 + z * 13) % 31) as f32 * 0.01;
    (0..=n).flat_map(move |z| (0..=n).map(move |x| [x as f32, height(x, z), z as f32]))
}

/// Its 2 n² triangles.
fn triangles(n: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..n * n * 2).map(move |i| {
        let (x, z) = (i / 2 % n, i / 2 / n);
        let a = z * (n + 1) + x;
        if i % 2 == 0 { [a, a + n + 1, a + 1] } else { [a + 1, a + n + 1, a + n + 2] }
    })
}

fn ply(n: u32) -> Vec<u8> {
    let mut out = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        (n + 1) * (n + 1),
        2 * n * n
    )
    .into_bytes();
    vertices(n).flatten().for_each(|c| out.extend(c.to_le_bytes()));
    for t in triangles(n) {
        out.push(3);
        t.iter().for_each(|i| out.extend(i.to_le_bytes()));
    }
    out
}

/// Positions, normals, texture coordinates and indices.
fn glb(n: u32) -> Vec<u8> {
    let (v, t) = ((n + 1) * (n + 1), 2 * n * n);
    let mut bin = Vec::new();
    vertices(n).flatten().for_each(|c| bin.extend(c.to_le_bytes()));
    vertices(n).for_each(|_| [0f32, 1.0, 0.0].iter().for_each(|c| bin.extend(c.to_le_bytes())));
    vertices(n).for_each(|p| [p[0], p[2]].iter().for_each(|c| bin.extend(c.to_le_bytes())));
    triangles(n).flatten().for_each(|i| bin.extend(i.to_le_bytes()));
    let parts = [
        (12 * v, v, 5126, "VEC3"),
        (12 * v, v, 5126, "VEC3"),
        (8 * v, v, 5126, "VEC2"),
        (12 * t, 3 * t, 5125, "SCALAR"),
    ];
    let (mut views, mut accessors, mut offset) = (Vec::new(), Vec::new(), 0);
    for (i, (bytes, count, component, kind)) in parts.iter().enumerate() {
        views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{bytes}}}"#));
        accessors.push(format!(
            r#"{{"bufferView":{i},"componentType":{component},"count":{count},"type":"{kind}"}}"#
        ));
        offset += bytes;
    }
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],
        "accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{offset}}}]}}"#,
        accessors.join(","),
        views.join(",")
    );
    json.extend(std::iter::repeat_n(' ', (4 - json.len() % 4) % 4));
    let words =
        |out: &mut Vec<u8>, list: &[usize]| list.iter().for_each(|w| out.extend((*w as u32).to_le_bytes()));
    let mut out = b"glTF".to_vec();
    words(&mut out, &[2, 28 + json.len() + bin.len(), json.len()]);
    out.extend(b"JSON");
    out.extend(json.as_bytes());
    words(&mut out, &[bin.len()]);
    out.extend(b"BIN\0");
    out.extend(bin);
    out
}

/// Time [s] of some work; dropping what it made does not count.
fn timed<T>(work: impl FnOnce() -> T) -> f64 {
    let begin = Instant::now();
    let out = work();
    let took = begin.elapsed().as_secs_f64();
    drop(out);
    took
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn drawn(scene: &SceneBuilder) -> usize {
    let of =
        |b: &Body| if let Body::Mesh(m) = b { scene.meshes[*m as usize].triangles.indices.len() } else { 0 };
    scene.objects.iter().map(|o| of(&o.body)).sum()
}

/// Reads the bytes and makes a builder of them, in turn; returns what it found as JSON.
fn race(name: &str, format: Format, bytes: Vec<u8>, folder: &Path) -> Result<String, String> {
    let path = folder.join(name);
    fs::write(&path, &bytes).map_err(|e| e.to_string())?;
    let parse = || read(format, &bytes, &MemoryFiles::default(), &Limits::default());
    let triangles = drawn(&parse().map_err(|e| e.to_string())?);
    let (mut reading, mut building) = (Vec::new(), Vec::new());
    for _ in 0..number("ANTUMBRA_ROUNDS", 9.0) as usize {
        reading.push(timed(|| fs::read(&path)));
        building.push(timed(parse));
    }
    let ratios: Vec<f64> = building.iter().zip(&reading).map(|(b, r)| b / r).collect();
    println!(
        "{name:<12} {:>6.1} MB  {triangles:>9} triangles  bytes {:>6.1} ms  bytes → builder {:>6.1} ms  ratio {:.2}",
        bytes.len() as f64 / 1e6,
        median(&reading) * 1e3,
        median(&building) * 1e3,
        median(&ratios)
    );
    Ok(format!(
        "{{\"name\": \"{name}\", \"bytes\": {}, \"triangles\": {triangles}, \"reading\": {reading:?}, \
         \"building\": {building:?}}}",
        bytes.len()
    ))
}

/// A number from the environment.
fn number(name: &str, without: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(without)
}

fn main() -> Result<(), String> {
    let edge = number("ANTUMBRA_DETAIL", 1.0).sqrt();
    let folder = std::env::temp_dir().join(format!("antumbra-reading-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
    let found = [
        ("field.ply", Format::Ply, ply((708.0 * edge) as u32)),
        ("field.glb", Format::Gltf, glb((1336.0 * edge) as u32)),
    ]
    .map(|(name, format, bytes)| race(name, format, bytes, &folder));
    fs::remove_dir_all(&folder).map_err(|e| e.to_string())?;
    let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
    match std::env::var("ANTUMBRA_RESULT") {
        Ok(file) => {
            fs::write(&file, format!("[{}]\n", found.join(",\n"))).map_err(|e| format!("{file}: {e}"))
        }
        Err(_) => Ok(()),
    }
}
